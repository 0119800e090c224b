//! A scene's spectra, laid out for paths that carry all bands at once.

use super::{At, Bands, CHUNK, Chunk, Spectrum};
use optics::wide::Lanes;
use pulp::Scalar;
use scene::{Scene, SpectrumId};
use spectra::{BandGrid, BandTable, knot_before};

/// A spectrum in the [`Tables`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Row(usize);

impl Row {
    #[inline(always)]
    pub(super) fn index(self) -> usize {
        self.0
    }
}

impl From<SpectrumId> for Row {
    fn from(id: SpectrumId) -> Self {
        Self(id.index())
    }
}

/// Tables of spectra at the knots within each band, as `[spectrum][knot][band]`. Bands are padded to whole chunks
/// with the last one; those of an observer with 0.
pub(crate) struct Tables {
    chunks: Vec<Chunk>,
    /// Number of bands without the padding.
    bands: usize,
    chunks_of_knot: usize,
    knots: usize,
    spectra: usize,
    observer: [Row; 3],
    grid: BandGrid,
}

impl Tables {
    /// Returns the tables of a scene's spectra, followed by its observer's.
    pub(crate) fn new(scene: &Scene) -> Self {
        let grid = &scene.settings().bands;
        let mut tables = Self {
            chunks: Vec::new(),
            bands: grid.count() as usize,
            chunks_of_knot: (grid.count() as usize).div_ceil(CHUNK),
            knots: BandTable::steps_of(grid) as usize + 1,
            spectra: 0,
            observer: [Row(0); 3],
            grid: *grid,
        };
        for table in scene.spectra() {
            tables.push(|knot, band| table.row(knot as u32)[band]);
        }
        // An observer sees nothing in the padding, so that colors are sums over whole chunks.
        tables.observer = scene.observer().each_ref().map(|table| {
            let seen = |knot: usize, band: usize| table.row(knot as u32).get(band).copied();
            tables.push_padded(|knot, band| seen(knot, band).unwrap_or(0.0))
        });
        tables
    }

    /// Adds a spectrum by its values at a knot of a band.
    pub(crate) fn push(&mut self, value: impl Fn(usize, usize) -> f64) -> Row {
        let last = self.bands - 1;
        self.push_padded(|knot, band| value(knot, band.min(last)))
    }

    /// Adds a spectrum with its own values in the padding behind the last band.
    fn push_padded(&mut self, value: impl Fn(usize, usize) -> f64) -> Row {
        for knot in 0..self.knots {
            for first in (0..self.bands).step_by(CHUNK) {
                let values = std::array::from_fn(|lane| value(knot, first + lane));
                self.chunks.push(Chunk(values));
            }
        }
        self.spectra += 1;
        Row(self.spectra - 1)
    }

    /// Adds a spectrum that is computed, band by band, from the spectra that are already there.
    pub(crate) fn push_from(
        &mut self,
        value: impl Fn(&Bands<'_, Scalar>, At) -> Lanes<Scalar>,
    ) -> Row {
        let mut values = Vec::with_capacity(self.knots * self.bands);
        for knot in 0..self.knots {
            let offset = knot as f64 / (self.knots - 1) as f64;
            let inverse = self.inverse_wavelengths(offset);
            let bands = Bands::new(Scalar::new(), self, self.place(offset), &inverse);
            for band in 0..self.bands {
                let mut one = [0.0];
                value(&bands, At(band / CHUNK, band % CHUNK)).store(&mut one);
                values.push(one[0]);
            }
        }
        let bands = self.bands;
        self.push(|knot, band| values[knot * bands + band])
    }

    /// Returns the observer's color-matching functions.
    pub(crate) fn observer(&self) -> [Row; 3] {
        self.observer
    }

    /// Returns the bands.
    pub(crate) fn grid(&self) -> &BandGrid {
        &self.grid
    }

    /// Returns the number of bands of a spectrum.
    pub(crate) fn bands(&self) -> usize {
        self.bands
    }

    /// Returns the number of chunks of a value for each band.
    pub(crate) fn chunks(&self) -> usize {
        self.chunks_of_knot
    }

    /// Returns 1/λ at an offset in [0, 1] of each band, nm⁻¹.
    fn inverse_wavelengths(&self, offset: f64) -> Spectrum {
        let mut inverse = Spectrum::zero(self.chunks());
        for (band, inverse) in inverse.values_mut().iter_mut().enumerate() {
            *inverse = self.grid.wavelength_nm(band as u32, offset).recip();
        }
        inverse
    }

    /// Returns the knot before an offset in [0, 1], and the fraction of the distance to the next knot.
    pub(crate) fn place(&self, offset: f64) -> (usize, f64) {
        knot_before(offset, self.knots)
    }

    /// Returns all numbers from a knot of the first spectrum on.
    #[inline(always)]
    pub(super) fn at_knot(&self, knot: usize) -> &[Chunk] {
        &self.chunks[knot * self.chunks_of_knot..]
    }

    /// Returns the number of chunks of a knot, and of a spectrum.
    #[inline(always)]
    pub(super) fn strides(&self) -> (usize, usize) {
        (self.chunks_of_knot, self.knots * self.chunks_of_knot)
    }

    /// Returns the smallest and the largest value of a spectrum.
    pub(crate) fn extent(&self, row: Row) -> (f64, f64) {
        let chunks = self.strides().1;
        let of_row = &self.chunks[row.0 * chunks..(row.0 + 1) * chunks];
        let values = of_row.iter().flat_map(|chunk| chunk.0);
        values.fold(
            (f64::INFINITY, f64::NEG_INFINITY),
            |(least, most), value| (least.min(value), most.max(value)),
        )
    }
}
