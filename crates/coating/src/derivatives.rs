//! How R and T change with each layer's thickness.

use crate::response::{Angle, Powers, Sampled};
use optics::Polarised;

/// ∂R/∂d and ∂T/∂d of one layer, per nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerDerivative {
    /// Of the reflectance.
    pub reflectance: Polarised,
    /// Of the transmittance.
    pub transmittance: Polarised,
}

/// Half the distance of the central differences, nm. Their error is h²/6 of the third derivative, some (4πn/λ)³ per nm³: below
/// 1e-9 per nm at h = 2e-3, and their rounding 1e-16/h.
const HALF_STEP_NM: f64 = 2e-3;

/// For each layer, ∂R/∂d and ∂T/∂d at each wavelength.
///
/// # Panics
/// When there is not one thickness per layer.
pub fn thickness_derivatives(
    sampled: &Sampled,
    thicknesses_nm: &[f64],
    angle: Angle,
) -> Vec<Vec<PowerDerivative>> {
    let moved = |layer: usize, by_nm: f64| {
        let mut thicknesses = thicknesses_nm.to_vec();
        thicknesses[layer] += by_nm;
        sampled.powers(&thicknesses, angle)
    };
    let of_layer = |layer| {
        // A layer of thickness 0 has no thinner neighbour, but the formulas go on to one.
        let pairs = moved(layer, HALF_STEP_NM)
            .into_iter()
            .zip(moved(layer, -HALF_STEP_NM));
        pairs
            .map(|(thicker, thinner)| slope(&thicker, &thinner))
            .collect()
    };
    (0..thicknesses_nm.len()).map(of_layer).collect()
}

fn slope(thicker: &Powers, thinner: &Powers) -> PowerDerivative {
    let of = |a: Polarised, b: Polarised| Polarised {
        s: (a.s - b.s) / (2.0 * HALF_STEP_NM),
        p: (a.p - b.p) / (2.0 * HALF_STEP_NM),
    };
    PowerDerivative {
        reflectance: of(thicker.reflectance, thinner.reflectance),
        transmittance: of(thicker.transmittance, thinner.transmittance),
    }
}
