//! The camera of a validated scene.

use crate::PixelFilter;
use glam::DVec3;

/// A camera: rays start at one point, on a lens, or run in parallel.
///
/// `right`, `up` and `back` are orthonormal and are the columns of the rotation `world_from_camera`;
/// the camera looks along −`back`.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Where the camera stands.
    pub origin: DVec3,
    /// +X of camera space: to the right in the picture.
    pub right: DVec3,
    /// +Y of camera space: upwards in the picture.
    pub up: DVec3,
    /// +Z of camera space: away from what is looked at.
    pub back: DVec3,
    /// How rays spread.
    pub projection: Projection,
    /// The lens of a perspective camera; without one everything is sharp.
    pub lens: Option<Lens>,
    /// How a pixel gathers light from about its middle.
    pub filter: PixelFilter,
}

/// A thin lens: what lies at its distance of focus is sharp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Radius of its opening, in scene units.
    pub radius: f64,
    /// Distance of the plane that is sharp, along the direction of view, in scene units.
    pub focus_distance: f64,
}

/// How the rays of a camera spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// All rays start at the origin. `half_height` is tan(vertical field of view / 2).
    Perspective {
        /// Half the picture's height at distance 1.
        half_height: f64,
    },
    /// All directions from the origin by longitude, from left to right, and latitude; the middle is −`back`, the top is `up`.
    Panorama,
    /// All rays are parallel.
    Orthographic {
        /// Half the picture's height in scene units.
        half_height: f64,
    },
}

impl Camera {
    /// Height of the view in degrees; `None` where rays are parallel or go everywhere.
    pub fn fov_deg(&self) -> Option<f64> {
        match self.projection {
            Projection::Perspective { half_height } => Some(2.0 * half_height.atan().to_degrees()),
            Projection::Orthographic { .. } | Projection::Panorama => None,
        }
    }
}
