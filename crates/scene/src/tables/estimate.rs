//! Rough estimates of how much light materials reflect and transmit; they steer sampling and cancel in the result.

use crate::rounding::RoundToF32;
use spectra::linear;

/// A cheap estimate of how much light a material reflects and transmits, averaged over its thicknesses.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// The fraction of incident light that is reflected or transmitted, in \[0, 1\], at the wavelength where it is largest.
    pub albedo: f64,
    /// The fraction R / (R + T) that a film reflects of the light that it does not absorb, in \[0, 1\], averaged over wavelengths, at
    /// [`Estimate::KNOTS`] equally spaced cosines from 0 to 1. Empty for other materials.
    pub reflected: Vec<f64>,
}

impl Estimate {
    /// Number of cosines.
    pub const KNOTS: usize = 33;

    /// The fraction [`Self::reflected`] of a film at a cosine, interpolated linearly between the knots.
    ///
    /// # Panics
    /// For materials that are not films.
    pub fn reflected_at(&self, cosine: f64) -> f64 {
        linear(&self.reflected, cosine.clamp(0.0, 1.0))
    }
}

impl RoundToF32 for Estimate {
    fn rounded(&self) -> Self {
        Self {
            albedo: self.albedo.rounded(),
            reflected: self.reflected.rounded(),
        }
    }
}
