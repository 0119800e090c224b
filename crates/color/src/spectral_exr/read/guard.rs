//! Sizes that a header may claim.
//!
//! A few damaged bytes in a header can ask for any amount of memory. Nothing is allocated for pixels
//! before the claims have passed here.

use exr::meta::BlockDescription;
use exr::meta::header::Header;
use spectra::SpectralImage;

use super::{Context, Plan, ReadExrError};

/// The most memory that an image read from a file may take, bytes (64 GiB).
pub const MAX_BYTES: u128 = 64 << 30;

/// The most that any of the format's compressions can shrink a block. DEFLATE, the strongest,
/// reaches 1032:1 on equal bytes; the rest is margin for what stands before it.
const MAX_RATIO: u128 = 2048;

/// Refuses headers whose claims the length of the file or the memory cannot account for.
pub(super) fn check(
    context: &Context<'_>,
    headers: &[Header],
    plan: &Plan,
    file_bytes: u64,
) -> Result<(), ReadExrError> {
    let file_bytes = u128::from(file_bytes);
    // Every chunk has an entry of 8 bytes in the offset table.
    let table_bytes: u128 = headers.iter().map(|h| 8 * h.chunk_count as u128).sum();
    if table_bytes > file_bytes {
        return Err(context.damaged("the file is shorter than its own table of contents"));
    }
    // The decoder multiplies these without looking.
    if headers.iter().any(|header| block_bytes(header) > MAX_BYTES) {
        return Err(context.damaged("a block of pixels is larger than any image"));
    }
    let (width, height) = plan.size;
    let header = &headers[plan.layer];
    let pixel_bytes = header.channels.bytes_per_pixel as u128;
    if width as u128 * height as u128 * pixel_bytes > file_bytes * MAX_RATIO {
        return Err(context.damaged("the file is too short for the size of its image"));
    }
    if !fits(plan) {
        return Err(ReadExrError::TooLarge {
            path: context.path.to_owned(),
            width,
            height,
            bands: plan.grid.count() as usize,
        });
    }
    Ok(())
}

/// Bytes of a header's largest block.
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

/// Whether the image may be as large as it is, and the memory for it is there.
fn fits(plan: &Plan) -> bool {
    let (Ok(width), Ok(height)) = (u32::try_from(plan.size.0), u32::try_from(plan.size.1)) else {
        return false;
    };
    let bytes = SpectralImage::bytes(width, height, plan.grid.count(), plan.light_groups.len());
    if bytes > MAX_BYTES {
        return false;
    }
    // Asking for it here gives an error; asking for it in the image would end the program.
    usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok())
}
