//! Pictures and their files.
//!
//! * [`spectral_exr`] reads and writes spectral images as OpenEXR.
//! * [`rgb_exr`] reads and writes linear red, green and blue as OpenEXR.
//! * [`png`] writes pictures of 8 or 16 bits, tagged with their display (cICP, ICC); [`png_colors`] converts the codes of a PNG file to
//!   colors.
//! * [`radiance`] reads Radiance files (.hdr).
//! * [`icc`] makes and reads ICC profiles.
//!
//! A file is written under another name in the same folder and renamed when it is complete ([`PendingFile`]), so a failure leaves no
//! partial file. [`abandon_all`] removes the unfinished files of a process that a signal ends.

mod cicp;
mod exr_file;
pub mod icc;
mod linear_image;
mod pending_file;
pub mod png;
pub mod png_colors;
pub mod radiance;
pub mod rgb_exr;
mod rgb_image;
pub mod spectral_exr;

pub use linear_image::LinearImage;
pub use pending_file::{
    Abandoned, Destination, PendingFile, STANDARD_OUTPUT, abandon_all, can_create_in,
};
pub use rgb_image::{Code, RgbImage, RgbImage8, RgbImage16};
