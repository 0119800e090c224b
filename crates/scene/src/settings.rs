//! How a validated scene is to be rendered.

use crate::Sampler;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use spectra::BandGrid;

/// How a scene is to be rendered.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
    /// Samples (paths) per pixel.
    pub samples: u32,
    /// Where the numbers come from that paths are drawn by.
    pub sampler: Sampler,
    /// Chooses the sequence of random numbers.
    pub seed: u32,
    /// Bands that each pixel has.
    pub bands: BandGrid,
    /// Where in its band a sample's wavelength lies.
    pub sampling: WavelengthSampling,
    /// The most segments of a path, from 1 to [`RenderSettings::MAX_PATH_SEGMENTS`]. The camera ray is the
    /// first; the one that reaches a light or the environment counts.
    pub max_path_segments: u32,
    /// How light that surfaces scatter is found.
    pub direct_light: DirectLight,
    /// Film hits, the first of a path, at which it follows both the reflection and the transmission; at most
    /// [`RenderSettings::MAX_FILM_SPLITS`].
    pub film_splits: u32,
    /// Segments after which Russian roulette may end a path.
    pub roulette_after: u32,
    /// The largest radiance that a sample may bring in any band, W m⁻² sr⁻¹ nm⁻¹; brighter ones are dimmed to it.
    pub clamp: Option<f64>,
    /// Exposure of the developed picture in stops: 0 shows radiance 1 at every wavelength, 72 983 cd/m², as white.
    pub exposure_ev: f64,
    /// Time of the picture, s. The thicknesses of the scene are those of this time already.
    pub time_s: f64,
}

impl RenderSettings {
    /// The longest path that can be asked for.
    pub const MAX_PATH_SEGMENTS: u32 = 32;
    /// The most film hits at which a path can be split: it then has 8 ends.
    pub const MAX_FILM_SPLITS: u32 = 3;
    /// The widest or highest picture that can be asked for.
    pub const MAX_SIDE: u32 = 32_768;
}

/// Where in its band a sample's wavelength lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WavelengthSampling {
    /// One offset is drawn per sample, for all bands: a band holds the mean over its width.
    Random,
    /// Always the center of the band: fixed wavelengths.
    Center,
}

/// How the light that reaches a surface straight from an emitter is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DirectLight {
    /// By emitter sampling and by BSDF sampling, weighted against each other (multiple importance sampling).
    #[default]
    Both,
    /// By emitter sampling alone.
    Emitters,
    /// By BSDF sampling alone, which never finds light from a point, a spot or a single direction.
    Bsdf,
}
