//! Writing a spectral image.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use exr::block::lines::LineIndex;
use exr::block::writer::ChunksWriter;
use exr::block::{BlockIndex, UncompressedBlock, chunk::Chunk};
use exr::meta::attribute::{LineOrder, Text};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::Compression;
use rayon::prelude::*;
use spectra::{SpectralImage, Values};
use thiserror::Error;

use super::attribute_order::finish_header;
use super::channels::Channels;
use super::content::Content;
use super::lights;
use super::metadata::Metadata;
use crate::exr_file::blocks_at_a_time;
use crate::pending_file::PendingFile;
use colorimetry::srgb;
use relight::xyz::exposure_scale;

/// Options for writing a file.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct WriteOptions {
    /// Whether to write the variance of every band too, which doubles the file size. On by default.
    pub variance: bool,
}

impl Default for WriteOptions {
    fn default() -> Self {
        Self { variance: true }
    }
}

/// Why a spectral file could not be written. No file is left behind.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WriteExrError {
    /// The file could not be opened, written or renamed to its target.
    #[error("cannot write {path}")]
    File {
        /// The requested file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The image has no pixels.
    #[error("cannot write {path}: the image has no pixels")]
    Empty {
        /// The requested file.
        path: PathBuf,
    },
    /// A setting's name is empty, too long or contains a zero.
    #[error("cannot write {path}: {name:?} cannot be the name of a setting")]
    SettingName {
        /// The requested file.
        path: PathBuf,
        /// The given name.
        name: String,
    },
    /// A light group's name cannot be the name of a layer, or occurs twice.
    #[error(
        "cannot write {path}: {name:?} cannot be the name of a light group, or names two of them"
    )]
    LightGroup {
        /// The requested file.
        path: PathBuf,
        /// The name.
        name: String,
    },
    /// The image cannot be put into an `OpenEXR` file.
    #[error("cannot encode {path} as OpenEXR")]
    Encode {
        /// The requested file.
        path: PathBuf,
        /// The error of the encoder.
        source: exr::error::Error,
    },
}

/// Writes a spectral file.
///
/// Compression is RLE, line by line, which is lossless. Noise fills the mantissas, so no lossless compression gains much, and the
/// cost of reading decides. Measured on 1920×1080 pixels, 40 bands without variance, 5 % noise, a third of the picture black, on
/// two cores that were also doing other work: 390 MB uncompressed (0.7 s to write, 0.9 s to read) become 274 MB with RLE
/// (1.1 s, 1.2 s), 259 MB with ZIP by line (5.2 s, 1.3 s), 258 MB with ZIP by 16 lines (11 s, 2.4 s) and 230 MB with PIZ
/// (5.8 s, 10.7 s). Neither RLE nor PIZ has a checksum: damaged pixels, unlike a damaged header, may be read as other values, with
/// RLE in one line at most.
///
/// Lines are taken from the image, compressed on all cores and written in order, several at a time. Compression needs up to three
/// times their bytes in addition to the image.
///
/// # Errors
/// When the file cannot be written, the image has no pixels, or a file cannot hold the name of a setting or light group.
pub fn write(
    path: &Path,
    image: &SpectralImage,
    metadata: &Metadata,
    options: WriteOptions,
) -> Result<(), WriteExrError> {
    let file_error = |source| WriteExrError::File {
        path: path.to_owned(),
        source,
    };
    if image.width() == 0 || image.height() == 0 {
        return Err(WriteExrError::Empty {
            path: path.to_owned(),
        });
    }
    if let Some(name) = metadata.bad_setting() {
        return Err(WriteExrError::SettingName {
            path: path.to_owned(),
            name: name.to_owned(),
        });
    }
    if let Some(name) = lights::bad_name(image.light_groups()) {
        return Err(WriteExrError::LightGroup {
            path: path.to_owned(),
            name: name.to_owned(),
        });
    }
    let pending = PendingFile::create(path).map_err(file_error)?;
    let file = pending.handle().map_err(file_error)?;
    encode(file, image, metadata, options).map_err(|error| match error {
        exr::error::Error::Io(source) => file_error(source),
        source => WriteExrError::Encode {
            path: path.to_owned(),
            source,
        },
    })?;
    let written = pending.handle().map_err(file_error)?;
    finish_header(written).map_err(file_error)?;
    pending.commit().map_err(file_error)
}

fn encode(
    file: File,
    image: &SpectralImage,
    metadata: &Metadata,
    options: WriteOptions,
) -> exr::error::UnitResult {
    let channels = Channels::new(image, options.variance);
    let size = (image.width() as usize, image.height() as usize);
    let mut header = Header::new(Text::default(), size, channels.descriptions.clone())
        .with_encoding(
            Compression::RLE,
            BlockDescription::ScanLines,
            LineOrder::Increasing,
        );
    metadata.clone().into_header(image.bands(), &mut header);
    lights::into_header(image.light_groups(), &mut header);
    let source = Source {
        image,
        contents: &channels.contents,
        scale: exposure_scale(metadata.exposure_ev),
    };
    let headers = std::iter::once(header).collect();
    exr::block::write(BufWriter::new(file), headers, true, |meta, writer| {
        source.write_blocks(&meta, writer)
    })
}

/// The source of a file's samples.
struct Source<'a> {
    image: &'a SpectralImage,
    contents: &'a [Content],
    scale: f64,
}

impl Source<'_> {
    fn write_blocks(
        &self,
        meta: &MetaData,
        writer: &mut impl ChunksWriter,
    ) -> exr::error::UnitResult {
        let blocks: Vec<(usize, BlockIndex)> =
            exr::block::enumerate_ordered_header_block_indices(&meta.headers).collect();
        let block_bytes = meta.headers[0].max_block_byte_size();
        for batch in blocks.chunks(blocks_at_a_time(block_bytes)) {
            let chunks: Vec<exr::error::Result<Chunk>> = batch
                .par_iter()
                .map(|&(_, block)| self.block(meta, block).compress_to_chunk(&meta.headers))
                .collect();
            for (&(index, _), chunk) in batch.iter().zip(chunks) {
                writer.write_chunk(index, chunk?)?;
            }
        }
        Ok(())
    }

    /// Converts to linear sRGB, not clipped.
    fn linear_rgb(&self, xyz: [f32; 3]) -> [f64; 3] {
        srgb::linear_from_xyz(xyz.map(|value| f64::from(value) * self.scale))
    }

    fn block(&self, meta: &MetaData, index: BlockIndex) -> UncompressedBlock {
        let channels = &meta.headers[index.layer].channels;
        UncompressedBlock::from_lines(channels, index, |line| self.fill(line.location, line.value))
    }

    /// Fills in the samples of one channel in one row of pixels.
    fn fill(&self, location: LineIndex, out: &mut [u8]) {
        let start = location.position.y() * self.image.width() as usize;
        let pixels = start..start + location.sample_count;
        match self.contents[location.channel] {
            Content::Value(key, index) => {
                if let Some(layer) = self.image.layer(key) {
                    let count = layer.values_per_pixel();
                    let row = pixels.start * count..pixels.end * count;
                    match layer.values() {
                        Values::Floats(values) => {
                            let values = values[row].iter().skip(index).step_by(count);
                            fill_with(out, values.map(|v| v.to_ne_bytes()));
                        }
                        Values::Counts(values) => {
                            let values = values[row].iter().skip(index).step_by(count);
                            fill_with(out, values.map(|v| v.to_ne_bytes()));
                        }
                    }
                }
            }
            Content::Rgb(light_group, channel) => {
                let xyz = match light_group {
                    Some(group) => self.image.group_xyz(group),
                    None => self.image.xyz(),
                };
                let values = xyz[pixels].iter();
                let values = values.map(|&v| self.linear_rgb(v)[channel] as f32);
                fill_with(out, values.map(f32::to_ne_bytes));
            }
        }
    }
}

fn fill_with(out: &mut [u8], values: impl Iterator<Item = [u8; 4]>) {
    for (out, value) in out.chunks_exact_mut(4).zip(values) {
        out.copy_from_slice(&value);
    }
}
