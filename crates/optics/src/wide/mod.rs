//! Formulas for many wavelengths at once, the basis of [`batch`](crate::batch) and of fast renderers.
//!
//! A formula is written once, for one wavelength, on numbers of the trait [`Real`]: one `f64`, or as many as a register of the
//! machine holds ([`Lanes`]). It is inlined into a loop over wavelengths that was compiled for an instruction set found at run time:
//! implement [`pulp::WithSimd`] on a struct. (A closure passed to `Arch::dispatch` is not inlined and runs without AVX.)
//!
//! Everything here is independent of [`stack`](crate::stack) and [`reflectance_unpolarized`](crate::reflectance_unpolarized). Those use
//! complex amplitudes and the standard library's functions, and this module is tested against them.
//!
//! Where a machine multiplies and adds with one rounding, [`Real::mul_add`] does so: results on AVX2, AVX-512 and NEON are bit-identical
//! and differ in the last digits from those without such an instruction. ([`Index::wave`] chooses one form of a layer for all lanes, so
//! the last digits also depend on the number of lanes where n < 1 and only some lanes are totally reflected.)

#![expect(
    clippy::inline_always,
    reason = "code that works on lanes must be inlined into the caller that was compiled for them"
)]

mod complex;
mod elementary;
mod film;
mod interface;
mod lanes;
mod polarized;
mod real;
mod stack;

pub(crate) use complex::WideComplex;
pub use elementary::{decay, sin_cos_half_turns, sin_cos_turns, sin_half_turns};
pub use film::{clear_film_reflectance, two_beam_powers};
pub use interface::interface_reflectance;
pub use lanes::{Lanes, MAX};
pub use polarized::{
    PolarizedPowers, clear_film_polarized, interface_polarized, two_beam_polarized,
};
pub use real::Real;
pub use stack::{Index, SCALED_AFTER, Sweep, Wave};
