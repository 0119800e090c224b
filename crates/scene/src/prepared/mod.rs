//! Data that both renderers look up and neither should compute itself, prepared once from a validated scene.

pub(crate) mod coats;
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
pub use direction_table::DirectionTable;
pub(crate) use direction_table::Sampled;
pub use emitter_tree::{EmitterNode, EmitterTree};
pub use energy::Energy;
pub use estimate::Estimate;
pub(crate) use estimate::estimates;
pub use facet_table::FacetTable;
pub use filter::PixelFilter;
pub use hierarchy::{Hierarchy, Node};
