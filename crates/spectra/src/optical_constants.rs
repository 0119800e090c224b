//! A complex index of refraction over wavelength.

use crate::{OutOfRange, Spectrum};
use num_complex::Complex64;

/// The complex index n + ik, with the time factor exp(−iωt): k ≥ 0 absorbs.
#[derive(Clone, Debug, PartialEq)]
pub struct OpticalConstants {
    /// Real part n.
    pub n: Spectrum,
    /// Imaginary part k, the extinction coefficient.
    pub k: Spectrum,
}

impl OpticalConstants {
    /// Returns n + ik at `nm`.
    ///
    /// # Errors
    /// When n or k has no value there.
    pub fn at(&self, nm: f64) -> Result<Complex64, OutOfRange> {
        Ok(Complex64::new(self.n.at(nm)?, self.k.at(nm)?))
    }

    /// First and last wavelength where both n and k have a value, nm; `None` if they have one at every wavelength.
    ///
    /// If n and k have no wavelength in common, the first is above the last.
    pub fn range_nm(&self) -> Option<(f64, f64)> {
        match (self.n.range_nm(), self.k.range_nm()) {
            (Some(n), Some(k)) => Some((n.0.max(k.0), n.1.min(k.1))),
            (n, k) => n.or(k),
        }
    }
}
