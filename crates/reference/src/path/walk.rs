//! The ways that a path takes.

use crate::{Ray, SurfacePoint};
use glam::DVec3;

/// One of the ways that a path takes.
#[derive(Clone)]
pub(super) struct Walk {
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
    /// About what part of the light comes through, in the wavelength where it is largest.
    pub(super) estimate: f64,
    pub(super) throughput: Vec<f64>,
}

/// How a surface scattered a path.
#[derive(Clone)]
pub(super) struct Scattered {
    pub(super) position: DVec3,
    /// Density of the direction.
    pub(super) pdf: f64,
    /// Probabilities of the lights there.
    pub(super) chances: Vec<f64>,
}

/// What a film does in each band (reflectance and transmittance), about what part goes the way taken, and the chance of that way.
pub(super) type Ways<'a> = (&'a [(f64, f64)], f64, f64);

impl Walk {
    /// Mirrored by a film.
    pub(super) fn go_mirrored(
        &mut self,
        object: usize,
        point: &SurfacePoint,
        (film, part, chance): Ways<'_>,
    ) {
        self.estimate *= part / chance;
        for (throughput, (reflectance, _)) in self.throughput.iter_mut().zip(film) {
            *throughput *= reflectance / chance;
        }
        self.ray = Ray {
            origin: point.position,
            direction: mirrored(self.ray.direction, point.normal),
        };
        self.from_object = Some(object);
        self.scattered = None;
    }

    /// Straight on through a film: what was said of the last scattering still holds.
    pub(super) fn go_through(
        &mut self,
        object: usize,
        point: &SurfacePoint,
        (film, part, chance): Ways<'_>,
    ) {
        self.estimate *= part / chance;
        for (throughput, (_, transmittance)) in self.throughput.iter_mut().zip(film) {
            *throughput *= transmittance / chance;
        }
        self.ray.origin = point.position;
        self.from_object = Some(object);
    }
}

/// Mirrors a direction at a surface.
pub(super) fn mirrored(direction: DVec3, normal: DVec3) -> DVec3 {
    (direction - 2.0 * direction.dot(normal) * normal).normalize()
}
