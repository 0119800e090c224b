//! Directions sampled from uniform numbers.

use glam::{DMat3, DVec3};
use optics::wide::sin_cos_turns;

/// Returns a right-handed orthonormal frame whose third column is `normal`, a unit vector (Duff et al., Building an Orthonormal
/// Basis, Revisited, JCGT 6(1), 2017).
pub fn frame_of(normal: DVec3) -> DMat3 {
    let DVec3 { x, y, z } = normal;
    let side = if z >= 0.0 { 1.0 } else { -1.0 };
    let a = -1.0 / (side + z);
    let b = x * y * a;
    DMat3::from_cols(
        DVec3::new(1.0 + side * x * x * a, side * b, -side * x),
        DVec3::new(b, side + y * y * a, -y),
        normal,
    )
}

fn polar(sine: f64, cosine: f64, turn: f64) -> DVec3 {
    let (sin_phi, cos_phi) = sin_cos_turns(turn);
    DVec3::new(sine * cos_phi, sine * sin_phi, cosine)
}

/// Samples a direction about +z with density cos θ / π.
pub fn sample_cosine_hemisphere(u: f64, v: f64) -> DVec3 {
    polar(u.sqrt(), (1.0 - u).sqrt(), v)
}

/// Samples a direction about +z, uniform in the cone whose half angle has 1 − cos = `height`.
pub fn sample_cone(u: f64, v: f64, height: f64) -> DVec3 {
    let cosine = 1.0 - u * height;
    polar((1.0 - cosine * cosine).max(0.0).sqrt(), cosine, v)
}

/// Returns 1 − cos of the half angle that a sphere subtends at a point outside.
pub fn cone_height(radius: f64, distance2: f64) -> f64 {
    let sin2 = (radius * radius / distance2).min(1.0);
    1.0 - (1.0 - sin2).sqrt()
}
