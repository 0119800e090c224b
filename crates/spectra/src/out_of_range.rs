//! The error of a spectrum that has no value at a wavelength.

use std::fmt;
use std::sync::Arc;
use thiserror::Error;

/// A spectrum was evaluated where its table or formula has no value.
#[derive(Clone, Debug, Error, PartialEq)]
pub struct OutOfRange {
    /// The wavelength, nm.
    pub nm: f64,
    /// First wavelength of the table or formula, nm.
    pub min_nm: f64,
    /// Last wavelength of the table or formula, nm.
    pub max_nm: f64,
    /// What is wrong with the data at that wavelength, if there are data that cannot be used.
    pub fault: Option<Arc<str>>,
}

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            nm, min_nm, max_nm, ..
        } = self;
        match &self.fault {
            Some(fault) => write!(f, "no value at {nm} nm: {fault}"),
            None => write!(
                f,
                "no value at {nm} nm: the data cover {min_nm} to {max_nm} nm"
            ),
        }
    }
}
