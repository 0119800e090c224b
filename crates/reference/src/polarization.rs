//! The geometry of polarized light: reference axes of Stokes vectors, and turns between them.
//!
//! Light travels along d, away from its source. Its Stokes vector refers to an axis x across d, with y = d × x. Where light meets a
//! surface, x is s, across the plane of incidence. A turn of the axis is scalar: it is computed once for all bands.

use crate::frame_of;
use glam::DVec3;
use scene::EmittedPolarization;

/// A turn of the reference axis by an angle φ: cos 2φ and sin 2φ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// cos 2φ.
    pub cos: f64,
    /// sin 2φ.
    pub sin: f64,
}

impl Turn {
    /// No turn.
    pub const NONE: Self = Self { cos: 1.0, sin: 0.0 };

    /// The turn of light along `direction` from one axis to another, both unit vectors across it.
    pub fn between(from: DVec3, to: DVec3, direction: DVec3) -> Self {
        let (cos, sin) = (from.dot(to), direction.dot(from.cross(to)));
        // Rounding must not change the degree of polarization.
        let size = (cos * cos + sin * sin).max(f64::MIN_POSITIVE);
        Self {
            cos: (cos * cos - sin * sin) / size,
            sin: 2.0 * cos * sin / size,
        }
    }

    /// S1 and S2 about the new axis.
    pub fn turned(self, [s1, s2]: [f64; 2]) -> [f64; 2] {
        let Self { cos, sin } = self;
        [cos * s1 + sin * s2, cos * s2 - sin * s1]
    }
}

/// The unit vector across two unit vectors; where they are parallel, any one across both.
pub fn axis_across(a: DVec3, b: DVec3) -> DVec3 {
    let across = a.cross(b);
    let size2 = across.length_squared();
    if size2 < 1e-24 {
        return frame_of(a).x_axis;
    }
    across / size2.sqrt()
}

/// S1, S2 and S3, over S0, of emitted light that comes from `toward`, about an axis across that unit vector.
pub fn emitted_stokes(of: &EmittedPolarization, toward: DVec3, axis: DVec3) -> [f64; 3] {
    let (own, [s1, s2, s3]) = match *of {
        EmittedPolarization::Stokes {
            stokes,
            axis: reference,
        } => {
            // Across the ray, in the plane of the ray and the reference.
            let side = axis_across(toward, reference);
            (side.cross(toward), stokes)
        }
        EmittedPolarization::Sky { sun, most } => {
            let cosine = toward.dot(sun);
            let sin2 = toward.cross(sun).length_squared();
            // The ground is not polarized.
            let above = f64::from(u8::from(toward.y >= 0.0));
            let degree = above * most * sin2 / (1.0 + cosine * cosine);
            (axis_across(toward, sun), [degree, 0.0, 0.0])
        }
    };
    let [s1, s2] = Turn::between(own, axis, -toward).turned([s1, s2]);
    [s1, s2, s3]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The light that falls on a viewer at the origin, who looks along −z with x to the right.
    const TOWARD: DVec3 = DVec3::NEG_Z;

    fn close(found: [f64; 3], expected: [f64; 3]) -> bool {
        found
            .iter()
            .zip(expected)
            .all(|(a, b)| (a - b).abs() < 1e-14)
    }

    /// Light that is polarized along +45° for the viewer has S2 = 1 about the horizontal, and S1 = 1 about +45°.
    #[test]
    fn turns_are_counterclockwise_for_the_receiver() {
        let up = DVec3::new(1.0, 1.0, 0.0).normalize();
        let turn = Turn::between(DVec3::X, up, -TOWARD);
        let [s1, s2] = turn.turned([0.0, 1.0]);
        assert!((s1 - 1.0).abs() < 1e-15 && s2.abs() < 1e-15);
        let [s1, s2] = Turn::between(up, DVec3::X, -TOWARD).turned([1.0, 0.0]);
        assert!(s1.abs() < 1e-15 && (s2 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn emitted_light_refers_to_the_part_of_its_axis_across_the_ray() {
        let vertical = EmittedPolarization::Stokes {
            stokes: [0.6, 0.0, 0.8],
            axis: DVec3::new(0.0, 0.8, 0.6),
        };
        let found = emitted_stokes(&vertical, TOWARD, DVec3::X);
        assert!(close(found, [-0.6, 0.0, 0.8]), "{found:?}");
        let tilted = EmittedPolarization::Stokes {
            stokes: [1.0, 0.0, 0.0],
            axis: DVec3::new(1.0, 1.0, 0.0).normalize(),
        };
        let found = emitted_stokes(&tilted, TOWARD, DVec3::X);
        assert!(close(found, [0.0, 1.0, 0.0]), "{found:?}");
    }

    /// At 90° from the sun the degree is the greatest, and the field is across the plane of sun and ray.
    #[test]
    fn the_sky_is_polarized_across_the_plane_of_the_sun() {
        let sky = |sun| EmittedPolarization::Sky { sun, most: 0.75 };
        let found = emitted_stokes(&sky(DVec3::Y), TOWARD, DVec3::X);
        assert!(close(found, [0.75, 0.0, 0.0]), "{found:?}");
        let found = emitted_stokes(&sky(DVec3::X), TOWARD, DVec3::X);
        assert!(close(found, [-0.75, 0.0, 0.0]), "{found:?}");
        let found = emitted_stokes(&sky(DVec3::NEG_Z), TOWARD, DVec3::X);
        assert!(close(found, [0.0; 3]), "{found:?}");
        // At 60°, sin² / (1 + cos²) = 0.75 / 1.25.
        let sun = DVec3::new(0.0, 0.75_f64.sqrt(), -0.5);
        let found = emitted_stokes(&sky(sun), TOWARD, DVec3::X);
        assert!(close(found, [0.75 * 0.6, 0.0, 0.0]), "{found:?}");
    }

    #[test]
    fn the_ground_is_not_polarized() {
        let sky = EmittedPolarization::Sky {
            sun: DVec3::Z,
            most: 1.0,
        };
        let below = DVec3::new(0.8, -0.6, 0.0);
        let across = axis_across(below, DVec3::Y);
        assert_eq!(emitted_stokes(&sky, below, across)[..2], [0.0; 2]);
        assert!(emitted_stokes(&sky, -below, across)[0].abs() > 0.1);
    }

    #[test]
    fn parallel_directions_have_an_axis() {
        for direction in [DVec3::Y, DVec3::NEG_Z, DVec3::new(0.6, 0.0, 0.8)] {
            for other in [direction, -direction] {
                let axis = axis_across(direction, other);
                assert!((axis.length() - 1.0).abs() < 1e-12 && axis.dot(direction).abs() < 1e-12);
            }
        }
    }
}
