//! Formulas for many wavelengths at once: what [`batch`](crate::batch) and fast renderers are made of.
//!
//! A formula is written once, for one wavelength, on numbers of the trait [`Real`]: an `f64`, or as many as the registers of the
//! machine hold ([`Lanes`]). It is inlined into a loop over wavelengths that was compiled for an instruction set found at run time:
//! implement [`pulp::WithSimd`] on a struct. (A closure passed to `Arch::dispatch` is not inlined and runs without AVX.)
//!
//! Everything here is independent of [`stack`](crate::stack) and [`reflectance_unpolarized`](crate::reflectance_unpolarized), which are
//! written on complex amplitudes with the standard library's functions and are what this module is tested against.
//!
//! Where a machine multiplies and adds with one rounding, [`Real::mul_add`] does so: results on AVX2, AVX-512 and NEON are the same
//! bits, and differ from those without such an instruction in the last digits. ([`Index::wave`] chooses one form of a layer for all lanes, so
//! that the last digits also depend on the number of lanes where n < 1 and only some lanes are totally reflected.)

#![expect(
    clippy::inline_always,
    reason = "what works on lanes must be inlined into the caller that was compiled for them"
)]

mod complex;
mod elementary;
mod film;
mod interface;
mod lanes;
mod real;
mod stack;

pub(crate) use complex::WideComplex;
pub use elementary::{decay, sin_cos_half_turns, sin_cos_turns, sin_half_turns};
pub use film::{clear_film_reflectance, two_beam_powers};
pub use interface::interface_reflectance;
pub use lanes::{Lanes, MOST};
pub use real::Real;
pub use stack::{Index, SCALED_AFTER, Sweep, Wave};
