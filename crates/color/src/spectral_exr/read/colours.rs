//! Gathering XYZ alone from blocks of samples.

use exr::block::UncompressedBlock;
use exr::meta::attribute::ChannelList;

use super::Plan;
use super::pixels::each;
use crate::XyzImage;
use crate::spectral_exr::channels::Content;

/// The colours of an image that is being read.
pub(super) struct Colours {
    size: (usize, usize),
    xyz: Vec<[f32; 3]>,
    /// How many samples of X, Y and Z have been written.
    filled: usize,
}

impl Colours {
    pub(super) fn new(plan: &Plan) -> Self {
        let (width, height) = plan.size;
        Self {
            size: plan.size,
            xyz: vec![[0.0; 3]; width * height],
            filled: 0,
        }
    }

    /// Takes over a block's X, Y and Z; `None` when it does not lie within the image.
    pub(super) fn insert(
        &mut self,
        plan: &Plan,
        block: &UncompressedBlock,
        channels: &ChannelList,
    ) -> Option<()> {
        if block.index.level.0 != 0 || block.index.level.1 != 0 {
            // A smaller version of the same image.
            return Some(());
        }
        for line in block.lines(channels) {
            let at = line.location;
            let Some(Content::Xyz(axis)) = plan.contents[at.channel] else {
                continue;
            };
            let (x, y) = (at.position.x(), at.position.y());
            if x.checked_add(at.sample_count)? > self.size.0 || y >= self.size.1 {
                return None;
            }
            let start = y * self.size.0 + x;
            let row = &mut self.xyz[start..start + at.sample_count];
            each(line, channels.list[at.channel].sample_type, |x, value| {
                row[x][axis] = plan.scale * value;
            });
            self.filled += at.sample_count;
        }
        Some(())
    }

    /// The colours, if every sample came.
    pub(super) fn finish(self) -> Option<XyzImage> {
        let (width, height) = self.size;
        let all = self.filled == 3 * width * height;
        all.then(|| XyzImage::new(width as u32, height as u32, self.xyz))?
    }
}
