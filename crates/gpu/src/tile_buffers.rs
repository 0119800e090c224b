//! The running means of a tile: accumulated on the device, and exchanged with the host.

use crate::layout::bindings::{BATCHES, SCENE_GROUP, SUMS, TILE_GROUP};
use crate::layout::{BATCH_COPIES, Batch, WORKGROUP_SIDE};
use crate::{DeviceError, Gpu, Pipeline, RenderError, SceneBindings};
use rayon::prelude::*;
use spectra::{Accumulation, LayerKey, Quantity, Stokes, SumLayout, Window};

/// The sizes of a pixel's running means.
#[derive(Clone, Copy)]
pub(crate) struct PixelShape {
    /// Groups of four bands.
    pub(crate) groups: u64,
    pub(crate) light_groups: u64,
    /// Whether S1, S2 and S3 are kept.
    pub(crate) is_polarized: bool,
}

impl PixelShape {
    /// Returns the lists of running means in the order of the buffer: what a list is for, and its number of sets of four. The means
    /// and colors are of each light group, the deviations of all light.
    fn lists(self) -> Vec<(LayerKey, u64)> {
        let means = self.groups * self.light_groups;
        let mut lists = vec![
            (LayerKey::RADIANCE, means),
            (LayerKey::VARIANCE, self.groups),
            (LayerKey::XYZ, self.light_groups),
        ];
        if self.is_polarized {
            let of =
                |key: LayerKey, sets| Stokes::POLARIZED.map(|stokes| (key.component(stokes), sets));
            lists.extend(of(LayerKey::RADIANCE, means));
            lists.extend(of(LayerKey::XYZ, self.light_groups));
        }
        lists
    }

    /// Returns the bytes of all of them.
    pub(crate) fn bytes(self) -> u64 {
        16 * self.lists().iter().map(|(_, sets)| sets).sum::<u64>()
    }
}

/// The running means of one tile.
pub(crate) struct TileBuffers {
    batch: wgpu::Buffer,
    /// Means, deviations, colors, each of all pixels.
    sums: wgpu::Buffer,
    staging: wgpu::Buffer,
    scene_group: wgpu::BindGroup,
    tile_group: wgpu::BindGroup,
    shape: PixelShape,
}

impl TileBuffers {
    pub(crate) fn new(
        gpu: &Gpu,
        (pipeline, scene): (&Pipeline, &SceneBindings),
        pixels: u64,
        shape: PixelShape,
    ) -> Result<Self, DeviceError> {
        let buffer = |label, size, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let batch = buffer(
            "batch",
            u64::from(BATCH_COPIES) * size_of::<Batch>() as u64,
            wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        );
        let size = shape.bytes() * pixels;
        let on_device = wgpu::BufferUsages::STORAGE
            | wgpu::BufferUsages::COPY_SRC
            | wgpu::BufferUsages::COPY_DST;
        let on_host = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        let sums = buffer("sums", size, on_device);
        let staging = buffer("staging", size, on_host);
        let tile_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("tile"),
            layout: &pipeline.compute.get_bind_group_layout(TILE_GROUP),
            entries: &[
                BATCHES.entry(batch.as_entire_binding()),
                SUMS.entry(sums.as_entire_binding()),
            ],
        });
        gpu.check()?;
        Ok(Self {
            batch,
            sums,
            staging,
            scene_group: scene.group(gpu, pipeline),
            tile_group,
            shape,
        })
    }

    /// Returns the bytes of a tile's sums.
    fn bytes(&self, tile: Window) -> u64 {
        self.shape.bytes() * tile.pixels() as u64
    }

    /// Begins a tile: with nothing, or with the samples that its pixels have.
    pub(crate) fn upload(&self, gpu: &Gpu, accumulation: &Accumulation, tile: Window, taken: u32) {
        if taken == 0 {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            encoder.clear_buffer(&self.sums, 0, Some(self.bytes(tile)));
            gpu.queue.submit([encoder.finish()]);
        } else {
            let sums = packed(self.shape, accumulation, tile, taken);
            gpu.queue
                .write_buffer(&self.sums, 0, bytemuck::cast_slice(&sums));
        }
    }

    /// Takes samples: `count` of them from the number `first` on, where the sums hold `taken`.
    pub(crate) fn dispatch(
        &self,
        gpu: &Gpu,
        pipeline: &Pipeline,
        tile: Window,
        (first, count, taken): (u32, u32, u32),
    ) {
        let batch = Batch {
            tile_origin: tile.origin,
            tile_size: tile.size,
            first_sample: first,
            sample_count: count,
            passes: 2,
            taken,
        };
        let batches = [batch; BATCH_COPIES as usize];
        gpu.queue
            .write_buffer(&self.batch, 0, bytemuck::cast_slice(&batches));
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&pipeline.compute);
            pass.set_bind_group(SCENE_GROUP, &self.scene_group, &[]);
            pass.set_bind_group(TILE_GROUP, &self.tile_group, &[]);
            let [x, y] = tile.size.map(|side| side.div_ceil(WORKGROUP_SIDE));
            pass.dispatch_workgroups(x, y, 1);
        }
        gpu.queue.submit([encoder.finish()]);
    }

    /// Copies the sums of a tile to the host. Nothing is changed there if that fails.
    pub(crate) fn read_back(
        &self,
        gpu: &Gpu,
        tile: Window,
        samples: u32,
        accumulation: &mut Accumulation,
    ) -> Result<(), RenderError> {
        let bytes = self.bytes(tile);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(&self.sums, 0, &self.staging, 0, bytes);
        gpu.queue.submit([encoder.finish()]);
        // A failure to map is visible as the device's error or as an unmapped range below.
        let slice = self.staging.slice(..bytes);
        slice.map_async(wgpu::MapMode::Read, |_| {});
        gpu.wait()?;
        {
            let mapped = slice
                .get_mapped_range()
                .map_err(|error| DeviceError::Refused(error.to_string()))?;
            let sums: &[[f32; 4]] = bytemuck::cast_slice(&mapped);
            let sums = Sums::new(self.shape, tile, sums);
            check_count(tile, sums.of(LayerKey::XYZ), samples)?;
            let values = unpacked(&sums, accumulation.layout(), tile);
            accumulation.store(tile, &values, samples);
        }
        self.staging.unmap();
        Ok(())
    }
}

/// The running means of a tile, list by list.
struct Sums<'a>(Vec<(LayerKey, &'a [[f32; 4]])>);

impl<'a> Sums<'a> {
    fn new(shape: PixelShape, tile: Window, mut rest: &'a [[f32; 4]]) -> Self {
        let lists = shape.lists().into_iter().map(|(key, sets)| {
            let own;
            (own, rest) = rest.split_at((sets * tile.pixels() as u64) as usize);
            (key, own)
        });
        Self(lists.collect())
    }

    /// Returns the list for a layer of an image.
    fn of(&self, key: LayerKey) -> &'a [[f32; 4]] {
        let found = self.0.iter().find(|(own, _)| *own == key);
        found.map_or(&[], |(_, sums)| sums)
    }
}

/// Checks that all samples of all pixels were taken, by the count beside the colors of the first light group.
fn check_count(tile: Window, colors: &[[f32; 4]], samples: u32) -> Result<(), RenderError> {
    let counts = colors.iter().take(tile.pixels());
    match counts.map(|color| color[3]).find(|&n| n != samples as f32) {
        None => Ok(()),
        Some(counted) => Err(RenderError::CutShort {
            counted: counted as u32,
            samples,
        }),
    }
}

/// Reorders the sums of a tile from `[list][set of four][pixel]` to `[pixel][value]`.
fn unpacked(sums: &Sums<'_>, layout: SumLayout, tile: Window) -> Vec<f64> {
    let (pixels, bands) = (tile.pixels(), layout.mean().len());
    let light_groups = sums.of(LayerKey::XYZ).len() / pixels;
    let deviations = sums.of(LayerKey::VARIANCE);
    // The means and colors of S0 and, where they are kept, of the other components.
    let components = Stokes::ALL.map(|stokes| {
        let of = |key: LayerKey| sums.of(key.component(stokes));
        (stokes, of(LayerKey::RADIANCE), of(LayerKey::XYZ))
    });
    let read = |to: &mut [f64], from: &[[f32; 4]], first: usize, pixel: usize| {
        for (band, to) in to.iter_mut().enumerate() {
            *to = f64::from(from[(first + band / 4) * pixels + pixel][band % 4]);
        }
    };
    let mut all = vec![0.0; pixels * layout.len()];
    let each = all.par_chunks_exact_mut(layout.len()).enumerate();
    each.with_min_len(1024).for_each(|(pixel, own)| {
        for (stokes, means, colors) in components {
            if means.is_empty() {
                continue;
            }
            for group in 0..light_groups {
                let first = group * bands.div_ceil(4);
                read(
                    &mut own[layout.component(group, stokes)],
                    means,
                    first,
                    pixel,
                );
                read(
                    &mut own[layout.component_xyz(group, stokes)],
                    colors,
                    group,
                    pixel,
                );
            }
        }
        read(&mut own[layout.deviation()], deviations, 0, pixel);
        if light_groups > 1 {
            // The device keeps no mean of the total.
            for group in 0..light_groups {
                for (band, place) in layout.group_mean(group).enumerate() {
                    own[layout.mean().start + band] += own[place];
                }
            }
        }
    });
    all
}

/// The inverse of [`unpacked`]. A color has the number of samples beside it.
fn packed(
    shape: PixelShape,
    accumulation: &Accumulation,
    tile: Window,
    taken: u32,
) -> Vec<[f32; 4]> {
    let layout = accumulation.layout();
    let indices: Vec<usize> = accumulation.row_indices(tile).flatten().collect();
    let mut sets = Vec::new();
    let four = |values: &[f64], group: usize| {
        let value = |i: usize| values.get(4 * group + i).map_or(0.0, |&value| value as f32);
        std::array::from_fn(value)
    };
    let push = |sets: &mut Vec<[f32; 4]>, range: std::ops::Range<usize>, group: usize| {
        let of_pixel = |&index: &usize| four(&accumulation.pixel(index)[range.clone()], group);
        sets.par_extend(indices.par_iter().with_min_len(1024).map(of_pixel));
    };
    let (groups, light_groups) = (shape.groups as usize, shape.light_groups as usize);
    let mut count_place = 0;
    for (key, _) in shape.lists() {
        let of_group = |group| match key.quantity {
            Quantity::Xyz => (layout.component_xyz(group, key.stokes), 1),
            Quantity::Variance => (layout.deviation(), groups),
            _ => (layout.component(group, key.stokes), groups),
        };
        let times = match key.quantity {
            Quantity::Variance => 1,
            _ => light_groups,
        };
        for (range, count) in (0..times).map(of_group) {
            for set in 0..count {
                if key == LayerKey::XYZ && range == layout.xyz(0) {
                    count_place = sets.len();
                }
                push(&mut sets, range.clone(), set);
            }
        }
    }
    // The first light group's colors have the count: the others have 0 there.
    for color in &mut sets[count_place..count_place + indices.len()] {
        color[3] = taken as f32;
    }
    sets
}
