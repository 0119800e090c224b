//! The camera as written.

use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where the scene is seen from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum Camera {
    /// All rays start at one point.
    Perspective {
        /// Where the camera stands.
        position: [f64; 3],
        /// The point in the middle of the picture.
        look_at: [f64; 3],
        /// A direction that points upwards in the picture.
        #[serde(default = "up_default")]
        up: [f64; 3],
        /// Vertical field of view in degrees.
        #[schemars(range(min = limits::FOV_DEG.low, max = limits::FOV_DEG.high))]
        fov_deg: f64,
        /// The lens; without one everything is sharp.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        lens: Option<Lens>,
        /// How a pixel gathers light from about its middle.
        #[serde(default)]
        filter: Filter,
    },
    /// All directions by longitude and latitude: a picture for `environment = { type = "image" }`. Best twice as wide as high.
    Panorama {
        /// Where the camera stands.
        position: [f64; 3],
        /// The point in the middle of the picture; straight toward −Z when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        look_at: Option<[f64; 3]>,
        /// A direction that points upwards in the picture.
        #[serde(default = "up_default")]
        up: [f64; 3],
        /// How a pixel gathers light from about its middle.
        #[serde(default)]
        filter: Filter,
    },
    /// All rays are parallel.
    Orthographic {
        /// The point that the middle ray starts from.
        position: [f64; 3],
        /// The point in the middle of the picture.
        look_at: [f64; 3],
        /// A direction that points upwards in the picture.
        #[serde(default = "up_default")]
        up: [f64; 3],
        /// Height of the picture in scene units.
        #[schemars(range(min = limits::LENGTH.low, max = limits::LENGTH.high))]
        height: f64,
        /// How a pixel gathers light from about its middle.
        #[serde(default)]
        filter: Filter,
    },
}

/// A thin lens.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lens {
    /// Radius of its opening, in scene units: the larger, the less is sharp.
    #[schemars(range(min = limits::LENGTH.low, max = limits::LENGTH.high))]
    pub radius: f64,
    /// Distance of the plane that is sharp, along the direction of view, in scene units; that of `look_at` where it is left out.
    #[schemars(range(min = limits::LENGTH.low, max = limits::LENGTH.high))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub focus_distance: Option<f64>,
}

/// How a pixel gathers light from about its middle, in x and in y alike.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Filter {
    /// Evenly from its own square.
    #[default]
    Box,
    /// By a normal distribution of standard deviation half a pixel, cut off at 1.5 pixels.
    Gaussian,
    /// By Blackman and Harris's window of 3 pixels' width (Harris, Proc. IEEE 66, 1978, four terms, −92 dB).
    BlackmanHarris,
}

fn up_default() -> [f64; 3] {
    [0.0, 1.0, 0.0]
}
