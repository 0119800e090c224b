//! What can go wrong with a render.

use crate::DeviceError;
use thiserror::Error;

/// The most thicknesses that a path remembers: 16 KiB of an invocation's own memory.
pub(crate) const MAX_THICKNESSES: u32 = 4096;

/// Why a render did not come to its end.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The scene does not fit into what the device binds at once.
    #[error(
        "the scene's {what} take {bytes} bytes, but this adapter binds at most {limit} at once; {advice}"
    )]
    TooLarge {
        /// What is too large.
        what: &'static str,
        /// How large it is.
        bytes: u64,
        /// How large it may be.
        limit: u64,
        /// What to do.
        advice: &'static str,
    },
    /// The record of a path would be longer than an invocation can hold.
    #[error(
        "a path would have to remember {thicknesses} thicknesses of layers, but at most {MAX_THICKNESSES} are possible; \
         let fewer layers of a stack vary over its surface, use fewer films, or set a smaller render.max_path_segments"
    )]
    RecordTooLong {
        /// How many.
        thicknesses: u32,
    },
    /// The driver ended the shader's loops before their end.
    #[error(
        "the driver ended the shader's loops too early: {counted} of {samples} samples of a pixel can be trusted; use fewer objects, \
         layers or bands, set a smaller render.max_path_segments, or render on another adapter or on the CPU"
    )]
    CutShort {
        /// How many samples were whole.
        counted: u32,
        /// How many were asked for.
        samples: u32,
    },
    /// The caller asked to stop.
    #[error("stopped before the picture was finished")]
    Stopped,
}
