//! Tables that renderers look up, made from a scene when it is validated.

pub(crate) mod coats;
mod direction_table;
mod energy;

pub use direction_table::DirectionTable;
pub use energy::Energy;
