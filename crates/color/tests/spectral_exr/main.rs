//! Spectral files: what is written is read again, and damaged files are told so.

mod damaged;
mod foreign;
mod lights;
mod reflectances;
mod round_trip;
mod support;
mod windows;
