//! Numbers for all bands at once, in the vector registers of the machine.
//!
//! Formulas come from `optics::wide`, written for one wavelength; here they are called in loops over the bands.

mod mueller;
mod spectrum;

pub(crate) use mueller::{BandMueller, Mueller, MuellerKind, StoredMueller};
pub(crate) use spectrum::{Row, Tables};

use bytemuck::{Pod, Zeroable};
use optics::wide::{Lanes, MAX, Real};
use pulp::Simd;
use scene::Emission;

/// Bands of a chunk: as many as the widest registers hold, so that registers of any width divide it.
const CHUNK: usize = MAX;

/// Some bands, in one cache line.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct Chunk([f64; CHUNK]);

impl Chunk {
    /// Returns the sum of the bands, in pairs.
    #[inline(always)]
    pub(crate) fn sum(&self) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.0;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }
}

/// A value for each band, padded to whole chunks.
#[derive(Clone, Debug)]
pub(crate) struct Spectrum(pub(crate) Vec<Chunk>);

impl Spectrum {
    pub(crate) fn zero(chunks: usize) -> Self {
        Self(vec![Chunk([0.0; CHUNK]); chunks])
    }

    /// Returns the values, including the padding of the last chunk.
    pub(crate) fn values(&self) -> &[f64] {
        bytemuck::cast_slice(&self.0)
    }

    pub(crate) fn values_mut(&mut self) -> &mut [f64] {
        bytemuck::cast_slice_mut(&mut self.0)
    }

    pub(crate) fn fill(&mut self, value: f64) {
        self.0.fill(Chunk([value; CHUNK]));
    }
}

/// As many bands as a register holds: a chunk, and the first of its lanes.
#[derive(Clone, Copy)]
pub(crate) struct At(usize, usize);

impl At {
    /// Returns all lanes of a chunk. Their number is known at compile time.
    #[inline(always)]
    pub(crate) fn lanes<S: Simd>(chunk: usize) -> impl Iterator<Item = Self> {
        (0..CHUNK)
            .step_by(Lanes::<S>::COUNT)
            .map(move |lane| Self(chunk, lane))
    }

    /// Returns the same lanes of another chunk.
    #[inline(always)]
    pub(crate) fn in_chunk(self, chunk: usize) -> Self {
        Self(chunk, self.1)
    }

    /// Returns the indices of the bands.
    #[inline(always)]
    pub(crate) fn band<S: Simd>(self, simd: S) -> Lanes<S> {
        const NUMBERS: [f64; CHUNK] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
        let first = Lanes::splat(simd, (CHUNK * self.0) as f64);
        first + Lanes::load(simd, &NUMBERS[self.1..])
    }

    /// Loads the bands of a spectrum.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(self, simd: S, chunks: &[Chunk]) -> Lanes<S> {
        Lanes::load(simd, &chunks[self.0].0[self.1..])
    }

    /// Stores the bands of a spectrum.
    #[inline(always)]
    pub(crate) fn store<S: Simd>(self, values: Lanes<S>, chunks: &mut [Chunk]) {
        values.store(&mut chunks[self.0].0[self.1..]);
    }
}

/// Something with a value in each band. Each implementation gets its own loop over the bands, which keeps only what it needs in registers.
pub(crate) trait BandValue {
    /// Returns the value in some bands.
    fn value<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S>;
}

/// Something with a reflectance and a transmittance in each band.
pub(crate) trait BandPowers {
    /// Returns reflectance and transmittance in some bands.
    fn powers<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> (Lanes<S>, Lanes<S>);
}

/// The result that is wanted of the light at a film.
pub(crate) enum Through<'a> {
    Reflected(&'a mut Spectrum),
    Transmitted(&'a mut Spectrum),
    /// The reflected light in place of the first spectrum, the transmitted light in the second.
    Both(&'a mut Spectrum, &'a mut Spectrum),
}

struct Reflected<'a, T>(&'a T);
struct Transmitted<'a, T>(&'a T);

impl<T: BandPowers> BandValue for Reflected<'_, T> {
    #[inline(always)]
    fn value<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S> {
        self.0.powers(bands, at).0
    }
}

impl<T: BandPowers> BandValue for Transmitted<'_, T> {
    #[inline(always)]
    fn value<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S> {
        self.0.powers(bands, at).1
    }
}

/// The wavelengths of a path in its bands, and the tables at these wavelengths.
#[derive(Clone, Copy)]
pub(crate) struct Bands<'a, S: Simd> {
    simd: S,
    /// `[spectrum][knot][chunk]`, from the knot before the path's offset on.
    tables: &'a [Chunk],
    /// Number of chunks of a knot, and of all knots of a spectrum.
    strides: (usize, usize),
    /// Fraction of the distance to the next knot.
    part: Lanes<S>,
    inverse_wavelength: &'a [Chunk],
}

impl<'a, S: Simd> Bands<'a, S> {
    #[inline(always)]
    pub(crate) fn new(
        simd: S,
        tables: &'a Tables,
        (knot, part): (usize, f64),
        inverse_wavelength: &'a Spectrum,
    ) -> Self {
        Self {
            simd,
            tables: tables.at_knot(knot),
            strides: tables.strides(),
            part: Lanes::splat(simd, part),
            inverse_wavelength: &inverse_wavelength.0,
        }
    }

    /// Returns the range of all chunks.
    #[inline(always)]
    pub(crate) fn chunks(&self) -> std::ops::Range<usize> {
        0..self.inverse_wavelength.len()
    }

    /// Multiplies a spectrum by a value and writes the product to `to`.
    #[inline(always)]
    pub(crate) fn product(&self, spectrum: &Spectrum, value: &impl BandValue, to: &mut Spectrum) {
        let count = self.chunks().len();
        let (spectrum, to) = (&spectrum.0[..count], &mut to.0[..count]);
        for chunk in self.chunks() {
            for at in At::lanes::<S>(chunk) {
                at.store(at.load(self.simd, spectrum) * value.value(self, at), to);
            }
        }
    }

    /// Multiplies a spectrum by a value.
    #[inline(always)]
    pub(crate) fn multiply(&self, spectrum: &mut Spectrum, value: &impl BandValue) {
        let spectrum = &mut spectrum.0[..self.chunks().len()];
        for chunk in self.chunks() {
            for at in At::lanes::<S>(chunk) {
                at.store(
                    at.load(self.simd, spectrum) * value.value(self, at),
                    spectrum,
                );
            }
        }
    }

    /// Adds the product of a spectrum and a value to a sum.
    #[inline(always)]
    pub(crate) fn add_product(
        &self,
        sum: &mut Spectrum,
        spectrum: &Spectrum,
        value: &impl BandValue,
    ) {
        let count = self.chunks().len();
        let (sum, spectrum) = (&mut sum.0[..count], &spectrum.0[..count]);
        for chunk in self.chunks() {
            for at in At::lanes::<S>(chunk) {
                let factor = at.load(self.simd, spectrum);
                let value = value.value(self, at);
                at.store(factor.mul_add(value, at.load(self.simd, sum)), sum);
            }
        }
    }

    /// Multiplies a spectrum by a film's reflectance or transmittance, or splits it into both.
    #[inline(always)]
    pub(crate) fn pass(&self, film: &impl BandPowers, through: Through<'_>) {
        match through {
            Through::Reflected(spectrum) => self.multiply(spectrum, &Reflected(film)),
            Through::Transmitted(spectrum) => self.multiply(spectrum, &Transmitted(film)),
            Through::Both(reflected, transmitted) => {
                let count = self.chunks().len();
                let reflected = &mut reflected.0[..count];
                let transmitted = &mut transmitted.0[..count];
                for chunk in self.chunks() {
                    for at in At::lanes::<S>(chunk) {
                        let all = at.load(self.simd, reflected);
                        let (r, t) = film.powers(self, at);
                        at.store(all * r, reflected);
                        at.store(all * t, transmitted);
                    }
                }
            }
        }
    }

    /// Returns one number for all bands.
    #[inline(always)]
    pub(crate) fn splat(&self, value: f64) -> Lanes<S> {
        Lanes::splat(self.simd, value)
    }

    /// Returns a spectrum of the tables in some bands.
    #[inline(always)]
    pub(crate) fn spectrum(&self, row: Row, at: At) -> Lanes<S> {
        self.knots(row).value(self, at)
    }

    /// Returns a spectrum of the tables, looked up once for all bands.
    #[inline(always)]
    pub(crate) fn knots(&self, row: Row) -> Knots<'a> {
        let (of_knot, of_spectrum) = self.strides;
        let from = &self.tables[row.index() * of_spectrum..];
        let count = self.inverse_wavelength.len();
        Knots {
            low: &from[..count],
            high: &from[of_knot..of_knot + count],
        }
    }

    /// Returns the emitted spectrum, times a weight.
    #[inline(always)]
    pub(crate) fn emission(&self, emission: &Emission, weight: f64) -> (Knots<'a>, f64) {
        let knots = self.knots(emission.spectrum.into());
        (knots, weight * emission.scale)
    }

    /// Returns 1/λ in some bands, nm⁻¹.
    #[inline(always)]
    pub(crate) fn inverse_wavelength(&self, at: At) -> Lanes<S> {
        at.load(self.simd, self.inverse_wavelength)
    }

    /// Returns numbers that the caller has for each band.
    #[inline(always)]
    pub(crate) fn each(&self, at: At, value: impl Fn(usize) -> f64) -> Lanes<S> {
        let mut values = [0.0; CHUNK];
        for (lane, of_lane) in values[..Lanes::<S>::COUNT].iter_mut().enumerate() {
            *of_lane = value(CHUNK * at.0 + at.1 + lane);
        }
        Lanes::load(self.simd, &values)
    }
}

/// A spectrum of the tables at the knots before and after a path's offset.
#[derive(Clone, Copy)]
pub(crate) struct Knots<'a> {
    low: &'a [Chunk],
    high: &'a [Chunk],
}

impl Knots<'_> {
    /// Returns the spectrum in some bands.
    #[inline(always)]
    pub(crate) fn value<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S> {
        let low = at.load(bands.simd, self.low);
        (at.load(bands.simd, self.high) - low).mul_add(bands.part, low)
    }
}

/// A spectrum of the tables, and its factor.
impl BandValue for (Knots<'_>, f64) {
    #[inline(always)]
    fn value<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S> {
        self.0.value(bands, at).times(self.1)
    }
}
