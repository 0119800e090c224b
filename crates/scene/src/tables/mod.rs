//! Tables that both renderers look up and neither should compute itself.

mod direction_table;
mod energy;
mod estimate;
mod facet_table;
mod filter;

pub use direction_table::{DirectionTable, Sampled};
pub use energy::Energy;
pub use estimate::Estimate;
pub use facet_table::{FacetTable, facet_direction};
pub use filter::{Filter, PixelFilter};
