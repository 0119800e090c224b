//! Numbers in the lanes of SIMD registers, of the instruction set found at run time. Every function is inlined into the
//! caller that was compiled for that set.

use super::Real;
use pulp::Simd;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The most lanes of any instruction set.
pub const MAX: usize = 8;

/// As many `f64` as a register of `S` holds.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<S: Simd> {
    simd: S,
    values: S::f64s,
}

impl<S: Simd> Lanes<S> {
    /// Number of lanes.
    pub const COUNT: usize = {
        assert!(S::F64_LANES <= MAX);
        S::F64_LANES
    };

    /// The same number in every lane.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        let values = simd.splat_f64s(value);
        Self { simd, values }
    }

    /// The first numbers of a slice of at least [`Self::COUNT`].
    #[inline(always)]
    pub fn load(simd: S, numbers: &[f64]) -> Self {
        let values = S::as_simd_f64s(&numbers[..Self::COUNT]).0[0];
        Self { simd, values }
    }

    /// Writes the lanes to the first [`Self::COUNT`] numbers of a slice.
    #[inline(always)]
    pub fn store(self, numbers: &mut [f64]) {
        S::as_mut_simd_f64s(&mut numbers[..Self::COUNT]).0[0] = self.values;
    }

    #[inline(always)]
    fn with(self, values: S::f64s) -> Self {
        Self { values, ..self }
    }
}

impl<S: Simd> Real for Lanes<S> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self.with(self.simd.mul_add_e_f64s(self.values, b.values, c.values))
    }

    #[inline(always)]
    fn negate_mul_add(self, b: Self, c: Self) -> Self {
        let found = self
            .simd
            .negate_mul_add_e_f64s(self.values, b.values, c.values);
        self.with(found)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.with(self.simd.sqrt_f64s(self.values))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.with(self.simd.abs_f64s(self.values))
    }

    #[inline(always)]
    fn at_least(self, least: f64) -> Self {
        let least = self.simd.splat_f64s(least);
        self.with(self.simd.max_f64s(self.values, least))
    }

    #[inline(always)]
    fn at_most(self, most: f64) -> Self {
        let most = self.simd.splat_f64s(most);
        self.with(self.simd.min_f64s(self.values, most))
    }

    #[inline(always)]
    fn least(self) -> f64 {
        self.simd.reduce_min_f64s(self.values)
    }

    #[inline(always)]
    fn choose(self, a: Self, b: Self) -> Self {
        let zero = self.simd.splat_f64s(0.0);
        let mask = self.simd.greater_than_or_equal_f64s(self.values, zero);
        self.with(self.simd.select_f64s(mask, a.values, b.values))
    }

    #[inline(always)]
    fn exp2_of_whole(self) -> Self {
        let mut shifted = (self + self.constant(Self::ROUNDER + 1023.0)).values;
        let one = std::slice::from_mut(&mut shifted);
        for bits in bytemuck::cast_slice_mut::<S::f64s, u64>(one) {
            *bits <<= 52;
        }
        self.with(shifted)
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        self.with(self.simd.add_f64s(self.values, b.values))
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        self.with(self.simd.sub_f64s(self.values, b.values))
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        self.with(self.simd.mul_f64s(self.values, b.values))
    }
}

impl<S: Simd> Div for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn div(self, b: Self) -> Self {
        self.with(self.simd.div_f64s(self.values, b.values))
    }
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self.simd.neg_f64s(self.values))
    }
}
