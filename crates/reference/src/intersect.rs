//! Intersections of rays with analytic shapes.

use crate::Ray;
use glam::DVec3;

/// Returns the distance to a sphere: the smaller positive root of |o + t d − c|² = r². A ray that starts on the sphere
/// (`from_surface`) has one root at its start, which is ignored; the other is −2 d·(o − c).
pub fn intersect_sphere(ray: &Ray, center: DVec3, radius: f64, from_surface: bool) -> Option<f64> {
    let from_center = ray.origin - center;
    let b = ray.direction.dot(from_center);
    if from_surface {
        return Some(-2.0 * b).filter(|&t| t > 0.0);
    }
    let c = from_center.length_squared() - radius * radius;
    let discriminant = b * b - c;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    [-b - root, -b + root].into_iter().find(|&t| t > 0.0)
}

/// Returns the distance to a plane.
pub fn intersect_plane(ray: &Ray, point: DVec3, normal: DVec3) -> Option<f64> {
    let distance = (point - ray.origin).dot(normal) / ray.direction.dot(normal);
    (distance.is_finite() && distance > 0.0).then_some(distance)
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: Ray = Ray {
        origin: DVec3::ZERO,
        direction: DVec3::X,
    };

    #[test]
    fn a_sphere_is_met_from_outside_inside_and_its_own_surface() {
        let at = |x: f64| DVec3::new(x, 0.0, 0.0);
        assert_eq!(intersect_sphere(&X, at(5.0), 2.0, false), Some(3.0));
        assert_eq!(intersect_sphere(&X, at(1.0), 2.0, false), Some(3.0));
        assert_eq!(intersect_sphere(&X, at(2.0), 2.0, true), Some(4.0));
        assert_eq!(intersect_sphere(&X, at(-2.0), 2.0, true), None);
        assert_eq!(intersect_sphere(&X, at(-5.0), 2.0, false), None);
        assert_eq!(
            intersect_sphere(&X, DVec3::new(5.0, 2.1, 0.0), 2.0, false),
            None
        );
    }

    #[test]
    fn a_plane_is_met_in_front_only() {
        assert_eq!(intersect_plane(&X, DVec3::X * 2.0, DVec3::NEG_X), Some(2.0));
        assert_eq!(intersect_plane(&X, DVec3::NEG_X, DVec3::X), None);
        assert_eq!(intersect_plane(&X, DVec3::Y, DVec3::Y), None);
        assert_eq!(intersect_plane(&X, DVec3::ZERO, DVec3::X), None);
    }
}
