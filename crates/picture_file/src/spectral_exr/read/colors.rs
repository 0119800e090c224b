//! Collecting only XYZ from blocks of samples.

use exr::block::UncompressedBlock;
use exr::meta::attribute::ChannelList;

use super::Plan;
use crate::exr_file::each_sample;
use crate::spectral_exr::content::Content;
use relight::XyzImage;
use spectra::LayerKey;

/// The colors of an image that is being read.
pub(super) struct Colors {
    size: (usize, usize),
    xyz: Vec<[f32; 3]>,
    /// Number of samples of X, Y and Z stored so far.
    filled: usize,
}

impl Colors {
    pub(super) fn new(plan: &Plan) -> Self {
        let (width, height) = plan.window.size();
        Self {
            size: (width, height),
            xyz: vec![[0.0; 3]; width * height],
            filled: 0,
        }
    }

    /// Stores a block's X, Y and Z; `None` if the block is not within the image.
    pub(super) fn insert(
        &mut self,
        plan: &Plan,
        block: &UncompressedBlock,
        channels: &ChannelList,
    ) -> Option<()> {
        for line in block.lines(channels) {
            let at = line.location;
            let axis = match plan.contents[at.channel] {
                Some(Content::Value(key, axis)) if key == LayerKey::XYZ => axis,
                _ => continue,
            };
            let (x, y) = (at.position.x(), at.position.y());
            if !plan.window.holds((x, y), at.sample_count) {
                return None;
            }
            self.filled += at.sample_count;
            let Some(run) = plan.window.place((x, y), at.sample_count) else {
                continue;
            };
            let start = run.y * self.size.0 + run.x;
            let row = &mut self.xyz[start..start + run.count];
            let kind = channels.list[at.channel].sample_type;
            each_sample(line, kind, (run.skip, run.count), |x, value| {
                row[x][axis] = plan.scale * value;
            });
        }
        Some(())
    }

    /// Returns the colors, if every sample was stored.
    pub(super) fn finish(self, plan: &Plan) -> Option<XyzImage> {
        let (width, height) = self.size;
        let held = plan.window.data();
        let all = self.filled == 3 * held.0 * held.1;
        all.then(|| XyzImage::new(width as u32, height as u32, self.xyz))?
    }
}
