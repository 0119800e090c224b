//! What both renderers walk and neither should compute itself: trees over objects and emitters, and stacks of coincident surfaces.

mod coincidence;
mod emitter_tree;
mod hierarchy;
mod lamp;

pub use coincidence::Sheet;
pub(crate) use coincidence::{overlap, sheets};
pub use emitter_tree::{EmitterNode, EmitterTree};
pub use hierarchy::{Hierarchy, Node};
