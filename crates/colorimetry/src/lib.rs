//! Colorimetry in `f64`, independent of images and image files.
//!
//! ```text
//! spectrum
//!   -> tristimulus    XYZ under an illuminant for an observer, by sums at 5 or 1 nm
//!   -> chromaticity   x, y and u', v'; temperature of the nearest black body
//!   -> lab, oklab, ciecam16   color appearance and color differences
//!   -> adaptation     the corresponding color under another white
//!   -> Display        amounts of a display's primaries -> its codes
//! ```
//!
//! ```
//! use pellicle_colorimetry::tristimulus::{Rule, Weights};
//! use pellicle_colorimetry::{Adaptation, Display, Lab, matrix::times};
//! use spectra::{Observer, Spectrum, find_illuminant};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let lamp = find_illuminant("A")?.data;
//! let light = Weights::new(&lamp, Observer::Cie1931Deg2, Rule::OneNm)?;
//! let gray = light.xyz_of(&Spectrum::Constant(0.184))?;
//! assert!((Lab::from_xyz(gray, light.white()).l - 50.0).abs() < 0.1);
//!
//! let crt = Display::open("crt_1997")?;
//! let adapted = times(&Adaptation::Bradford.matrix(light.white(), crt.white_xyz()), gray);
//! let amounts = times(crt.rgb_from_xyz(), adapted);
//! let codes: [f64; 3] = std::array::from_fn(|i| crt.responses()[i].code(amounts[i]));
//! assert!(codes.iter().all(|code| (code - codes[0]).abs() < 1e-12));
//! # Ok(())
//! # }
//! ```
//!
//! Tristimulus values are passed and returned as `[X, Y, Z]`; a white is given in the same unit.

pub mod adaptation;
pub mod chromaticity;
pub mod ciecam16;
pub mod display;
pub mod lab;
pub mod lifting;
pub mod matrix;
pub mod oklab;
pub mod srgb;
pub mod temperature;
pub mod tristimulus;

pub use adaptation::Adaptation;
pub use display::Display;
pub use lab::Lab;
pub use matrix::Matrix3;
pub use oklab::Oklab;
