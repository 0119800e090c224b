//! The most recently used pipelines of a device.

use crate::modules::Shader;
use std::collections::VecDeque;

/// Number of pipelines that are kept.
const KEPT: usize = 8;

/// A compiled shader on a device.
#[derive(Clone, Debug)]
pub struct Pipeline {
    /// The pipeline, with a layout deduced from the shader.
    pub(crate) compute: wgpu::ComputePipeline,
    /// The numbers of the bindings in the group of a scene's data that it reads.
    pub(crate) bindings: Vec<u32>,
}

impl Pipeline {
    /// Returns the pipeline itself, for tests with their own shaders.
    pub fn compute(&self) -> &wgpu::ComputePipeline {
        &self.compute
    }
}

/// What a pipeline was compiled from.
#[derive(Debug, PartialEq)]
pub(crate) struct Key {
    text: String,
    entry_point: String,
}

impl Key {
    pub(crate) fn new(shader: &Shader, entry_point: &str) -> Self {
        Self {
            text: shader.text().to_owned(),
            entry_point: entry_point.to_owned(),
        }
    }
}

/// The most recently used pipelines of a device, the latest at the end.
#[derive(Debug, Default)]
pub(crate) struct RecentPipelines(VecDeque<(Key, Pipeline)>);

impl RecentPipelines {
    pub(crate) fn find(&mut self, key: &Key) -> Option<Pipeline> {
        let place = self.0.iter().position(|(known, _)| known == key)?;
        let found = self.0.remove(place)?;
        let pipeline = found.1.clone();
        self.0.push_back(found);
        Some(pipeline)
    }

    /// Whether it has a pipeline, without making it the latest.
    pub(crate) fn has(&self, key: &Key) -> bool {
        self.0.iter().any(|(known, _)| known == key)
    }

    pub(crate) fn keep(&mut self, key: Key, pipeline: Pipeline) {
        self.0.push_back((key, pipeline));
        if self.0.len() > KEPT {
            self.0.pop_front();
        }
    }
}
