//! Spectra, optical constants and spectral images.
//!
//! Wavelengths are vacuum wavelengths in nanometers. Everything is `f64` until a renderer fills a
//! [`SpectralImage`], which holds `f32`.
//!
//! * [`Tabulated`] is a table over wavelength, linear between its points; [`DispersionFormula`] computes an index from
//!   coefficients; [`Spectrum`] is one of these or a constant.
//! * [`OpticalConstants`] is a complex index n + ik over wavelength, where k ≥ 0 absorbs; [`OpticalConstants::mixture`]
//!   computes it for a mixture of two media.
//! * [`BandGrid`] divides the rendered range into N uniform bands.
//! * [`BandTable`] is a spectrum resampled onto a grid, fine enough for any wavelength sampled within a band.
//! * [`table_file`] reads users' tables.
//! * [`SpectralImage`] is the output of a renderer: radiance per pixel and band, by [`LightGroup`], as a list of [`ImageLayer`]s.
//! * [`stokes`] defines the components of polarized light.
//! * [`Accumulation`] is a render in progress: running means, advanced in [`Round`]s.
//! * [`find_illuminant`], [`Observer`], [`optical_constants()`] and [`reflectance`] give access to the built-in data;
//!   [`material_info`] gives the source of a material's data.

mod accumulation;
mod band_grid;
mod band_table;
mod data;
mod effective_medium;
mod fault;
mod formula;
mod interpolation;
mod light_group;
mod optical_constants;
mod out_of_range;
pub mod sky;
mod spectral_image;
mod spectrum;
mod sprague;
pub mod stokes;
pub mod table_file;
mod window;

pub use accumulation::{Accumulation, Round, SumLayout, variance_of_mean};
pub use band_grid::{BandGrid, BandGridError};
pub use band_table::BandTable;
pub use data::{
    DataSet, IlluminantError, KM_LUMENS_PER_WATT, MaterialInfo, Observer, UnknownObserver,
    black_body, find_illuminant, illuminant, illuminant_names, is_line_lamp, material_aliases,
    material_info, material_names, material_sets, observer_1931, optical_constants, reflectance,
    reflectance_names,
};
pub use effective_medium::{MixtureError, MixtureRule, bruggeman, maxwell_garnett};
pub use fault::Fault;
pub use formula::{DispersionFormula, FormulaError, FormulaKind};
pub use interpolation::{knot_before, linear};
pub use light_group::LightGroup;
pub use optical_constants::OpticalConstants;
pub use out_of_range::OutOfRange;
pub use spectral_image::{
    ImageLayer, LayerError, LayerKey, PixelContent, Quantity, RowMut, SpectralImage, Values,
};
pub use spectrum::{Spectrum, Tabulated, TabulatedError};
pub use sprague::sprague;
pub use stokes::Stokes;
pub use window::Window;
