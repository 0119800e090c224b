//! The fraction of light that leaves facets after a single reflection.

use super::FacetTable;
use crate::rounding::RoundToF32;

/// The directional albedo E of perfectly reflecting facets after a single reflection: the fraction 1 − E of the light hits another facet.
#[derive(Clone, Debug, PartialEq)]
pub struct Energy {
    table: FacetTable,
    mean: f64,
}

impl RoundToF32 for Energy {
    fn rounded(&self) -> Self {
        Self {
            table: self.table.rounded(),
            mean: self.mean.rounded(),
        }
    }
}

impl Energy {
    /// The table, and the cosine-weighted mean of its values over directions.
    pub fn new(table: FacetTable, mean: f64) -> Self {
        Self { table, mean }
    }

    /// E as a function of direction.
    pub fn table(&self) -> &FacetTable {
        &self.table
    }

    /// The cosine-weighted mean over directions.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// E in a direction of the local frame: a unit vector whose z is the cosine with the normal and whose x is along the grain.
    pub fn at(&self, direction: [f64; 3]) -> f64 {
        self.table.at(direction)
    }
}
