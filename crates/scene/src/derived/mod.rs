//! What both renderers look up and neither should work out by itself, made once from a validated scene.

mod estimate;
mod filter;

pub use estimate::Estimate;
pub(crate) use estimate::estimates;
pub use filter::PixelFilter;
