//! Mueller matrices of interfaces and surfaces, in all bands at once.

use super::{At, BandValue, Bands, CHUNK, Spectrum};
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
        let weight = weight.times(0.5);
        let (out_mean, out_half) = ((out_s + out_p) * weight, (out_s - out_p) * weight);
        let (in_mean, in_half) = ((in_s + in_p).times(0.5), (in_s - in_p).times(0.5));
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
        let rows = &mut rows[self.first..];
        bands.store(at, m.m00, &mut rows[0]);
        if self.kind == MuellerKind::Depolarizer {
            return;
        }
        bands.store(at, m.m01, &mut rows[1]);
        bands.store(at, m.m22, &mut rows[2]);
        bands.store(at, m.m23, &mut rows[3]);
        if self.kind == MuellerKind::General {
            bands.store(at, m.m10, &mut rows[4]);
            bands.store(at, m.m11, &mut rows[5]);
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
        let rows = &rows[self.first..];
        let m00 = bands.load(at, &rows[0]);
        match self.kind {
            MuellerKind::Depolarizer => {
                let zero = bands.splat(0.0);
                [m00 * s0, zero, zero, zero]
            }
            MuellerKind::Amplitudes => {
                let [_, m01, m22, m23] = bands.load_four(at, rows);
                [
                    m01.mul_add(s1, m00 * s0),
                    m01.mul_add(s0, m00 * s1),
                    m23.mul_add(s3, m22 * s2),
                    m23.negate_mul_add(s2, m22 * s3),
                ]
            }
            MuellerKind::General => {
                let [_, m01, m22, m23] = bands.load_four(at, rows);
                let (m10, m11) = (bands.load(at, &rows[4]), bands.load(at, &rows[5]));
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

    /// Loads some bands of the first four spectra.
    #[inline(always)]
    pub(crate) fn load_four(&self, at: At, spectra: &[Spectrum]) -> [Lanes<S>; 4] {
        [
            self.load(at, &spectra[0]),
            self.load(at, &spectra[1]),
            self.load(at, &spectra[2]),
            self.load(at, &spectra[3]),
        ]
    }

    /// Returns all bands, one register after the other.
    #[inline(always)]
    pub(crate) fn registers(&self) -> impl Iterator<Item = At> + use<S> {
        let lanes = CHUNK / Lanes::<S>::COUNT;
        (0..self.chunks().len() * lanes).map(move |i| At(i / lanes, i % lanes * Lanes::<S>::COUNT))
    }

    /// Stores some bands of a spectrum.
    #[inline(always)]
    pub(crate) fn store(&self, at: At, values: Lanes<S>, to: &mut Spectrum) {
        at.store(values, &mut to.0[..self.chunks().len()]);
    }

    /// Writes a value to a spectrum.
    #[inline(always)]
    pub(crate) fn write(&self, value: &impl BandValue, to: &mut Spectrum) {
        for at in self.registers() {
            self.store(at, value.value(self, at), to);
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
        for at in self.registers() {
            to.store((self, at), rows, &value.mueller(self, at));
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
