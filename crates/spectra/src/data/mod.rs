//! The tables that the project carries, by name.

use crate::{OpticalConstants, Spectrum, Tabulated};

/// Maximum luminous efficacy of radiation, lm/W (CIE 018:2019; 683 as the CIE rounds 683.002).
pub const KM_LUMENS_PER_WATT: f64 = 683.0;

/// A named spectrum with its source.
#[derive(Clone, Debug, PartialEq)]
pub struct DataSet<T> {
    /// The name by which scenes ask for it.
    pub name: &'static str,
    /// The publication that the figures come from, and the licence where one applies.
    pub citation: String,
    /// The figures.
    pub data: T,
}

/// The CIE 1931 2° colour-matching functions x̄, ȳ, z̄ at 1 nm, 360 to 830 nm.
pub fn observer_1931() -> &'static [Tabulated; 3] { todo!() }
/// A CIE illuminant by name (`"D65"`), relative, scaled so that its luminance equals that of the
/// equal-energy spectrum of value 1: ∫S ȳ dλ = ∫ȳ dλ over 380 to 780 nm (1 nm rule).
pub fn illuminant(name: &str) -> Option<DataSet<Spectrum>> { todo!() }
/// Names that [`illuminant`] knows.
pub fn illuminant_names() -> Vec<&'static str> { todo!() }
/// Optical constants by name (`"gold"`, `"water"`).
pub fn optical_constants(name: &str) -> Option<DataSet<OpticalConstants>> { todo!() }
/// Names that [`optical_constants`] knows.
pub fn material_names() -> Vec<&'static str> { todo!() }
/// A diffuse reflectance by name.
pub fn reflectance(name: &str) -> Option<DataSet<Spectrum>> { todo!() }
/// Names that [`reflectance`] knows.
pub fn reflectance_names() -> Vec<&'static str> { todo!() }
