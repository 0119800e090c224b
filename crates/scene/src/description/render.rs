//! How to render, as written.

use crate::{DirectLight, RenderSettings, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the scene is rendered.
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
    /// Where in its band a sample's wavelength lies.
    pub sampling: WavelengthSampling,
    /// Which lights are kept apart in the spectral image, so that their lamps can be changed without rendering again.
    pub light_groups: LightGroups,
    /// Where the numbers come from that paths are drawn by.
    pub sampler: Sampler,
    /// How light that surfaces scatter is found. What each way finds is the same, its noise is not; but "bsdf" never finds points,
    /// spots and light from a single direction, and is refused with them.
    pub direct_light: DirectLight,
    /// Chooses the sequence of random numbers.
    pub seed: u32,
    /// The most segments of a path. The camera ray is the first; the one that reaches a light counts.
    #[schemars(range(min = 1, max = RenderSettings::MAX_PATH_SEGMENTS))]
    pub max_path_segments: u32,
    /// Film hits, the first of a path from the camera, at which it follows both the reflection and the transmission, so that neither
    /// is left to luck. After those, and after a diffuse or rough surface, one of both is drawn.
    #[schemars(range(max = RenderSettings::MAX_FILM_SPLITS))]
    pub film_splits: u32,
    /// Segments after which Russian roulette may end a path that carries little light. What is left of the light is right on average.
    #[schemars(range(min = 1, max = RenderSettings::MAX_PATH_SEGMENTS))]
    pub roulette_after: u32,
    /// The largest radiance that a sample may bring in any band, in W m⁻² sr⁻¹ nm⁻¹: brighter samples are dimmed to it, with their color. That takes
    /// away rare bright dots, and some of the light with them. Without it the picture is right on average.
    #[schemars(range(min = limits::CLAMP.low, max = limits::CLAMP.high))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clamp: Option<f64>,
    /// Exposure of the developed picture in stops: 0 shows radiance 1 at every wavelength as white, which is 72 983 cd/m²; so
    /// log2(72 983 / L) shows L cd/m² as white.
    #[schemars(range(min = limits::EXPOSURE_EV.low, max = limits::EXPOSURE_EV.high))]
    pub exposure_ev: f64,
    /// Time of the picture in seconds; thicknesses that change with time read it.
    #[schemars(range(min = limits::TIME_S.low, max = limits::TIME_S.high))]
    pub time_s: f64,
    /// Time from one frame of a sequence to the next, in seconds.
    #[schemars(range(min = limits::TIME_S.low, max = limits::TIME_S.high))]
    pub time_step_s: f64,
}

/// Where in its band a sample's wavelength lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WavelengthSampling {
    /// One offset is drawn per sample, for all bands: a band holds the mean over its width.
    #[default]
    Random,
    /// Always the center of the band: fixed wavelengths.
    Center,
}

/// Where the numbers come from that paths are drawn by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sampler {
    /// Sobol's sequence with Owen's scrambling: a pixel's samples are spread evenly, so that they err less. A number of samples
    /// that is a power of two serves best.
    #[default]
    Sobol,
    /// Independent random numbers.
    Independent,
}

/// Which lights are kept apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LightGroups {
    /// Those of each `light_group`, and of the lights without one those of each different spectrum. Where no light has a
    /// `light_group` and the spectra are more than 32, all lights are one group.
    #[default]
    BySpectrum,
    /// None: all lights are one group, which takes the least memory and time.
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
