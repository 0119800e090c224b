//! What both renderers look up and neither should work out by itself, made once from a validated scene.

pub(crate) mod coats;
mod coincidence;
mod direction_table;
mod energy;
mod estimate;
mod facet_table;
mod filter;
mod hierarchy;
mod light_tree;

pub use coincidence::Sheet;
pub(crate) use coincidence::{overlap, sheets};
pub use direction_table::DirectionTable;
pub(crate) use direction_table::Sent;
pub use energy::Energy;
pub use estimate::Estimate;
pub(crate) use estimate::estimates;
pub use facet_table::FacetTable;
pub use filter::PixelFilter;
pub use hierarchy::{Hierarchy, Node};
pub use light_tree::{LightNode, LightTree};
