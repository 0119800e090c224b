//! The environment as written.

use super::{Emission, Reflectance};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What surrounds the objects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
#[expect(clippy::large_enum_variant, reason = "a scene has one of them")]
pub enum Environment {
    /// The same radiance from every direction.
    Constant {
        /// The radiance.
        emission: Emission,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, that of all such lights
        /// with this spectrum.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
    },
    /// A picture of all directions by longitude and latitude. Its middle is toward −Z, its right half toward +X, its top toward
    /// +Y.
    Image {
        /// A Radiance file (.hdr) or an OpenEXR file; relative to the scene file. Colors are linear with the primaries of sRGB: each
        /// becomes a smooth spectrum times the illuminant's, so that (1, 1, 1) is the illuminant. The spectra of a spectral
        /// OpenEXR file are taken as they are.
        image: PathBuf,
        /// The layer of colors to take from an OpenEXR file of several: what stands before the last dot of its channels' names, as
        /// "ViewLayer.Combined" does in `ViewLayer.Combined.R`. When absent, the only one, or plain R, G and B.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        layer: Option<String>,
        /// Factor of all radiance.
        #[serde(default = "one")]
        #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
        scale: f64,
        /// The illuminant that white light in the picture has; "D65" when absent. Not for a spectral file.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        illuminant: Option<String>,
        /// By how many degrees the environment are turned about +Y, from +Z toward +X.
        #[serde(default)]
        #[schemars(range(min = limits::ROTATION_DEG.low, max = limits::ROTATION_DEG.high))]
        rotation_deg: f64,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, that of all such lights
        /// with this spectrum.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
    },
    /// A clear sky by day with its sun, over flat ground (Preetham, Shirley and Smits 1999), in W m⁻² sr⁻¹ nm⁻¹.
    Sky {
        /// Height of the sun over the horizon in degrees.
        #[schemars(range(min = limits::SUN_ELEVATION_DEG.low, max = limits::SUN_ELEVATION_DEG.high))]
        sun_elevation_deg: f64,
        /// Direction of the sun in degrees: 0 toward −Z, 90 toward +X.
        #[serde(default)]
        #[schemars(range(min = limits::ROTATION_DEG.low, max = limits::ROTATION_DEG.high))]
        sun_azimuth_deg: f64,
        /// Haze: 2 is very clear, 3 clear, 6 hazy.
        #[serde(default = "clear")]
        #[schemars(range(min = limits::TURBIDITY.low, max = limits::TURBIDITY.high))]
        turbidity: f64,
        /// Whether the sun's disk is there, which is seen and lights objects. Without it objects have skylight alone.
        #[serde(default = "yes")]
        sun: bool,
        /// Reflectance of the ground, which is lit by the sun, whether its disk is there or not, and by the sky; 0.2 when absent.
        #[serde(default = "ground")]
        ground: Reflectance,
        /// Factor of all radiance.
        #[serde(default = "one")]
        #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
        scale: f64,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, that of all such lights
        /// with this spectrum.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
        /// The light group of the sun's disk; that of the sky when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        sun_light_group: Option<String>,
    },
    /// A mixture by the height of the direction over the horizon.
    Gradient {
        /// Radiance from straight above.
        zenith: Emission,
        /// Radiance from the horizon.
        horizon: Emission,
        /// Radiance from straight below; that of the horizon when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        ground: Option<Emission>,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, each of
        /// the three belongs to that of all such lights with its spectrum.
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
