//! Spectral files: written files are read back, and damaged files are reported.

mod damaged;
mod foreign;
mod lights;
mod polarized;
mod reflectances;
mod round_trip;
mod rows;
mod strips;
mod support;
mod windows;
