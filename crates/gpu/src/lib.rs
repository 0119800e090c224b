//! The renderer on the GPU, by wgpu: Vulkan, Metal or DX12, hardware or software.
//!
//! A [`scene::Scene`] becomes a [`PackedScene`], whose structs ([`layout`]) the shader shares. The shader is assembled from the
//! [`modules`] of `shaders/`. A [`Gpu`] is an open adapter; [`render`] renders a scene on it, tile by tile and batch by batch, and
//! reads back a [`spectra::SpectralImage`].

mod bindings;
mod counts;
mod device;
mod device_error;
mod driver_cache;
mod error;
mod features;
pub mod layout;
mod lists;
pub mod modules;
mod pack;
mod pipelines;
mod recent_pipelines;
mod render;
mod specialize;
mod stacks;
mod tile_buffers;
mod tiles;

pub use bindings::{SceneBindings, bind_scene};
pub use device::{AdapterChoice, AdapterDescription, Gpu, INSTALL_HINT, OpenError, adapters};
pub use device_error::DeviceError;
pub use error::RenderError;
pub use features::{Feature, Features};
pub use layout::RunStack;
pub use layout::list_form::ListForm;
pub use pack::PackedScene;
pub use pipelines::compile;
pub use recent_pipelines::Pipeline;
pub use render::{InjectedFault, Session, Work, render, render_divided};
pub use stacks::{MAX_BATCH_LAYERS, StackBatch, StackError, StackPowers, evaluate_stacks};
pub use tiles::Division;
