//! What goes wrong on a device.

use thiserror::Error;

/// Something went wrong on the device.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum DeviceError {
    /// Out of memory.
    #[error("the adapter is out of memory: {0}")]
    OutOfMemory(String),
    /// The device was lost: unplugged, reset, or stopped by the system because a dispatch took too long.
    #[error("the device was lost: {0}")]
    Lost(String),
    /// The driver rejected a call or a shader.
    #[error("the driver refused a call: {0}")]
    Refused(String),
    /// Work did not finish within a time that no batch should need.
    #[error("the device has not answered for {seconds} s")]
    NoAnswer {
        /// How long the host waited, s.
        seconds: u64,
    },
}
