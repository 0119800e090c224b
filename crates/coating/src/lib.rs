//! Design and analysis of thin-film stacks.
//!
//! ```text
//! "air | silica 300nm | silicon"  or a stack file     errors: where, what was found, what would be right
//!   -> Stack                media (n + ik over wavelength) and layers with their thickness
//!   -> Sampled              the stack at chosen wavelengths: numbers alone
//!   -> powers               R, T and A for s and p over wavelength at an angle
//!   -> amplitudes           r and t, and the ellipsometric angles
//!   -> Light::xyz           color under an illuminant for an observer, sums at 1 nm
//!   -> sensitivity, tolerance, matching: how the color depends on the thicknesses
//!   -> film_fit             which thickness gives a measured or rendered spectrum
//!   -> plot, phase_plot, chart  pictures of these results
//! ```
//!
//! ```
//! use pellicle_coating::{Angle, Light, Stack, StackColor, View};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let stack = Stack::parse("1.0 | silica 300nm | silicon")?;
//! let color = StackColor::new(&stack, Light::named("D65")?, View::default())?;
//! let blue = color.at(stack.thicknesses_nm(), Angle::NORMAL);
//! assert!(blue.lab().b < -30.0);
//! # Ok(())
//! # }
//! ```
//!
//! Wavelengths are vacuum wavelengths. Wavelengths and thicknesses are in nanometers. Angles are in degrees, in the incident
//! medium. Light is unpolarized unless stated otherwise. The sign convention is n + ik, where k ≥ 0 absorbs.

mod angle;
mod chart;
mod file;
mod film_fit;
mod fringes;
mod label;
mod light;
mod line;
mod matching;
mod medium;
mod model;
mod open;
mod phase;
mod phase_plot;
mod plot;
mod response;
mod sensitivity;
mod stack;
mod stack_color;
mod thickness;
mod tolerance;
mod view;

pub use self::plot::{Curve, Plot};
pub use ::plot::Over;
pub use angle::{Angle, AngleError};
pub use chart::{Chart, ChartOf};
pub use file::{LayerDescription, OpticalThickness, StackDescription};
pub use film_fit::{FilmFit, FilmFits, FilmFitting, Measured, Verdict, nearest_fit};
pub use light::Light;
pub use line::LineError;
pub use matching::{Match, MatchBy, MatchPlace, Matching, matches};
pub use medium::{Layer, Medium};
pub use model::Model;
pub use open::StackError;
pub use optics::batch::Powers;
pub use optics::{Amplitudes, PathDifference};
pub use phase::{EllipsometricAngles, PSign};
pub use phase_plot::PhasePlot;
pub use response::{Batch, Sampled, absorptance};
pub use sensitivity::{LayerSensitivity, Sensitivity, sensitivity};
pub use stack::{SampleError, Stack};
pub use stack_color::{Color, ParseColorError, StackColor, parse_srgb};
pub use tolerance::{Quantiles, Spread, Tolerance, ToleranceError, tolerance};
pub use view::{Polarization, Side, View};
