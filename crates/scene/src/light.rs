//! Lights that are not objects, and all emitters that are sampled, in a validated scene.

use crate::Emission;
use crate::rounding::RoundToF32;
use glam::DVec3;

/// A light that is not an object. Rays do not hit it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Its position.
    pub shape: LightShape,
    /// Radiance of a disk; irradiance of a surface that faces light from a single direction; intensity of a point, or of a spot along its
    /// axis.
    pub emission: Emission,
}

/// The kind and position of a light that is not an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightShape {
    /// A disk in the sky, visible wherever nothing is in front of it.
    DistantDisk {
        /// Unit vector toward its center.
        toward: DVec3,
        /// 1 − cos of the angle between center and edge, > 0.
        height: f64,
    },
    /// Light from a single direction.
    Direction {
        /// Unit vector toward the light.
        toward: DVec3,
    },
    /// A point that emits equally in all directions.
    Point {
        /// Its position.
        position: DVec3,
    },
    /// A point that emits into a cone.
    Spot {
        /// Its position.
        position: DVec3,
        /// Unit vector in which it emits.
        axis: DVec3,
        /// 1 − cosine with the axis up to which the intensity is constant.
        full_height: f64,
        /// 1 − cosine with the axis beyond which the intensity is 0; more than `full_height`.
        edge_height: f64,
    },
}

/// An emitter that can be sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmitterSource {
    /// Its kind and index.
    pub kind: EmitterKind,
    /// What it emits.
    pub emission: Emission,
    /// Its visual brightness, up to a factor that all emitters share; never 0. It steers the choice among emitters.
    pub brightness: f64,
}

/// The kind of an emitter, and its index in the list of this kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EmitterKind {
    /// One of [`Scene::objects`](crate::Scene::objects) with bounds.
    Object(usize),
    /// One of [`Scene::environment_parts`](crate::Scene::environment_parts).
    Environment(usize),
    /// One of [`Scene::lights`](crate::Scene::lights) that is not a disk.
    Light(usize),
}

impl RoundToF32 for Light {
    fn rounded(&self) -> Self {
        Self {
            shape: self.shape.rounded(),
            emission: self.emission.rounded(),
        }
    }
}

impl RoundToF32 for LightShape {
    fn rounded(&self) -> Self {
        match self {
            Self::DistantDisk { toward, height } => Self::DistantDisk {
                toward: toward.rounded(),
                height: height.rounded(),
            },
            Self::Direction { toward } => Self::Direction {
                toward: toward.rounded(),
            },
            Self::Point { position } => Self::Point {
                position: position.rounded(),
            },
            Self::Spot {
                position,
                axis,
                full_height,
                edge_height,
            } => Self::Spot {
                position: position.rounded(),
                axis: axis.rounded(),
                full_height: full_height.rounded(),
                edge_height: edge_height.rounded(),
            },
        }
    }
}
