//! From spectra to pictures.
//!
//! ```text
//! spectra::SpectralImage
//!   -> relight        its light groups under other lamps, seen by another observer
//!   -> xyz            XYZ of a pixel, relative to an equal-energy radiance of 1, times 2^EV
//!   -> colorimetry    linear sRGB, then the transfer curve
//!   -> develop        the whole image: 8-bit RGB
//!   -> png            a PNG file that says which colour space it is in
//!   -> spectral_exr   a spectral OpenEXR file, from which all of the above can be done again
//! ```
//!
//! Arithmetic is `f64`. Nothing here knows how the image was rendered. Files are written under another
//! name beside the one asked for and renamed when complete, so a failure leaves no half file.

mod develop;
mod pending_file;
pub mod png;
mod relight;
pub mod spectral_exr;
pub mod xyz;

pub use develop::{RgbImage8, develop};
pub use pending_file::PendingFile;
pub use relight::{BandWeights, DarkBand, Relight, RelightError, relight};
