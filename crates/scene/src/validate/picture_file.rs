//! Pictures as numbers.

use crate::PictureFile;
use crate::limits::{MAX_PICTURE_PIXELS, MAX_PICTURE_SIDE};
use image::{DynamicImage, ImageBuffer, ImageFormat, ImageReader, Limits, Rgb};
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

fn decode(path: &Path) -> Result<DynamicImage, PictureFileError> {
    let bytes = read_bytes(path)?;
    let (width, height) = reader(&bytes).into_dimensions()?;
    let is_small = width.max(height) <= MAX_PICTURE_SIDE
        && u64::from(width) * u64::from(height) <= MAX_PICTURE_PIXELS;
    if !is_small {
        return Err(PictureFileError::TooLarge { width, height });
    }
    Ok(reader(&bytes).decode()?)
}

fn reader(bytes: &[u8]) -> ImageReader<Cursor<&[u8]>> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    reader.limits(Limits::default());
    reader
}
