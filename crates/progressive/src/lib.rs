//! Renders in rounds: when to stop, checkpoints, parts of a picture.
//!
//! A [`Render`] says which rounds are next; a renderer advances its [`spectra::Accumulation`] by them. Nothing here knows a
//! renderer, and no renderer knows of this: stopping, previews, checkpoints and parts are views of the accumulation.
//!
//! ```text
//! while let Some(rounds) = render.next_rounds() {
//!     renderer advances render.accumulation_mut() by rounds
//!     render.finish_round(samples, seconds)
//!     render.write_checkpoint(path, identity), now and then
//! }
//! ```

pub mod adaptive;
mod checkpoint;
mod goal;
mod identity;
mod merge;
pub mod noise;
mod render;

pub use checkpoint::CheckpointError;
pub use goal::{End, Goal};
pub use identity::{Difference, Identity};
pub use merge::{MergeError, Merged, merge};
pub use noise::NoiseEstimator;
pub use render::Render;
