//! The camera of a validated scene.

use crate::PixelFilter;
use crate::rounding::RoundToF32;
use glam::DVec3;
use spectra::stokes::Polarizer;

/// A camera, whose rays start at one point, start on a lens, or are parallel.
///
/// `right`, `up` and `back` are orthonormal and are the columns of the rotation `world_from_camera`;
/// the camera looks along −`back`.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Position of the camera.
    pub origin: DVec3,
    /// +X of camera space: to the right in the picture.
    pub right: DVec3,
    /// +Y of camera space: up in the picture.
    pub up: DVec3,
    /// +Z of camera space: opposite to the view direction.
    pub back: DVec3,
    /// The projection.
    pub projection: Projection,
    /// The lens of a perspective camera; without one, everything is in focus.
    pub lens: Option<Lens>,
    /// The reconstruction filter of the pixels.
    pub filter: PixelFilter,
    /// The polarizer in front of the camera. It matters only to polarized light.
    pub polarizer: Option<Polarizer>,
}

/// A thin lens: objects at its focus distance are in focus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Radius of the aperture, in scene units.
    pub radius: f64,
    /// Distance to the plane in focus, along the view direction, in scene units.
    pub focus_distance: f64,
}

/// The projection of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// All rays start at the origin. `half_height` is tan(vertical field of view / 2).
    Perspective {
        /// Half the picture's height at distance 1.
        half_height: f64,
    },
    /// All directions from the origin by longitude, from left to right, and latitude; the center is −`back`, the top is `up`.
    Panorama,
    /// All rays are parallel.
    Orthographic {
        /// Half the picture's height in scene units.
        half_height: f64,
    },
}

impl Camera {
    /// Vertical field of view in degrees; `None` if rays are parallel or go in all directions.
    pub fn fov_deg(&self) -> Option<f64> {
        match self.projection {
            Projection::Perspective { half_height } => Some(2.0 * half_height.atan().to_degrees()),
            Projection::Orthographic { .. } | Projection::Panorama => None,
        }
    }
}

impl RoundToF32 for Camera {
    fn rounded(&self) -> Self {
        Self {
            origin: self.origin.rounded(),
            right: self.right.rounded(),
            up: self.up.rounded(),
            back: self.back.rounded(),
            projection: self.projection.rounded(),
            lens: self.lens.map(|lens| Lens {
                radius: lens.radius.rounded(),
                focus_distance: lens.focus_distance.rounded(),
            }),
            filter: self.filter.rounded(),
            // An angle decides over sines and cosines, which the renderers round.
            polarizer: self.polarizer,
        }
    }
}

impl RoundToF32 for Projection {
    fn rounded(&self) -> Self {
        match self {
            Self::Perspective { half_height } => Self::Perspective {
                half_height: half_height.rounded(),
            },
            Self::Panorama => Self::Panorama,
            Self::Orthographic { half_height } => Self::Orthographic {
                half_height: half_height.rounded(),
            },
        }
    }
}
