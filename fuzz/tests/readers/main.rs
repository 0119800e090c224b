//! Tests every reader of files from users and other programs: no panic, no hang, proportional memory, and accepted inputs are sound.

mod bombs;
mod displays;
mod exr;
mod png;
mod radiance;
mod scenes;
mod stacks;
mod support;
mod tables;
