//! Blocks of pixels, several at a time on all cores.

use std::fs::File;
use std::io::BufReader;

use exr::block::chunk::{Chunk, TileCoordinates};
use exr::block::reader::Reader;
use exr::block::{BlockIndex, UncompressedBlock};
use exr::math::Vec2;
use exr::meta::MetaData;
use exr::meta::attribute::ChannelList;
use rayon::prelude::*;

use super::digest::{Comparison, Progress};
use super::{Context, ReadExrError, Window};

/// The most bytes of uncompressed blocks in memory at a time (a single block may be larger).
pub const BATCH_BYTES: usize = 256 << 20;

/// Number of blocks to process in parallel before the next are read or these are written: two for each core, more if they are
/// small.
pub(crate) fn blocks_at_a_time(block_bytes: usize) -> usize {
    const SMALL: usize = 16 << 20;
    let block_bytes = block_bytes.max(1);
    let enough = (2 * rayon::current_num_threads()).max(SMALL / block_bytes);
    (BATCH_BYTES / block_bytes).clamp(1, enough)
}

/// Decompresses the blocks of a part, several at a time on all cores, and passes those of full size to `insert` in order. If the file
/// has a digest, it is compared at the end.
pub(crate) fn each_block(
    context: &Context<'_>,
    reader: Reader<BufReader<File>>,
    part: usize,
    insert: impl FnMut(&UncompressedBlock, &ChannelList) -> Option<()> + Send,
) -> Result<(), ReadExrError> {
    let meta = reader.meta_data().clone();
    let mut comparison = Comparison::of_header(&meta.headers[part]);
    let mut chunks = context.run(|| reader.all_chunks(false))?;
    let mut blocks = Blocks {
        context,
        meta: &meta,
        part,
        insert,
    };
    let next = |count| {
        let batch: Vec<Chunk> = context.run(|| chunks.by_ref().take(count).collect())?;
        if let Some(comparison) = &mut comparison {
            for chunk in &batch {
                comparison.add(chunk);
            }
        }
        Ok(batch)
    };
    blocks.insert_all(next)?;
    comparison.map_or(Ok(()), |comparison| comparison.finish(context))
}

/// As [`each_block`], but only with blocks that have pixels in the picture of a window, which are found by the file's table of
/// contents. They are added to the `progress` of the digest, which is not compared.
pub(crate) fn each_block_within(
    context: &Context<'_>,
    reader: Reader<BufReader<File>>,
    part: usize,
    window: &Window,
    progress: Option<&mut Progress>,
    insert: impl FnMut(&UncompressedBlock, &ChannelList) -> Option<()> + Send,
) -> Result<(), ReadExrError> {
    let meta = reader.meta_data().clone();
    let is_wanted = |_: &MetaData, _: TileCoordinates, block: BlockIndex| {
        let (position, size) = (block.pixel_position, block.pixel_size);
        block.layer == part
            && block.level == Vec2(0, 0)
            && window.meets((position.x(), position.y()), (size.width(), size.height()))
    };
    let mut chunks = context.run(|| reader.filter_chunks(false, is_wanted))?;
    let mut blocks = Blocks {
        context,
        meta: &meta,
        part,
        insert,
    };
    let mut progress = progress;
    blocks.insert_all(|count| {
        let batch: Vec<Chunk> = context.run(|| chunks.by_ref().take(count).collect())?;
        if let Some(progress) = &mut progress {
            for chunk in &batch {
                progress.add(chunk);
            }
        }
        Ok(batch)
    })
}

/// The blocks of a part, and where they go.
struct Blocks<'a, F> {
    context: &'a Context<'a>,
    meta: &'a MetaData,
    part: usize,
    insert: F,
}

impl<F: FnMut(&UncompressedBlock, &ChannelList) -> Option<()> + Send> Blocks<'_, F> {
    /// Inserts batches up to an empty one. `next` reads up to a number of chunks, while the ones before are inserted.
    fn insert_all(
        &mut self,
        mut next: impl FnMut(usize) -> Result<Vec<Chunk>, ReadExrError> + Send,
    ) -> Result<(), ReadExrError> {
        let at_a_time = blocks_at_a_time(self.meta.headers[self.part].max_block_byte_size());
        let mut batch = next(at_a_time)?;
        while !batch.is_empty() {
            let (inserted, read) = rayon::join(|| self.insert(batch), || next(at_a_time));
            inserted?;
            batch = read?;
        }
        Ok(())
    }

    fn insert(&mut self, batch: Vec<Chunk>) -> Result<(), ReadExrError> {
        let (meta, part) = (self.meta, self.part);
        let blocks: Vec<UncompressedBlock> = self.context.run(|| {
            batch
                .into_par_iter()
                .filter(|chunk| chunk.layer_index == part)
                .map(|chunk| UncompressedBlock::decompress_chunk(chunk, meta, false))
                .collect()
        })?;
        // Other levels are smaller versions of the same image.
        let full_size = blocks
            .iter()
            .filter(|block| block.index.level == Vec2(0, 0));
        let outside = || self.context.damaged("a block lies outside the image");
        for block in full_size {
            (self.insert)(block, &meta.headers[part].channels).ok_or_else(outside)?;
        }
        Ok(())
    }
}
