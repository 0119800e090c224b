//! One door to both renderers.

use gpu::{AdapterChoice, Gpu};
use scene::Scene;
use spectra::SpectralImage;
use std::ops::ControlFlow;
use thiserror::Error;

/// What is to render.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Backend {
    /// The best GPU, and the CPU where there is none: it is faster than a software driver, and needs none.
    #[default]
    Auto,
    /// An adapter.
    Gpu(AdapterChoice),
    /// The reference in `f64` on the CPU.
    Cpu,
}

/// Why no renderer could be opened.
pub type OpenError = gpu::OpenError;

/// Why a render did not come to its end.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// On an adapter.
    #[error(transparent)]
    Gpu(gpu::RenderError),
    /// The caller asked to stop.
    #[error("stopped before the picture was finished")]
    Stopped,
}

/// A renderer that is ready.
#[derive(Debug)]
#[non_exhaustive]
pub enum Renderer {
    /// An open adapter.
    Gpu(Box<Gpu>),
    /// The CPU.
    Cpu {
        /// Why, where a GPU was wanted but there is none.
        instead_of_gpu: Option<OpenError>,
    },
}

impl Renderer {
    /// Opens what a backend asks for.
    ///
    /// # Errors
    /// When an adapter was asked for and there is none such, or the one found refuses.
    pub fn open(backend: &Backend) -> Result<Self, OpenError> {
        match backend {
            Backend::Cpu => Ok(Self::Cpu {
                instead_of_gpu: None,
            }),
            Backend::Gpu(choice) => Gpu::open(choice).map(|gpu| Self::Gpu(Box::new(gpu))),
            Backend::Auto => match Gpu::open(&AdapterChoice::Hardware) {
                Ok(gpu) => Ok(Self::Gpu(Box::new(gpu))),
                Err(error @ (OpenError::NoAdapter | OpenError::NoHardware { .. })) => {
                    Ok(Self::Cpu {
                        instead_of_gpu: Some(error),
                    })
                }
                Err(error) => Err(error),
            },
        }
    }

    /// What renders, in one line.
    pub fn description(&self) -> String {
        match self {
            Self::Gpu(gpu) => gpu.description().to_string(),
            Self::Cpu { .. } => {
                let threads = std::thread::available_parallelism().map_or(1, usize::from);
                let instructions = reference::SimdLevel::best().name();
                format!("CPU, f64 ({threads} threads, {instructions})")
            }
        }
    }

    /// Renders a scene. `on_progress` is told the samples taken so far, of width × height × samples per pixel, and may
    /// stop the render. It is told 0 before a driver compiles the scene's shader, which may take seconds and last into the first
    /// batch of samples: from 0 to the next number the render is compiling. On the CPU, and where the shader was compiled for a
    /// picture before, there is no 0.
    ///
    /// # Errors
    /// When the device fails, the scene is too large for it, or the caller stops the render.
    pub fn render(
        &self,
        scene: &Scene,
        on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<SpectralImage, RenderError> {
        match self {
            Self::Gpu(gpu) => gpu::render(gpu, scene, on_progress).map_err(|error| match error {
                gpu::RenderError::Stopped => RenderError::Stopped,
                other => RenderError::Gpu(other),
            }),
            Self::Cpu { .. } => reference::render(scene, on_progress)
                .map_err(|reference::Stopped| RenderError::Stopped),
        }
    }
}
