//! Why an OpenEXR file cannot be read.

use spectra::{BandGrid, BandGridError};
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// Why a spectral file could not be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadExrError {
    /// The file cannot be opened or read.
    #[error("cannot read {path}")]
    File {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The file does not begin like an `OpenEXR` file.
    #[error("{path} is not an OpenEXR file")]
    NotExr {
        /// The file.
        path: PathBuf,
    },
    /// The file is cut short or contradicts itself.
    #[error("{path} is damaged or cut short: {reason}")]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The fault that was found.
        reason: String,
    },
    /// The file may be valid, but has a form that is not supported here.
    #[error("{path} has a form that is not supported: {reason}")]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// The form.
        reason: String,
    },
    /// No channel is spectral.
    #[error("{path} is an OpenEXR file without spectral channels (`S0.550,000000nm`)")]
    NoSpectrum {
        /// The file.
        path: PathBuf,
    },
    /// The spectral channels do not form a band grid.
    #[error("the spectral channels of {path} cannot be used")]
    Bands {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: BandLayoutError,
    },
    /// The requested rows are not among those of the image.
    #[error("{path} has {height} rows: rows {start} to {end} cannot be read")]
    Rows {
        /// The file.
        path: PathBuf,
        /// The first row requested.
        start: u32,
        /// The row after the last one requested.
        end: u32,
        /// Height of the image in pixels.
        height: u32,
    },
    /// The image would take more memory than [`MAX_BYTES`](super::guard::MAX_BYTES) or than is available.
    #[error(
        "{path} holds an image of {width}×{height} pixels and {bands} bands, too large to read"
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
        /// Number of bands.
        bands: usize,
    },
}

/// Why the spectral channels of a file do not form a band grid.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BandLayoutError {
    /// A channel's name starts like a spectral one but does not end in a wavelength or a frequency.
    #[error(
        "channel {0:?} does not name a wavelength or a frequency, such as `S0.550,000000nm`, `S0.0,55um` or `S0.545THz`"
    )]
    NotAWavelength(String),
    /// Two channels have the same wavelength.
    #[error("two channels have the wavelength {0} nm")]
    Duplicate(f64),
    /// There is a single band of unknown width.
    #[error("there is a single band, at {0} nm, and no attribute that gives its width")]
    SingleBand(f64),
    /// The file gives the ends of a uniform grid, and a channel is not on it.
    #[error("the file's bands should be evenly spaced, but the band at {nm} nm is {off_nm} nm off")]
    NotUniform {
        /// The channel's wavelength.
        nm: f64,
        /// Its distance from its position with even spacing.
        off_nm: f64,
    },
    /// Two bands overlap, or there is a gap between them.
    #[error("the band that ends at {end_nm} nm is followed by one that starts at {start_nm} nm")]
    NotConnected {
        /// The end of one band.
        end_nm: f64,
        /// The start of the next one.
        start_nm: f64,
    },
    /// No band is visible.
    #[error("the bands lie from {first_nm} to {last_nm} nm, none of them within {low} to {high} nm",
        low = BandGrid::LIMITS_NM.0, high = BandGrid::LIMITS_NM.1)]
    OutOfRange {
        /// The shortest wavelength.
        first_nm: f64,
        /// The longest wavelength.
        last_nm: f64,
    },
    /// The bands form a grid that is not supported.
    #[error(transparent)]
    Grid(#[from] BandGridError),
}
