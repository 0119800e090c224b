//! CIE 1931 XYZ relative to an exposure.

use std::sync::OnceLock;

use spectra::{KM_LUMENS_PER_WATT, observer_1931};

/// Returns Y, in cd/m², of the radiance 1 W m⁻² sr⁻¹ nm⁻¹ at every wavelength.
///
/// Y = Kₘ Σ ȳ(λ) Δλ at 380, 381 … 780 nm with Kₘ = 683 lm/W (CIE 015:2018), about 7.298e4.
pub fn equal_energy_luminance() -> f64 {
    static LUMINANCE: OnceLock<f64> = OnceLock::new();
    *LUMINANCE.get_or_init(|| {
        let [_, y_bar, _] = observer_1931();
        let sum: f64 = (380..=780).map(|nm| y_bar.clamped_at(f64::from(nm))).sum();
        KM_LUMENS_PER_WATT * sum
    })
}

/// Returns the factor on XYZ in cd/m² at an exposure of `exposure_ev` stops, which gives the radiance
/// 1 at every wavelength Y = 2^EV.
pub fn exposure_scale(exposure_ev: f64) -> f64 {
    exposure_ev.exp2() / equal_energy_luminance()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stop_doubles_the_light() {
        assert!((exposure_scale(0.0) * equal_energy_luminance() - 1.0).abs() < 1e-15);
        assert!((exposure_scale(3.0) / exposure_scale(0.0) - 8.0).abs() < 1e-14);
    }
}
