//! How to render a validated scene.

use crate::rounding::RoundToF32;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use spectra::BandGrid;

/// How to render a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
    /// Samples (paths) per pixel.
    pub samples: u32,
    /// The source of the random numbers that paths are sampled with.
    pub sampler: Sampler,
    /// Chooses the sequence of random numbers.
    pub seed: u32,
    /// The bands of each pixel.
    pub bands: BandGrid,
    /// Where the wavelengths of a sample lie in their bands.
    pub sampling: WavelengthSampling,
    /// Whether light is traced with its polarization. Otherwise it is taken as unpolarized at every surface.
    pub polarization: bool,
    /// The maximum number of segments of a path, from 1 to [`RenderSettings::MAX_PATH_SEGMENTS`]. The camera ray is the first; the segment
    /// that reaches a light or the environment counts too.
    pub max_path_segments: u32,
    /// How direct light at surfaces is sampled.
    pub direct_light: DirectLight,
    /// How many of a path's first film hits follow both the reflection and the transmission; at most [`RenderSettings::MAX_FILM_SPLITS`].
    pub film_splits: u32,
    /// The number of segments after which Russian roulette may end a path.
    pub roulette_after: u32,
    /// The largest radiance that a sample may have in any band, W m⁻² sr⁻¹ nm⁻¹; brighter ones are scaled down to it.
    pub clamp: Option<f64>,
    /// Exposure of the developed picture in stops: 0 shows radiance 1 at every wavelength, 72 983 cd/m², as white.
    pub exposure_ev: f64,
    /// Time of the picture, s. The thicknesses of the scene are already evaluated at this time.
    pub time_s: f64,
}

impl RenderSettings {
    /// The largest allowed number of segments of a path.
    pub const MAX_PATH_SEGMENTS: u32 = 32;
    /// The largest allowed number of film hits that split a path: it then has 8 ends.
    pub const MAX_FILM_SPLITS: u32 = 3;
    /// The largest allowed width or height of a picture.
    pub const MAX_SIDE: u32 = 32_768;
}

/// Where the wavelengths of a sample lie in their bands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WavelengthSampling {
    /// One random offset per sample for all bands: the value of a band is the mean over its width.
    #[default]
    Random,
    /// Always the center of the band: fixed wavelengths.
    Center,
}

/// The source of the random numbers that paths are sampled with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sampler {
    /// The Owen-scrambled Sobol sequence: it spreads a pixel's samples evenly, which reduces noise. It works best when the number of
    /// samples is a power of two.
    #[default]
    Sobol,
    /// Independent random numbers.
    Independent,
}

/// How the light that reaches a surface directly from an emitter is sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DirectLight {
    /// By emitter sampling and BSDF sampling, combined by multiple importance sampling.
    #[default]
    Both,
    /// By emitter sampling alone.
    Emitters,
    /// By BSDF sampling alone, which never finds light from a point, a spot or a single direction.
    Bsdf,
}

impl RoundToF32 for RenderSettings {
    fn rounded(&self) -> Self {
        Self {
            width: self.width,
            height: self.height,
            samples: self.samples,
            sampler: self.sampler,
            seed: self.seed,
            // Validation has already rounded the ends of the bands.
            bands: self.bands,
            sampling: self.sampling,
            polarization: self.polarization,
            max_path_segments: self.max_path_segments,
            direct_light: self.direct_light,
            film_splits: self.film_splits,
            roulette_after: self.roulette_after,
            clamp: self.clamp.map(|clamp| clamp.rounded()),
            exposure_ev: self.exposure_ev.rounded(),
            // Thicknesses are already evaluated at this time, and no renderer uses it.
            time_s: self.time_s,
        }
    }
}
