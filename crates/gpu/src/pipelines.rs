//! Compiles shaders into pipelines.

use crate::Gpu;
use crate::device_error::DeviceError;
use crate::layout::bindings::SCENE_GROUP;
use crate::modules::Shader;
use crate::recent_pipelines::{Key, Pipeline, RecentPipelines};
use std::borrow::Cow;
use std::sync::{MutexGuard, PoisonError};

/// Compiles a shader into a pipeline for one of its entry points and everything that it reaches. The last few pipelines are kept,
/// because the pictures of a sequence use the same one.
///
/// # Errors
/// When the shader or the pipeline is rejected; the message names the module's own file and line.
pub fn compile(gpu: &Gpu, shader: &Shader, entry_point: &str) -> Result<Pipeline, DeviceError> {
    let key = Key::new(shader, entry_point);
    if let Some(pipeline) = recent(gpu).find(&key) {
        return Ok(pipeline);
    }
    let pipeline = compile_anew(gpu, shader, entry_point)?;
    recent(gpu).keep(key, pipeline.clone());
    Ok(pipeline)
}

/// Whether [`compile`] would return a pipeline that was kept.
pub(crate) fn is_kept(gpu: &Gpu, shader: &Shader, entry_point: &str) -> bool {
    let key = Key::new(shader, entry_point);
    recent(gpu).has(&key)
}

fn recent(gpu: &Gpu) -> MutexGuard<'_, RecentPipelines> {
    gpu.pipelines.lock().unwrap_or_else(PoisonError::into_inner)
}

fn compile_anew(gpu: &Gpu, shader: &Shader, entry_point: &str) -> Result<Pipeline, DeviceError> {
    let module = shader.specialized(entry_point)?;
    let bindings = bindings_of(&module);
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(entry_point),
            source: wgpu::ShaderSource::Naga(Cow::Owned(module)),
        });
    let compute = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry_point),
            layout: None,
            module: &module,
            entry_point: Some(entry_point),
            compilation_options: Default::default(),
            cache: gpu.driver_cache.as_ref().map(|kept| &kept.cache),
        });
    gpu.check()?;
    if let Some(kept) = &gpu.driver_cache {
        kept.save_now_and_then();
    }
    Ok(Pipeline { compute, bindings })
}

/// Returns the bindings of the group of a scene's data.
fn bindings_of(module: &naga::Module) -> Vec<u32> {
    let variables = module.global_variables.iter();
    let bindings = variables.filter_map(|(_, variable)| variable.binding);
    let scene = bindings.filter(|binding| binding.group == SCENE_GROUP);
    scene.map(|binding| binding.binding).collect()
}
