//! Tables that renderers look up, made from a scene when it is validated.

pub(crate) mod coats;
mod energy;

pub use energy::Energy;
