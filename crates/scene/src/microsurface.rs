//! Rough surfaces, in a validated scene.

use crate::Energy;
use crate::description::Distribution;
use glam::DVec3;
use std::sync::Arc;

/// The facets of a rough surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Microsurface {
    /// How their slopes are distributed.
    pub distribution: Distribution,
    /// Width α of the distribution along the grain and across it; alike where there is no grain.
    pub roughness: [f64; 2],
    /// Which way the grain runs.
    pub grain: Grain,
    /// How much light leaves it without meeting another facet.
    pub energy: Arc<Energy>,
}

/// Which way the grain of a surface runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grain {
    /// The surface is the same in all directions.
    None,
    /// Along a unit vector, as far as that lies in the surface.
    Along(DVec3),
    /// In circles about an axis of this direction, a unit vector, through the object's center.
    Around(DVec3),
}

impl Microsurface {
    /// Whether its directions differ.
    pub fn is_brushed(&self) -> bool {
        self.grain != Grain::None
    }
}
