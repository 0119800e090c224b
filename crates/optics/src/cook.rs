//! The terms of the reflection model of Cook and Torrance as Suzuki, Yokoi and Toriwaki print it (section 3-1).
//!
//! I_r = I_a R_a + Σ I_l dω_l R_s with R_s = F D G / (π (N·E)), in which the cosine N·L of the irradiance has already canceled the
//! one in the denominator. G is [`v_groove_g`](crate::v_groove_g). Two forms of D are printed: [`gaussian_d1`](crate::gaussian_d1)
//! with an arbitrary constant, and [`beckmann_d2`], whose projected area is π instead of 1. With the printed π in place of the 4 for
//! mirroring facets (Torrance and Sparrow 1967) and D₂ in place of D₂/π, R_s is four times as large.

use crate::beckmann_d;
use std::f64::consts::PI;

/// The index n = (1 + √F₀) / (1 − √F₀) of a dielectric whose reflectance at normal incidence is `normal_reflectance`
/// (Cook and Torrance 1982, section "Spectral composition", from F₀ = ((n − 1) / (n + 1))²).
///
/// Domain: 0 ≤ F₀ < 1; n ranges from 1 to ∞.
pub fn index_from_normal_reflectance(normal_reflectance: f64) -> f64 {
    let root = normal_reflectance.sqrt();
    (1.0 + root) / (1.0 - root)
}

/// Fresnel's reflectance of unpolarized light from a real index `n` ≥ 1, with c the cosine at the facet and g² = n² + c² − 1:
/// F = ½ (g − c)² / (g + c)² {1 + (c (g + c) − 1)² / (c (g − c) + 1)²} (Cook and Torrance 1982, with c = E·H).
///
/// The paper prints c = N·E and a garbled g. For an index without absorption, this is the same function as
/// [`reflectance_unpolarized`](crate::reflectance_unpolarized).
///
/// Domain: 0 ≤ c ≤ 1, and not both n = 1 and c = 0, where g + c is 0 and the result is NaN.
pub fn fresnel_by_g_and_c(n: f64, c: f64) -> f64 {
    let g = (n * n + c * c - 1.0).sqrt();
    let first = ((g - c) / (g + c)).powi(2);
    let second = ((c * (g + c) - 1.0) / (c * (g - c) + 1.0)).powi(2);
    0.5 * first * (1.0 + second)
}

/// D₂ = exp(−tan²a / m²) / (m² cos⁴a), as printed: π times [`beckmann_d`].
///
/// Domain: `slope` m > 0. Cosines of 0 and less give 0.
pub fn beckmann_d2(cos_facet: f64, slope: f64) -> f64 {
    PI * beckmann_d(cos_facet, slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Complex64, gaussian_constant, gaussian_d1, gaussian_pdf, reflectance_unpolarized,
        v_groove_g,
    };

    fn close(found: f64, expected: f64, tolerance: f64) {
        assert!((found - expected).abs() <= tolerance, "{found} {expected}");
    }

    /// √0.04 = 0.2: n = 1.2 / 0.8. √0.25 = 0.5: n = 1.5 / 0.5. √0.81 = 0.9: n = 1.9 / 0.1.
    #[test]
    fn the_inversion_by_hand() {
        for (reflectance, n) in [(0.0, 1.0), (0.04, 1.5), (0.25, 3.0), (0.81, 19.0)] {
            close(index_from_normal_reflectance(reflectance), n, 1e-12);
            close(fresnel_by_g_and_c(n, 1.0), reflectance, 1e-14);
        }
    }

    /// n = 1.5 at 60°: g² = 2.25 + 0.25 − 1 = 1.5, g = 1.224745; (g − c)²/(g + c)² = 0.525255/2.974745 = 0.176572;
    /// c (g + c) − 1 = −0.137628, c (g − c) + 1 = 1.362372, their squares' quotient 0.010205;
    /// F = 0.088286 × 1.010205 = 0.089187. Hecht (Optics, 4th ed., section 4.6) has r⊥ = −0.420 and r∥ = −0.042 (0.0892).
    #[test]
    fn fresnel_by_hand() {
        close(fresnel_by_g_and_c(1.5, 0.5), 0.089_187, 5e-7);
    }

    /// The formula in g and c equals Fresnel's.
    #[test]
    fn fresnel_is_that_of_an_index_without_absorption() {
        for n in [1.0, 1.333, 1.5, 3.0, 19.0, 300.0] {
            for c in [1e-6, 0.1, 0.5, 0.9, 1.0] {
                let exact = reflectance_unpolarized(Complex64::from(n), c);
                close(fresnel_by_g_and_c(n, c), exact, 1e-12);
            }
        }
        // The cosine with the normal instead of the facet gives another value.
        assert!((fresnel_by_g_and_c(1.5, 0.3) - fresnel_by_g_and_c(1.5, 0.5)).abs() > 0.1);
    }

    /// m = 0.2: D₂ = 25 at the normal. Where tan a = m, cos²a = 1/1.04 and D₂ = 25 e⁻¹ 1.04² = 25 × 0.3678794 × 1.0816 = 9.947460.
    /// m = 0.5, a = 45°: e⁻⁴ / (0.25 × 0.25) = 0.0183156 × 16 = 0.293050.
    #[test]
    fn d2_by_hand() {
        close(beckmann_d2(1.0, 0.2), 25.0, 1e-12);
        close(beckmann_d2(1.04_f64.sqrt().recip(), 0.2), 9.947_460, 1e-6);
        close(beckmann_d2(0.5_f64.sqrt(), 0.5), 0.293_050, 1e-6);
        assert_eq!(beckmann_d2(-0.1, 0.5), 0.0);
    }

    /// At a = m: e⁻¹. At a = 30° (0.523599) and m = 0.35: (0.523599 / 0.35)² = 2.237998, e^−2.237998 = 0.106672.
    #[test]
    fn d1_by_hand() {
        close(gaussian_d1(1.0, 0.2), 1.0, 1e-15);
        close(gaussian_d1(0.2_f64.cos(), 0.2), 0.367_879, 1e-6);
        close(gaussian_d1(0.75_f64.sqrt(), 0.35), 0.106_672, 1e-6);
        assert_eq!(gaussian_d1(0.0, 0.2), 0.0);
    }

    /// For small m, c = 1 / (π m²) covers the surface once, as in a plane. As long as the horizon cuts nothing off,
    /// ∫ exp(−a²/m²) sin 2a da = m F(m) with Dawson's integral: F(0.3) = 0.28263 (Abramowitz and Stegun, table 7.5).
    #[test]
    fn the_constant_of_d1_covers_the_surface_once() {
        close(gaussian_constant(0.02) * PI * 4e-4, 1.0, 4e-4);
        close(gaussian_constant(0.3), 1.0 / (PI * 0.3 * 0.282_63), 2e-4);
        for slope in [0.05, 0.2, 0.6, 1.0] {
            let c = gaussian_constant(slope);
            let steps = 200_000;
            let sum: f64 = (0..steps)
                .map(|i| 0.5 * PI * (f64::from(i) + 0.5) / f64::from(steps))
                .map(|a| gaussian_d1(a.cos(), slope) * a.cos() * a.sin())
                .sum();
            close(c * sum * 2.0 * PI * 0.5 * PI / f64::from(steps), 1.0, 1e-8);
        }
    }

    /// Both directions at 60° on opposite sides: the facet is level and nothing is masked, 2 · 1 · ½ / ½ = 2 > 1. Both at 75° and
    /// identical: E·H = 1, G = 2 cos²75° = 0.133975. E at 60° and L at the normal: H at 30°, E·H = cos 30°, G = 2 (cos 30°)(½) /
    /// cos 30° = 1. E at 80°, L at the normal: 2 cos 40° cos 80° / cos 40° = 0.347296.
    #[test]
    fn g_by_hand() {
        let cosine = |degrees: f64| degrees.to_radians().cos();
        close(v_groove_g(1.0, 0.5, 0.5, 0.5), 1.0, 0.0);
        let steep = cosine(75.0);
        close(v_groove_g(steep, steep, steep, 1.0), 0.133_975, 1e-6);
        close(v_groove_g(cosine(30.0), 0.5, 1.0, cosine(30.0)), 1.0, 1e-12);
        let hidden = v_groove_g(cosine(40.0), cosine(80.0), 1.0, cosine(40.0));
        close(hidden, 0.347_296, 1e-6);
    }

    /// The density of the sampler integrates to 1 over the hemisphere of facets.
    #[test]
    fn the_density_of_gaussian_facets_is_one() {
        for slope in [0.05, 0.3, 1.0] {
            let steps = 200_000;
            let sum: f64 = (0..steps)
                .map(|i| 0.5 * PI * (f64::from(i) + 0.5) / f64::from(steps))
                .map(|a| gaussian_pdf(a.cos(), slope) * a.sin())
                .sum();
            close(sum * PI * PI / f64::from(steps), 1.0, 1e-7);
        }
    }
}
