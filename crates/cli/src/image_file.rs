//! Reads the images of commands.

use crate::print;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::color::compare::Picture;
use pellicle::document::text_file::STANDARD_INPUT;
use pellicle::picture_file::spectral_exr::{self, Metadata};
use pellicle::scene_file::limits;
use pellicle::spectra::SpectralImage;
use std::ffi::OsStr;
use std::path::Path;
use tempfile::NamedTempFile;

/// A spectral image or a picture.
pub(crate) enum Opened {
    Spectral(Box<SpectralImage>, Metadata),
    Picture(Picture),
}

impl Opened {
    /// Reads a file that ends in `.exr` or `.png`.
    pub(crate) fn read(path: &Path) -> miette::Result<Self> {
        let ending = path.extension().map(OsStr::to_ascii_lowercase);
        match ending.as_deref().and_then(OsStr::to_str) {
            Some("png") => Ok(Self::Picture(Picture::read_png(path).into_diagnostic()?)),
            Some("exr") => {
                let (image, metadata) = spectral(path)?;
                Ok(Self::Spectral(Box::new(image), metadata))
            }
            _ if path == Path::new(STANDARD_INPUT) => {
                let (image, metadata) = spectral(path)?;
                Ok(Self::Spectral(Box::new(image), metadata))
            }
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

/// Reads a spectral image, and prints what the reader assumed or changed.
pub(crate) fn spectral(path: &Path) -> miette::Result<(SpectralImage, Metadata)> {
    let spooled = spooled(path)?;
    let file = spooled.as_ref().map_or(path, |spooled| spooled.path());
    let (image, metadata) = spectral_exr::read(file)
        .into_diagnostic()
        .wrap_err_with(|| format!("{} was not read", path.display()))?;
    print_notes(path, &metadata);
    Ok((image, metadata))
}

/// Prints what the reader of a file assumed or changed.
pub(crate) fn print_notes(path: &Path, metadata: &Metadata) {
    for note in &metadata.notes {
        print::note(format_args!("{}: {note}", path.display()));
    }
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
