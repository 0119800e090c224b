//! A scene's buffers and textures on the device.

use crate::layout::{self, Field, NUMBERS_WIDTH, TEXELS_WIDTH};
use crate::{Gpu, PackedScene, RenderError};
use wgpu::util::DeviceExt;

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
