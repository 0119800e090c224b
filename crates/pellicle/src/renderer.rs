//! One interface to both renderers.

use gpu::{AdapterChoice, Gpu};
use std::sync::Arc;
use thiserror::Error;

/// The device that renders.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Backend {
    /// The best GPU, or the CPU if there is none: the CPU is faster than a software driver, and needs no driver.
    #[default]
    Auto,
    /// The chosen adapter.
    Gpu(AdapterChoice),
    /// The reference in `f64` on the CPU.
    Cpu,
}

/// Why no renderer could be opened.
pub type OpenError = gpu::OpenError;

/// Why a render did not finish.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The adapter failed.
    #[error(transparent)]
    Gpu(gpu::RenderError),
    /// The caller asked to stop.
    #[error("stopped before the picture was finished")]
    Stopped,
}

impl From<gpu::RenderError> for RenderError {
    fn from(error: gpu::RenderError) -> Self {
        match error {
            gpu::RenderError::Stopped => Self::Stopped,
            other => Self::Gpu(other),
        }
    }
}

/// A renderer that is ready.
#[derive(Debug)]
#[non_exhaustive]
pub enum Renderer {
    /// An open adapter.
    Gpu(Arc<Gpu>),
    /// The CPU.
    Cpu {
        /// Why the CPU is used, if a GPU was wanted but there is none.
        instead_of_gpu: Option<OpenError>,
    },
}

impl Renderer {
    /// Opens the renderer that a backend asks for.
    ///
    /// # Errors
    /// When the requested adapter does not exist, or the one found cannot be opened.
    pub fn open(backend: &Backend) -> Result<Self, OpenError> {
        match backend {
            Backend::Cpu => Ok(Self::Cpu {
                instead_of_gpu: None,
            }),
            Backend::Gpu(choice) => Gpu::open(choice).map(|gpu| Self::Gpu(Arc::new(gpu))),
            Backend::Auto => match Gpu::open(&AdapterChoice::Hardware) {
                Ok(gpu) => Ok(Self::Gpu(Arc::new(gpu))),
                Err(error @ (OpenError::NoAdapter | OpenError::NoHardware { .. })) => {
                    Ok(Self::Cpu {
                        instead_of_gpu: Some(error),
                    })
                }
                Err(error) => Err(error),
            },
        }
    }

    /// The device that renders, in one line.
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

    /// What decides, beside the scene, over the bits of a picture: the adapter with its driver, or how the CPU rounds. It is the same on
    /// all machines whose pictures have the same bits.
    pub fn identity(&self) -> String {
        match self {
            Self::Gpu(gpu) => gpu.description().to_string(),
            Self::Cpu { .. } if reference::SimdLevel::best().has_fused_multiply_add() => {
                "CPU, f64".to_owned()
            }
            Self::Cpu { .. } => "CPU, f64 without fused multiply-add".to_owned(),
        }
    }
}
