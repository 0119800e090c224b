//! Pictures as numbers.

use crate::PictureFile;
use crate::limits::{MAX_PICTURE_PIXELS, MAX_PICTURE_SIDE};
use color::spectral_exr::ReadExrError;
use image::{DynamicImage, ImageBuffer, ImageFormat, ImageReader, Limits, Rgb};
use spectra::SpectralImage;
use spectra::text_file::{TextFileError, read_bytes};
use std::io::Cursor;
use std::path::Path;
use thiserror::Error;

/// Why a file is not a picture that can be used.
#[derive(Debug, Error)]
pub(crate) enum PictureFileError {
    #[error(transparent)]
    File(#[from] TextFileError),
    #[error("is not a PNG picture that can be read: {0}")]
    NotPng(#[from] image::ImageError),
    #[error("is neither a Radiance picture (.hdr) nor an OpenEXR picture")]
    NotLight,
    #[error("cannot be read: {0}")]
    BadLight(image::ImageError),
    #[error("{0}")]
    Exr(String),
    #[error(
        "has {width} × {height} pixels; at most {MAX_PICTURE_SIDE} on a side and {MAX_PICTURE_PIXELS} in all are possible"
    )]
    TooLarge { width: u32, height: u32 },
}

/// Reads a PNG file of 8 or 16 bits, its values taken as they stand: grey, or luma of a coloured one.
pub(crate) fn read(path: &Path) -> Result<PictureFile, PictureFileError> {
    let picture = decode(path)?.into_luma16();
    let values = picture
        .pixels()
        .map(|pixel| f32::from(pixel.0[0]) / 65_535.0);
    Ok(PictureFile {
        width: picture.width(),
        height: picture.height(),
        values: values.collect(),
    })
}

/// The codes of red, green and blue of 16 bits of a PNG file of 8 or 16 bits.
pub(crate) fn read_colours(
    path: &Path,
) -> Result<ImageBuffer<Rgb<u16>, Vec<u16>>, PictureFileError> {
    Ok(decode(path)?.into_rgb16())
}

/// Light from all directions as a file has it.
pub(crate) enum LightFile {
    /// Linear red, green and blue of the primaries of sRGB, row by row.
    Colours { width: u32, rgb: Vec<[f32; 3]> },
    /// Spectra.
    Spectra(Box<SpectralImage>),
}

/// Reads a Radiance file or an OpenEXR file, of colours or of spectra.
pub(crate) fn read_light(path: &Path) -> Result<LightFile, PictureFileError> {
    let bytes = read_bytes(path)?;
    let format = image::guess_format(&bytes).ok();
    let format = format.filter(|format| [ImageFormat::Hdr, ImageFormat::OpenExr].contains(format));
    let format = format.ok_or(PictureFileError::NotLight)?;
    if format == ImageFormat::OpenExr {
        match color::spectral_exr::read(path) {
            Ok((image, _)) => return Ok(LightFile::Spectra(Box::new(image))),
            Err(ReadExrError::NoSpectrum { .. }) => {}
            Err(error) => return Err(PictureFileError::Exr(chain(&error))),
        }
    }
    let reader = || {
        let mut reader = ImageReader::with_format(Cursor::new(&bytes), format);
        reader.limits(Limits::default());
        reader
    };
    let read = |error| PictureFileError::BadLight(error);
    let (width, height) = reader().into_dimensions().map_err(read)?;
    check_size(width, height)?;
    let picture = reader().decode().map_err(read)?.into_rgb32f();
    let rgb = picture.pixels().map(|pixel| pixel.0).collect();
    Ok(LightFile::Colours { width, rgb })
}

/// An error with what lies behind it, in one line.
fn chain(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut inner = error.source();
    while let Some(error) = inner {
        text.push_str(&format!(": {error}"));
        inner = error.source();
    }
    text
}

fn decode(path: &Path) -> Result<DynamicImage, PictureFileError> {
    let bytes = read_bytes(path)?;
    let (width, height) = reader(&bytes).into_dimensions()?;
    check_size(width, height)?;
    Ok(reader(&bytes).decode()?)
}

fn check_size(width: u32, height: u32) -> Result<(), PictureFileError> {
    let is_small = width.max(height) <= MAX_PICTURE_SIDE
        && u64::from(width) * u64::from(height) <= MAX_PICTURE_PIXELS;
    if is_small {
        Ok(())
    } else {
        Err(PictureFileError::TooLarge { width, height })
    }
}

fn reader(bytes: &[u8]) -> ImageReader<Cursor<&[u8]>> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    reader.limits(Limits::default());
    reader
}
