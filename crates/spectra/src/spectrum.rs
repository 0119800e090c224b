//! A quantity over wavelength: a constant, a table or a formula.

use crate::fault::Faults;
use crate::{DispersionFormula, Fault, OutOfRange};
use std::sync::Arc;
use thiserror::Error;

/// A table over wavelength, linear between its points. It has at least one point, rising wavelengths and finite values.
#[derive(Clone, Debug, PartialEq)]
pub struct Tabulated {
    nm: Vec<f64>,
    values: Vec<f64>,
    faults: Faults,
}

/// Why points do not define a [`Tabulated`].
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TabulatedError {
    /// There are no points.
    #[error("the table has no points")]
    Empty,
    /// A wavelength or value is NaN or infinite.
    #[error("point {index} of the table is not finite")]
    NotFinite {
        /// Which point, counted from 0.
        index: usize,
    },
    /// A wavelength is not above the one before it.
    #[error("wavelengths must rise, but point {index} of the table ({nm} nm) does not")]
    NotRising {
        /// Which point, counted from 0.
        index: usize,
        /// Its wavelength.
        nm: f64,
    },
}

impl Tabulated {
    /// Creates a table through the points (wavelength in nm, value).
    ///
    /// # Errors
    /// When there are no points, one is not finite, or the wavelengths do not rise.
    pub fn new(points: Vec<(f64, f64)>) -> Result<Self, TabulatedError> {
        if points.is_empty() {
            return Err(TabulatedError::Empty);
        }
        for (index, &(nm, value)) in points.iter().enumerate() {
            if !nm.is_finite() || !value.is_finite() {
                return Err(TabulatedError::NotFinite { index });
            }
            if index > 0 && nm <= points[index - 1].0 {
                return Err(TabulatedError::NotRising { index, nm });
            }
        }
        let (nm, values) = points.into_iter().unzip();
        Ok(Self {
            nm,
            values,
            faults: Faults::default(),
        })
    }

    /// Returns the same table with no values within `faults`, also beyond its ends.
    #[must_use]
    pub fn with_faults(mut self, faults: Vec<Fault>) -> Self {
        self.faults = Faults::new(faults);
        self
    }

    pub(crate) fn faults(&self) -> &Faults {
        &self.faults
    }

    /// First and last wavelength, nm.
    pub fn range_nm(&self) -> (f64, f64) {
        (self.nm[0], self.nm[self.nm.len() - 1])
    }

    /// The points as (wavelength in nm, value).
    pub fn points(&self) -> impl ExactSizeIterator<Item = (f64, f64)> + '_ {
        self.nm.iter().copied().zip(self.values.iter().copied())
    }

    /// Returns the value at `nm`, linear between points.
    ///
    /// # Errors
    /// When `nm` lies outside the table by more than 1e-9 nm, or in a fault.
    pub fn at(&self, nm: f64) -> Result<f64, OutOfRange> {
        let (min_nm, max_nm) = self.range_nm();
        let fault = self.faults.at(nm).map(|fault| Arc::clone(&fault.reason));
        if fault.is_some() || !(nm >= min_nm - 1e-9 && nm <= max_nm + 1e-9) {
            return Err(OutOfRange {
                nm,
                min_nm,
                max_nm,
                fault,
            });
        }
        let above = self.nm.partition_point(|&x| x <= nm);
        Ok(match above {
            0 => self.values[0],
            i if i == self.nm.len() => self.values[i - 1],
            i => {
                let t = (nm - self.nm[i - 1]) / (self.nm[i] - self.nm[i - 1]);
                self.values[i - 1] + (self.values[i] - self.values[i - 1]) * t
            }
        })
    }

    /// Returns the value at `nm`, or beyond the ends the value at the nearer end. For tables without faults.
    pub fn clamped_at(&self, nm: f64) -> f64 {
        let (min_nm, max_nm) = self.range_nm();
        // `clamp` keeps a NaN, for which `at` fails, so that the first value is returned.
        self.at(nm.clamp(min_nm, max_nm)).unwrap_or(self.values[0])
    }

    /// Returns the first position where a table whose values do not fall reaches a value: the inverse of [`Self::at`]. For values
    /// below the table this is the first point, for values above it `None`.
    pub fn first_reach(&self, value: f64) -> Option<f64> {
        let above = self.values.partition_point(|&v| v < value);
        let nm = *self.nm.get(above)?;
        let Some(below) = above.checked_sub(1) else {
            return Some(nm);
        };
        let (low_nm, low) = (self.nm[below], self.values[below]);
        Some(low_nm + (nm - low_nm) * (value - low) / (self.values[above] - low))
    }

    /// Returns the same table with all values multiplied by `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            nm: self.nm.clone(),
            values: self.values.iter().map(|v| v * factor).collect(),
            faults: self.faults.clone(),
        }
    }
}

/// A quantity over wavelength.
#[derive(Clone, Debug, PartialEq)]
pub enum Spectrum {
    /// The same value at every wavelength.
    Constant(f64),
    /// A table that has no value outside its range.
    Table(Tabulated),
    /// A table that keeps its end values outside its range (`extrapolate = "clamp"`).
    ClampedTable(Tabulated),
    /// A dispersion formula that has no value outside its range.
    Formula(DispersionFormula),
    /// A dispersion formula that keeps its end values outside its range.
    ClampedFormula(DispersionFormula),
}

impl Spectrum {
    /// Returns the value at `nm`.
    ///
    /// # Errors
    /// When the table or formula has no value there.
    pub fn at(&self, nm: f64) -> Result<f64, OutOfRange> {
        match self {
            Self::Constant(value) => Ok(*value),
            Self::Table(table) => table.at(nm),
            Self::ClampedTable(table) if table.faults.at(nm).is_some() => table.at(nm),
            Self::ClampedTable(table) => Ok(table.clamped_at(nm)),
            Self::Formula(formula) => formula.at(nm),
            Self::ClampedFormula(formula) => formula.clamped_at(nm),
        }
    }

    /// Checks that no data from `low_nm` to `high_nm` are faulty.
    ///
    /// # Errors
    /// When a fault overlaps that range; the error names a wavelength in the overlap.
    pub fn is_sound_within(&self, low_nm: f64, high_nm: f64) -> Result<(), OutOfRange> {
        let fault = self.faults().and_then(|all| all.within(low_nm, high_nm));
        match (fault, self.extent_nm()) {
            (Some(fault), Some((min_nm, max_nm))) => Err(OutOfRange {
                nm: f64::midpoint(fault.from_nm.max(low_nm), fault.to_nm.min(high_nm)),
                min_nm,
                max_nm,
                fault: Some(Arc::clone(&fault.reason)),
            }),
            _ => Ok(()),
        }
    }

    pub(crate) fn faults(&self) -> Option<&Faults> {
        match self {
            Self::Constant(_) => None,
            Self::Table(table) | Self::ClampedTable(table) => Some(table.faults()),
            Self::Formula(formula) | Self::ClampedFormula(formula) => Some(formula.faults()),
        }
    }

    /// Returns the same spectrum, extended beyond its range by its end values.
    #[must_use]
    pub fn clamped(self) -> Self {
        match self {
            Self::Table(table) => Self::ClampedTable(table),
            Self::Formula(formula) => Self::ClampedFormula(formula),
            unbounded => unbounded,
        }
    }

    /// First and last wavelength with a value, nm; `None` if all have one.
    pub fn range_nm(&self) -> Option<(f64, f64)> {
        match self {
            Self::Table(_) | Self::Formula(_) => self.extent_nm(),
            Self::Constant(_) | Self::ClampedTable(_) | Self::ClampedFormula(_) => None,
        }
    }

    /// First and last wavelength of the table or formula, clamped or not, nm; `None` for a constant.
    pub(crate) fn extent_nm(&self) -> Option<(f64, f64)> {
        match self {
            Self::Constant(_) => None,
            Self::Table(table) | Self::ClampedTable(table) => Some(table.range_nm()),
            Self::Formula(formula) | Self::ClampedFormula(formula) => Some(formula.range_nm()),
        }
    }

    /// The wavelengths of a table's points, nm; none for a constant or formula.
    pub(crate) fn points_nm(&self) -> impl Iterator<Item = f64> + '_ {
        let table = match self {
            Self::Table(table) | Self::ClampedTable(table) => Some(table),
            Self::Constant(_) | Self::Formula(_) | Self::ClampedFormula(_) => None,
        };
        table
            .into_iter()
            .flat_map(Tabulated::points)
            .map(|(nm, _)| nm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_place_of_a_value_is_found() {
        let points = vec![(0.0, 1.0), (1.0, 1.0), (3.0, 2.0), (4.0, 2.0), (5.0, 6.0)];
        let table = Tabulated::new(points).unwrap();
        for (value, place) in [
            (0.5, Some(0.0)),
            (1.0, Some(0.0)),
            (1.5, Some(2.0)),
            (2.0, Some(3.0)),
            (3.0, Some(4.25)),
            (6.0, Some(5.0)),
            (6.1, None),
        ] {
            assert_eq!(table.first_reach(value), place, "{value}");
        }
    }

    #[test]
    fn between_points_the_table_is_linear_and_outside_it_is_an_error() {
        let table = Tabulated::new(vec![(400.0, 1.0), (500.0, 3.0), (510.0, 0.0)]).unwrap();
        assert_eq!(table.at(450.0), Ok(2.0));
        assert_eq!(table.at(510.0), Ok(0.0));
        assert_eq!(table.at(400.0), Ok(1.0));
        assert!(
            table.at(399.0).is_err() && table.at(511.0).is_err() && table.at(f64::NAN).is_err()
        );
        assert_eq!(table.clamped_at(300.0), 1.0);
        assert_eq!(table.clamped_at(900.0), 0.0);
    }

    #[test]
    fn in_a_fault_there_is_no_value_and_its_reason_is_reported() {
        let fault = |from_nm, to_nm, reason: &str| Fault {
            from_nm,
            to_nm,
            reason: reason.into(),
        };
        let table = Tabulated::new(vec![(400.0, 1.0), (500.0, 3.0), (600.0, 5.0)]).unwrap();
        let table = table.with_faults(vec![
            fault(500.0, 600.0, "line 3 is wrong"),
            fault(600.0, f64::INFINITY, "line 5 is wrong"),
        ]);
        for spectrum in [
            Spectrum::Table(table.clone()),
            Spectrum::ClampedTable(table),
        ] {
            assert_eq!(spectrum.at(450.0), Ok(2.0));
            assert_eq!((spectrum.at(500.0), spectrum.at(600.0)), (Ok(3.0), Ok(5.0)));
            let said = |nm| spectrum.at(nm).unwrap_err().to_string();
            assert_eq!(said(550.0), "no value at 550 nm: line 3 is wrong");
            assert_eq!(said(900.0), "no value at 900 nm: line 5 is wrong");
            assert_eq!(spectrum.is_sound_within(300.0, 500.0), Ok(()));
            assert!(spectrum.is_sound_within(400.0, 520.0).is_err());
        }
    }

    #[test]
    fn bad_points_are_refused() {
        assert_eq!(Tabulated::new(vec![]), Err(TabulatedError::Empty));
        assert!(Tabulated::new(vec![(1.0, f64::NAN)]).is_err());
        assert!(Tabulated::new(vec![(2.0, 0.0), (2.0, 1.0)]).is_err());
    }
}
