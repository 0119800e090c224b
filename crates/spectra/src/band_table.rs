//! A spectrum resampled onto a band grid, for lookup at any sampled wavelength.

use crate::interpolation::knot_before;
use crate::{BandGrid, OutOfRange, Spectrum};

/// A spectrum tabulated at `steps + 1` offsets within each band of a grid.
///
/// All bands of a sample share one offset u, so a lookup reads one row (u rounded down) and the
/// next, and interpolates: the value is linear in wavelength between knots that are at most
/// [`BandTable::KNOT_NM`] apart. Row `steps` of a band equals row 0 of the next band.
#[derive(Clone, Debug, PartialEq)]
pub struct BandTable {
    bands: u32,
    steps: u32,
    values: Vec<f64>,
}

impl BandTable {
    /// The largest distance between knots, nm.
    pub const KNOT_NM: f64 = 1.0;

    /// Number of steps that a band of `grid` is divided into: even, so that the center is a knot,
    /// and large enough for [`Self::KNOT_NM`].
    pub fn steps_of(grid: &BandGrid) -> u32 {
        let halves = (grid.width_nm() / (2.0 * Self::KNOT_NM) - 1e-9).ceil();
        2 * (halves.max(1.0) as u32)
    }

    /// Samples `spectrum` at the knots of `grid`.
    ///
    /// # Errors
    /// When the spectrum has no value at one of the knots, or a fault between them.
    pub fn new(grid: &BandGrid, spectrum: &Spectrum) -> Result<Self, OutOfRange> {
        spectrum.is_sound_within(grid.min_nm(), grid.max_nm())?;
        let steps = Self::steps_of(grid);
        let mut values = Vec::with_capacity(((steps + 1) * grid.count()) as usize);
        for step in 0..=steps {
            for band in 0..grid.count() {
                let offset = f64::from(step) / f64::from(steps);
                values.push(spectrum.at(grid.wavelength_nm(band, offset))?);
            }
        }
        Ok(Self {
            bands: grid.count(),
            steps,
            values,
        })
    }

    /// Number of bands.
    pub fn bands(&self) -> u32 {
        self.bands
    }

    /// Number of steps within a band.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// The values at offset `step / steps` of every band, `step` from 0 to `steps`.
    pub fn row(&self, step: u32) -> &[f64] {
        let start = (step * self.bands) as usize;
        &self.values[start..start + self.bands as usize]
    }

    /// The value at `offset` in \[0, 1\] of band `band`.
    pub fn at(&self, band: u32, offset: f64) -> f64 {
        let (step, part) = knot_before(offset, self.steps as usize + 1);
        let [low, high] = [step, step + 1].map(|step| self.row(step as u32)[band as usize]);
        low + (high - low) * part
    }

    /// Returns the table with `f` applied to each value.
    #[must_use]
    pub fn map(&self, f: impl Fn(f64) -> f64) -> Self {
        Self {
            values: self.values.iter().map(|&v| f(v)).collect(),
            ..*self
        }
    }

    /// Combines the values of this table and of `other`, on the same grid, with `f`.
    ///
    /// # Panics
    /// When `other` is on another grid.
    #[must_use]
    pub fn combined(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        assert_eq!((self.bands, self.steps), (other.bands, other.steps));
        let pairs = self.values.iter().zip(&other.values);
        Self {
            values: pairs.map(|(&a, &b)| f(a, b)).collect(),
            ..*self
        }
    }

    /// The mean of all values.
    pub fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }

    /// The smallest and the largest value.
    pub fn extent(&self) -> (f64, f64) {
        self.values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), &v| {
                (lo.min(v), hi.max(v))
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Tabulated;

    #[test]
    fn lookup_is_exact_where_the_table_is_linear() {
        let grid = BandGrid::visible(40).unwrap();
        let line = Spectrum::Table(Tabulated::new(vec![(300.0, 0.0), (900.0, 600.0)]).unwrap());
        let table = BandTable::new(&grid, &line).unwrap();
        assert_eq!(table.steps(), 10);
        for (band, offset) in [(0, 0.0), (7, 0.33), (39, 1.0), (20, 0.5)] {
            let expected = grid.wavelength_nm(band, offset) - 300.0;
            assert!((table.at(band, offset) - expected).abs() < 1e-10);
        }
    }

    #[test]
    fn knots_are_even_and_fine_enough_for_any_grid() {
        for (count, steps) in [(1, 400), (4, 100), (16, 26), (256, 2), (1024, 2)] {
            assert_eq!(
                BandTable::steps_of(&BandGrid::visible(count).unwrap()),
                steps
            );
        }
    }

    #[test]
    fn a_table_that_is_too_short_is_refused() {
        let grid = BandGrid::visible(4).unwrap();
        let short = Spectrum::Table(Tabulated::new(vec![(400.0, 1.0), (700.0, 1.0)]).unwrap());
        assert!(BandTable::new(&grid, &short).is_err());
    }
}
