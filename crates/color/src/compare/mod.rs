//! Differences of two images: per band, in color, and as perceived.
//!
//! ```text
//! two spectral images -> bands      RMSE, bias and noise of each band; strip by strip: BandSums
//!   -> Picture        linear sRGB, not clipped
//!      -> delta_e       CIEDE2000 of each pixel
//!      -> flip          FLIP of each pixel
//!      -> psnr          peak signal-to-noise ratio of the codes
//!         -> Summary, heat_map
//! ```
//!
//! The first of two images is the reference; differences are second minus first.

mod bands;
mod flip;
mod map;
mod picture;
mod summary;

pub use bands::{BandDifference, BandSums, Noise, bands, check_bands, check_sizes};
pub use flip::flip;
pub use map::heat_map;
pub(crate) use map::{NOT_A_NUMBER, magma};
pub use picture::{Picture, ReadPictureError, delta_e, psnr};
pub use summary::Summary;

use spectra::BandGrid;
use thiserror::Error;

/// Why two images cannot be compared.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CompareError {
    /// They have different sizes.
    #[error("the first image has {}×{} pixels, the second {}×{}", .first[0], .first[1], .second[0], .second[1])]
    Sizes {
        /// Width and height of the first.
        first: [usize; 2],
        /// Width and height of the second.
        second: [usize; 2],
    },
    /// They have different bands.
    #[error("the first image has {}, the second {}", described(.first), described(.second))]
    Bands {
        /// Bands of the first.
        first: BandGrid,
        /// Bands of the second.
        second: BandGrid,
    },
    /// They have no pixels.
    #[error("the images have no pixels")]
    Empty,
}

fn described(bands: &BandGrid) -> String {
    let (count, from, to) = (bands.count(), bands.min_nm(), bands.max_nm());
    format!("{count} bands from {from} to {to} nm")
}
