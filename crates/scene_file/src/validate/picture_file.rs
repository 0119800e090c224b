//! Reads picture files as numbers or colors.

use crate::description::PictureChannel;
use crate::limits::{
    MAX_PICTURE_BYTES, MAX_PICTURE_PIXELS, MAX_PICTURE_SIDE, MAX_PICTURE_VALUES, PANORAMA_TOLERANCE,
};
use document::text_file::{TextFileError, read_bytes, read_start};
use image::{DynamicImage, ImageBuffer, ImageFormat, ImageReader, Limits, Rgb, Rgba};
use picture_file::png_colors::{CodeColors, PngColorsError};
use picture_file::radiance::{RadianceError, RadiancePicture, is_radiance};
use picture_file::rgb_exr::RgbFile;
use picture_file::spectral_exr::ReadExrError;
use scene::PictureFile;
use spectra::{BandGrid, SpectralImage};
use std::io::Cursor;
use std::path::Path;
use thiserror::Error;

/// The reason why a picture file cannot be used.
#[derive(Debug, Error)]
pub(crate) enum PictureFileError {
    #[error(transparent)]
    File(#[from] TextFileError),
    #[error("is not a PNG picture that can be read: {0}")]
    NotPng(#[from] image::ImageError),
    #[error("is neither a Radiance picture (.hdr) nor an OpenEXR picture")]
    NotPanorama,
    #[error("is a Radiance picture, which has no layers; leave out `layer`")]
    NoLayers,
    #[error(transparent)]
    Radiance(#[from] RadianceError),
    #[error(transparent)]
    Colors(#[from] PngColorsError),
    #[error("has no alpha channel; \"r\", \"g\", \"b\" and \"luma\" are possible")]
    NoAlpha,
    #[error("{0}")]
    Exr(String),
    #[error("its spectra cover {} to {} nm, but the bands cover {} to {} nm; set `render.wavelengths_nm` within them", own.0, own.1, bands.0, bands.1)]
    Bands { own: (f64, f64), bands: (f64, f64) },
    #[error(
        "has {width} × {height} pixels; a picture of all directions by longitude and latitude is twice as wide as high"
    )]
    NoPanorama { width: u32, height: u32 },
    #[error(
        "has {width} × {height} pixels, which is too many for {bands} bands: at most {} are possible", MAX_PICTURE_VALUES / bands.next_multiple_of(4)
    )]
    TooManyValues { width: u32, height: u32, bands: u64 },
    #[error(
        "has {width} × {height} pixels; at most {MAX_PICTURE_SIDE} per side and {MAX_PICTURE_PIXELS} in all are possible"
    )]
    TooLarge { width: u32, height: u32 },
}

/// Reads the stored values of a channel of a PNG file of 8 or 16 bits, regardless of the color space that the file declares.
///
/// Without a channel, the values are gray, or the luma of a color picture. What this ignores is noted.
pub(crate) fn read(
    path: &Path,
    channel: Option<PictureChannel>,
    notes: &mut Vec<String>,
) -> Result<PictureFile, PictureFileError> {
    let picture = decode(&read_bytes(path, MAX_PICTURE_BYTES)?)?;
    if channel == Some(PictureChannel::A) && !picture.color().has_alpha() {
        return Err(PictureFileError::NoAlpha);
    }
    if channel != Some(PictureChannel::A) && has_transparency(&picture) {
        notes.push("it has transparent pixels: their values are used unchanged".to_owned());
    }
    if channel.is_none() && has_colors(&picture) {
        notes.push(
            "its red, green and blue differ: their luma is used (write channel = \"luma\" if this is intended, or a channel such as \
             channel = \"g\")"
                .to_owned(),
        );
    }
    let (width, height) = (picture.width(), picture.height());
    let codes: Vec<u16> = match channel.unwrap_or(PictureChannel::Luma) {
        PictureChannel::Luma => picture.into_luma16().into_raw(),
        PictureChannel::R => one_of(&picture.into_rgba16(), 0),
        PictureChannel::G => one_of(&picture.into_rgba16(), 1),
        PictureChannel::B => one_of(&picture.into_rgba16(), 2),
        PictureChannel::A => one_of(&picture.into_rgba16(), 3),
    };
    let values = codes.into_iter().map(|code| f32::from(code) / 65_535.0);
    Ok(PictureFile {
        width,
        height,
        values: values.collect(),
    })
}

fn one_of(picture: &ImageBuffer<Rgba<u16>, Vec<u16>>, channel: usize) -> Vec<u16> {
    picture.pixels().map(|pixel| pixel.0[channel]).collect()
}

/// Whether red, green and blue differ in any pixel.
fn has_colors(picture: &DynamicImage) -> bool {
    fn differ<T: PartialEq>(codes: &[T], per_pixel: usize) -> bool {
        let mut pixels = codes.chunks_exact(per_pixel);
        pixels.any(|pixel| pixel[0] != pixel[1] || pixel[1] != pixel[2])
    }
    match picture {
        DynamicImage::ImageRgb8(picture) => differ(picture, 3),
        DynamicImage::ImageRgba8(picture) => differ(picture, 4),
        DynamicImage::ImageRgb16(picture) => differ(picture, 3),
        DynamicImage::ImageRgba16(picture) => differ(picture, 4),
        _ => false,
    }
}

/// Whether any pixel is not opaque.
fn has_transparency(picture: &DynamicImage) -> bool {
    match picture {
        DynamicImage::ImageLumaA8(picture) => picture.pixels().any(|pixel| pixel.0[1] != u8::MAX),
        DynamicImage::ImageRgba8(picture) => picture.pixels().any(|pixel| pixel.0[3] != u8::MAX),
        DynamicImage::ImageLumaA16(picture) => picture.pixels().any(|pixel| pixel.0[1] != u16::MAX),
        DynamicImage::ImageRgba16(picture) => picture.pixels().any(|pixel| pixel.0[3] != u16::MAX),
        _ => false,
    }
}

/// Codes of red, green and blue.
pub(crate) type Codes = ImageBuffer<Rgb<u16>, Vec<u16>>;

/// Reads a PNG file of 8 or 16 bits: its codes of red, green and blue as 16 bits, and the meaning of the codes as colors.
pub(crate) fn read_colors(
    path: &Path,
    notes: &mut Vec<String>,
) -> Result<(Codes, CodeColors), PictureFileError> {
    let bytes = read_bytes(path, MAX_PICTURE_BYTES)?;
    let colors = CodeColors::of_png(&bytes)?;
    let picture = decode(&bytes)?;
    notes.extend_from_slice(colors.notes());
    if has_transparency(&picture) {
        notes.push("it has transparent pixels: their colors are used unchanged".to_owned());
    }
    Ok((picture.into_rgb16(), colors))
}

/// A picture of all directions as read from a file.
pub(crate) enum PanoramaFile {
    /// Linear red, green and blue with the primaries of sRGB, row by row.
    Colors { width: u32, rgb: Vec<[f32; 3]> },
    /// Spectra.
    Spectra(Box<SpectralImage>),
}

/// Reads a picture of all directions for these bands: a Radiance file, or an OpenEXR file of colors or spectra. `layer` selects a color
/// layer of an OpenEXR file with several. Assumptions are added to `notes`.
pub(crate) fn read_panorama(
    path: &Path,
    layer: Option<&str>,
    grid: &BandGrid,
    notes: &mut Vec<String>,
) -> Result<PanoramaFile, PictureFileError> {
    let start = read_start(path, 64)?;
    if is_radiance(&start) {
        return match layer {
            Some(_) => Err(PictureFileError::NoLayers),
            None => read_radiance(path, notes),
        };
    }
    match image::guess_format(&start).ok() {
        Some(ImageFormat::OpenExr) if layer.is_some() => read_exr_colors(path, layer, notes),
        Some(ImageFormat::OpenExr) => match picture_file::spectral_exr::read_size(path) {
            Ok(found) => read_spectra(path, found, grid, notes),
            Err(ReadExrError::NoSpectrum { .. }) => read_exr_colors(path, None, notes),
            Err(error) => Err(PictureFileError::Exr(chain(&error))),
        },
        _ => Err(PictureFileError::NotPanorama),
    }
}

fn read_radiance(path: &Path, notes: &mut Vec<String>) -> Result<PanoramaFile, PictureFileError> {
    let bytes = read_bytes(path, MAX_PICTURE_BYTES)?;
    let picture = RadiancePicture::new(&bytes)?;
    check_size(picture.width(), picture.height())?;
    check_panorama(picture.width(), picture.height())?;
    let rgb = picture.pixels()?;
    notes.extend_from_slice(picture.notes());
    let width = picture.width();
    Ok(PanoramaFile::Colors { width, rgb })
}

fn read_exr_colors(
    path: &Path,
    layer: Option<&str>,
    notes: &mut Vec<String>,
) -> Result<PanoramaFile, PictureFileError> {
    let file = RgbFile::open(path, layer);
    let file = file.map_err(|error| PictureFileError::Exr(chain(&error)))?;
    let [width, height] = file.size();
    check_size(width, height)?;
    check_panorama(width, height)?;
    notes.extend_from_slice(file.notes());
    let rgb = file.read();
    let rgb = rgb.map_err(|error| PictureFileError::Exr(chain(&error)))?;
    Ok(PanoramaFile::Colors { width, rgb })
}

fn read_spectra(
    path: &Path,
    ([width, height], own): ([u32; 2], BandGrid),
    grid: &BandGrid,
    notes: &mut Vec<String>,
) -> Result<PanoramaFile, PictureFileError> {
    check_size(width, height)?;
    check_panorama(width, height)?;
    let bands = u64::from(grid.count());
    if u64::from(width) * u64::from(height) * bands.next_multiple_of(4) > MAX_PICTURE_VALUES {
        return Err(PictureFileError::TooManyValues {
            width,
            height,
            bands,
        });
    }
    if own.min_nm() > grid.min_nm() + 1e-6 || own.max_nm() < grid.max_nm() - 1e-6 {
        return Err(PictureFileError::Bands {
            own: (own.min_nm(), own.max_nm()),
            bands: (grid.min_nm(), grid.max_nm()),
        });
    }
    let read = picture_file::spectral_exr::read(path);
    let (image, metadata) = read.map_err(|error| PictureFileError::Exr(chain(&error)))?;
    notes.extend(metadata.notes);
    Ok(PanoramaFile::Spectra(Box::new(image)))
}

/// An error with its sources, in one line.
fn chain(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut inner = error.source();
    while let Some(error) = inner {
        text.push_str(&format!(": {error}"));
        inner = error.source();
    }
    text
}

fn decode(bytes: &[u8]) -> Result<DynamicImage, PictureFileError> {
    let (width, height) = reader(bytes).into_dimensions()?;
    check_size(width, height)?;
    Ok(reader(bytes).decode()?)
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

/// Rejects pictures with another projection, such as a mirror ball or a cube map.
fn check_panorama(width: u32, height: u32) -> Result<(), PictureFileError> {
    let (part, pixels) = PANORAMA_TOLERANCE;
    let aside = width.abs_diff(2 * height);
    if aside <= pixels || f64::from(aside) <= part * f64::from(width) {
        Ok(())
    } else {
        Err(PictureFileError::NoPanorama { width, height })
    }
}

fn reader(bytes: &[u8]) -> ImageReader<Cursor<&[u8]>> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    reader.limits(Limits::default());
    reader
}
