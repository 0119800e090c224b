//! PNG files that declare their color space.

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use ::png::Compression;
use colorimetry::Display;
use thiserror::Error;

use crate::icc::{self, IccError};
use crate::pending_file::PendingFile;
use crate::{Code, RgbImage, RgbImage8, cicp};

/// Why a PNG file could not be written. No file is left behind.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WritePngError {
    /// The file could not be opened, written or renamed to its target.
    #[error("cannot write {path}")]
    File {
        /// The requested file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The picture cannot be put into a PNG file: it has no pixels, or too many.
    #[error("cannot encode {path} as PNG")]
    Encode {
        /// The requested file.
        path: PathBuf,
        /// The error of the encoder.
        source: ::png::EncodingError,
    },
    /// The display cannot be described by a profile.
    #[error("cannot tag {path} with the color space of its display")]
    Profile {
        /// The requested file.
        path: PathBuf,
        /// The reason.
        source: IccError,
    },
}

/// Writes an 8-bit RGB PNG with an sRGB chunk, an equivalent cICP chunk for readers of the third
/// edition, and the name of the software.
///
/// # Errors
/// When the file cannot be written or the picture has no pixels.
pub fn write(path: &Path, image: &RgbImage8) -> Result<(), WritePngError> {
    // Mostly diagrams, which compress well.
    write_tagged(path, image, &Tags::srgb(), Compression::Balanced)
}

/// Writes an RGB PNG of 8 or 16 bits per channel whose codes are those of `display`.
///
/// The file declares the display with the code points of ITU-R H.273 (cICP) if the display has them, which take precedence in the
/// third edition of PNG, and with an ICC profile ([`icc`]), which all software knows; for sRGB with the sRGB chunk instead of the
/// profile.
///
/// # Errors
/// As [`write()`], and when the display's numbers do not fit a profile.
pub fn write_for_display<C: PngCode>(
    path: &Path,
    image: &RgbImage<C>,
    display: &Display,
) -> Result<(), WritePngError> {
    let tags = Tags::of(display).map_err(|source| WritePngError::Profile {
        path: path.to_owned(),
        source,
    })?;
    // Rendered pictures have noise, which does not compress at any effort.
    write_tagged(path, image, &tags, Compression::Fast)
}

/// The declarations of a file about its color space.
struct Tags {
    is_srgb: bool,
    cicp: Option<[u8; 4]>,
    icc: Option<Vec<u8>>,
}

impl Tags {
    fn srgb() -> Self {
        Self {
            is_srgb: true,
            cicp: Some(cicp::SRGB),
            icc: None,
        }
    }

    fn of(display: &Display) -> Result<Self, IccError> {
        let cicp = cicp::code_points(display);
        if cicp == Some(cicp::SRGB) {
            return Ok(Self::srgb());
        }
        Ok(Self {
            is_srgb: false,
            cicp,
            icc: Some(icc::profile(display)?),
        })
    }
}

/// A type of codes that a PNG file can hold.
pub trait PngCode: Code {
    /// Bits of a code.
    const DEPTH: ::png::BitDepth;

    /// Returns the codes as bytes of the file.
    fn bytes(codes: &[Self]) -> Cow<'_, [u8]>;
}

impl PngCode for u8 {
    const DEPTH: ::png::BitDepth = ::png::BitDepth::Eight;

    fn bytes(codes: &[Self]) -> Cow<'_, [u8]> {
        codes.into()
    }
}

impl PngCode for u16 {
    const DEPTH: ::png::BitDepth = ::png::BitDepth::Sixteen;

    fn bytes(codes: &[Self]) -> Cow<'_, [u8]> {
        let bytes = codes.iter().flat_map(|code| code.to_be_bytes());
        bytes.collect::<Vec<u8>>().into()
    }
}

fn write_tagged<C: PngCode>(
    path: &Path,
    image: &RgbImage<C>,
    tags: &Tags,
    compression: Compression,
) -> Result<(), WritePngError> {
    let file_error = |source| WritePngError::File {
        path: path.to_owned(),
        source,
    };
    let pending = PendingFile::create(path).map_err(file_error)?;
    let file = pending.handle().map_err(file_error)?;
    encode(file, image, tags, compression).map_err(|error| match error {
        ::png::EncodingError::IoError(source) => file_error(source),
        source => WritePngError::Encode {
            path: path.to_owned(),
            source,
        },
    })?;
    pending.commit().map_err(file_error)
}

fn encode<C: PngCode>(
    file: File,
    image: &RgbImage<C>,
    tags: &Tags,
    compression: Compression,
) -> Result<(), ::png::EncodingError> {
    let mut info = ::png::Info::with_size(image.width(), image.height());
    info.color_type = ::png::ColorType::Rgb;
    info.bit_depth = C::DEPTH;
    info.icc_profile = tags.icc.as_ref().map(Into::into);
    let mut buffered = BufWriter::new(file);
    let mut encoder = ::png::Encoder::with_info(&mut buffered, info)?;
    encoder.set_compression(compression);
    if tags.is_srgb {
        encoder.set_source_srgb(::png::SrgbRenderingIntent::RelativeColorimetric);
    }
    encoder.add_text_chunk("Software".to_owned(), crate::spectral_exr::software())?;
    let mut writer = encoder.write_header()?;
    if let Some(cicp) = tags.cicp {
        writer.write_chunk(::png::chunk::ChunkType(*b"cICP"), &cicp)?;
    }
    writer.write_image_data(&C::bytes(image.data()))?;
    writer.finish()?;
    buffered.flush()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32) -> RgbImage8 {
        let color = |i: u32| [(15 * (i % width)) as u8, (28 * (i / width)) as u8, 120];
        let codes = (0..width * height).flat_map(color).collect();
        RgbImage8::new(width, height, codes).unwrap()
    }

    /// The types of a PNG file's chunks, in order.
    fn chunks(bytes: &[u8]) -> Vec<String> {
        let mut at = 8;
        let mut types = Vec::new();
        while at < bytes.len() {
            let length = u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
            types.push(String::from_utf8(bytes[at + 4..at + 8].to_vec()).unwrap());
            at += 12 + length as usize;
        }
        types
    }

    #[test]
    fn what_is_written_is_read_again_with_its_color_space() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("picture.png");
        let picture = picture(17, 9);
        write(&path, &picture).unwrap();

        let decoder = ::png::Decoder::new(io::BufReader::new(File::open(&path).unwrap()));
        let mut reader = decoder.read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let frame = reader.next_frame(&mut data).unwrap();
        assert_eq!((frame.width, frame.height), (17, 9));
        assert_eq!(data, picture.data());

        let info = reader.info();
        assert!(info.srgb.is_some());
        let points = info.coding_independent_code_points.unwrap();
        assert_eq!(points.color_primaries, 1);
        assert_eq!(points.transfer_function, 13);
        let text = &info.uncompressed_latin1_text[0];
        assert!(text.keyword == "Software" && text.text.starts_with("Pellicle "));

        let types = chunks(&std::fs::read(&path).unwrap());
        let place = |name: &str| types.iter().position(|t| t == name).unwrap();
        assert!(place("sRGB") < place("IDAT") && place("cICP") < place("IDAT"));
    }

    /// Codes and the declared color space are right for every built-in display.
    #[test]
    fn every_display_has_its_tags() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("picture.png");
        let codes: Vec<u16> = (0..3 * 11 * 7).map(|i: u16| i.wrapping_mul(7919)).collect();
        let picture = RgbImage::new(11, 7, codes.clone()).unwrap();
        for name in Display::names() {
            let display = Display::named(name).unwrap();
            write_for_display(&path, &picture, &display).unwrap();
            let decoder = ::png::Decoder::new(io::BufReader::new(File::open(&path).unwrap()));
            let mut reader = decoder.read_info().unwrap();
            let mut data = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut data).unwrap();
            let found = data
                .chunks_exact(2)
                .map(|b| u16::from_be_bytes([b[0], b[1]]));
            assert!(found.eq(codes.iter().copied()), "{name}");

            let info = reader.info();
            let points = info.coding_independent_code_points;
            let expected = cicp::code_points(&display);
            assert_eq!(points.map(|p| p.color_primaries), expected.map(|p| p[0]));
            assert_eq!(points.map(|p| p.transfer_function), expected.map(|p| p[1]));
            assert_eq!(info.srgb.is_some(), name == "srgb", "{name}");
            assert_eq!(info.icc_profile.is_some(), name != "srgb", "{name}");
        }
    }

    #[test]
    fn a_failure_leaves_no_file() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("empty.png");
        let error = write(&path, &picture(0, 0)).unwrap_err();
        assert!(matches!(error, WritePngError::Encode { .. }), "{error:?}");
        assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 0);

        let nowhere = directory.path().join("missing").join("picture.png");
        let error = write(&nowhere, &picture(2, 2)).unwrap_err();
        assert!(matches!(error, WritePngError::File { .. }), "{error:?}");
        assert!(error.to_string().contains("picture.png"));
    }
}
