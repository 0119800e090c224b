//! Shapes of emitters that directions are sampled toward: spheres, rectangles and disks.

use crate::{cone_height, frame_of, sample_cone};
use glam::DVec3;
use optics::wide::sin_cos_turns;
use scene::Shape;
use std::f64::consts::PI;

/// A point is inside a sphere if its squared distance from the center is at most this times the squared radius.
pub(crate) const INSIDE: f64 = 1.000_01;

/// Samples a direction from `point` toward a shape: uniform in the solid angle of a sphere (over all directions from inside it),
/// uniform over the area of a rectangle or disk.
///
/// # Panics
/// For an unbounded plane, which is never sampled as an emitter.
pub fn sample_shape(shape: &Shape, point: DVec3, u: f64, v: f64) -> DVec3 {
    match *shape {
        Shape::Sphere { center, radius } => {
            let toward = center - point;
            let distance2 = toward.length_squared();
            if distance2 <= radius * radius * INSIDE {
                return sample_cone(u, v, 2.0);
            }
            let height = cone_height(radius, distance2);
            frame_of(toward.normalize()) * sample_cone(u, v, height)
        }
        Shape::Rectangle {
            center,
            tangent,
            bitangent,
            half_width,
            half_height,
            ..
        } => {
            let place = center
                + tangent * ((2.0 * u - 1.0) * half_width)
                + bitangent * ((2.0 * v - 1.0) * half_height);
            (place - point).normalize()
        }
        Shape::Disk {
            center,
            tangent,
            bitangent,
            radius,
            ..
        } => {
            let (sine, cosine) = sin_cos_turns(v);
            let place = center + (tangent * cosine + bitangent * sine) * (radius * u.sqrt());
            (place - point).normalize()
        }
        Shape::Plane { .. } => unreachable!("an unbounded plane is not sampled"),
    }
}

/// Returns the density with which [`sample_shape`] samples a direction that hits the shape, sr⁻¹.
///
/// # Panics
/// For an unbounded plane, which is never sampled as an emitter.
pub fn shape_pdf(shape: &Shape, point: DVec3, direction: DVec3) -> f64 {
    match *shape {
        Shape::Sphere { center, radius } => {
            let distance2 = (center - point).length_squared();
            if distance2 <= radius * radius * INSIDE {
                return 1.0 / (4.0 * PI);
            }
            1.0 / (2.0 * PI * cone_height(radius, distance2))
        }
        Shape::Rectangle {
            center,
            normal,
            half_width,
            half_height,
            ..
        } => plane_pdf(
            center - point,
            normal,
            direction,
            4.0 * half_width * half_height,
        ),
        Shape::Disk {
            center,
            normal,
            radius,
            ..
        } => plane_pdf(center - point, normal, direction, PI * radius * radius),
        Shape::Plane { .. } => unreachable!("an unbounded plane is not sampled"),
    }
}

/// Returns the density per solid angle of positions sampled uniformly over an area of a plane.
fn plane_pdf(to_center: DVec3, normal: DVec3, direction: DVec3, area: f64) -> f64 {
    let cosine = direction.dot(normal).abs();
    let distance = to_center.dot(normal).abs() / cosine;
    if !distance.is_finite() || distance == 0.0 {
        return 0.0;
    }
    distance * distance / (cosine * area)
}
