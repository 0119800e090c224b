//! Mueller matrices of interfaces and surfaces, in all bands at once.

use super::{At, BandValue, Bands, Spectrum};
use crate::polarization::Turn;
use optics::wide::{Lanes, PolarizedPowers, Real};
use pulp::Simd;

/// The elements of a Mueller matrix that are not 0, for reference axes in the planes of incidence. M33 = M22 and M32 = −M23.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mueller<T> {
    pub(crate) m00: T,
    pub(crate) m01: T,
    pub(crate) m10: T,
    pub(crate) m11: T,
    pub(crate) m22: T,
    pub(crate) m23: T,
}

/// Which elements a matrix has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MuellerKind {
    /// M00 alone: what leaves is unpolarized, and only S0 of what arrives matters.
    Depolarizer,
    /// M11 = M00 and M10 = M01: amplitudes for s and p.
    Amplitudes,
    /// All.
    General,
}

impl MuellerKind {
    /// Number of elements that are stored.
    pub(crate) fn rows(self) -> usize {
        match self {
            Self::Depolarizer => 1,
            Self::Amplitudes => 4,
            Self::General => 6,
        }
    }
}

/// Something with a Mueller matrix in each band.
pub(crate) trait BandMueller {
    /// Returns the matrix in some bands.
    fn mueller<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Mueller<Lanes<S>>;
}

impl<T: Real> Mueller<T> {
    /// The matrix of amplitudes for s and p, times a weight.
    #[inline(always)]
    pub(crate) fn of(powers: &PolarizedPowers<T>, weight: f64) -> Self {
        let (sum, difference) = (powers.s + powers.p, powers.s - powers.p);
        let (mean, half) = (sum.times(0.5 * weight), difference.times(0.5 * weight));
        Self {
            m00: mean,
            m01: half,
            m10: half,
            m11: mean,
            m22: powers.re.times(weight),
            m23: -powers.im.times(weight),
        }
    }

    /// A matrix that takes the powers of s and p of what arrives and gives those of what leaves, without phases.
    #[inline(always)]
    pub(crate) fn product([out_s, out_p]: [T; 2], [in_s, in_p]: [T; 2], weight: T) -> Self {
        let half = |a: T, b: T| ((a + b).times(0.5), (a - b).times(0.5));
        let ((out_mean, out_half), (in_mean, in_half)) = (half(out_s, out_p), half(in_s, in_p));
        let (out_mean, out_half) = (out_mean * weight, out_half * weight);
        let zero = out_mean.constant(0.0);
        Self {
            m00: out_mean * in_mean,
            m01: out_mean * in_half,
            m10: out_half * in_mean,
            m11: out_half * in_half,
            m22: zero,
            m23: zero,
        }
    }

    /// The matrix with a depolarizing part added.
    #[inline(always)]
    pub(crate) fn and_depolarizer(self, more: T) -> Self {
        Self {
            m00: self.m00 + more,
            ..self
        }
    }
}

/// A stored matrix: its kind, and its rows in a list of spectra.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StoredMueller {
    pub(crate) kind: MuellerKind,
    pub(crate) first: usize,
}

impl StoredMueller {
    /// Stores some bands of the matrix.
    #[inline(always)]
    pub(crate) fn store<S: Simd>(
        self,
        (bands, at): (&Bands<'_, S>, At),
        rows: &mut [Spectrum],
        m: &Mueller<Lanes<S>>,
    ) {
        let mut put = |place: usize, value| bands.store(at, value, &mut rows[self.first + place]);
        put(0, m.m00);
        if self.kind == MuellerKind::Depolarizer {
            return;
        }
        put(1, m.m01);
        put(2, m.m22);
        put(3, m.m23);
        if self.kind == MuellerKind::General {
            put(4, m.m10);
            put(5, m.m11);
        }
    }

    /// Multiplies a Stokes vector by the matrix, in some bands.
    #[inline(always)]
    pub(crate) fn apply<S: Simd>(
        self,
        (bands, at): (&Bands<'_, S>, At),
        rows: &[Spectrum],
        [s0, s1, s2, s3]: [Lanes<S>; 4],
    ) -> [Lanes<S>; 4] {
        let row = |place: usize| bands.load(at, &rows[self.first + place]);
        let m00 = row(0);
        match self.kind {
            MuellerKind::Depolarizer => {
                let zero = bands.splat(0.0);
                [m00 * s0, zero, zero, zero]
            }
            MuellerKind::Amplitudes => {
                let (m01, m22, m23) = (row(1), row(2), row(3));
                [
                    m01.mul_add(s1, m00 * s0),
                    m01.mul_add(s0, m00 * s1),
                    m23.mul_add(s3, m22 * s2),
                    m23.negate_mul_add(s2, m22 * s3),
                ]
            }
            MuellerKind::General => {
                let (m01, m22, m23) = (row(1), row(2), row(3));
                let (m10, m11) = (row(4), row(5));
                [
                    m01.mul_add(s1, m00 * s0),
                    m11.mul_add(s1, m10 * s0),
                    m23.mul_add(s3, m22 * s2),
                    m23.negate_mul_add(s2, m22 * s3),
                ]
            }
        }
    }
}

impl<S: Simd> Bands<'_, S> {
    /// Loads some bands of a spectrum.
    #[inline(always)]
    pub(crate) fn load(&self, at: At, spectrum: &Spectrum) -> Lanes<S> {
        at.load(self.simd, &spectrum.0[..self.chunks().len()])
    }

    /// Stores some bands of a spectrum.
    #[inline(always)]
    pub(crate) fn store(&self, at: At, values: Lanes<S>, to: &mut Spectrum) {
        at.store(values, &mut to.0[..self.chunks().len()]);
    }

    /// Writes a value to a spectrum.
    #[inline(always)]
    pub(crate) fn write(&self, value: &impl BandValue, to: &mut Spectrum) {
        for chunk in self.chunks() {
            for at in At::lanes::<S>(chunk) {
                self.store(at, value.value(self, at), to);
            }
        }
    }

    /// Writes a matrix to its rows.
    #[inline(always)]
    pub(crate) fn write_mueller(
        &self,
        value: &impl BandMueller,
        to: StoredMueller,
        rows: &mut [Spectrum],
    ) {
        for chunk in self.chunks() {
            for at in At::lanes::<S>(chunk) {
                to.store((self, at), rows, &value.mueller(self, at));
            }
        }
    }

    /// Turns the reference axis of a Stokes vector.
    #[inline(always)]
    pub(crate) fn turned(&self, turn: Turn, [s0, s1, s2, s3]: [Lanes<S>; 4]) -> [Lanes<S>; 4] {
        let (cos, sin) = (self.splat(turn.cos), self.splat(turn.sin));
        [
            s0,
            sin.mul_add(s2, cos * s1),
            sin.negate_mul_add(s1, cos * s2),
            s3,
        ]
    }
}
