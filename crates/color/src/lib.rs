//! From spectra to pictures.
//!
//! ```text
//! spectra::SpectralImage
//!   -> relight        its light groups with other lamps, seen by another observer
//!   -> develop        exposure, white adaptation, glare, gamut mapping, the display's response, codes
//!   -> png            a PNG file of 8 or 16 bits, tagged with its display (cICP, ICC)
//!   -> rgb_exr        an OpenEXR file of linear red, green and blue
//!   -> spectral_exr   a spectral OpenEXR file, from which all of the above can be repeated
//!   -> probe          the means of a region
//!   -> compare        differences of two images
//! ```
//!
//! In the other direction, pictures are inputs: `radiance` reads Radiance files (.hdr), and `png_colors` converts the codes of a
//! PNG file to colors.
//!
//! Arithmetic is `f64`. Nothing here knows how the image was rendered. Files are written under another
//! name in the same folder and renamed when complete, so a failure leaves no partial file.

mod cicp;
pub mod compare;
pub mod develop;
mod exr_file;
pub mod icc;
mod pending_file;
pub mod png;
pub mod png_colors;
mod probe;
pub mod radiance;
pub(crate) mod relight;
pub mod rgb_exr;
mod rgb_image;
pub mod spectral_exr;
pub mod xyz;
mod xyz_image;

pub use develop::{DevelopSettings, develop};
pub use pending_file::{Destination, PendingFile};
pub use probe::{GroupProbe, Probe, Region, RegionError, probe};
pub use relight::{BandWeights, DarkBand, Relight, RelightError, relight};
pub use rgb_image::{RgbImage, RgbImage8, RgbImage16};
pub use xyz_image::XyzImage;
