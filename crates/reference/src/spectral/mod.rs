//! The spectrum of a path, and the statistics of the paths of a pixel, in all bands at once.

mod events;
mod found;
mod pixel;
mod spectral_path;
mod stokes_path;
mod wavelengths;

pub(crate) use found::{Found, SpectralTransport};
pub(crate) use pixel::Pixel;
pub(crate) use spectral_path::SpectralPath;
pub(crate) use stokes_path::StokesPath;
