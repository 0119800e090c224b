//! The environment as written in a scene file.

use super::{Emission, Polarization, Reflectance};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The environment: the radiance that reaches the scene from all around.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
#[expect(clippy::large_enum_variant, reason = "a scene has one of them")]
pub enum Environment {
    /// The same radiance from every direction.
    Constant {
        /// The radiance.
        emission: Emission,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, it shares a group with all emitters
        /// of the same spectrum that name none.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
    },
    /// A picture of all directions by longitude and latitude. Its center is toward −Z, its right half toward +X, its top toward +Y.
    Image {
        /// A Radiance file (.hdr) or an OpenEXR file; relative to the scene file. Colors are linear with the primaries of sRGB: each
        /// becomes a smooth spectrum times the illuminant, so that (1, 1, 1) is the illuminant itself. The spectra of a spectral OpenEXR
        /// file are used unchanged.
        image: PathBuf,
        /// The color layer to use from an OpenEXR file with several: the part of its channels' names before the last dot, such as
        /// "ViewLayer.Combined" in `ViewLayer.Combined.R`. When absent, the only layer, or plain R, G and B.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        layer: Option<String>,
        /// Factor of the radiance.
        #[serde(default = "one")]
        #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
        scale: f64,
        /// The illuminant that white in the picture stands for; "D65" when absent. Not for a spectral file.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        illuminant: Option<String>,
        /// Rotation of the environment about +Y in degrees, from +Z toward +X.
        #[serde(default)]
        #[schemars(range(min = limits::ROTATION_DEG.low, max = limits::ROTATION_DEG.high))]
        rotation_deg: f64,
        /// The polarization, the same in every direction; unpolarized when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        polarization: Option<Polarization>,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, it shares a group with all emitters
        /// of the same spectrum that name none.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
    },
    /// A clear daytime sky with its sun, over flat ground (Preetham, Shirley and Smits 1999), in W m⁻² sr⁻¹ nm⁻¹.
    Sky {
        /// Elevation of the sun above the horizon in degrees.
        #[schemars(range(min = limits::SUN_ELEVATION_DEG.low, max = limits::SUN_ELEVATION_DEG.high))]
        sun_elevation_deg: f64,
        /// Azimuth of the sun in degrees: 0 toward −Z, 90 toward +X.
        #[serde(default)]
        #[schemars(range(min = limits::ROTATION_DEG.low, max = limits::ROTATION_DEG.high))]
        sun_azimuth_deg: f64,
        /// Haze: 2 is very clear, 3 clear, 6 hazy.
        #[serde(default = "clear")]
        #[schemars(range(min = limits::TURBIDITY.low, max = limits::TURBIDITY.high))]
        turbidity: f64,
        /// Whether the sun's disk is visible and lights objects. Without it, only skylight lights objects.
        #[serde(default = "yes")]
        sun: bool,
        /// Reflectance of the ground, which the sky and the sun light, even if the sun's disk is off; 0.2 when absent.
        #[serde(default = "ground")]
        ground: Reflectance,
        /// Factor of the radiance.
        #[serde(default = "one")]
        #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
        scale: f64,
        /// The degree of polarization at 90° from the sun, where it is largest, by single Rayleigh scattering; measured clear skies reach
        /// 0.7 to 0.8. The sun's disk is unpolarized, and so is the sky when this is absent. It matters only with
        /// `render.polarization = true`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = limits::FRACTION.low, max = limits::FRACTION.high))]
        polarization_degree: Option<f64>,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, it shares a group with all emitters
        /// of the same spectrum that name none.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
        /// The light group of the sun's disk; the group of the sky when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        sun_light_group: Option<String>,
    },
    /// A mixture that depends on the elevation of the direction above the horizon.
    Gradient {
        /// Radiance from straight above.
        zenith: Emission,
        /// Radiance from the horizon.
        horizon: Emission,
        /// Radiance from straight below; the same as `horizon` when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        ground: Option<Emission>,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, each of the three shares a group
        /// with all emitters of its spectrum that name none.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
    },
}

fn one() -> f64 {
    1.0
}

fn yes() -> bool {
    true
}

fn clear() -> f64 {
    3.0
}

fn ground() -> Reflectance {
    Reflectance::Constant(0.2)
}
