//! The digest of a file's pixels, which the format itself lacks.
//!
//! It is an attribute of the files that are written here: BLAKE3 over the y coordinate (four bytes, little-endian) and the compressed
//! bytes of every chunk in the order of the file, as 64 hexadecimal digits.

use std::fs::File;
use std::io::BufReader;

use exr::block::chunk::{Chunk, CompressedBlock};
use exr::block::reader::Reader;
use exr::meta::BlockDescription;
use exr::meta::attribute::{AttributeValue, LineOrder, Text};
use exr::meta::header::Header;

use super::{Context, ReadExrError};

/// The name of the attribute.
pub(crate) const NAME: &str = "pellicle.digest";

/// The digest of the chunks so far.
#[derive(Debug, Default)]
pub(crate) struct Digest(blake3::Hasher);

impl Digest {
    /// Adds the next chunk of the file.
    pub(crate) fn add(&mut self, chunk: &Chunk) {
        match &chunk.compressed_block {
            CompressedBlock::ScanLine(lines) => {
                self.0.update(&lines.y_coordinate.to_le_bytes());
                self.0.update(&lines.compressed_pixels_le);
            }
            // Not written here.
            CompressedBlock::Tile(tile) => {
                self.0.update(&tile.compressed_pixels_le);
            }
            CompressedBlock::DeepScanLine(_) | CompressedBlock::DeepTile(_) => {}
        }
    }

    /// The digest in hexadecimal digits.
    pub(crate) fn hex(&self) -> String {
        self.0.finalize().to_hex().to_string()
    }
}

/// Makes room for the digest in a header, before there is any.
pub(crate) fn reserve(header: &mut Header) {
    let room = Text::from_slice_unchecked(Digest::default().hex().as_bytes());
    let other = &mut header.own_attributes.other;
    other.insert(name(), AttributeValue::Text(room));
}

/// The comparison of a file's digest with that of the chunks that are read.
#[derive(Debug)]
pub(crate) struct Comparison {
    expected: String,
    found: Digest,
}

impl Comparison {
    /// Starts before the first chunk; `None` if the file has no digest.
    pub(crate) fn of_header(header: &Header) -> Option<Self> {
        match header.own_attributes.other.get(&name()) {
            Some(AttributeValue::Text(text)) => Some(Self {
                expected: String::from_utf8_lossy(text.as_slice()).into_owned(),
                found: Digest::default(),
            }),
            _ => None,
        }
    }

    /// Adds the next chunk of the file.
    pub(crate) fn add(&mut self, chunk: &Chunk) {
        self.found.add(chunk);
    }

    /// Compares after the last chunk.
    pub(crate) fn finish(self, context: &Context<'_>) -> Result<(), ReadExrError> {
        self.check(context)
    }

    fn check(&self, context: &Context<'_>) -> Result<(), ReadExrError> {
        if self.found.hex() == self.expected {
            return Ok(());
        }
        Err(context.damaged("its pixels are not those that were written"))
    }
}

/// The digest of a file of scan lines whose blocks are read by some rows at a time, from the first to the last.
#[derive(Debug)]
pub(crate) struct Progress {
    comparison: Comparison,
    /// The y coordinate of the next block, and that below the last one.
    next_y: i64,
    end_y: i64,
    block_rows: i64,
}

impl Progress {
    /// Starts before the first block; `None` if the file has no digest, or its blocks need not be in the order of their rows.
    pub(crate) fn of_headers(headers: &[Header]) -> Option<Self> {
        let [header] = headers else {
            return None;
        };
        let in_order = header.line_order == LineOrder::Increasing
            && header.blocks == BlockDescription::ScanLines;
        let next_y = i64::from(header.own_attributes.layer_position.y());
        Some(Self {
            comparison: Comparison::of_header(header).filter(|_| in_order)?,
            next_y,
            end_y: next_y + header.layer_size.height() as i64,
            block_rows: header.compression.scan_lines_per_block() as i64,
        })
    }

    /// Adds a block if it is the next one. A block that is read twice counts once.
    pub(crate) fn add(&mut self, chunk: &Chunk) {
        if let CompressedBlock::ScanLine(lines) = &chunk.compressed_block
            && i64::from(lines.y_coordinate) == self.next_y
        {
            self.comparison.add(chunk);
            self.next_y += self.block_rows;
        }
    }

    /// Compares the digest if all blocks have been added; otherwise returns false.
    pub(crate) fn is_verified(&self, context: &Context<'_>) -> Result<bool, ReadExrError> {
        if self.next_y < self.end_y {
            return Ok(false);
        }
        self.comparison.check(context).map(|()| true)
    }
}

/// Compares the digest of a part, if it has one, without decompressing anything; one chunk is in memory at a time. Returns whether
/// there is a digest.
pub(crate) fn verify(
    context: &Context<'_>,
    reader: Reader<BufReader<File>>,
    part: usize,
) -> Result<bool, ReadExrError> {
    let Some(mut comparison) = Comparison::of_header(&reader.headers()[part]) else {
        return Ok(false);
    };
    let mut chunks = context.run(|| reader.all_chunks(false))?;
    while let Some(chunk) = context.run(|| chunks.next().transpose())? {
        comparison.add(&chunk);
    }
    comparison.finish(context)?;
    Ok(true)
}

fn name() -> Text {
    Text::from_slice_unchecked(NAME.as_bytes())
}
