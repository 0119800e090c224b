//! The environment, in parts that are sampled separately.

use crate::environment_picture::{environment_picture_pdf, sample_environment_picture};
use crate::{frame_of, sample_cone, sample_cosine_hemisphere};
use glam::DVec3;
use optics::wide::sin_cos_turns;
use scene::EnvironmentShape;
use std::f64::consts::{FRAC_1_PI, TAU};

/// Returns the relative radiance of a part of the environment in a direction; a picture has its own values.
pub fn environment_strength(part: EnvironmentShape<'_>, direction: DVec3) -> f64 {
    match part {
        EnvironmentShape::Everywhere | EnvironmentShape::Picture(_) => 1.0,
        EnvironmentShape::Horizon => (1.0 - direction.y.abs()).max(0.0),
        EnvironmentShape::Pole(pole) => direction.dot(pole).clamp(0.0, 1.0),
        EnvironmentShape::DistantDisk { toward, height } => f64::from(u8::from(
            (direction - toward).length_squared() <= 2.0 * height,
        )),
    }
}

/// Samples a direction toward a part of the environment, by the density of [`environment_pdf`].
pub fn sample_environment(part: EnvironmentShape<'_>, u: f64, v: f64) -> DVec3 {
    match part {
        EnvironmentShape::Everywhere => sample_cone(u, v, 2.0),
        EnvironmentShape::Horizon => {
            // The cumulative distribution function of |h| is 1 − (1 − |h|)².
            let (t, side) = if u < 0.5 {
                (2.0 * u, 1.0)
            } else {
                (2.0 * u - 1.0, -1.0)
            };
            let height = 1.0 - (1.0 - t).sqrt();
            let sine = (1.0 - height * height).sqrt();
            let (sin_phi, cos_phi) = sin_cos_turns(v);
            DVec3::new(sine * cos_phi, side * height, sine * sin_phi)
        }
        EnvironmentShape::Picture(picture) => sample_environment_picture(picture, u, v),
        EnvironmentShape::Pole(pole) => frame_of(pole) * sample_cosine_hemisphere(u, v),
        EnvironmentShape::DistantDisk { toward, height } => {
            frame_of(toward) * sample_cone(u, v, height)
        }
    }
}

/// Returns the density with which [`sample_environment`] samples a direction, sr⁻¹: the relative radiance over its integral.
pub fn environment_pdf(part: EnvironmentShape<'_>, direction: DVec3) -> f64 {
    let strength = environment_strength(part, direction);
    match part {
        EnvironmentShape::Everywhere => strength / (2.0 * TAU),
        EnvironmentShape::Horizon => strength / TAU,
        EnvironmentShape::Pole(_) => strength * FRAC_1_PI,
        EnvironmentShape::Picture(picture) => environment_picture_pdf(picture, direction),
        EnvironmentShape::DistantDisk { height, .. } => strength / (TAU * height),
    }
}
