//! Where a path is, and what steers it.

use crate::{Ray, SurfacePoint};
use glam::DVec3;

/// A path on its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathState {
    pub(super) ray: Ray,
    /// The object that the ray starts on.
    pub(super) from_object: Option<usize>,
    /// How a surface last scattered the path; none after the camera or a mirror.
    pub(super) scattered: Option<Scattered>,
    pub(super) segment: u32,
    /// Films at which it will still be split.
    pub(super) splits: u32,
    /// Which of the ways that splits made of the path it is.
    pub(super) branch: u32,
    /// What its throughput is to be multiplied by: probabilities undone.
    pub(super) weight: f64,
    /// About what part of the light comes through, in the wavelength where it is largest: steers Russian roulette.
    pub(super) rr_throughput: f64,
}

/// How a surface scattered a path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scattered {
    pub(super) position: DVec3,
    pub(super) normal: DVec3,
    /// Density of the direction, sr⁻¹.
    pub(super) pdf: f64,
    /// Of the emitters there.
    pub(super) emitter_weight_sum: f64,
}

impl PathState {
    /// A path that starts with a ray from the camera.
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

    /// Mirrored at a point of an object.
    pub(super) fn mirror(&mut self, object: usize, point: &SurfacePoint) {
        let direction = self.ray.direction;
        let mirrored = direction - 2.0 * direction.dot(point.normal) * point.normal;
        self.ray.direction = mirrored.normalize();
        self.scattered = None;
        self.pass_through(object, point);
    }

    /// Straight on through a film: what was known of the last scattering still holds.
    pub(super) fn pass_through(&mut self, object: usize, point: &SurfacePoint) {
        self.ray.origin = point.position;
        self.from_object = Some(object);
    }

    /// Scattered by an object, in a direction in world space. Films do not split it any more.
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
