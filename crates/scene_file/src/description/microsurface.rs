//! Roughness as written in a scene file.

use crate::limits;
use scene::Distribution;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How rough a surface is; smooth by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Finish {
    /// Roughness; smooth when absent.
    #[serde(default)]
    pub roughness: Roughness,
    /// The distribution of the slopes of a rough surface; "beckmann" when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distribution: Option<Distribution>,
    /// The direction of the grain, if `roughness` is `[along, across]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub brushed: Option<Brushed>,
}

/// Roughness of a surface: the width α of its distribution of slopes. For Beckmann's distribution α is the root mean square slope. It is 0
/// for a smooth surface, and otherwise from 0.02 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Roughness {
    /// The same in all directions.
    Even(#[schemars(range(min = 0.0, max = limits::ROUGHNESS.high))] f64),
    /// `[along, across]` the grain of a brushed surface; `brushed` gives the grain's direction.
    Brushed(
        #[schemars(inner(range(min = limits::ROUGHNESS.low, max = limits::ROUGHNESS.high)))]
        [f64; 2],
    ),
}

impl Default for Roughness {
    fn default() -> Self {
        Self::Even(0.0)
    }
}

/// The direction of the grain of a brushed surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Brushed {
    /// Along the same direction everywhere.
    Along {
        /// The direction, which is projected onto the surface.
        along: [f64; 3],
    },
    /// In circles about an axis through the object's center, as on a lathe-turned part.
    Around {
        /// Direction of the axis.
        around: [f64; 3],
    },
}
