//! What both renderers look up and neither should compute itself: trees over objects and emitters, and tables.

mod coincidence;
mod direction_table;
mod emitter_tree;
mod energy;
mod estimate;
mod facet_table;
mod filter;
mod hierarchy;

pub use coincidence::Sheet;
pub(crate) use coincidence::{overlap, sheets};
pub use direction_table::{DirectionTable, Sampled};
pub use emitter_tree::{EmitterNode, EmitterTree};
pub use energy::Energy;
pub use estimate::Estimate;
pub use facet_table::{FacetTable, facet_direction};
pub use filter::{Filter, PixelFilter};
pub use hierarchy::{Hierarchy, Node};
