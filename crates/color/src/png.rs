//! PNG files that say which colour space they are in.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::RgbImage8;
use crate::pending_file::PendingFile;

/// Why a PNG file was not written. No file is left behind.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WritePngError {
    /// The file could not be opened, written or put in its place.
    #[error("cannot write {path}")]
    File {
        /// The file asked for.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The picture cannot be put into a PNG file: it has no pixels, or too many.
    #[error("cannot encode {path} as PNG")]
    Encode {
        /// The file asked for.
        path: PathBuf,
        /// What the encoder said.
        source: ::png::EncodingError,
    },
}

/// Coding-independent code points of sRGB: BT.709 primaries (1), the sRGB curve (13), RGB (0), full
/// range (1); ITU-T H.273 and the PNG specification, third edition, 11.3.2.6.
const CICP_SRGB: [u8; 4] = [1, 13, 0, 1];

/// Writes an 8-bit RGB PNG with an sRGB chunk, for readers of the third edition a cICP chunk that
/// says the same, and the software's name.
///
/// # Errors
/// When the file cannot be written or the picture has no pixels.
pub fn write(path: &Path, image: &RgbImage8) -> Result<(), WritePngError> {
    let file_error = |source| WritePngError::File {
        path: path.to_owned(),
        source,
    };
    let pending = PendingFile::create(path).map_err(file_error)?;
    let file = pending.handle().map_err(file_error)?;
    encode(file, image).map_err(|error| match error {
        ::png::EncodingError::IoError(source) => file_error(source),
        source => WritePngError::Encode {
            path: path.to_owned(),
            source,
        },
    })?;
    pending.commit().map_err(file_error)
}

fn encode(file: File, image: &RgbImage8) -> Result<(), ::png::EncodingError> {
    let mut buffered = BufWriter::new(file);
    let mut encoder = ::png::Encoder::new(&mut buffered, image.width(), image.height());
    encoder.set_color(::png::ColorType::Rgb);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_source_srgb(::png::SrgbRenderingIntent::RelativeColorimetric);
    encoder.add_text_chunk("Software".to_owned(), crate::spectral_exr::software())?;
    let mut writer = encoder.write_header()?;
    writer.write_chunk(::png::chunk::ChunkType(*b"cICP"), &CICP_SRGB)?;
    writer.write_image_data(image.data())?;
    writer.finish()?;
    buffered.flush()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::xyz::equal_energy_luminance;
    use crate::{DevelopSettings, XyzImage, develop};

    fn picture(width: u32, height: u32) -> RgbImage8 {
        let luminance = equal_energy_luminance() as f32;
        let colour = |i: u32| [(i % width) as f32 / 20.0, (i / width) as f32 / 10.0, 0.2];
        let xyz = (0..width * height).map(|i| colour(i).map(|v| v * luminance));
        let image = XyzImage::new(width, height, xyz.collect()).unwrap();
        develop(&image, &DevelopSettings::srgb(0.0)).unwrap()
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
    fn what_is_written_is_read_again_with_its_colour_space() {
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
