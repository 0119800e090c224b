//! From spectral images to pictures for a display, and comparing both.
//!
//! ```text
//! spectra::SpectralImage
//!   -> relight::relight   its light groups with other lamps, seen by another observer
//!   -> develop            exposure, white adaptation, glare, gamut mapping, the display's response, codes
//!   -> picture_file       PNG, or OpenEXR of linear red, green and blue
//! ```
//!
//! [`Polarization`] shows the polarization of an image in false colors.
//!
//! [`probe()`] gives the means of a region, and [`compare`] the differences of two images. [`Probing`] and [`compare::BandSums`] do so
//! for images that come in strips because they do not fit into memory. Arithmetic is `f64`. Nothing here knows how the
//! image was rendered.

pub mod compare;
pub mod develop;
mod polarization;
mod probe;

pub use develop::{DevelopSettings, develop};
pub use polarization::Polarization;
pub use probe::{GroupProbe, Probe, Probing, Region, RegionError, probe};
