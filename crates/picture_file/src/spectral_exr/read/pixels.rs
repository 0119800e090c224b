//! Collecting blocks of samples into an image.

use exr::block::UncompressedBlock;
use exr::block::lines::LineRef;
use exr::meta::attribute::{ChannelList, SampleType};
use spectra::{ImageLayer, LayerKey, Observer, Quantity, SpectralImage, Stokes};

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
    /// Computes XYZ if the file lacks some.
    observer: Option<BandWeights>,
    /// The components of the Stokes vector whose XYZ the file lacks.
    lacks_xyz: [bool; 4],
}

/// The pixels of one row of a block: a layer for each of the image. That of the radiance of all light has a value for each spectral
/// channel of the file.
struct Row {
    layers: Vec<ImageLayer>,
}

impl Pixels {
    pub(super) fn new(plan: Plan) -> Self {
        let (width, height) = plan.window.size();
        let image = SpectralImage::with_light_groups(
            width as u32,
            height as u32,
            plan.grid,
            plan.light_groups.clone(),
        );
        let lacks_xyz = Stokes::ALL
            .map(|stokes| plan.components().contains(&stokes) && !plan.has_xyz_of(stokes));
        Self {
            image: if plan.is_polarized {
                image.with_polarization()
            } else {
                image
            },
            filled: vec![0; height],
            observer: lacks_xyz
                .contains(&true)
                .then(|| BandWeights::observed(&plan.grid, Observer::Cie1931Deg2)),
            lacks_xyz,
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
                    &self.plan,
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
        for x in run.skip..run.skip + run.count {
            let place = ((run.x + x - run.skip) as u32, run.y as u32);
            for &stokes in self.plan.components() {
                let own_xyz;
                let (radiance, xyz) = if self.plan.light_groups.len() == 1 {
                    let radiance = self.total(row, x, stokes, &mut even);
                    own_xyz = [self.xyz(row, x, stokes, radiance)];
                    (radiance, &own_xyz[..])
                } else {
                    row.by_light(x, stokes, &mut lights);
                    (&lights.0[..], &lights.1[..])
                };
                if stokes == Stokes::S0 {
                    let variance = row.pixel(LayerKey::VARIANCE, x);
                    let samples = row.samples(x);
                    self.image
                        .set_pixel_by_light(place, radiance, variance, xyz, samples);
                } else {
                    self.image
                        .set_component_by_light(place, stokes, radiance, xyz);
                }
            }
        }
        self.filled[run.y] += run.count;
    }

    /// A component of all light of a pixel of a row, on the bands of the image, for which `even` has room.
    fn total<'a>(&self, row: &'a Row, x: usize, stokes: Stokes, even: &'a mut [f32]) -> &'a [f32] {
        let radiance = row.pixel(LayerKey::RADIANCE.component(stokes), x);
        let Some(shares) = &self.plan.shares else {
            return radiance;
        };
        for (even, shares) in even.iter_mut().zip(shares) {
            *even = shares.iter().map(|&(i, share)| share * radiance[i]).sum();
        }
        even
    }

    /// XYZ of a component of all light of a pixel of a row: those of the file, or of this radiance.
    fn xyz(&self, row: &Row, x: usize, stokes: Stokes, radiance: &[f32]) -> [f32; 3] {
        match &self.observer {
            Some(observer) if self.lacks_xyz[stokes.index()] => {
                observer.xyz(radiance).map(|v| v as f32)
            }
            _ => {
                let xyz = row.pixel(LayerKey::XYZ.component(stokes), x);
                [xyz[0], xyz[1], xyz[2]]
            }
        }
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
        let layer = |key: LayerKey| {
            let bands = if key.component(Stokes::S0) == LayerKey::RADIANCE {
                plan.spectral_channels
            } else {
                plan.grid.count() as usize
            };
            ImageLayer::zeros(key, bands, width)
        };
        Self {
            layers: keys(plan).map(layer).collect(),
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

    /// Collects a component of the light groups of a pixel: radiance as `[light group][band]`, and XYZ.
    fn by_light(&self, x: usize, stokes: Stokes, (radiance, xyz): &mut (Vec<f32>, Vec<[f32; 3]>)) {
        radiance.clear();
        xyz.clear();
        let of_groups =
            |layer: &&ImageLayer| layer.key().light_group.is_some() && layer.key().stokes == stokes;
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
    fn take(&mut self, line: LineRef<'_>, kind: SampleType, content: Content, plan: &Plan) {
        let Content::Value(key, index) = content else {
            return;
        };
        let scale = plan.scale_of(key);
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

/// The layers that are read.
fn keys(plan: &Plan) -> impl Iterator<Item = LayerKey> {
    let groups = plan.light_groups.len();
    let polarized = plan.is_polarized.then(|| LayerKey::polarized(groups));
    LayerKey::all(groups).chain(polarized.into_iter().flatten())
}

/// Calls `put` with the index and value of every sample of a line.
fn each(line: LineRef<'_>, kind: SampleType, put: impl FnMut(usize, f32)) {
    each_sample(line, kind, (0, line.location.sample_count), put);
}
