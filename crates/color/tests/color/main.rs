//! Gamut mapping, and files of colors and of spectra.

mod gamut;
mod rgb_exr;
mod spectral_exr;
