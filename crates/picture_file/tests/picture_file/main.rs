//! Files of colors and of spectra.

mod rgb_exr;
mod spectral_exr;
