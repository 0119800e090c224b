//! The uniform division of the rendered wavelength range into bands.

use thiserror::Error;

/// N uniform bands over a range of wavelengths.
///
/// Band `b` covers `[min + b·width, min + (b + 1)·width)` nanometers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandGrid {
    min_nm: f64,
    max_nm: f64,
    count: u32,
}

/// Why a [`BandGrid`] cannot be made.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BandGridError {
    /// The number of bands is 0 or above [`BandGrid::MAX_COUNT`].
    #[error("{0} bands; between 1 and {max} are possible", max = BandGrid::MAX_COUNT)]
    Count(u32),
    /// The range is empty, reversed, not finite or outside [`BandGrid::LIMITS_NM`].
    #[error(
        "wavelengths from {min_nm} to {max_nm} nm; they must rise and lie within {low} to {high} nm",
        low = BandGrid::LIMITS_NM.0, high = BandGrid::LIMITS_NM.1
    )]
    Range {
        /// Lower end as given.
        min_nm: f64,
        /// Upper end as given.
        max_nm: f64,
    },
}

impl BandGrid {
    /// The largest number of bands of an image.
    pub const MAX_COUNT: u32 = 1024;
    /// Range that a grid must lie within: that of the CIE 1931 table, nm.
    pub const LIMITS_NM: (f64, f64) = (360.0, 830.0);

    /// Creates a grid of `count` bands from `min_nm` to `max_nm`.
    ///
    /// # Errors
    /// When `count` is 0 or above [`Self::MAX_COUNT`], or the range does not rise or is not within [`Self::LIMITS_NM`].
    pub fn new(min_nm: f64, max_nm: f64, count: u32) -> Result<Self, BandGridError> {
        if count == 0 || count > Self::MAX_COUNT {
            return Err(BandGridError::Count(count));
        }
        // A NaN fails every comparison, so it is refused here too.
        if !(min_nm >= Self::LIMITS_NM.0 && max_nm <= Self::LIMITS_NM.1 && min_nm < max_nm) {
            return Err(BandGridError::Range { min_nm, max_nm });
        }
        Ok(Self {
            min_nm,
            max_nm,
            count,
        })
    }

    /// The default: 380 to 780 nm in `count` bands.
    ///
    /// # Errors
    /// When `count` is 0 or above [`Self::MAX_COUNT`].
    pub fn visible(count: u32) -> Result<Self, BandGridError> {
        Self::new(380.0, 780.0, count)
    }

    /// Lower end of the first band, nm.
    pub fn min_nm(&self) -> f64 {
        self.min_nm
    }

    /// Upper end of the last band, nm.
    pub fn max_nm(&self) -> f64 {
        self.max_nm
    }

    /// Number of bands.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Width of a band, nm.
    pub fn width_nm(&self) -> f64 {
        (self.max_nm - self.min_nm) / f64::from(self.count)
    }

    /// The wavelength at `offset` in \[0, 1\] of band `band`, nm.
    pub fn wavelength_nm(&self, band: u32, offset: f64) -> f64 {
        self.min_nm + (f64::from(band) + offset) * self.width_nm()
    }

    /// The wavelength in the middle of a band, nm.
    pub fn center_nm(&self, band: u32) -> f64 {
        self.wavelength_nm(band, 0.5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn default_bands_are_ten_nanometers_wide() {
        let grid = BandGrid::visible(40).unwrap();
        assert_eq!(grid.width_nm(), 10.0);
        assert_eq!(grid.center_nm(0), 385.0);
        assert_eq!(grid.wavelength_nm(39, 1.0), 780.0);
    }

    #[test]
    fn impossible_grids_are_refused() {
        assert_eq!(BandGrid::visible(0), Err(BandGridError::Count(0)));
        assert!(BandGrid::visible(1025).is_err());
        assert!(BandGrid::new(500.0, 500.0, 1).is_err());
        assert!(BandGrid::new(f64::NAN, 500.0, 1).is_err());
        assert!(BandGrid::new(100.0, 500.0, 1).is_err());
    }
}
