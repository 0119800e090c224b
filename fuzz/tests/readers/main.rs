//! Every reader of what users and other programs write: no panic, no hang, memory in proportion, and what is accepted is sound.

mod bombs;
mod displays;
mod exr;
mod png;
mod radiance;
mod scenes;
mod stacks;
mod support;
mod tables;
