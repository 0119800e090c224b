//! From spectra to pictures: CIE XYZ, the sRGB display, whole images. Arithmetic is `f64`.

mod develop;
pub mod srgb;
pub mod xyz;

pub use develop::{RgbImage8, develop};
