//! The lines of a file.

use exr::block::chunk::Chunk;
use exr::block::lines::LineIndex;
use exr::block::writer::ChunksWriter;
use exr::block::{BlockIndex, UncompressedBlock};
use exr::math::Vec2;
use exr::meta::MetaData;
use rayon::prelude::*;
use spectra::{SpectralImage, Values};

use crate::exr_file::blocks_at_a_time;
use crate::exr_file::digest::Digest;
use crate::spectral_exr::content::Content;
use colorimetry::srgb;

/// The lines of a file, each of which is a block, since the compression is RLE.
pub(super) struct Lines<'a> {
    contents: &'a [Content],
    scale: f64,
    /// Number of lines written so far.
    count: usize,
    digest: Digest,
}

impl<'a> Lines<'a> {
    /// Starts at the first line. Developed colors are multiplied by `scale`.
    pub(super) fn new(contents: &'a [Content], scale: f64) -> Self {
        Self {
            contents,
            scale,
            count: 0,
            digest: Digest::default(),
        }
    }

    /// Writes all rows of an image as the next lines: some are written while the next ones are compressed.
    pub(super) fn write(
        &mut self,
        image: &SpectralImage,
        meta: &MetaData,
        writer: &mut (impl ChunksWriter + Send),
    ) -> exr::error::UnitResult {
        let source = Source {
            image,
            first_row: self.count,
            contents: self.contents,
            scale: self.scale,
        };
        self.count += image.height() as usize;
        let lines: Vec<usize> = (source.first_row..self.count).collect();
        let mut compressed = Vec::new();
        for batch in lines.chunks(blocks_at_a_time(meta.headers[0].max_block_byte_size())) {
            let (next, put) = rayon::join(
                || source.compressed(meta, batch),
                || self.put(compressed, writer),
            );
            put?;
            compressed = next;
        }
        self.put(compressed, writer)
    }

    /// Writes compressed lines.
    fn put(
        &mut self,
        lines: Vec<CompressedLine>,
        writer: &mut impl ChunksWriter,
    ) -> exr::error::UnitResult {
        for (line, chunk) in lines {
            let chunk = chunk?;
            self.digest.add(&chunk);
            writer.write_chunk(line, chunk)?;
        }
        Ok(())
    }

    /// The digest of the lines written.
    pub(super) fn into_digest(self) -> Digest {
        self.digest
    }
}

/// The number of a line, and its chunk.
type CompressedLine = (usize, exr::error::Result<Chunk>);

/// The source of samples.
struct Source<'a> {
    image: &'a SpectralImage,
    /// The line of the image's first row.
    first_row: usize,
    contents: &'a [Content],
    scale: f64,
}

impl Source<'_> {
    /// Compresses lines on all cores.
    fn compressed(&self, meta: &MetaData, lines: &[usize]) -> Vec<CompressedLine> {
        let lines = lines.par_iter();
        lines
            .map(|&line| (line, self.line(meta, line).compress_to_chunk(&meta.headers)))
            .collect()
    }

    fn line(&self, meta: &MetaData, line: usize) -> UncompressedBlock {
        let index = BlockIndex {
            layer: 0,
            pixel_position: Vec2(0, line),
            pixel_size: Vec2(self.image.width() as usize, 1),
            level: Vec2(0, 0),
        };
        let channels = &meta.headers[0].channels;
        UncompressedBlock::from_lines(channels, index, |line| self.fill(line.location, line.value))
    }

    /// Converts to linear sRGB, not clipped.
    fn linear_rgb(&self, xyz: [f32; 3]) -> [f64; 3] {
        srgb::linear_from_xyz(xyz.map(|value| f64::from(value) * self.scale))
    }

    /// Fills in the samples of one channel in one row of pixels.
    fn fill(&self, location: LineIndex, out: &mut [u8]) {
        let start = (location.position.y() - self.first_row) * self.image.width() as usize;
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
