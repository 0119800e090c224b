//! The running means of a tile: accumulated on the device, and copied into the picture.

use crate::layout::bindings::{BATCHES, SCENE_GROUP, SUMS, TILE_GROUP};
use crate::layout::{BATCH_COPIES, Batch, WORKGROUP_SIDE};
use crate::tiles::Tile;
use crate::{DeviceError, Gpu, Pipeline, RenderError, SceneBindings};
use spectra::{KM_LUMENS_PER_WATT, Quantity, SpectralImage};

/// The sizes of a pixel's running means.
#[derive(Clone, Copy)]
pub(crate) struct PixelShape {
    /// Groups of four bands.
    pub(crate) groups: u64,
    pub(crate) light_groups: u64,
}

impl PixelShape {
    /// Returns the lists of running means in the order of the buffer: what a list is for, and its number of sets of four. The means
    /// and colors are of each light group, the deviations of all light.
    fn lists(self) -> [(Quantity, u64); 3] {
        [
            (Quantity::Radiance, self.groups * self.light_groups),
            (Quantity::Variance, self.groups),
            (Quantity::Xyz, self.light_groups),
        ]
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
    fn bytes(&self, tile: Tile) -> u64 {
        self.shape.bytes() * u64::from(tile.pixels())
    }

    pub(crate) fn clear(&self, gpu: &Gpu, tile: Tile) {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.clear_buffer(&self.sums, 0, Some(self.bytes(tile)));
        gpu.queue.submit([encoder.finish()]);
    }

    pub(crate) fn dispatch(
        &self,
        gpu: &Gpu,
        pipeline: &Pipeline,
        tile: Tile,
        (first_sample, sample_count): (u32, u32),
    ) {
        let batch = Batch {
            tile_origin: tile.origin,
            tile_size: tile.size,
            first_sample,
            sample_count,
            passes: 2,
            ..Default::default()
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

    /// Copies the finished tile into the picture.
    pub(crate) fn read_back(
        &self,
        gpu: &Gpu,
        tile: Tile,
        samples: u32,
        image: &mut SpectralImage,
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
            check_count(tile, sums.of(Quantity::Xyz), samples)?;
            store(tile, &sums, samples, image);
        }
        self.staging.unmap();
        Ok(())
    }
}

/// The running means of a tile, list by list.
struct Sums<'a>(Vec<(Quantity, &'a [[f32; 4]])>);

impl<'a> Sums<'a> {
    fn new(shape: PixelShape, tile: Tile, mut rest: &'a [[f32; 4]]) -> Self {
        let lists = shape.lists().into_iter().map(|(quantity, sets)| {
            let own;
            (own, rest) = rest.split_at((sets * u64::from(tile.pixels())) as usize);
            (quantity, own)
        });
        Self(lists.collect())
    }

    /// Returns the list for a quantity.
    fn of(&self, quantity: Quantity) -> &'a [[f32; 4]] {
        let found = self.0.iter().find(|(own, _)| *own == quantity);
        found.map_or(&[], |(_, sums)| sums)
    }
}

/// Checks that all samples of all pixels were taken, by the count beside the colors of the first light group.
fn check_count(tile: Tile, colors: &[[f32; 4]], samples: u32) -> Result<(), RenderError> {
    let counts = colors.iter().take(tile.pixels() as usize);
    match counts.map(|color| color[3]).find(|&n| n != samples as f32) {
        None => Ok(()),
        Some(counted) => Err(RenderError::CutShort {
            counted: counted as u32,
            samples,
        }),
    }
}

/// Reorders a tile from `[light group][group][pixel]` to the picture's `[light group][pixel][band]`.
fn store(tile: Tile, sums: &Sums<'_>, samples: u32, image: &mut SpectralImage) {
    let [means, deviations, colors] =
        [Quantity::Radiance, Quantity::Variance, Quantity::Xyz].map(|quantity| sums.of(quantity));
    let bands = image.bands().count() as usize;
    let light_groups = image.light_groups().len();
    let pixels = tile.pixels() as usize;
    let n = samples as f32;
    let to_variance = if samples > 1 {
        1.0 / (n * (n - 1.0))
    } else {
        0.0
    };
    let to_xyz = (KM_LUMENS_PER_WATT * image.bands().width_nm()) as f32;
    let mut radiance = vec![0.0; light_groups * bands];
    let (mut variance, mut xyz) = (vec![0.0; bands], vec![[0.0; 3]; light_groups]);
    let value = |values: &[[f32; 4]], first: usize, band: usize, pixel: usize| {
        values[(first + band / 4) * pixels + pixel][band % 4]
    };
    for y in 0..tile.size[1] {
        for x in 0..tile.size[0] {
            let pixel = (y * tile.size[0] + x) as usize;
            for (light_group, radiance) in radiance.chunks_exact_mut(bands).enumerate() {
                for (band, radiance) in radiance.iter_mut().enumerate() {
                    *radiance = value(means, light_group * bands.div_ceil(4), band, pixel);
                }
                let [cx, cy, cz, _] = colors[light_group * pixels + pixel];
                xyz[light_group] = [cx * to_xyz, cy * to_xyz, cz * to_xyz];
            }
            for (band, variance) in variance.iter_mut().enumerate() {
                *variance = value(deviations, 0, band, pixel) * to_variance;
            }
            let at = (tile.origin[0] + x, tile.origin[1] + y);
            image.set_pixel_by_light(at, &radiance, &variance, &xyz, samples);
        }
    }
}
