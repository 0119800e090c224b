//! The spectrum of a path, and the statistics of the paths of a pixel, in all bands at once.

mod pixel;
mod spectral_path;

pub(crate) use pixel::Pixel;
pub(crate) use spectral_path::SpectralPath;
