//! Errors of a render.

use crate::device_error::DeviceError;
use thiserror::Error;

/// The most thicknesses that a path can record: 16 KiB of an invocation's private memory.
pub(crate) const MAX_THICKNESSES: u32 = 4096;

/// Why a render did not finish.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The scene is larger than the device can bind at once.
    #[error(
        "the scene's {what} take {bytes} bytes, but this adapter binds at most {limit} at once; {advice}"
    )]
    TooLarge {
        /// The part that is too large.
        what: &'static str,
        /// Its size.
        bytes: u64,
        /// The largest possible size.
        limit: u64,
        /// Advice.
        advice: &'static str,
    },
    /// The record of a path would be longer than an invocation can hold.
    #[error(
        "a path would have to record {thicknesses} thicknesses of layers, but at most {MAX_THICKNESSES} are possible; \
         let fewer layers of a stack vary over its surface, use fewer films, or set a smaller render.max_path_segments"
    )]
    RecordTooLong {
        /// The required number of thicknesses.
        thicknesses: u32,
    },
    /// The driver ended the shader's loops early.
    #[error(
        "the driver ended the shader's loops too early: {counted} of {samples} samples of a pixel can be trusted; use fewer objects, \
         layers or bands, set a smaller render.max_path_segments, or render on another adapter or on the CPU"
    )]
    CutShort {
        /// The number of complete samples.
        counted: u32,
        /// The number of requested samples.
        samples: u32,
    },
    /// The caller asked to stop.
    #[error("stopped before the picture was finished")]
    Stopped,
}
