//! Collecting blocks of samples into an image.

use exr::block::UncompressedBlock;
use exr::block::lines::LineRef;
use exr::meta::attribute::{ChannelList, SampleType};
use spectra::{Observer, SpectralImage};

use super::Plan;
use crate::exr_file::{Run, each_sample, words};
use crate::spectral_exr::channels::{Content, LightContent};
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

/// The pixels of one row of a block.
struct Row {
    radiance: Vec<f32>,
    variance: Vec<f32>,
    xyz: Vec<[f32; 3]>,
    samples: Vec<u32>,
    /// Number of radiances of each pixel.
    channels: usize,
    /// Number of variances of each pixel.
    bands: usize,
    /// Radiance and XYZ of each of several light groups.
    lights: Vec<(Vec<f32>, Vec<[f32; 3]>)>,
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

    /// Index of the layer that is read.
    pub(super) fn layer(&self) -> usize {
        self.plan.layer
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
            if let Some(content) = self.plan.contents[channel] {
                row.take(
                    line,
                    channels.list[channel].sample_type,
                    content,
                    self.plan.scale,
                );
            }
            if channel == last
                && let Some(run) = self.plan.window.place((position.x(), y), size.width())
            {
                self.put(&row, run);
            }
        }
        Some(())
    }

    fn put(&mut self, row: &Row, run: Run) {
        let bands = self.plan.grid.count() as usize;
        let mut even = vec![0.0; bands];
        let mut lights = (Vec::new(), Vec::new());
        for (x, &xyz) in row.xyz.iter().enumerate().skip(run.skip).take(run.count) {
            let values = x * bands..(x + 1) * bands;
            let radiance = &row.radiance[x * row.channels..(x + 1) * row.channels];
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
                None => xyz,
            };
            let place = ((run.x + x - run.skip) as u32, run.y as u32);
            let variance = &row.variance[values];
            if row.lights.is_empty() {
                self.image
                    .set_pixel(place, radiance, variance, xyz, row.samples[x]);
            } else {
                row.by_light(x, &mut lights);
                let (radiance, xyz) = &lights;
                self.image
                    .set_pixel_by_light(place, radiance, variance, xyz, row.samples[x]);
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
        let (channels, bands) = (plan.spectral_channels, plan.grid.count() as usize);
        let light_groups = plan.light_groups.len();
        let kept = if light_groups > 1 { light_groups } else { 0 };
        Self {
            channels,
            bands,
            radiance: vec![0.0; width * channels],
            variance: vec![0.0; width * bands],
            xyz: vec![[0.0; 3]; width],
            samples: vec![0; width],
            lights: vec![(vec![0.0; width * bands], vec![[0.0; 3]; width]); kept],
        }
    }

    /// Collects the light groups of a pixel: radiance as `[light group][band]`, and XYZ.
    fn by_light(&self, x: usize, (radiance, xyz): &mut (Vec<f32>, Vec<[f32; 3]>)) {
        let bands = self.bands;
        radiance.clear();
        xyz.clear();
        for (radiances, colors) in &self.lights {
            radiance.extend(&radiances[x * bands..(x + 1) * bands]);
            xyz.push(colors[x]);
        }
    }

    /// Stores the samples of one channel. The scale of the file's unit applies to all light in the file.
    fn take(&mut self, line: LineRef<'_>, kind: SampleType, content: Content, scale: f32) {
        let (channels, bands) = (self.channels, self.bands);
        match content {
            Content::Radiance(band) => each(line, kind, |x, v| {
                self.radiance[x * channels + band] = scale * v;
            }),
            Content::Variance(band) => each(line, kind, |x, v| {
                self.variance[x * bands + band] = scale * (scale * v);
            }),
            Content::Xyz(axis) => each(line, kind, |x, v| self.xyz[x][axis] = scale * v),
            Content::Samples if kind == SampleType::U32 => {
                for (samples, bytes) in self.samples.iter_mut().zip(words(line.value)) {
                    *samples = u32::from_ne_bytes(bytes);
                }
            }
            Content::Samples => each(line, kind, |x, v| self.samples[x] = v as u32),
            Content::Light(group, LightContent::Radiance(band)) => {
                let radiance = &mut self.lights[group].0;
                each(line, kind, |x, v| radiance[x * bands + band] = scale * v);
            }
            Content::Light(group, LightContent::Xyz(axis)) => {
                let xyz = &mut self.lights[group].1;
                each(line, kind, |x, v| xyz[x][axis] = scale * v);
            }
            Content::Rgb(_) | Content::Light(_, LightContent::Rgb(_)) => {}
        }
    }
}

/// Calls `put` with the index and value of every sample of a line.
fn each(line: LineRef<'_>, kind: SampleType, put: impl FnMut(usize, f32)) {
    each_sample(line, kind, (0, line.location.sample_count), put);
}
