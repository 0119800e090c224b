//! The trait of the numbers that formulas are written on.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number, or several in lanes.
pub trait Real:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// 1.5 · 2⁵²: a number of less than 2⁵¹ added to it loses its fraction.
    const ROUNDER: f64 = 6_755_399_441_055_744.0;

    /// A number, in every lane.
    #[must_use]
    fn constant(self, value: f64) -> Self;

    /// self · b + c, rounded once where the machine can.
    #[must_use]
    fn mul_add(self, b: Self, c: Self) -> Self;

    /// c − self · b, rounded once where the machine can.
    #[must_use]
    fn negate_mul_add(self, b: Self, c: Self) -> Self;

    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;

    /// The absolute value.
    #[must_use]
    fn abs(self) -> Self;

    /// The larger of this and `least`.
    #[must_use]
    fn at_least(self, least: f64) -> Self;

    /// The smaller of this and `most`.
    #[must_use]
    fn at_most(self, most: f64) -> Self;

    /// The smallest number of all lanes.
    fn least(self) -> f64;

    /// `a` where self ≥ 0, elsewhere `b`.
    #[must_use]
    fn choose(self, a: Self, b: Self) -> Self;

    /// 2^self for whole numbers from −1022 to 1023: the number, as an integer in the low bits, moved to the exponent.
    #[must_use]
    fn exp2_of_whole(self) -> Self;

    /// self · factor.
    #[inline(always)]
    #[must_use]
    fn times(self, factor: f64) -> Self {
        self * self.constant(factor)
    }

    /// 1 − self.
    #[inline(always)]
    #[must_use]
    fn complement(self) -> Self {
        self.constant(1.0) - self
    }

    /// 1 / self.
    #[inline(always)]
    #[must_use]
    fn recip(self) -> Self {
        self.constant(1.0) / self
    }

    /// The nearest whole number, for |self| < 2⁵¹.
    #[inline(always)]
    #[must_use]
    fn round(self) -> Self {
        self + self.constant(Self::ROUNDER) - self.constant(Self::ROUNDER)
    }
}

impl Real for f64 {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value
    }

    // Not `f64::mul_add`: without the instruction that is a slow function of the C library.
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    #[inline(always)]
    fn negate_mul_add(self, b: Self, c: Self) -> Self {
        c - self * b
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }

    #[inline(always)]
    fn at_least(self, least: f64) -> Self {
        self.max(least)
    }

    #[inline(always)]
    fn at_most(self, most: f64) -> Self {
        self.min(most)
    }

    #[inline(always)]
    fn least(self) -> f64 {
        self
    }

    #[inline(always)]
    fn choose(self, a: Self, b: Self) -> Self {
        if self >= 0.0 { a } else { b }
    }

    #[inline(always)]
    fn exp2_of_whole(self) -> Self {
        Self::from_bits((self + (Self::ROUNDER + 1023.0)).to_bits() << 52)
    }
}
