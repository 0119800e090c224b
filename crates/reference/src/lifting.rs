//! Smooth spectra for colors (Jakob and Hanika, Computer Graphics Forum 38 (2), 2019).

use optics::wide::Real;

/// Returns the smooth spectrum with these coefficients: (1 + x/√(1 + x²)) / 2 with x = c₀ t² + c₁ t + c₂ and
/// t = (λ − 580 nm) / 200 nm (Jakob and Hanika 2019, equations 4 and 5).
#[inline(always)]
pub fn smooth_value<T: Real>([c0, c1, c2]: [f64; 3], wavelength_nm: T) -> T {
    let one = wavelength_nm.constant(1.0);
    let t = (wavelength_nm - one.times(580.0)).times(1.0 / 200.0);
    let x = one
        .times(c0)
        .mul_add(t, one.times(c1))
        .mul_add(t, one.times(c2));
    (x / x.mul_add(x, one).sqrt()).mul_add(one.times(0.5), one.times(0.5))
}
