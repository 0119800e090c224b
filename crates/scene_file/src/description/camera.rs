//! The camera as written in a scene file.

use super::Polarizer;
use crate::limits;
use scene::Filter;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The camera.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum Camera {
    /// All rays start at one point.
    Perspective {
        /// Position of the camera.
        position: [f64; 3],
        /// The point that appears at the center of the picture.
        look_at: [f64; 3],
        /// A direction that points up in the picture.
        #[serde(default = "up_default")]
        up: [f64; 3],
        /// Vertical field of view in degrees.
        #[schemars(range(min = limits::FOV_DEG.low, max = limits::FOV_DEG.high))]
        fov_deg: f64,
        /// The lens; without one, everything is in focus.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        lens: Option<Lens>,
        /// The reconstruction filter of the pixels.
        #[serde(default)]
        filter: Filter,
        /// A polarizer in front of the camera, which needs `render.polarization = true`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        polarizer: Option<Polarizer>,
    },
    /// All directions by longitude and latitude, which suits `environment = { type = "image" }`. The picture should be twice as wide as
    /// high.
    Panorama {
        /// Position of the camera.
        position: [f64; 3],
        /// The point that appears at the center of the picture; straight toward −Z when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        look_at: Option<[f64; 3]>,
        /// A direction that points up in the picture.
        #[serde(default = "up_default")]
        up: [f64; 3],
        /// The reconstruction filter of the pixels.
        #[serde(default)]
        filter: Filter,
        /// A polarizer in front of the camera, which needs `render.polarization = true`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        polarizer: Option<Polarizer>,
    },
    /// All rays are parallel.
    Orthographic {
        /// The point that the central ray starts from.
        position: [f64; 3],
        /// The point that appears at the center of the picture.
        look_at: [f64; 3],
        /// A direction that points up in the picture.
        #[serde(default = "up_default")]
        up: [f64; 3],
        /// Height of the picture in scene units.
        #[schemars(range(min = limits::LENGTH.low, max = limits::LENGTH.high))]
        height: f64,
        /// The reconstruction filter of the pixels.
        #[serde(default)]
        filter: Filter,
        /// A polarizer in front of the camera, which needs `render.polarization = true`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        polarizer: Option<Polarizer>,
    },
}

/// A thin lens.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lens {
    /// Radius of the aperture, in scene units; a larger one gives a smaller depth of field.
    #[schemars(range(min = limits::LENGTH.low, max = limits::LENGTH.high))]
    pub radius: f64,
    /// Distance to the plane in focus, along the view direction, in scene units; the distance to `look_at` when absent.
    #[schemars(range(min = limits::LENGTH.low, max = limits::LENGTH.high))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub focus_distance: Option<f64>,
}

impl Camera {
    /// The polarizer in front of it.
    pub fn polarizer(&self) -> Option<&Polarizer> {
        match self {
            Self::Perspective { polarizer, .. }
            | Self::Panorama { polarizer, .. }
            | Self::Orthographic { polarizer, .. } => polarizer.as_ref(),
        }
    }
}

fn up_default() -> [f64; 3] {
    [0.0, 1.0, 0.0]
}
