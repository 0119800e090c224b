//! Reads the images of commands.

use crate::print;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::color::compare::Picture;
use pellicle::document::text_file::STANDARD_INPUT;
use pellicle::picture_file::spectral_exr::{ReadExrError, RowReader};
use pellicle::relight::XyzImage;
use pellicle::scene_file::limits;
use pellicle::spectra::SpectralImage;
use std::ffi::OsStr;
use std::ops::Range;
use std::path::Path;
use tempfile::NamedTempFile;

/// A spectral image or a picture.
pub(crate) enum Opened {
    /// Its pixels are not read yet.
    Spectral(Box<RowReader>),
    Picture(Picture),
}

impl Opened {
    /// Opens a file that ends in `.exr` or `.png`.
    pub(crate) fn read(path: &Path) -> miette::Result<Self> {
        let ending = path.extension().map(OsStr::to_ascii_lowercase);
        match ending.as_deref().and_then(OsStr::to_str) {
            Some("png") => Ok(Self::Picture(Picture::read_png(path).into_diagnostic()?)),
            Some("exr") => Ok(Self::Spectral(Box::new(rows(path)?))),
            _ if path == Path::new(STANDARD_INPUT) => Ok(Self::Spectral(Box::new(rows(path)?))),
            _ => Err(miette!(
                help = "give a spectral image (.exr) or a picture (.png)",
                "{}: a file with this ending cannot be read",
                path.display()
            )),
        }
    }
}

/// Copies standard input to a temporary file if it is requested: an OpenEXR file is not read sequentially.
fn spooled(path: &Path) -> miette::Result<Option<NamedTempFile>> {
    if path != Path::new(STANDARD_INPUT) {
        return Ok(None);
    }
    let mut file = NamedTempFile::new().into_diagnostic()?;
    std::io::copy(&mut std::io::stdin().lock(), &mut file)
        .into_diagnostic()
        .wrap_err("standard input was not read")?;
    Ok(Some(file))
}

/// The bytes of the pixels of a strip that is processed at a time.
pub(crate) const STRIP_BYTES: usize = 64 << 20;

/// Opens a spectral image to be read in strips, and prints what the reader assumes or changes.
pub(crate) fn rows(path: &Path) -> miette::Result<RowReader> {
    let spooled = spooled(path)?;
    let file = spooled.as_ref().map_or(path, |spooled| spooled.path());
    let reader = said(path, RowReader::open(file))?;
    for note in &reader.metadata().notes {
        print::note(format_args!("{}: {note}", path.display()));
    }
    Ok(reader)
}

/// Refuses a file whose pixels do not have its digest.
pub(crate) fn verify(path: &Path, reader: &mut RowReader) -> miette::Result<()> {
    said(path, reader.verify()).map(drop)
}

/// Reads a strip of a file.
pub(crate) fn strip(
    path: &Path,
    reader: &mut RowReader,
    rows: Range<u32>,
) -> miette::Result<SpectralImage> {
    said(path, reader.read(rows))
}

/// Reads the colors of a file without keeping its spectra.
pub(crate) fn colors(path: &Path, reader: &mut RowReader) -> miette::Result<XyzImage> {
    said(path, reader.read_xyz())
}

/// Says which file was not read.
fn said<T>(path: &Path, read: Result<T, ReadExrError>) -> miette::Result<T> {
    read.into_diagnostic()
        .wrap_err_with(|| format!("{} was not read", path.display()))
}

/// Returns an exposure if it is within its limits.
pub(crate) fn checked_exposure(ev: f64) -> miette::Result<f64> {
    let possible = limits::EXPOSURE_EV;
    if possible.contains(ev) {
        Ok(ev)
    } else {
        Err(miette!("--exposure {ev}: it must be from {possible}"))
    }
}
