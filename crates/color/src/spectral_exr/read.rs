//! Reading a spectral image.

use std::fs::File;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};

use exr::block::reader::Reader;
use spectra::{BandGrid, SpectralImage};
use thiserror::Error;

use super::bands::BandLayoutError;
use super::metadata::Metadata;
use crate::XyzImage;
use crate::exr_file::{self, Context, each_block, guard};

mod colors;
mod pixels;
mod plan;
mod reflectances;

pub use crate::exr_file::guard::MAX_BYTES;

use colors::Colors;
use pixels::Pixels;
use plan::Plan;

/// Why a spectral file was not read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadExrError {
    /// The file cannot be opened or read.
    #[error("cannot read {path}")]
    File {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file does not begin as an `OpenEXR` file does.
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
        /// What was found wrong.
        reason: String,
    },
    /// The file may be sound, but has a form that is not read here.
    #[error("{path} has a form that is not supported: {reason}")]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// Which form.
        reason: String,
    },
    /// No channel is spectral.
    #[error("{path} is an OpenEXR file without spectral channels (`S0.550,000000nm`)")]
    NoSpectrum {
        /// The file.
        path: PathBuf,
    },
    /// The spectral channels make no band grid.
    #[error("the spectral channels of {path} cannot be used")]
    Bands {
        /// The file.
        path: PathBuf,
        /// Why not.
        source: BandLayoutError,
    },
    /// The image would take more memory than [`MAX_BYTES`] or than there is.
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

/// Reads a spectral file: one written by [`write`](super::write()), or one of other origin in the same layout.
///
/// The bands of others may have any widths. Each is taken as constant from half way to its neighbor on one side to half way
/// on the other, as the layout has it; where the widths differ, the bands are read onto even ones as narrow as the narrowest
/// (1024 at most), which keeps the integral over wavelength. Bands beyond 360 to 830 nm are left out, and one that reaches over
/// an end from where people see (380 to 780 nm) is cut there.
///
/// What a file of other origin lacks is filled in: XYZ by summing the bands
/// ([`BandWeights::observed`](crate::BandWeights::observed)), variance and sample count as 0.
///
/// Reflectances, where there is no radiance in the file, are looked at under an illuminant: the one that the file's attribute
/// `illuminant` names or has a table of, else D65. It is as bright as a radiance of 1 at every wavelength, so that a perfect white
/// is a display's white at 0 EV. It is the lamp of the image's only light group, `illuminant`. Beyond the file's bands, from 380 to
/// 780 nm, the reflectance stays what it is at the ends (CIE 15:2018, 7.2.3).
///
/// The image is the file's display window: pixels of it that the data window lacks are black and have 0 samples, those outside are
/// cut off. Polarized components, light emitted at another wavelength than it was absorbed at,
/// and other channels are passed over. What was assumed or changed is in the metadata's notes.
///
/// # Errors
/// When the file cannot be read, is damaged, has no such spectrum, or is larger than its length or
/// this machine's memory can account for.
pub fn read(path: &Path) -> Result<(SpectralImage, Metadata), ReadExrError> {
    let (reader, plan, metadata) = open(path)?;
    Ok((pixels(&Context { path }, reader, plan)?, metadata))
}

/// How large the image of a spectral file is: width and height in pixels, and its bands. Its pixels are not read.
///
/// # Errors
/// As [`read`], but for what is wrong with pixels.
pub fn read_size(path: &Path) -> Result<([u32; 2], BandGrid), ReadExrError> {
    let (_, plan, _) = open(path)?;
    // Sides that memory holds, which has been looked at.
    let side = |side| u32::try_from(side).unwrap_or(u32::MAX);
    let (width, height) = plan.window.size();
    Ok(([side(width), side(height)], plan.grid))
}

/// Reads the colors of a spectral file, without its spectra: the same XYZ as [`read`] gives, sooner.
///
/// # Errors
/// As [`read`].
pub fn read_xyz(path: &Path) -> Result<(XyzImage, Metadata), ReadExrError> {
    let (reader, plan, metadata) = open(path)?;
    let context = Context { path };
    let image = if plan.has_xyz() {
        let mut colors = Colors::new(&plan);
        each_block(&context, reader, plan.layer, |block, channels| {
            colors.insert(&plan, block, channels)
        })?;
        colors.finish(&plan)
    } else {
        Some(XyzImage::from(&pixels(&context, reader, plan)?))
    };
    let missing = || context.damaged("some pixels are missing");
    Ok((image.ok_or_else(missing)?, metadata))
}

/// Opens a file and reads what its header says, which is checked.
fn open(path: &Path) -> Result<(Reader<BufReader<File>>, Plan, Metadata), ReadExrError> {
    let (reader, length) = exr_file::open(path)?;
    let context = Context { path };
    let (plan, metadata) = Plan::new(&context, reader.headers())?;
    guard::check(&context, reader.headers(), plan.layer, length)?;
    let (bands, groups) = (plan.grid.count(), plan.light_groups.len());
    let bytes = |width, height| SpectralImage::bytes(width, height, bands, groups);
    if !guard::fits(&plan.window, bytes) {
        let (width, height) = plan.window.size();
        return Err(ReadExrError::TooLarge {
            path: path.to_owned(),
            width,
            height,
            bands: bands as usize,
        });
    }
    Ok((reader, plan, metadata))
}

/// The whole image.
fn pixels(
    context: &Context<'_>,
    reader: Reader<BufReader<File>>,
    plan: Plan,
) -> Result<SpectralImage, ReadExrError> {
    let illuminant = plan.illuminant.clone();
    let mut pixels = Pixels::new(plan);
    each_block(context, reader, pixels.layer(), |block, channels| {
        pixels.insert(block, channels)
    })?;
    let missing = || context.damaged("some pixels are missing");
    let mut image = pixels.finish().ok_or_else(missing)?;
    if let Some(illuminant) = illuminant {
        reflectances::light(&mut image, illuminant)
            .map_err(|error| context.unsupported(&error.to_string()))?;
    }
    Ok(image)
}
