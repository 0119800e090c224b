//! Collecting blocks of samples into an image.

use exr::block::UncompressedBlock;
use exr::block::lines::LineRef;
use exr::meta::attribute::{ChannelList, SampleType};
use spectra::{ImageLayer, LayerKey, Observer, Quantity, SpectralImage};

use super::Plan;
use crate::exr_file::{Run, each_sample, words};
use crate::spectral_exr::content::Content;
use relight::BandWeights;

/// An image that is being read.
pub(super) struct Pixels {
    plan: Plan,
    image: SpectralImage,
    /// Number of pixels of each row stored so far.
    filled: Vec<usize>,
    /// Computes XYZ if the file has none.
    observer: Option<BandWeights>,
}

/// The pixels of one row of a block: a layer for each of the image. That of the radiance of all light has a value for each spectral
/// channel of the file.
struct Row {
    layers: Vec<ImageLayer>,
}

impl Pixels {
    pub(super) fn new(plan: Plan) -> Self {
        let (width, height) = plan.window.size();
        Self {
            image: SpectralImage::with_light_groups(
                width as u32,
                height as u32,
                plan.grid,
                plan.light_groups.clone(),
            ),
            filled: vec![0; height],
            observer: (!plan.has_xyz())
                .then(|| BandWeights::observed(&plan.grid, Observer::Cie1931Deg2)),
            plan,
        }
    }

    /// What is read.
    pub(super) fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Stores a block's pixels; `None` if the block is not within the image.
    pub(super) fn insert(
        &mut self,
        block: &UncompressedBlock,
        channels: &ChannelList,
    ) -> Option<()> {
        let (position, size) = (block.index.pixel_position, block.index.pixel_size);
        let last_row = position.y().checked_add(size.height())?.checked_sub(1)?;
        if !self
            .plan
            .window
            .holds((position.x(), last_row), size.width())
        {
            return None;
        }
        let mut row = Row::new(size.width(), &self.plan);
        let last = channels.list.len() - 1;
        for line in block.lines(channels) {
            let (channel, y) = (line.location.channel, line.location.position.y());
            let Some(run) = self.plan.window.place((position.x(), y), size.width()) else {
                continue;
            };
            if let Some(content) = self.plan.contents[channel] {
                row.take(
                    line,
                    channels.list[channel].sample_type,
                    content,
                    self.plan.scale,
                );
            }
            if channel == last {
                self.put(&row, run);
            }
        }
        Some(())
    }

    fn put(&mut self, row: &Row, run: Run) {
        let mut even = vec![0.0; self.plan.grid.count() as usize];
        let mut lights = (Vec::new(), Vec::new());
        let totals = [LayerKey::RADIANCE, LayerKey::VARIANCE, LayerKey::XYZ];
        for x in run.skip..run.skip + run.count {
            let [radiance, variance, xyz] = totals.map(|key| row.pixel(key, x));
            let radiance = match &self.plan.shares {
                None => radiance,
                Some(shares) => {
                    for (even, shares) in even.iter_mut().zip(shares) {
                        *even = shares.iter().map(|&(i, share)| share * radiance[i]).sum();
                    }
                    &even
                }
            };
            let xyz = match &self.observer {
                Some(observer) => observer.xyz(radiance).map(|v| v as f32),
                None => [xyz[0], xyz[1], xyz[2]],
            };
            let place = ((run.x + x - run.skip) as u32, run.y as u32);
            let samples = row.samples(x);
            if self.plan.light_groups.len() == 1 {
                self.image
                    .set_pixel(place, radiance, variance, xyz, samples);
            } else {
                row.by_light(x, &mut lights);
                let (radiance, xyz) = &lights;
                self.image
                    .set_pixel_by_light(place, radiance, variance, xyz, samples);
            }
        }
        self.filled[run.y] += run.count;
    }

    /// Returns the image, if every pixel was stored exactly once.
    pub(super) fn finish(self) -> Option<SpectralImage> {
        let window = self.plan.window;
        let mut rows = self.filled.iter().enumerate();
        rows.all(|(y, &count)| count == window.held_in_row(y))
            .then_some(self.image)
    }
}

impl Row {
    fn new(width: usize, plan: &Plan) -> Self {
        let layer = |key| {
            let bands = if key == LayerKey::RADIANCE {
                plan.spectral_channels
            } else {
                plan.grid.count() as usize
            };
            ImageLayer::zeros(key, bands, width)
        };
        Self {
            layers: LayerKey::all(plan.light_groups.len()).map(layer).collect(),
        }
    }

    /// The values of pixel `x` in a layer.
    fn pixel(&self, key: LayerKey, x: usize) -> &[f32] {
        let layer = self.layers.iter().find(|layer| layer.key() == key);
        layer.map_or(&[], |layer| &layer.floats()[layer.values_of(x)])
    }

    /// The number of samples of pixel `x`.
    fn samples(&self, x: usize) -> u32 {
        let mut counts = self.layers.iter().map(ImageLayer::counts);
        let counts = counts.find(|counts| !counts.is_empty());
        counts.map_or(0, |counts| counts[x])
    }

    /// Collects the light groups of a pixel: radiance as `[light group][band]`, and XYZ.
    fn by_light(&self, x: usize, (radiance, xyz): &mut (Vec<f32>, Vec<[f32; 3]>)) {
        radiance.clear();
        xyz.clear();
        let of_groups = |layer: &&ImageLayer| layer.key().light_group.is_some();
        for layer in self.layers.iter().filter(of_groups) {
            let values = &layer.floats()[layer.values_of(x)];
            match layer.key().quantity {
                Quantity::Radiance => radiance.extend(values),
                Quantity::Xyz => xyz.extend(values.as_chunks::<3>().0),
                Quantity::Variance | Quantity::Samples => {}
            }
        }
    }

    /// Stores the samples of one channel. The scale of the file's unit applies to all light in the file.
    fn take(&mut self, line: LineRef<'_>, kind: SampleType, content: Content, scale: f32) {
        let Content::Value(key, index) = content else {
            return;
        };
        let Some(layer) = self.layers.iter_mut().find(|layer| layer.key() == key) else {
            return;
        };
        let count = layer.values_per_pixel();
        match key.quantity {
            Quantity::Radiance | Quantity::Xyz => {
                let values = layer.floats_mut();
                each(line, kind, |x, v| values[x * count + index] = scale * v);
            }
            Quantity::Variance => {
                let values = layer.floats_mut();
                each(line, kind, |x, v| {
                    values[x * count + index] = scale * (scale * v);
                });
            }
            Quantity::Samples if kind == SampleType::U32 => {
                for (samples, bytes) in layer.counts_mut().iter_mut().zip(words(line.value)) {
                    *samples = u32::from_ne_bytes(bytes);
                }
            }
            Quantity::Samples => {
                let samples = layer.counts_mut();
                each(line, kind, |x, v| samples[x] = v as u32);
            }
        }
    }
}

/// Calls `put` with the index and value of every sample of a line.
fn each(line: LineRef<'_>, kind: SampleType, put: impl FnMut(usize, f32)) {
    each_sample(line, kind, (0, line.location.sample_count), put);
}
