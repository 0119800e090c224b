//! Light sources that directions are drawn towards: emitting spheres and rectangles.

use crate::{cone_height, frame_of, sample_cone};
use glam::DVec3;
use scene::Shape;
use std::f64::consts::PI;

/// A point this close to a sphere's surface, relative to its squared radius, counts as inside.
const INSIDE: f64 = 1.000_01;

/// A direction from `point` towards a light: uniform in the solid angle of a sphere (over all directions from
/// inside it), uniform over the area of a rectangle.
///
/// # Panics
/// For an unbounded plane or a disk, which are never lights.
pub fn sample_light(light: &Shape, point: DVec3, u: f64, v: f64) -> DVec3 {
    match *light {
        Shape::Sphere { center, radius } => {
            let towards = center - point;
            let distance2 = towards.length_squared();
            if distance2 <= radius * radius * INSIDE {
                return sample_cone(u, v, 2.0);
            }
            let height = cone_height(radius, distance2);
            frame_of(towards.normalize()) * sample_cone(u, v, height)
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
        Shape::Plane { .. } | Shape::Disk { .. } => unreachable!("no light has this shape"),
    }
}

/// Density with which [`sample_light`] draws a direction that hits the light, sr⁻¹.
///
/// # Panics
/// For an unbounded plane or a disk, which are never lights.
pub fn light_pdf(light: &Shape, point: DVec3, direction: DVec3) -> f64 {
    match *light {
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
        } => {
            let cosine = direction.dot(normal).abs();
            let distance = (center - point).dot(normal).abs() / cosine;
            if !distance.is_finite() || distance == 0.0 {
                return 0.0;
            }
            let area = 4.0 * half_width * half_height;
            distance * distance / (cosine * area)
        }
        Shape::Plane { .. } | Shape::Disk { .. } => unreachable!("no light has this shape"),
    }
}
