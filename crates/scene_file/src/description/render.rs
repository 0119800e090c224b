//! How to render, as written in a scene file.

use crate::limits;
use scene::{DirectLight, RenderSettings, Sampler, WavelengthSampling};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How to render the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Render {
    /// Width and height of the picture in pixels.
    #[schemars(inner(range(min = 1, max = RenderSettings::MAX_SIDE)))]
    pub size: [u32; 2],
    /// Samples (paths) per pixel.
    #[schemars(range(min = 1, max = limits::MAX_SAMPLES))]
    pub samples: u32,
    /// Number of bands that the wavelength range is divided into.
    #[schemars(range(min = 1, max = spectra::BandGrid::MAX_COUNT))]
    pub bands: u32,
    /// First and last wavelength in nm.
    #[schemars(inner(range(min = limits::BAND_NM.low, max = limits::BAND_NM.high)))]
    pub wavelengths_nm: [f64; 2],
    /// Where the wavelengths of a sample lie in their bands.
    pub sampling: WavelengthSampling,
    /// Whether light is traced with its polarization, which takes more time and memory. Otherwise it counts as unpolarized at every surface.
    pub polarization: bool,
    /// Which emitters are kept apart in the spectral image, so that their lamps can be changed without rendering again.
    pub light_groups: LightGroups,
    /// The source of the random numbers that paths are sampled with.
    pub sampler: Sampler,
    /// How direct light at surfaces is sampled. All choices have the same expected value but different noise, except that "bsdf" never
    /// finds points, spots and light from a single direction; it is an error with them.
    pub direct_light: DirectLight,
    /// Chooses the sequence of random numbers.
    pub seed: u32,
    /// The maximum number of segments of a path. The camera ray is the first; the segment that reaches an emitter counts too.
    #[schemars(range(min = 1, max = RenderSettings::MAX_PATH_SEGMENTS))]
    pub max_path_segments: u32,
    /// How many of a path's first film hits follow both the reflection and the transmission, so that neither is left to chance. After
    /// those, and after a diffuse or rough surface, a path follows one of the two at random.
    #[schemars(range(max = RenderSettings::MAX_FILM_SPLITS))]
    pub film_splits: u32,
    /// The number of segments after which Russian roulette may end a path that carries little light. The result stays unbiased.
    #[schemars(range(min = 1, max = RenderSettings::MAX_PATH_SEGMENTS))]
    pub roulette_after: u32,
    /// The largest radiance that a sample may have in any band, in W m⁻² sr⁻¹ nm⁻¹: brighter samples are scaled down to it and keep their
    /// color. This removes rare bright dots (fireflies), and some light with them. When absent, the picture is unbiased.
    #[schemars(range(min = limits::CLAMP.low, max = limits::CLAMP.high))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clamp: Option<f64>,
    /// Exposure of the developed picture in stops: 0 shows radiance 1 at every wavelength, which is 72 983 cd/m², as white; log2(72 983 /
    /// L) shows L cd/m² as white.
    #[schemars(range(min = limits::EXPOSURE_EV.low, max = limits::EXPOSURE_EV.high))]
    pub exposure_ev: f64,
    /// Time of the picture in seconds, for thicknesses that change with time.
    #[schemars(range(min = limits::TIME_S.low, max = limits::TIME_S.high))]
    pub time_s: f64,
    /// Time from one frame of a sequence to the next, in seconds.
    #[schemars(range(min = limits::TIME_S.low, max = limits::TIME_S.high))]
    pub time_step_s: f64,
}

/// Which emitters are kept apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LightGroups {
    /// Each `light_group` is a group, and so is each different spectrum of the emitters that name none. If no emitter has a `light_group`
    /// and there are more than 32 spectra, all emitters form one group.
    #[default]
    BySpectrum,
    /// None: all emitters form one group, which takes the least memory and time.
    Single,
}

impl Default for Render {
    fn default() -> Self {
        Self {
            size: [640, 480],
            samples: 64,
            bands: 40,
            wavelengths_nm: [380.0, 780.0],
            sampling: WavelengthSampling::Random,
            polarization: false,
            light_groups: LightGroups::BySpectrum,
            sampler: Sampler::Sobol,
            direct_light: DirectLight::Both,
            seed: 0,
            max_path_segments: 12,
            film_splits: 1,
            roulette_after: 4,
            clamp: None,
            exposure_ev: 0.0,
            time_s: 0.0,
            time_step_s: 1.0 / 24.0,
        }
    }
}
