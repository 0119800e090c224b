//! Rough surfaces as a distribution of small mirrors.
//!
//! Directions are unit vectors in a local frame whose third component is the cosine with the macroscopic normal.

use std::f64::consts::{PI, TAU};

/// Beckmann's distribution of facet normals, sr⁻¹:
/// D = exp(−tan²α / m²) / (π m² cos⁴α), α the angle between facet and surface normal, m the root mean square slope
/// (Beckmann and Spizzichino 1963; Cook and Torrance 1982, equation 5, with the 1/π that makes ∫ D cos α dω = 1).
pub fn beckmann_d(cos_facet: f64, slope: f64) -> f64 {
    if cos_facet <= 0.0 {
        return 0.0;
    }
    let cos2 = cos_facet * cos_facet;
    let tan2 = (1.0 - cos2) / cos2;
    (-tan2 / (slope * slope)).exp() / (PI * slope * slope * cos2 * cos2)
}

/// Shadowing and masking of a symmetric V-shaped groove:
/// G = min(1, 2 (N·H)(N·E) / (E·H), 2 (N·H)(N·L) / (E·H))
/// (Torrance and Sparrow 1967; Blinn 1977; Cook and Torrance 1982).
pub fn v_groove_g(cos_facet: f64, cos_eye: f64, cos_light: f64, eye_dot_facet: f64) -> f64 {
    if cos_eye <= 0.0 || cos_light <= 0.0 || eye_dot_facet <= 0.0 {
        return 0.0;
    }
    let groove = 2.0 * cos_facet / eye_dot_facet;
    (groove * cos_eye).min(groove * cos_light).min(1.0)
}

/// The reflection function of a rough mirror without its Fresnel factor, sr⁻¹: D G / (4 (N·E)(N·L)).
pub fn cook_torrance(eye: [f64; 3], light: [f64; 3], slope: f64) -> f64 {
    let (cos_eye, cos_light) = (eye[2], light[2]);
    if cos_eye <= 0.0 || cos_light <= 0.0 {
        return 0.0;
    }
    let facet = half_vector(eye, light);
    let eye_dot_facet = dot(eye, facet);
    let g = v_groove_g(facet[2], cos_eye, cos_light, eye_dot_facet);
    beckmann_d(facet[2], slope) * g / (4.0 * cos_eye * cos_light)
}

/// A facet normal drawn with density D cos α from two uniform numbers in [0, 1):
/// tan²α = −m² ln(1 − u) (Walter et al. 2007, equation 28).
pub fn sample_beckmann(u: f64, v: f64, slope: f64) -> [f64; 3] {
    let tan2 = -slope * slope * (-u).ln_1p();
    let cosine = 1.0 / (1.0 + tan2).sqrt();
    let sine = (tan2 / (1.0 + tan2)).sqrt();
    let (sin_phi, cos_phi) = (TAU * v).sin_cos();
    [sine * cos_phi, sine * sin_phi, cosine]
}

/// Density of a facet normal drawn by [`sample_beckmann`], sr⁻¹.
pub fn half_vector_pdf(cos_facet: f64, slope: f64) -> f64 {
    beckmann_d(cos_facet, slope) * cos_facet.max(0.0)
}

/// Density of the direction mirrored at such a facet, sr⁻¹: D cos α / (4 E·H) (Torrance and Sparrow 1967; Walter et al. 2007, equation 14).
pub fn reflected_pdf(cos_facet: f64, eye_dot_facet: f64, slope: f64) -> f64 {
    if eye_dot_facet <= 0.0 {
        return 0.0;
    }
    half_vector_pdf(cos_facet, slope) / (4.0 * eye_dot_facet)
}

fn half_vector(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let sum = [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let length = dot(sum, sum).sqrt();
    sum.map(|x| x / length)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The integral over a hemisphere, by the midpoint rule in both angles.
    fn over_hemisphere(f: impl Fn([f64; 3]) -> f64) -> f64 {
        let (rows, columns) = (2000, 64);
        let mut sum = 0.0;
        for i in 0..rows {
            let (sine, cosine) = (0.5 * PI * (f64::from(i) + 0.5) / f64::from(rows)).sin_cos();
            for j in 0..columns {
                let phi = TAU * (f64::from(j) + 0.5) / f64::from(columns);
                sum += f([sine * phi.cos(), sine * phi.sin(), cosine]) * sine;
            }
        }
        sum * 0.5 * PI * TAU / f64::from(rows * columns)
    }

    #[test]
    fn projected_facets_cover_the_surface_once() {
        for slope in [0.05, 0.1, 0.3, 0.6, 1.0] {
            let area = over_hemisphere(|w| half_vector_pdf(w[2], slope));
            assert!((area - 1.0).abs() < 5e-5, "{slope}: {area}");
        }
    }

    #[test]
    fn reflection_is_reciprocal() {
        let a = [0.3, 0.4, 0.866_025];
        let b = [-0.6, 0.1, 0.793_725];
        let there = cook_torrance(a, b, 0.3);
        let back = cook_torrance(b, a, 0.3);
        assert!(there > 0.0 && (there - back).abs() < 1e-14);
    }

    /// White furnace: a lossless rough mirror never returns more than it receives, and at a small slope
    /// and a steep view all of it.
    #[test]
    fn a_lossless_surface_returns_at_most_everything() {
        for slope in [0.1, 0.2, 0.5, 1.0] {
            for eye_degrees in [0.0_f64, 30.0, 60.0, 80.0] {
                let (sine, cosine) = eye_degrees.to_radians().sin_cos();
                let eye = [sine, 0.0, cosine];
                let albedo = over_hemisphere(|light| cook_torrance(eye, light, slope) * light[2]);
                assert!(albedo < 1.005, "{slope} {eye_degrees}: {albedo}");
                if slope <= 0.1 && eye_degrees == 0.0 {
                    assert!(albedo > 0.99, "{slope} {eye_degrees}: {albedo}");
                }
            }
        }
    }

    /// The integrator of these tests can tell a wrong constant: the printed 1/π instead of 1/4 is four times too much (over π).
    #[test]
    fn the_furnace_notices_a_wrong_constant() {
        let eye = [0.0, 0.0, 1.0];
        let wrong = over_hemisphere(|l| 4.0 / PI * cook_torrance(eye, l, 0.2) * l[2]);
        assert!(wrong > 1.2);
    }
}
