//! R and T of a stack, computed on the CPU or on a GPU.

use crate::Backend;
use coating::{Angle, Powers, Sampled};
use thiserror::Error;

/// Why there are no numbers.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StacksError {
    /// Stacks are computed on the CPU alone.
    #[error("stacks cannot be computed on a GPU yet")]
    NoGpu,
}

/// For each angle R and T at each wavelength of `stack`, with these thicknesses (nm, one per layer). [`Backend::Auto`] takes the
/// CPU.
///
/// # Errors
/// When the backend cannot do it.
///
/// # Panics
/// When there is not one thickness per layer.
pub fn powers(
    stack: &Sampled,
    thicknesses_nm: &[f64],
    angles: &[Angle],
    backend: &Backend,
) -> Result<Vec<Vec<Powers>>, StacksError> {
    match backend {
        Backend::Cpu | Backend::Auto => Ok(angles
            .iter()
            .map(|&angle| stack.powers(thicknesses_nm, angle))
            .collect()),
        Backend::Gpu(_) => Err(StacksError::NoGpu),
    }
}
