//! A scene's buffers and textures on the device.

use crate::layout::bindings::{Binding, FRAME, NUMBERS, SCENE_GROUP, TEXELS};
use crate::layout::list_form::{ListForm, UNIFORM_BYTES};
use crate::layout::{LIST_WIDTH, NUMBERS_WIDTH, TEXELS_WIDTH};
use crate::lists::List;
use crate::recent_pipelines::Pipeline;
use crate::{Gpu, PackedScene, RenderError};
use wgpu::util::DeviceExt;

/// A scene in the device's memory: its bindings, each with its resource.
#[derive(Debug)]
pub struct SceneBindings(Vec<(Binding, Resource)>);

#[derive(Debug)]
enum Resource {
    Buffer(wgpu::Buffer),
    Texture(wgpu::TextureView),
}

impl Resource {
    fn binding(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Buffer(buffer) => buffer.as_entire_binding(),
            Self::Texture(view) => wgpu::BindingResource::TextureView(view),
        }
    }
}

impl SceneBindings {
    /// Returns the bind group of the scene's data, as far as a pipeline reads them.
    pub fn group(&self, gpu: &Gpu, pipeline: &Pipeline) -> wgpu::BindGroup {
        let used = self.0.iter();
        let used = used.filter(|(binding, _)| pipeline.bindings.contains(&binding.number));
        let entries: Vec<_> = used
            .map(|(binding, resource)| binding.entry(resource.binding()))
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene"),
            layout: &pipeline.compute.get_bind_group_layout(SCENE_GROUP),
            entries: &entries,
        })
    }
}

/// Uploads a scene.
///
/// # Errors
/// When a part of it is larger than the device can bind at once, or the device fails.
pub fn bind_scene(gpu: &Gpu, packed: &PackedScene) -> Result<SceneBindings, RenderError> {
    let frame = bytemuck::bytes_of(&packed.frame);
    let frame = buffer(gpu, "frame", frame, wgpu::BufferUsages::UNIFORM);
    let mut resources = vec![(FRAME, Resource::Buffer(frame))];
    for list in packed.lists() {
        resources.push((list.binding, list.upload(gpu)?));
    }
    let numbers = Table {
        what: "tables of numbers",
        format: wgpu::TextureFormat::R32Float,
        width: NUMBERS_WIDTH,
        bytes: bytemuck::cast_slice(&packed.numbers),
        advice: "use fewer or smaller pictures",
    };
    let texels = Table {
        what: "pictures of colors",
        format: wgpu::TextureFormat::Rgba32Float,
        width: TEXELS_WIDTH,
        bytes: bytemuck::cast_slice(&packed.texels),
        advice: "use fewer or smaller pictures",
    };
    for (binding, table) in [(NUMBERS, numbers), (TEXELS, texels)] {
        resources.push((binding, Resource::Texture(table.upload(gpu)?)));
    }
    gpu.check()?;
    Ok(SceneBindings(resources))
}

fn buffer(gpu: &Gpu, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents,
            usage,
        })
}

impl List<'_> {
    fn upload(&self, gpu: &Gpu) -> Result<Resource, RenderError> {
        // The limit of storage buffers also serves for the other forms.
        let limit = gpu.limits().max_storage_buffer_binding_size;
        if self.bytes.len() as u64 > limit {
            return Err(RenderError::TooLarge {
                what: self.what,
                bytes: self.bytes.len() as u64,
                limit,
                advice: self.advice,
            });
        }
        let filled = |least: usize| {
            let mut contents = self.bytes.to_vec();
            contents.resize(contents.len().max(least), 0);
            contents
        };
        let uniform = wgpu::BufferUsages::UNIFORM;
        Ok(match self.form(gpu.is_software()) {
            ListForm::Uniform => {
                Resource::Buffer(buffer(gpu, self.what, &filled(UNIFORM_BYTES), uniform))
            }
            // A binding may not be empty: a list without rows gets a row that nothing reads.
            ListForm::Storage => {
                let storage = wgpu::BufferUsages::STORAGE;
                Resource::Buffer(buffer(gpu, self.what, &filled(16), storage))
            }
            ListForm::Texture => {
                let table = Table {
                    what: self.what,
                    format: self.texture_format(),
                    width: LIST_WIDTH,
                    bytes: self.bytes,
                    advice: self.advice,
                };
                Resource::Texture(table.upload(gpu)?)
            }
        })
    }
}

/// The contents of a texture, row by row.
struct Table<'a> {
    what: &'static str,
    format: wgpu::TextureFormat,
    /// Number of elements of a row.
    width: u32,
    bytes: &'a [u8],
    /// Advice for when the table is too large.
    advice: &'static str,
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
                advice: self.advice,
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
