//! A scene's buffers and textures on the device.

use crate::layout::{self, NUMBERS_WIDTH, TEXELS_WIDTH};
use crate::modules::Specialization;
use crate::pipelines::Pipeline;
use crate::{Gpu, PackedScene, RenderError};
use wgpu::util::DeviceExt;

/// A list of a scene, as `shaders/bindings.wgsl` declares it.
struct List<'a> {
    /// Its variable.
    name: &'static str,
    /// What to call it.
    what: &'static str,
    bytes: &'a [u8],
    /// Bytes of an element.
    stride: usize,
    /// What to do where there are too many.
    advice: &'static str,
}

impl PackedScene {
    /// The lists that stand in buffers, in the order of their bindings, from 1 on.
    fn lists(&self) -> [List<'_>; 4] {
        fn list<'a, T: bytemuck::Pod>(
            [name, what]: [&'static str; 2],
            elements: &'a [T],
            advice: &'static str,
        ) -> List<'a> {
            List {
                name,
                what,
                bytes: bytemuck::cast_slice(elements),
                stride: size_of::<T>(),
                advice,
            }
        }
        let fewer = "use fewer of them";
        [
            list(["shapes", "objects"], &self.shapes, fewer),
            list(["emitters", "lights"], &self.emitters, fewer),
            list(
                ["records", "materials"],
                &self.records,
                "use fewer of them, of fewer layers",
            ),
            list(
                ["spectra", "spectra"],
                &self.spectra,
                "use fewer materials and lights",
            ),
        ]
    }

    /// What a shader for this scene is made for, on a device that has small tables in uniform buffers or not
    /// ([`Gpu::prefers_uniform_tables`]).
    pub fn specialization(&self, prefers_uniform: bool) -> Specialization {
        let lists = self.lists();
        let uniform = lists.iter().filter(|list| list.is_uniform(prefers_uniform));
        Specialization {
            limits: self.limits,
            features: self.features.clone(),
            uniform_tables: uniform.map(|list| list.name).collect(),
        }
    }
}

/// Bytes of a list in a uniform buffer: what every device binds. Shaders do not depend on how much of it is used.
const UNIFORM_BYTES: usize = 65_536;

/// A line of `shaders/bindings.wgsl` that declares one of the `uniform` lists, in its uniform form; none of another line.
pub(crate) fn uniform_table(line: &str, uniform: &[&str]) -> Option<String> {
    let (place, declared) = line.split_once("var<storage, read> ")?;
    let (name, element) = declared.split_once(": array<")?;
    let element = element.strip_suffix(">;")?;
    uniform.contains(&name).then(|| {
        let count = UNIFORM_BYTES / stride_of(element);
        format!("{place}var<uniform> {name}: array<{element}, {count}>;")
    })
}

/// Bytes of an element of a list, by its type in WGSL.
fn stride_of(element: &str) -> usize {
    match element {
        "Shape" => size_of::<layout::Shape>(),
        "Emitter" => size_of::<layout::Emitter>(),
        _ => 16,
    }
}

/// A scene in the device's memory.
#[derive(Debug)]
pub struct SceneBindings {
    /// The frame and the lists.
    buffers: Vec<wgpu::Buffer>,
    /// Numbers and texels.
    textures: [wgpu::TextureView; 2],
}

impl SceneBindings {
    /// The bind group 0 of a pipeline.
    pub fn group(&self, gpu: &Gpu, pipeline: &Pipeline) -> wgpu::BindGroup {
        let entries: Vec<_> = pipeline
            .bindings
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
            layout: &pipeline.compute.get_bind_group_layout(0),
            entries: &entries,
        })
    }
}

/// Uploads a scene.
///
/// # Errors
/// When a part of it is larger than what the device binds at once, or the device fails.
pub fn bind_scene(gpu: &Gpu, packed: &PackedScene) -> Result<SceneBindings, RenderError> {
    let frame = gpu
        .device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("frame"),
            contents: bytemuck::bytes_of(&packed.frame),
            usage: wgpu::BufferUsages::UNIFORM,
        });
    let mut buffers = vec![frame];
    for list in packed.lists() {
        buffers.push(list.upload(gpu)?);
    }
    let numbers = Table {
        what: "tables of numbers",
        format: wgpu::TextureFormat::R32Float,
        width: NUMBERS_WIDTH,
        bytes: bytemuck::cast_slice(&packed.numbers),
    };
    let texels = Table {
        what: "pictures of colors",
        format: wgpu::TextureFormat::Rgba32Float,
        width: TEXELS_WIDTH,
        bytes: bytemuck::cast_slice(&packed.texels),
    };
    let textures = [numbers.upload(gpu)?, texels.upload(gpu)?];
    gpu.check()?;
    Ok(SceneBindings { buffers, textures })
}

impl List<'_> {
    /// Whether it stands in a uniform buffer.
    fn is_uniform(&self, prefers_uniform: bool) -> bool {
        prefers_uniform && self.bytes.len() <= UNIFORM_BYTES
    }

    fn upload(&self, gpu: &Gpu) -> Result<wgpu::Buffer, RenderError> {
        let limit = gpu.limits().max_storage_buffer_binding_size;
        if self.bytes.len() as u64 > limit {
            return Err(RenderError::TooLarge {
                what: self.what,
                bytes: self.bytes.len() as u64,
                limit,
                advice: self.advice,
            });
        }
        let (usage, least) = if self.is_uniform(gpu.prefers_uniform_tables()) {
            (wgpu::BufferUsages::UNIFORM, UNIFORM_BYTES)
        } else {
            // A binding may not be empty: a list without elements has one that nothing reads.
            (wgpu::BufferUsages::STORAGE, self.stride)
        };
        let mut contents = self.bytes.to_vec();
        contents.resize(contents.len().max(least), 0);
        Ok(gpu
            .device
            .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(self.what),
                contents: &contents,
                usage,
            }))
    }
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
