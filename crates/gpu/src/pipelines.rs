//! Making pipelines of shaders, and keeping the last ones.

use crate::modules::Shader;
use crate::{DeviceError, Gpu};
use std::collections::VecDeque;
use std::sync::{MutexGuard, PoisonError};

/// How many pipelines are kept.
const KEPT: usize = 8;

/// What a pipeline is made of.
#[derive(Debug, PartialEq)]
struct Key {
    text: String,
    entry_point: String,
    constants: Vec<(String, f64)>,
}

/// The pipelines of a device that were made or used last, the latest at the end.
#[derive(Debug, Default)]
pub(crate) struct RecentPipelines(VecDeque<(Key, wgpu::ComputePipeline)>);

impl RecentPipelines {
    fn find(&mut self, key: &Key) -> Option<wgpu::ComputePipeline> {
        let place = self.0.iter().position(|(known, _)| known == key)?;
        let found = self.0.remove(place)?;
        let pipeline = found.1.clone();
        self.0.push_back(found);
        Some(pipeline)
    }

    fn keep(&mut self, key: Key, pipeline: wgpu::ComputePipeline) {
        self.0.push_back((key, pipeline));
        if self.0.len() > KEPT {
            self.0.pop_front();
        }
    }
}

/// Compiles a shader and makes a pipeline of one of its entry points, with a layout deduced from the shader and the
/// overridable `constants` as given. The last few are kept: the pictures of a sequence are rendered by the same.
///
/// # Errors
/// When the shader or the pipeline is refused; the message names the module's own file and line.
pub fn compile(
    gpu: &Gpu,
    shader: &Shader,
    entry_point: &str,
    constants: &[(&str, f64)],
) -> Result<wgpu::ComputePipeline, DeviceError> {
    let key = Key {
        text: shader.text().to_owned(),
        entry_point: entry_point.to_owned(),
        constants: constants
            .iter()
            .map(|&(name, value)| (name.to_owned(), value))
            .collect(),
    };
    if let Some(pipeline) = recent(gpu).find(&key) {
        return Ok(pipeline);
    }
    let pipeline = compile_anew(gpu, shader, entry_point, constants)?;
    recent(gpu).keep(key, pipeline.clone());
    Ok(pipeline)
}

fn recent(gpu: &Gpu) -> MutexGuard<'_, RecentPipelines> {
    gpu.pipelines.lock().unwrap_or_else(PoisonError::into_inner)
}

fn compile_anew(
    gpu: &Gpu,
    shader: &Shader,
    entry_point: &str,
    constants: &[(&str, f64)],
) -> Result<wgpu::ComputePipeline, DeviceError> {
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(entry_point),
            source: wgpu::ShaderSource::Wgsl(shader.text().into()),
        });
    let info = pollster::block_on(module.get_compilation_info());
    let mistakes: Vec<String> = info
        .messages
        .iter()
        .filter(|message| message.message_type == wgpu::CompilationMessageType::Error)
        .map(|message| match message.location {
            Some(at) => {
                let (file, line) = shader.origin_of_line(at.line_number as usize);
                format!("{file}:{line}:{}: {}", at.line_position, message.message)
            }
            None => message.message.clone(),
        })
        .collect();
    if !mistakes.is_empty() {
        // The same mistake was also reported to the device; this report is the better one.
        let _ = gpu.check();
        return Err(DeviceError::Refused(mistakes.join("\n")));
    }
    let pipeline = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry_point),
            layout: None,
            module: &module,
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants,
                ..Default::default()
            },
            cache: None,
        });
    gpu.check()?;
    Ok(pipeline)
}
