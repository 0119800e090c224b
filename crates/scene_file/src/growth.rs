//! Oxides grown by a process. For sources and limits, see [`Anodizing`](crate::description::Anodizing) and
//! [`HeatTint`](crate::description::HeatTint).

/// The gas constant, J/(mol K) (CODATA 2018, exact).
const GAS_CONSTANT: f64 = 8.314_462_618;
/// Fitted to the temper colors: nm²/s.
const TINT_RATE: f64 = 1.06e6;
/// Fitted to the temper colors: J/mol.
const TINT_ENERGY: f64 = 60e3;

/// Square of the thickness of a heat tint on carbon steel, nm².
pub(crate) fn heat_tint_nm2(temperature_c: f64, minutes: f64) -> f64 {
    let kelvin = temperature_c + 273.15;
    TINT_RATE * (-TINT_ENERGY / (GAS_CONSTANT * kelvin)).exp() * 60.0 * minutes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parabolic in time, Arrhenius in temperature, and with the thickness of purple at its calibrated temperature.
    #[test]
    fn heat_tints_follow_their_law() {
        let nm = |c, minutes| heat_tint_nm2(c, minutes).sqrt();
        assert!((nm(282.0, 40.0) / nm(282.0, 10.0) - 2.0).abs() < 1e-12);
        let slope = (nm(300.0, 10.0) / nm(250.0, 10.0)).ln() / (1.0 / 523.15 - 1.0 / 573.15);
        assert!((2.0 * slope * GAS_CONSTANT - TINT_ENERGY).abs() < 1e-6);
        assert!((nm(282.0, 10.0) - 37.9).abs() < 0.1, "{}", nm(282.0, 10.0));
        assert_eq!(nm(282.0, 0.0), 0.0);
    }
}
