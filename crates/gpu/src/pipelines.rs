//! Making pipelines of shaders, and keeping the last ones.

use crate::modules::Shader;
use crate::{DeviceError, Gpu};
use std::borrow::Cow;
use std::collections::VecDeque;
use std::sync::{MutexGuard, PoisonError};

/// How many pipelines are kept.
const KEPT: usize = 8;

/// A shader on a device.
#[derive(Clone, Debug)]
pub struct Pipeline {
    /// The pipeline, with a layout deduced from the shader.
    pub(crate) compute: wgpu::ComputePipeline,
    /// The numbers of the bindings in group 0 that it reads.
    pub(crate) bindings: Vec<u32>,
}

impl Pipeline {
    /// The pipeline itself, for tests that run shaders of their own.
    pub fn compute(&self) -> &wgpu::ComputePipeline {
        &self.compute
    }
}

/// What a pipeline is made of.
#[derive(Debug, PartialEq)]
struct Key {
    text: String,
    entry_point: String,
}

/// The pipelines of a device that were made or used last, the latest at the end.
#[derive(Debug, Default)]
pub(crate) struct RecentPipelines(VecDeque<(Key, Pipeline)>);

impl RecentPipelines {
    fn find(&mut self, key: &Key) -> Option<Pipeline> {
        let place = self.0.iter().position(|(known, _)| known == key)?;
        let found = self.0.remove(place)?;
        let pipeline = found.1.clone();
        self.0.push_back(found);
        Some(pipeline)
    }

    fn keep(&mut self, key: Key, pipeline: Pipeline) {
        self.0.push_back((key, pipeline));
        if self.0.len() > KEPT {
            self.0.pop_front();
        }
    }
}

/// Compiles a shader and makes a pipeline of one of its entry points and what that reaches. The last few are kept: the pictures of a
/// sequence are rendered by the same.
///
/// # Errors
/// When the shader or the pipeline is refused; the message names the module's own file and line.
pub fn compile(gpu: &Gpu, shader: &Shader, entry_point: &str) -> Result<Pipeline, DeviceError> {
    let key = Key {
        text: shader.text().to_owned(),
        entry_point: entry_point.to_owned(),
    };
    if let Some(pipeline) = recent(gpu).find(&key) {
        return Ok(pipeline);
    }
    let pipeline = compile_anew(gpu, shader, entry_point)?;
    recent(gpu).keep(key, pipeline.clone());
    Ok(pipeline)
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
            cache: None,
        });
    gpu.check()?;
    Ok(Pipeline { compute, bindings })
}

/// The bindings of group 0.
fn bindings_of(module: &naga::Module) -> Vec<u32> {
    let variables = module.global_variables.iter();
    let bindings = variables.filter_map(|(_, variable)| variable.binding);
    let scene = bindings.filter(|binding| binding.group == 0);
    scene.map(|binding| binding.binding).collect()
}
