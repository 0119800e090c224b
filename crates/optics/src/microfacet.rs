//! Rough surfaces as Cook and Torrance model them: facets with Beckmann's distribution, in V-shaped grooves.
//!
//! Directions are unit vectors in a local frame whose third component is the cosine with the macroscopic normal.

use std::f64::consts::{PI, TAU};

/// Beckmann's distribution of facet normals, sr⁻¹:
/// D = exp(−tan²α / m²) / (π m² cos⁴α), where α is the angle between facet and surface normal, m the root mean square slope
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
pub fn v_groove_g(cos_facet: f64, cos_wo: f64, cos_wi: f64, wo_dot_facet: f64) -> f64 {
    if cos_wo <= 0.0 || cos_wi <= 0.0 || wo_dot_facet <= 0.0 {
        return 0.0;
    }
    let groove = 2.0 * cos_facet / wo_dot_facet;
    (groove * cos_wo).min(groove * cos_wi).min(1.0)
}

/// Samples a facet normal with density D cos α from two uniform numbers in [0, 1):
/// tan²α = −m² ln(1 − u) (Walter et al. 2007, equation 28).
pub fn sample_beckmann(u: f64, v: f64, slope: f64) -> [f64; 3] {
    let tan2 = -slope * slope * (-u).ln_1p();
    let cosine = 1.0 / (1.0 + tan2).sqrt();
    let sine = (tan2 / (1.0 + tan2)).sqrt();
    let (sin_phi, cos_phi) = (TAU * v).sin_cos();
    [sine * cos_phi, sine * sin_phi, cosine]
}

/// Density of a facet normal sampled by [`sample_beckmann`], sr⁻¹.
pub fn half_vector_pdf(cos_facet: f64, slope: f64) -> f64 {
    beckmann_d(cos_facet, slope) * cos_facet.max(0.0)
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
}
