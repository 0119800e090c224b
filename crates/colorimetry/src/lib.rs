//! Colorimetry in `f64`: functions of numbers, which know no image and no file of one.
//!
//! Tristimulus values enter and leave as `[X, Y, Z]`; where a white matters it is given in the same unit.

pub mod adaptation;
pub mod chromaticity;
pub mod ciecam16;
pub mod display;
pub mod lab;
pub mod matrix;
pub mod oklab;
pub mod srgb;
pub mod tristimulus;

pub use adaptation::Adaptation;
pub use display::Display;
pub use lab::Lab;
pub use matrix::Matrix3;
pub use oklab::Oklab;
