//! Optical constants and reflectances as people write them.
//!
//! [`Index`] and [`Reflectance`] are what a file or a program says: a number, a name, a table, a file, a formula or a mixture.
//! [`read_index`] and [`read_reflectance`] check them and return functions of wavelength. Scenes and stacks use the same ones.

mod database;
mod description;
mod formula;
mod index;
pub mod limits;
pub mod points;
mod reflectance;

pub use description::{
    Extrapolate, Index, IndexColumns, MixtureRule, Reflectance, SellmeierTerms, TableColumn,
};
pub use index::{optical_constants, read_index};
pub use reflectance::read_reflectance;

use spectra::Spectrum;

/// What a user can do if data do not cover the wavelengths that are needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Advice<'a> {
    /// Nothing.
    None,
    /// The field `extrapolate` can be added to the table.
    Add,
    /// The name must first be written as a table.
    Name(&'a str),
    /// A part of the mixture does not cover them.
    Part,
}

/// The spectrum, continued outside its wavelengths as requested.
pub fn extrapolated(spectrum: Spectrum, extrapolate: Extrapolate) -> Spectrum {
    match extrapolate {
        Extrapolate::Clamp => spectrum.clamped(),
        Extrapolate::Error => spectrum,
    }
}
