//! Numbers side by side in the registers of whichever instruction set is found at run time, with operators, so that the
//! formulas read as formulas. Every function is inlined into the caller that was compiled for that set.

use pulp::Simd;
use std::ops::{Add, Mul, Neg, Sub};

/// The most lanes that any instruction set has.
pub(super) const MOST: usize = 8;

/// As many f64 as the registers of `S` hold.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lanes<S: Simd> {
    simd: S,
    values: S::f64s,
}

impl<S: Simd> Lanes<S> {
    pub(super) const COUNT: usize = {
        assert!(S::F64_LANES <= MOST);
        S::F64_LANES
    };

    #[inline(always)]
    pub(super) fn splat(simd: S, value: f64) -> Self {
        let values = simd.splat_f64s(value);
        Self { simd, values }
    }

    /// The first numbers of a slice of at least [`Self::COUNT`].
    #[inline(always)]
    pub(super) fn load(simd: S, numbers: &[f64]) -> Self {
        let values = S::as_simd_f64s(&numbers[..Self::COUNT]).0[0];
        Self { simd, values }
    }

    #[inline(always)]
    pub(super) fn store(self, numbers: &mut [f64]) {
        S::as_mut_simd_f64s(&mut numbers[..Self::COUNT]).0[0] = self.values;
    }

    #[inline(always)]
    fn with(self, values: S::f64s) -> Self {
        Self { values, ..self }
    }

    /// The same number in every lane.
    #[inline(always)]
    pub(super) fn constant(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    /// self · b + c, rounded once where the machine can.
    #[inline(always)]
    pub(super) fn mul_add(self, b: Self, c: Self) -> Self {
        self.with(self.simd.mul_add_e_f64s(self.values, b.values, c.values))
    }

    /// c − self · b.
    #[inline(always)]
    pub(super) fn negate_mul_add(self, b: Self, c: Self) -> Self {
        let found = self
            .simd
            .negate_mul_add_e_f64s(self.values, b.values, c.values);
        self.with(found)
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        self.with(self.simd.sqrt_f64s(self.values))
    }

    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        self.with(self.simd.abs_f64s(self.values))
    }

    #[inline(always)]
    pub(super) fn recip(self) -> Self {
        let one = self.simd.splat_f64s(1.0);
        self.with(self.simd.div_f64s(one, self.values))
    }

    #[inline(always)]
    pub(super) fn at_least(self, least: f64) -> Self {
        let least = self.simd.splat_f64s(least);
        self.with(self.simd.max_f64s(self.values, least))
    }

    #[inline(always)]
    pub(super) fn at_most(self, most: f64) -> Self {
        let most = self.simd.splat_f64s(most);
        self.with(self.simd.min_f64s(self.values, most))
    }

    /// The least number of all lanes.
    #[inline(always)]
    pub(super) fn least(self) -> f64 {
        self.simd.reduce_min_f64s(self.values)
    }

    /// `a` where self ≥ 0, elsewhere `b`.
    #[inline(always)]
    pub(super) fn choose(self, a: Self, b: Self) -> Self {
        let zero = self.simd.splat_f64s(0.0);
        let mask = self.simd.greater_than_or_equal_f64s(self.values, zero);
        self.with(self.simd.select_f64s(mask, a.values, b.values))
    }

    /// 1.5 · 2⁵²: a number of less than 2⁵¹ added to it loses its fraction.
    const ROUNDER: f64 = 6_755_399_441_055_744.0;

    /// The nearest whole number, for |self| < 2⁵¹.
    #[inline(always)]
    pub(super) fn round(self) -> Self {
        self + self.constant(Self::ROUNDER) - self.constant(Self::ROUNDER)
    }

    /// 2^self for whole numbers from −1022 to 1023: the number, as an integer in the low bits, moved to the exponent.
    #[inline(always)]
    pub(super) fn exp2_of_whole(self) -> Self {
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

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self.simd.neg_f64s(self.values))
    }
}

/// Complex numbers side by side.
#[derive(Clone, Copy, Debug)]
pub(super) struct ComplexLanes<S: Simd> {
    pub(super) re: Lanes<S>,
    pub(super) im: Lanes<S>,
}

impl<S: Simd> ComplexLanes<S> {
    #[inline(always)]
    pub(super) fn new(re: Lanes<S>, im: Lanes<S>) -> Self {
        Self { re, im }
    }

    #[inline(always)]
    pub(super) fn real(re: Lanes<S>) -> Self {
        Self {
            re,
            im: re.constant(0.0),
        }
    }

    #[inline(always)]
    pub(super) fn norm_sqr(self) -> Lanes<S> {
        self.re.mul_add(self.re, self.im * self.im)
    }

    #[inline(always)]
    pub(super) fn scale(self, factor: Lanes<S>) -> Self {
        Self::new(self.re * factor, self.im * factor)
    }

    #[inline(always)]
    pub(super) fn recip(self) -> Self {
        let factor = self.norm_sqr().recip();
        Self::new(self.re * factor, -(self.im * factor))
    }

    /// self · b + c.
    #[inline(always)]
    pub(super) fn mul_add(self, b: Self, c: Self) -> Self {
        Self {
            re: self.im.negate_mul_add(b.im, self.re.mul_add(b.re, c.re)),
            im: self.im.mul_add(b.re, self.re.mul_add(b.im, c.im)),
        }
    }
}

impl<S: Simd> Mul for ComplexLanes<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        Self {
            re: self.im.negate_mul_add(b.im, self.re * b.re),
            im: self.im.mul_add(b.re, self.re * b.im),
        }
    }
}
