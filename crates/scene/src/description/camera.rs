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
    },
    /// All directions by longitude and latitude: a picture for `environment = { type = "image" }`. Best twice as wide as high.
    Panorama {
        /// Where the camera stands.
        position: [f64; 3],
        /// The point in the middle of the picture; straight towards −Z when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        look_at: Option<[f64; 3]>,
        /// A direction that points upwards in the picture.
        #[serde(default = "up_default")]
        up: [f64; 3],
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
    },
}

fn up_default() -> [f64; 3] {
    [0.0, 1.0, 0.0]
}
