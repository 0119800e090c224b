//! The harness of the suites in `tests/`.

pub mod agreement;
pub mod cases;
pub mod colorimetry;
pub mod device;
pub mod frames;
pub mod probe;
pub mod scenes;
pub mod sources;
pub mod tables;
pub mod tolerances;
pub mod wgsl;
