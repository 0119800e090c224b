//! Tables that both renderers look up, made once from the scene.

mod direction_table;

pub use direction_table::DirectionTable;
