//! The polarization of emitted light, and polarizers, as written in a scene file.

use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The polarization of emitted light, the same at all wavelengths: either `stokes`, or `degree` with angles. It matters only with
/// `render.polarization = true`. Angles are counterclockwise for who receives the light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Polarization {
    /// S1, S2 and S3 relative to S0; √(S1² + S2² + S3²) is at most 1. S1 is what is polarized along the axis minus what is across it, S2 the
    /// same at +45° and −45°, S3 what is circularly polarized to the right minus to the left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = limits::STOKES.low, max = limits::STOKES.high)))]
    pub stokes: Option<[f64; 3]>,
    /// The degree of polarization: 0 is unpolarized, 1 fully polarized.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::FRACTION.low, max = limits::FRACTION.high))]
    pub degree: Option<f64>,
    /// With `degree`: the angle in degrees from the axis to the direction of polarization, the major axis of the ellipse; 0 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::POLARIZATION_DEG.low, max = limits::POLARIZATION_DEG.high))]
    pub angle_deg: Option<f64>,
    /// With `degree`: the ellipticity in degrees; 0 is linear, which is the default, 45 circular to the right, −45 to the left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::ELLIPTICITY_DEG.low, max = limits::ELLIPTICITY_DEG.high))]
    pub ellipticity_deg: Option<f64>,
    /// The reference axis, a direction in space. For each ray it is the part of it across the ray; light along the axis itself has any axis
    /// across the ray.
    pub axis: [f64; 3],
}

/// An ideal linear polarizer in front of the camera, which needs `render.polarization = true`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Polarizer {
    /// The direction of the electric field that passes, in degrees counterclockwise from the horizontal, as the camera sees it.
    #[schemars(range(min = limits::POLARIZATION_DEG.low, max = limits::POLARIZATION_DEG.high))]
    pub angle_deg: f64,
    /// A retarder in front of the polarizer, which light passes first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub retarder: Option<Retarder>,
}

/// A retarder, which delays light along its slow axis by either `retardance_deg` or `retardance_nm`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Retarder {
    /// The fast axis, in degrees counterclockwise from the horizontal, as the camera sees it.
    #[schemars(range(min = limits::POLARIZATION_DEG.low, max = limits::POLARIZATION_DEG.high))]
    pub fast_axis_deg: f64,
    /// The phase in degrees, the same at every wavelength: 90 for a quarter-wave plate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::RETARDANCE_DEG.low, max = limits::RETARDANCE_DEG.high))]
    pub retardance_deg: Option<f64>,
    /// The path difference in nm; the phase is 360° times this over the wavelength.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::RETARDANCE_NM.low, max = limits::RETARDANCE_NM.high))]
    pub retardance_nm: Option<f64>,
}
