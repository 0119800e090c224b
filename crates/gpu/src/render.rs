//! Running a scene on a device and reading the picture back.

use crate::layout::{self, Batch, Field, NUMBERS_WIDTH, TEXELS_WIDTH, WORKGROUP_SIDE};
use crate::modules::Shader;
use crate::pipelines::compile;
use crate::tiles::{Division, Planner, Tile};
use crate::{DeviceError, Gpu, PackedScene};
use scene::Scene;
use spectra::{KM_LUMENS_PER_WATT, SpectralImage};
use std::ops::ControlFlow;
use std::time::Instant;
use thiserror::Error;
use wgpu::util::DeviceExt;

/// The most thicknesses that a path remembers: 16 KiB of an invocation's own memory.
const MAX_THICKNESSES: u32 = 4096;

/// Why a render did not come to its end.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The scene does not fit into what the device binds at once.
    #[error(
        "the scene's {what} take {bytes} bytes, but this adapter binds at most {limit} at once; {advice}"
    )]
    TooLarge {
        /// What is too large.
        what: &'static str,
        /// How large it is.
        bytes: u64,
        /// How large it may be.
        limit: u64,
        /// What to do.
        advice: &'static str,
    },
    /// The record of a path would be longer than an invocation can hold.
    #[error(
        "a path would have to remember {thicknesses} thicknesses of layers, but at most {MAX_THICKNESSES} are possible; \
         let fewer layers of a stack vary over its surface, use fewer films, or set a smaller render.max_path_segments"
    )]
    RecordTooLong {
        /// How many.
        thicknesses: u32,
    },
    /// The driver ended the shader's loops before their end.
    #[error(
        "the driver ended the shader's loops too early: {counted} of {samples} samples of a pixel can be trusted; use fewer objects, \
         layers or bands, set a smaller render.max_path_segments, or render on another adapter or on the CPU"
    )]
    CutShort {
        /// How many samples were whole.
        counted: u32,
        /// How many were asked for.
        samples: u32,
    },
    /// The caller asked to stop.
    #[error("stopped before the picture was finished")]
    Stopped,
}

/// Renders a scene.
///
/// `on_progress` is told the samples taken so far (of width × height × samples per pixel) after each
/// batch, and may stop the render.
///
/// The same scene on the same adapter and driver gives the same bits, however the work was divided.
///
/// # Errors
/// When the scene is too large for the device, the device fails, or the caller stops the render.
pub fn render(
    gpu: &Gpu,
    scene: &Scene,
    on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
) -> Result<SpectralImage, RenderError> {
    render_divided(gpu, scene, None, on_progress)
}

/// Like [`render`], with the division of the work given: for tests.
///
/// # Errors
/// As [`render`].
pub fn render_divided(
    gpu: &Gpu,
    scene: &Scene,
    division: Option<Division>,
    on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
) -> Result<SpectralImage, RenderError> {
    let settings = scene.settings();
    let packed = PackedScene::new(scene);
    let thicknesses = packed.limits.thicknesses;
    if thicknesses > MAX_THICKNESSES {
        return Err(RenderError::RecordTooLong { thicknesses });
    }
    let bindings = bind_scene(gpu, &packed)?;
    let shader = Shader::assemble(&["render"], packed.limits, "");
    let pipeline = compile(gpu, &shader, "render", packed.features.constants())?;

    let shape = PixelShape {
        groups: u64::from(settings.bands.count().div_ceil(4)),
        light_groups: u64::from(packed.limits.light_groups),
    };
    let limits = gpu.limits();
    let largest = limits
        .max_storage_buffer_binding_size
        .min(limits.max_buffer_size);
    let size = [settings.width, settings.height];
    let mut planner = Planner::new(
        size,
        (shape.bytes()[0], largest),
        packed.passes_per_sample,
        division,
    );
    let tile_buffers = TileBuffers::new(gpu, &pipeline, u64::from(planner.max_pixels()), shape)?;

    let light_groups = scene.light_groups().to_vec();
    let mut image = SpectralImage::with_light_groups(
        settings.width,
        settings.height,
        settings.bands,
        light_groups,
    );
    let mut done = 0;
    while let Some(tile) = planner.next_tile() {
        tile_buffers.clear(gpu, tile);
        let mut taken = 0;
        while taken < settings.samples {
            let samples = planner.batch(tile, settings.samples - taken);
            let started = Instant::now();
            tile_buffers.dispatch(gpu, (&pipeline, &bindings), tile, (taken, samples));
            gpu.wait()?;
            planner.learn(tile, samples, started.elapsed());
            taken += samples;
            done += u64::from(samples) * u64::from(tile.pixels());
            if on_progress(done).is_break() {
                return Err(RenderError::Stopped);
            }
        }
        tile_buffers.read_back(gpu, tile, settings.samples, &mut image)?;
    }
    Ok(image)
}

/// A scene in the device's memory.
#[derive(Debug)]
pub struct SceneBindings {
    buffers: [wgpu::Buffer; 6],
    /// Numbers and texels.
    textures: [wgpu::TextureView; 2],
}

impl SceneBindings {
    /// The bind group 0 of a pipeline that uses the bindings in `used` (0: frame, 1: objects, 2: materials, 3: layers, 4: spectra,
    /// 5: fields, 6: numbers, 7: texels).
    pub fn group(
        &self,
        gpu: &Gpu,
        pipeline: &wgpu::ComputePipeline,
        used: &[u32],
    ) -> wgpu::BindGroup {
        let entries: Vec<_> = used
            .iter()
            .map(|&binding| wgpu::BindGroupEntry {
                binding,
                resource: if let Some(buffer) = self.buffers.get(binding as usize) {
                    buffer.as_entire_binding()
                } else {
                    let texture = binding as usize - self.buffers.len();
                    wgpu::BindingResource::TextureView(&self.textures[texture])
                },
            })
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        })
    }
}

/// Uploads a scene.
///
/// # Errors
/// When a part of it is larger than what the device binds at once, or the device fails.
pub fn bind_scene(gpu: &Gpu, packed: &PackedScene) -> Result<SceneBindings, RenderError> {
    let limit = gpu.limits().max_storage_buffer_binding_size;
    let storage = |what, bytes: &[u8], stride: usize, advice| {
        if bytes.len() as u64 > limit {
            let bytes = bytes.len() as u64;
            return Err(RenderError::TooLarge {
                what,
                bytes,
                limit,
                advice,
            });
        }
        // A binding may not be empty: a list without elements has one that nothing reads.
        let padding = vec![0; stride];
        Ok(gpu
            .device
            .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(what),
                contents: if bytes.is_empty() { &padding } else { bytes },
                usage: wgpu::BufferUsages::STORAGE,
            }))
    };
    let frame = gpu
        .device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("frame"),
            contents: bytemuck::bytes_of(&packed.frame),
            usage: wgpu::BufferUsages::UNIFORM,
        });
    let fewer = "use fewer of them";
    let buffers = [
        frame,
        storage(
            "objects",
            bytemuck::cast_slice(&packed.objects),
            size_of::<layout::Object>(),
            fewer,
        )?,
        storage(
            "materials",
            bytemuck::cast_slice(&packed.materials),
            size_of::<layout::Material>(),
            fewer,
        )?,
        storage(
            "layers",
            bytemuck::cast_slice(&packed.layers),
            size_of::<layout::Layer>(),
            fewer,
        )?,
        storage(
            "spectra",
            bytemuck::cast_slice(&packed.spectra),
            16,
            "use fewer materials and lights",
        )?,
        storage(
            "thickness fields",
            bytemuck::cast_slice(&packed.fields),
            size_of::<Field>(),
            fewer,
        )?,
    ];
    let numbers = Table {
        what: "tables of numbers",
        format: wgpu::TextureFormat::R32Float,
        width: NUMBERS_WIDTH,
        bytes: bytemuck::cast_slice(&packed.numbers),
    };
    let texels = Table {
        what: "pictures of colours",
        format: wgpu::TextureFormat::Rgba32Float,
        width: TEXELS_WIDTH,
        bytes: bytemuck::cast_slice(&packed.texels),
    };
    let textures = [numbers.upload(gpu)?, texels.upload(gpu)?];
    gpu.check()?;
    Ok(SceneBindings { buffers, textures })
}

/// A list as a texture, row by row: storage buffers are few.
struct Table<'a> {
    what: &'static str,
    format: wgpu::TextureFormat,
    /// Elements of a row.
    width: u32,
    bytes: &'a [u8],
}

impl Table<'_> {
    fn upload(&self, gpu: &Gpu) -> Result<wgpu::TextureView, RenderError> {
        let size = self.format.block_copy_size(None).unwrap_or(16);
        let count = self.bytes.len() as u64 / u64::from(size);
        let rows = count.div_ceil(u64::from(self.width)).max(1);
        let most = u64::from(gpu.limits().max_texture_dimension_2d);
        if rows > most {
            return Err(RenderError::TooLarge {
                what: self.what,
                bytes: self.bytes.len() as u64,
                limit: most * u64::from(self.width * size),
                advice: "use fewer or smaller pictures",
            });
        }
        let extent = wgpu::Extent3d {
            width: (count as u32).clamp(1, self.width),
            height: rows as u32,
            depth_or_array_layers: 1,
        };
        let mut contents = self.bytes.to_vec();
        contents.resize((extent.width * extent.height * size) as usize, 0);
        let texture = gpu.device.create_texture_with_data(
            &gpu.queue,
            &wgpu::TextureDescriptor {
                label: Some(self.what),
                size: extent,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: self.format,
                usage: wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            },
            wgpu::util::TextureDataOrder::default(),
            &contents,
        );
        Ok(texture.create_view(&wgpu::TextureViewDescriptor::default()))
    }
}

/// What a pixel has of running means.
#[derive(Clone, Copy)]
struct PixelShape {
    /// Groups of four bands.
    groups: u64,
    light_groups: u64,
}

impl PixelShape {
    /// Bytes of means, deviations and colours. The means are the most.
    fn bytes(self) -> [u64; 3] {
        [
            self.groups * self.light_groups,
            self.groups,
            self.light_groups,
        ]
        .map(|count| 16 * count)
    }
}

/// The running means of one tile.
struct TileBuffers {
    batch: wgpu::Buffer,
    /// Means, deviations, colours.
    sums: [wgpu::Buffer; 3],
    staging: [wgpu::Buffer; 3],
    bind_group: wgpu::BindGroup,
    shape: PixelShape,
}

impl TileBuffers {
    fn new(
        gpu: &Gpu,
        pipeline: &wgpu::ComputePipeline,
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
            2 * size_of::<Batch>() as u64,
            wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        );
        let sizes = shape.bytes().map(|bytes| bytes * pixels);
        let on_device = wgpu::BufferUsages::STORAGE
            | wgpu::BufferUsages::COPY_SRC
            | wgpu::BufferUsages::COPY_DST;
        let on_host = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        let sums = sizes.map(|size| buffer("sums", size, on_device));
        let staging = sizes.map(|size| buffer("staging", size, on_host));
        let entries: Vec<_> = std::iter::once(&batch)
            .chain(&sums)
            .zip(0..)
            .map(|(buffer, binding)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("tile"),
            layout: &pipeline.get_bind_group_layout(1),
            entries: &entries,
        });
        gpu.check()?;
        Ok(Self {
            batch,
            sums,
            staging,
            bind_group,
            shape,
        })
    }

    /// Bytes of means, deviations and colours of a tile.
    fn bytes(&self, tile: Tile) -> [u64; 3] {
        self.shape
            .bytes()
            .map(|bytes| bytes * u64::from(tile.pixels()))
    }

    fn clear(&self, gpu: &Gpu, tile: Tile) {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for (buffer, bytes) in self.sums.iter().zip(self.bytes(tile)) {
            encoder.clear_buffer(buffer, 0, Some(bytes));
        }
        gpu.queue.submit([encoder.finish()]);
    }

    fn dispatch(
        &self,
        gpu: &Gpu,
        (pipeline, scene): (&wgpu::ComputePipeline, &SceneBindings),
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
        gpu.queue
            .write_buffer(&self.batch, 0, bytemuck::cast_slice(&[batch; 2]));
        let scene = scene.group(gpu, pipeline, &[0, 1, 2, 3, 4, 5, 6, 7]);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &scene, &[]);
            pass.set_bind_group(1, &self.bind_group, &[]);
            let [x, y] = tile.size.map(|side| side.div_ceil(WORKGROUP_SIDE));
            pass.dispatch_workgroups(x, y, 1);
        }
        gpu.queue.submit([encoder.finish()]);
    }

    /// Copies the finished tile into the picture.
    fn read_back(
        &self,
        gpu: &Gpu,
        tile: Tile,
        samples: u32,
        image: &mut SpectralImage,
    ) -> Result<(), RenderError> {
        let bytes = self.bytes(tile);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for ((from, to), bytes) in self.sums.iter().zip(&self.staging).zip(bytes) {
            encoder.copy_buffer_to_buffer(from, 0, to, 0, bytes);
        }
        gpu.queue.submit([encoder.finish()]);
        for (buffer, bytes) in self.staging.iter().zip(bytes) {
            // A failure to map shows as the device's error or as an unmapped range below.
            buffer.slice(..bytes).map_async(wgpu::MapMode::Read, |_| {});
        }
        gpu.wait()?;
        let mapped = |index: usize| {
            self.staging[index]
                .slice(..bytes[index])
                .get_mapped_range()
                .map_err(|error| DeviceError::Refused(error.to_string()))
        };
        {
            let (means, deviations, colors) = (mapped(0)?, mapped(1)?, mapped(2)?);
            check_count(tile, bytemuck::cast_slice(&colors), samples)?;
            store(
                tile,
                (
                    bytemuck::cast_slice(&means),
                    bytemuck::cast_slice(&deviations),
                ),
                bytemuck::cast_slice(&colors),
                samples,
                image,
            );
        }
        self.staging.iter().for_each(wgpu::Buffer::unmap);
        Ok(())
    }
}

/// Whether all samples of all pixels were taken, by the count that stands beside the first light group's colours.
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
fn store(
    tile: Tile,
    (means, deviations): (&[[f32; 4]], &[[f32; 4]]),
    colors: &[[f32; 4]],
    samples: u32,
    image: &mut SpectralImage,
) {
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
