//! The harness of the suites in `tests/`.

pub mod wgsl;
