//! A complex index of refraction over wavelength.

use crate::Spectrum;

/// The complex index n + ik, with the time factor exp(−iωt): k ≥ 0 absorbs.
#[derive(Clone, Debug, PartialEq)]
pub struct OpticalConstants {
    /// Real part n.
    pub n: Spectrum,
    /// Imaginary part k, the extinction coefficient.
    pub k: Spectrum,
}
