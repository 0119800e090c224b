//! Rough surfaces of a validated scene.

use crate::Energy;
use crate::rounding::RoundToF32;
use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The facets of a rough surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Microsurface {
    /// The distribution of their slopes.
    pub distribution: Distribution,
    /// Width α of the distribution along and across the grain; equal if there is no grain.
    pub roughness: [f64; 2],
    /// The direction of the grain.
    pub grain: Grain,
    /// The fraction of light that leaves without hitting another facet.
    pub energy: Arc<Energy>,
}

/// The direction of the grain of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grain {
    /// The surface is the same in all directions.
    None,
    /// Along a unit vector, projected onto the surface.
    Along(DVec3),
    /// In circles about an axis through the object's center, with this unit vector as its direction.
    Around(DVec3),
}

impl Microsurface {
    /// Whether the surface has a grain.
    pub fn is_brushed(&self) -> bool {
        self.grain != Grain::None
    }
}

/// The distribution of the slopes of a rough surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Distribution {
    /// A normal distribution of slopes (Beckmann and Spizzichino 1963).
    #[default]
    Beckmann,
    /// The distribution of Trowbridge and Reitz (1975), which Walter et al. (2007) call GGX: its highlights have long tails.
    Ggx,
}

impl RoundToF32 for Microsurface {
    fn rounded(&self) -> Self {
        Self {
            distribution: self.distribution,
            roughness: self.roughness.map(|alpha| alpha.rounded()),
            grain: match self.grain {
                Grain::None => Grain::None,
                Grain::Along(direction) => Grain::Along(direction.rounded()),
                Grain::Around(axis) => Grain::Around(axis.rounded()),
            },
            energy: Arc::new(self.energy.rounded()),
        }
    }
}
