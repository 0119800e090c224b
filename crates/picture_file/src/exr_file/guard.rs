//! Limits on the sizes that a header may claim.
//!
//! A few damaged bytes in a header can ask for any amount of memory. Memory for pixels is allocated only
//! after the claims have been checked here.

use exr::meta::BlockDescription;
use exr::meta::header::Header;
use exr::prelude::Compression;

use super::{Context, ReadExrError, Window};

/// The most memory that an image read from a file may take, bytes (64 GiB).
pub const MAX_BYTES: u128 = 64 << 30;

/// How many times as large as its pixels in the file a picture may be, plus [`MISSING_BYTES`].
const MAX_MISSING: u128 = 16;
/// By how many further bytes a picture may exceed its pixels in the file: missing pixels take memory without bytes in the file. A file of a
/// few hundred bytes may ask for less: this many bytes for each of its own.
const MISSING_BYTES: u128 = 1 << 30;
const MISSING_BYTES_PER_BYTE: u128 = 1 << 16;

/// Returns the largest factor by which a compression can shrink a block, with a margin for the data around it.
///
/// RLE writes runs of 128 bytes in two, B44A blocks of 32 in three. DEFLATE reaches 1032:1 on equal bytes, and PXR24 hands it three
/// bytes of four. DWA hands coefficients to it and to its own run-length code, in which one coefficient stands for up to 63.
fn most_ratio(compression: Compression) -> u128 {
    match compression {
        Compression::Uncompressed => 1,
        Compression::RLE => 80,
        Compression::B44 | Compression::B44A => 16,
        Compression::DWAA(_) | Compression::DWAB(_) => 1 << 16,
        _ => 2048,
    }
}

/// Rejects headers that claim more than the length of the file can account for.
pub(crate) fn check(
    context: &Context<'_>,
    headers: &[Header],
    part: usize,
    file_bytes: u64,
) -> Result<(), ReadExrError> {
    let file_bytes = u128::from(file_bytes);
    // Every chunk has an entry of 8 bytes in the offset table.
    let table_bytes: u128 = headers.iter().map(|h| 8 * h.chunk_count as u128).sum();
    if table_bytes > file_bytes {
        return Err(context.damaged("the file is shorter than its own table of contents"));
    }
    // The decoder multiplies these without a check.
    if headers.iter().any(|header| block_bytes(header) > MAX_BYTES) {
        return Err(context.damaged("a block of pixels is larger than any image"));
    }
    let header = &headers[part];
    let (width, height) = (header.layer_size.width(), header.layer_size.height());
    let pixels = (width as u128).saturating_mul(height as u128);
    let pixel_bytes = pixels.saturating_mul(header.channels.bytes_per_pixel as u128);
    if pixel_bytes > file_bytes.saturating_mul(most_ratio(header.compression)) {
        return Err(context.damaged("the file is too short for the size of its image"));
    }
    let display = header.shared_attributes.display_window.size;
    if [width, height, display.width(), display.height()].contains(&0) {
        return Err(context.damaged("its data window or its display window has no pixels"));
    }
    Ok(())
}

/// Whether an image of the display window may be as large as it is, and memory for it is available; `bytes_of` returns the bytes
/// of an image of a width and a height.
pub(crate) fn fits(window: &Window, file_bytes: u64, bytes_of: impl Fn(u32, u32) -> u128) -> bool {
    let bytes =
        |(width, height): (usize, usize)| match (u32::try_from(width), u32::try_from(height)) {
            (Ok(width), Ok(height)) => Some(bytes_of(width, height)),
            _ => None,
        };
    let (Some(shown), Some(held)) = (bytes(window.size()), bytes(window.data())) else {
        return false;
    };
    let missing = MISSING_BYTES.min(MISSING_BYTES_PER_BYTE * u128::from(file_bytes));
    if shown > MAX_BYTES || shown > held.saturating_mul(MAX_MISSING).saturating_add(missing) {
        return false;
    }
    // A failed allocation is an error here; in the image it would abort the program.
    usize::try_from(shown).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok())
}

/// Returns the bytes of a header's largest block.
fn block_bytes(header: &Header) -> u128 {
    let pixels = match header.blocks {
        BlockDescription::Tiles(tiles) => {
            tiles.tile_size.width() as u128 * tiles.tile_size.height() as u128
        }
        BlockDescription::ScanLines => {
            header.layer_size.width() as u128 * header.compression.scan_lines_per_block() as u128
        }
    };
    pixels.saturating_mul(header.channels.bytes_per_pixel as u128)
}
