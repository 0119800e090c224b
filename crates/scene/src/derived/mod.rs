//! Tables that renderers look up, made from a scene when it is validated.

mod energy;

pub use energy::Energy;
