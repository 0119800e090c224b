//! Fresnel's equations for the boundary between two media.

use num_complex::Complex64;

/// Amplitude coefficients of reflection and transmission of a boundary, for s and p polarization.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amplitudes {
    /// Reflection, s.
    pub r_s: Complex64,
    /// Reflection, p. Equals −r_s at normal incidence.
    pub r_p: Complex64,
    /// Transmission, s.
    pub t_s: Complex64,
    /// Transmission, p.
    pub t_p: Complex64,
}

/// Cosine of the angle of refraction in a medium of index `n`, for a wave whose transverse wave number
/// relative to vacuum is `n_sin` = n₁ sin θ₁ (by Snell's law it is the same in every layer).
///
/// cos θ = √(1 − (n_sin / n)²), on the branch where the wave decays or propagates forward: Im(n cos θ) ≥ 0,
/// and Re(n cos θ) ≥ 0 where the imaginary part vanishes (Born and Wolf, Principles of Optics, 7th ed., section 14.2).
pub fn cos_refracted(n: Complex64, n_sin: Complex64) -> Complex64 {
    let sine = n_sin / n;
    // (1 − sin)(1 + sin) keeps the digits that 1 − sin² loses near grazing.
    let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
    let forward = n * cosine;
    let tiny = 1e-14 * forward.norm();
    if forward.im < -tiny || (forward.im.abs() <= tiny && forward.re < 0.0) {
        -cosine
    } else {
        cosine
    }
}

/// Fresnel's amplitude coefficients for light in a medium of index `n1` that meets a medium of index `n2`.
///
/// r_s = (n₁ c₁ − n₂ c₂) / (n₁ c₁ + n₂ c₂), r_p = (n₂ c₁ − n₁ c₂) / (n₂ c₁ + n₁ c₂),
/// t_s = 2 n₁ c₁ / (n₁ c₁ + n₂ c₂), t_p = 2 n₁ c₁ / (n₂ c₁ + n₁ c₂)
/// (Born and Wolf, 7th ed., section 1.5, equations 20 and 21, with the same field direction for r_p).
///
/// `cos1` and `cos2` are the cosines in the two media, from [`cos_refracted`].
pub fn fresnel(n1: Complex64, cos1: Complex64, n2: Complex64, cos2: Complex64) -> Amplitudes {
    let (s_sum, p_sum) = (n1 * cos1 + n2 * cos2, n2 * cos1 + n1 * cos2);
    Amplitudes {
        r_s: (n1 * cos1 - n2 * cos2) / s_sum,
        r_p: (n2 * cos1 - n1 * cos2) / p_sum,
        t_s: 2.0 * n1 * cos1 / s_sum,
        t_p: 2.0 * n1 * cos1 / p_sum,
    }
}

/// Reflectance for unpolarized light of a half space of complex index `index` seen from vacuum.
///
/// Domain: `cos_incident` in (0, 1].
pub fn reflectance_unpolarized(index: Complex64, cos_incident: f64) -> f64 {
    let cos1 = Complex64::from(cos_incident);
    let sine = ((1.0 - cos_incident) * (1.0 + cos_incident)).sqrt();
    let vacuum = Complex64::ONE;
    let a = fresnel(vacuum, cos1, index, cos_refracted(index, sine.into()));
    0.5 * (a.r_s.norm_sqr() + a.r_p.norm_sqr())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glass(cos1: f64) -> Amplitudes {
        let n = Complex64::from(1.5);
        let sine = (1.0 - cos1 * cos1).sqrt();
        fresnel(1.0.into(), cos1.into(), n, cos_refracted(n, sine.into()))
    }

    #[test]
    fn glass_at_normal_incidence_reflects_four_per_cent() {
        let a = glass(1.0);
        assert!((a.r_s.norm_sqr() - 0.04).abs() < 1e-15);
        assert!((a.r_s + a.r_p).norm() < 1e-15);
    }

    /// tan θ_B = n₂ / n₁ (Brewster 1815).
    #[test]
    fn p_vanishes_at_brewsters_angle() {
        let a = glass(1.5_f64.atan().cos());
        assert!(a.r_p.norm() < 1e-15);
        assert!(a.r_s.norm() > 0.3);
    }

    /// A published value: aluminum with n = 0.82 + 5.99i at 546 nm has R = 0.9163 at normal incidence
    /// by ((n − 1)² + k²) / ((n + 1)² + k²).
    #[test]
    fn a_metal_at_normal_incidence_follows_the_closed_form() {
        let (n, k) = (0.82, 5.99);
        let expected = ((n - 1.0_f64).powi(2) + k * k) / ((n + 1.0_f64).powi(2) + k * k);
        let found = reflectance_unpolarized(Complex64::new(n, k), 1.0);
        assert!((found - expected).abs() < 1e-15);
    }

    #[test]
    fn total_reflection_beyond_the_critical_angle() {
        let n1 = Complex64::from(1.5);
        let sine = 0.8; // critical: 1 / 1.5 = 0.667
        let cos2 = cos_refracted(1.0.into(), n1 * sine);
        assert!(cos2.im > 0.0, "the evanescent wave decays");
        let a = fresnel(n1, 0.6.into(), 1.0.into(), cos2);
        assert!((a.r_s.norm() - 1.0).abs() < 1e-15 && (a.r_p.norm() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn everything_reflects_at_grazing() {
        let r = reflectance_unpolarized(Complex64::new(0.2, 3.4), 1e-9);
        assert!((r - 1.0).abs() < 1e-7);
    }
}
