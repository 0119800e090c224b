//! The state of a path, and what steers it.

use crate::{Ray, SurfacePoint};
use glam::DVec3;

/// A path at its current end.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathState {
    pub(super) ray: Ray,
    /// The object on which the ray starts.
    pub(super) from_object: Option<usize>,
    /// The last scattering by a surface; `None` after the camera or a specular reflection.
    pub(super) scattered: Option<Scattered>,
    pub(super) segment: u32,
    /// Number of films at which the path will still be split.
    pub(super) splits: u32,
    /// Index of the branch, among those that splits made of the path.
    pub(super) branch: u32,
    /// Factor of the throughput: the inverse of the probabilities.
    pub(super) weight: f64,
    /// Rough estimate of the throughput, at the wavelength where it is largest; steers Russian roulette.
    pub(super) rr_throughput: f64,
}

/// The scattering of a path by a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scattered {
    pub(super) position: DVec3,
    pub(super) normal: DVec3,
    /// Density of the direction, sr⁻¹.
    pub(super) pdf: f64,
    /// The sum of the emitters' weights there.
    pub(super) emitter_weight_sum: f64,
}

impl PathState {
    /// Returns a path that starts with a ray from the camera.
    pub(super) fn new(ray: Ray, splits: u32) -> Self {
        Self {
            ray,
            from_object: None,
            scattered: None,
            segment: 1,
            splits,
            branch: 0,
            weight: 1.0,
            rr_throughput: 1.0,
        }
    }

    /// Reflects the path specularly at a point of an object.
    pub(super) fn mirror(&mut self, object: usize, point: &SurfacePoint) {
        let direction = self.ray.direction;
        let mirrored = direction - 2.0 * direction.dot(point.normal) * point.normal;
        self.ray.direction = mirrored.normalize();
        self.scattered = None;
        self.pass_through(object, point);
    }

    /// Passes the path straight through a film: the last scattering is kept.
    pub(super) fn pass_through(&mut self, object: usize, point: &SurfacePoint) {
        self.ray.origin = point.position;
        self.from_object = Some(object);
    }

    /// Scatters the path at an object, in a direction in world space. After that, films no longer split it.
    pub(super) fn scatter(&mut self, object: usize, direction: DVec3, scattered: Scattered) {
        self.splits = 0;
        self.ray = Ray {
            origin: scattered.position,
            direction,
        };
        self.from_object = Some(object);
        self.scattered = Some(scattered);
    }
}

impl Default for PathState {
    fn default() -> Self {
        let ray = Ray {
            origin: DVec3::ZERO,
            direction: DVec3::Z,
        };
        Self::new(ray, 0)
    }
}
