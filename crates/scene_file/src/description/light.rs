//! Lights that are not objects, as written in a scene file.

use super::Emission;
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A light that is not an object, so that rays do not hit it. A distant light with a diameter is visible in front of the environment;
/// points, spots and distant lights without a diameter are visible only by the surfaces that they light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum Light {
    /// A light so far away that it has the same direction everywhere, such as the sun.
    Distant {
        /// What it emits.
        emission: Emission,
        /// Direction toward the light.
        direction: [f64; 3],
        /// Angular diameter in degrees: the sun's 0.533° when absent; 0 is light from a single direction.
        #[serde(default = "sun")]
        #[schemars(range(min = limits::ANGULAR_DIAMETER_DEG.low, max = limits::ANGULAR_DIAMETER_DEG.high))]
        diameter_deg: f64,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, it shares a group with all emitters
        /// of the same spectrum that name none.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
    },
    /// A point that emits equally in all directions.
    Point {
        /// What it emits.
        emission: Emission,
        /// Position.
        position: [f64; 3],
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, it shares a group with all emitters
        /// of the same spectrum that name none.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
    },
    /// A point that emits into a cone.
    Spot {
        /// What it emits.
        emission: Emission,
        /// Position.
        position: [f64; 3],
        /// Direction in which it shines.
        direction: [f64; 3],
        /// Full angle of the cone, from edge to edge, in degrees.
        #[schemars(range(min = limits::SPOT_DEG.low, max = limits::SPOT_DEG.high))]
        angle_deg: f64,
        /// Full angle of the inner cone of constant intensity, in degrees; between the two cones the intensity falls off smoothly. Four
        /// fifths of `angle_deg` when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.0, max = limits::SPOT_DEG.high))]
        full_angle_deg: Option<f64>,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, it shares a group with all emitters
        /// of the same spectrum that name none.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
    },
}

/// Mean angular diameter of the sun, degrees.
fn sun() -> f64 {
    0.533
}

impl Light {
    /// What it emits.
    pub fn emission(&self) -> &Emission {
        match self {
            Self::Distant { emission, .. }
            | Self::Point { emission, .. }
            | Self::Spot { emission, .. } => emission,
        }
    }

    /// The name of its light group.
    pub fn light_group(&self) -> Option<&str> {
        match self {
            Self::Distant { light_group, .. }
            | Self::Point { light_group, .. }
            | Self::Spot { light_group, .. } => light_group.as_deref(),
        }
    }
}
