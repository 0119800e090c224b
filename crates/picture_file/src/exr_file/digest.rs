//! The digest of a file's pixels, which the format itself lacks.
//!
//! It is an attribute of the files that are written here: BLAKE3 over the y coordinate (four bytes, little-endian) and the compressed
//! bytes of every chunk in the order of the file, as 64 hexadecimal digits.

use std::fs::File;
use std::io::BufReader;

use exr::block::chunk::{Chunk, CompressedBlock};
use exr::block::reader::Reader;
use exr::meta::attribute::{AttributeValue, Text};
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
        if self.found.hex() == self.expected {
            return Ok(());
        }
        Err(context.damaged("its pixels are not those that were written"))
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
