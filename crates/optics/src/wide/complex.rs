//! Complex numbers.

use super::Real;
use std::ops::Mul;

/// A complex number, or several in lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WideComplex<T> {
    pub(crate) re: T,
    pub(crate) im: T,
}

impl<T: Real> WideComplex<T> {
    #[inline(always)]
    pub(crate) fn new(re: T, im: T) -> Self {
        Self { re, im }
    }

    #[inline(always)]
    pub(crate) fn real(re: T) -> Self {
        Self {
            re,
            im: re.constant(0.0),
        }
    }

    #[inline(always)]
    pub(crate) fn norm_sqr(self) -> T {
        self.re.mul_add(self.re, self.im * self.im)
    }

    #[inline(always)]
    pub(crate) fn scale(self, factor: T) -> Self {
        Self::new(self.re * factor, self.im * factor)
    }

    #[inline(always)]
    pub(crate) fn recip(self) -> Self {
        let factor = self.norm_sqr().recip();
        Self::new(self.re * factor, -(self.im * factor))
    }

    /// self · b*.
    #[inline(always)]
    pub(crate) fn times_conj(self, b: Self) -> Self {
        Self {
            re: self.im.mul_add(b.im, self.re * b.re),
            im: self.re.negate_mul_add(b.im, self.im * b.re),
        }
    }

    /// self · b + c.
    #[inline(always)]
    pub(crate) fn mul_add(self, b: Self, c: Self) -> Self {
        Self {
            re: self.im.negate_mul_add(b.im, self.re.mul_add(b.re, c.re)),
            im: self.im.mul_add(b.re, self.re.mul_add(b.im, c.im)),
        }
    }
}

impl<T: Real> Mul for WideComplex<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        Self {
            re: self.im.negate_mul_add(b.im, self.re * b.re),
            im: self.im.mul_add(b.re, self.re * b.im),
        }
    }
}
