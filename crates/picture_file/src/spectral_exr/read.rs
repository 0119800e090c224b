//! Reading a spectral image.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use exr::block::reader::Reader;
use spectra::{BandGrid, SpectralImage};

use super::metadata::Metadata;
use crate::exr_file::{self, Context, ReadExrError, each_block, guard};
use relight::XyzImage;

mod colors;
mod pixels;
mod plan;
mod polarization;
mod reflectances;
mod rows;
mod spectral;

use colors::Colors;
use pixels::Pixels;
use plan::Plan;
pub use rows::RowReader;

/// Reads a spectral file written by [`write`](super::write()), or by another program in the same layout.
///
/// The bands of other programs may have any widths. Each is taken as constant from halfway to one neighbor to halfway to the other,
/// as in the layout. If the widths differ, the bands are read onto even ones as narrow as the narrowest (1024 at most), which
/// preserves the integral over wavelength. Bands beyond 360 to 830 nm are left out; a band that crosses one of these ends from the
/// visible range (380 to 780 nm) is cut there.
///
/// Data that a file of another program lacks is filled in: XYZ by summing the bands
/// ([`BandWeights::observed`](relight::BandWeights::observed)), variance and sample count as 0.
///
/// Reflectances, if the file has no radiance, are shown under an illuminant: the one that the file's attribute `illuminant` names or
/// tabulates, otherwise D65. It is as bright as a radiance of 1 at every wavelength, so a perfect white is a display's white at 0 EV.
/// It is the lamp of the image's only light group, `illuminant`. Beyond the file's bands, within 380 to 780 nm, the reflectance has
/// its value at the nearest end (CIE 15:2018, 7.2.3).
///
/// The image is the file's display window: its pixels that the data window lacks are black and have 0 samples; pixels outside it are
/// cut off. The image is polarized if the file has S1, S2 and S3 at the wavelengths of S0; S3 changes its sign if the file says that it is
/// positive for left-handed light. Light emitted at a wavelength other than that of its absorption,
/// and other channels are ignored. Assumptions and changes are in the metadata's notes.
///
/// # Errors
/// When the file cannot be read, is damaged, has no such spectrum, or is larger than its length or
/// this machine's memory can account for.
pub fn read(path: &Path) -> Result<(SpectralImage, Metadata), ReadExrError> {
    let (reader, plan, metadata) = open(path)?;
    Ok((pixels(&Context { path }, reader, plan)?, metadata))
}

/// Reads the size of a spectral file's image: width and height in pixels, and its bands. Pixels are not read.
///
/// # Errors
/// As [`read`], except errors in pixels.
pub fn read_size(path: &Path) -> Result<([u32; 2], BandGrid), ReadExrError> {
    let (_, plan, _) = open(path)?;
    // `open` has checked that an image of these sides fits into memory.
    let side = |side| u32::try_from(side).unwrap_or(u32::MAX);
    let (width, height) = plan.window.size();
    Ok(([side(width), side(height)], plan.grid))
}

/// Reads the colors of a spectral file without keeping its spectra, so it may be larger than memory. The XYZ are those of [`read`].
///
/// # Errors
/// As [`read`].
pub fn read_xyz(path: &Path) -> Result<(XyzImage, Metadata), ReadExrError> {
    let mut rows = RowReader::open(path)?;
    let image = rows.read_xyz()?;
    Ok((image, rows.into_metadata()))
}

/// Opens a file, and reads and checks its header.
fn open(path: &Path) -> Result<(Reader<BufReader<File>>, Plan, Metadata), ReadExrError> {
    let (reader, length) = exr_file::open(path)?;
    let context = Context { path };
    let (plan, metadata) = checked_plan(&context, &reader, length)?;
    check_memory(path, &plan)?;
    Ok((reader, plan, metadata))
}

fn checked_plan(
    context: &Context<'_>,
    reader: &Reader<BufReader<File>>,
    length: u64,
) -> Result<(Plan, Metadata), ReadExrError> {
    let (plan, metadata) = Plan::new(context, reader.headers())?;
    guard::check(context, reader.headers(), plan.layer, length)?;
    Ok((plan, metadata))
}

/// Checks that there is memory for the image.
fn check_memory(path: &Path, plan: &Plan) -> Result<(), ReadExrError> {
    let bytes = |width, height| SpectralImage::bytes(width, height, plan.content());
    check_fits(path, plan, bytes)
}

/// Checks that there is memory for the colors of the image.
fn check_color_memory(path: &Path, plan: &Plan) -> Result<(), ReadExrError> {
    let bytes =
        |width, height| u128::from(width) * u128::from(height) * size_of::<[f32; 3]>() as u128;
    check_fits(path, plan, bytes)
}

fn check_fits(
    path: &Path,
    plan: &Plan,
    bytes: impl Fn(u32, u32) -> u128,
) -> Result<(), ReadExrError> {
    // An image that is read by rows is checked by its rows.
    let file_bytes = std::fs::metadata(path).map_or(u64::MAX, |data| data.len());
    if guard::fits(&plan.window, file_bytes, bytes) {
        return Ok(());
    }
    let (width, height) = plan.window.size();
    Err(ReadExrError::TooLarge {
        path: path.to_owned(),
        width,
        height,
        bands: plan.grid.count() as usize,
    })
}

/// Reads the whole image.
fn pixels(
    context: &Context<'_>,
    reader: Reader<BufReader<File>>,
    plan: Plan,
) -> Result<SpectralImage, ReadExrError> {
    let mut pixels = Pixels::new(plan);
    each_block(context, reader, pixels.plan().layer, |block, channels| {
        pixels.insert(block, channels)
    })?;
    finish(context, pixels)
}

/// Checks that no pixel is missing, and lights reflectances.
fn finish(context: &Context<'_>, pixels: Pixels) -> Result<SpectralImage, ReadExrError> {
    let illuminant = pixels.plan().illuminant.clone();
    let missing = || context.damaged("some pixels are missing");
    let mut image = pixels.finish().ok_or_else(missing)?;
    if let Some(illuminant) = illuminant {
        reflectances::light(&mut image, illuminant)
            .map_err(|error| context.unsupported(&error.to_string()))?;
    }
    Ok(image)
}
