//! The harness of the suites in `tests/`.

pub mod agreement;
pub mod device;
pub mod probe;
pub mod tolerances;
pub mod wgsl;
