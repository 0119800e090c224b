//! Tables over the directions above facets.

use crate::rounding::RoundToF32;
use spectra::knot_before;
use std::f64::consts::FRAC_PI_2;

/// Number of knots over the square root of the cosine: close near grazing, where masking changes fast.
const COSINES: usize = 32;
/// Number of knots over the width of the slopes in the direction's azimuth, if it varies.
const WIDTHS: usize = 17;
/// Number of azimuths of a mean over azimuth, within a quarter turn.
const AZIMUTHS: u32 = 64;

/// A number for each direction above facets: a table over the cosine and, for a brushed surface, over the width of the slopes in the
/// direction's azimuth, interpolated linearly. Its numbers are exact in `f32`.
#[derive(Clone, Debug, PartialEq)]
pub struct FacetTable {
    /// Width of the slopes along and across the grain.
    roughness: [f64; 2],
    /// `[width][cosine]`.
    values: Vec<f64>,
}

impl RoundToF32 for FacetTable {
    fn rounded(&self) -> Self {
        Self {
            roughness: self.roughness.map(|alpha| alpha.rounded()),
            values: self.values.rounded(),
        }
    }
}

impl FacetTable {
    /// Number of knots over the square root of the cosine.
    pub const COSINES: usize = COSINES;
    /// Number of knots over the width of the slopes, if it varies with azimuth.
    pub const WIDTHS: usize = WIDTHS;

    /// Tabulates `of` in the directions of the knots, unit vectors, on facets of these widths along and across the grain.
    ///
    /// Widths that round to the same `f32` count as equal: the shader could not distinguish them.
    /// The table of a function of the direction, for widths of the slopes along and across the grain.
    pub fn new(roughness: [f64; 2], mut of: impl FnMut([f64; 3]) -> f64) -> Self {
        let [along, across] = roughness.map(|alpha| alpha.rounded());
        let columns = if along == across { 1 } else { WIDTHS };
        let mut values = Vec::with_capacity(columns * COSINES);
        for column in 0..columns {
            let azimuth = match columns {
                1 => 0.0,
                _ => azimuth_of(roughness, column as f64 / (WIDTHS - 1) as f64),
            };
            for row in 0..COSINES {
                let cosine = (row as f64 / (COSINES - 1) as f64).powi(2).max(1e-4);
                values.push(of(facet_direction(cosine, azimuth)).rounded());
            }
        }
        Self { roughness, values }
    }

    /// The table's numbers: for each width, from the one along to the one across the grain, the values at [`Self::COSINES`] cosines whose
    /// square roots are equally spaced.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Number of widths: 1 if the values depend only on the cosine.
    pub fn widths(&self) -> usize {
        self.values.len() / COSINES
    }

    /// The value in a direction of the local frame: a unit vector whose z is the cosine with the normal and whose x is along the grain.
    pub fn at(&self, [x, y, cosine]: [f64; 3]) -> f64 {
        let (row, down) = knot_before(cosine.clamp(0.0, 1.0).sqrt(), COSINES);
        let of_column = |column: usize| {
            let first = column * COSINES + row;
            self.values[first] + (self.values[first + 1] - self.values[first]) * down
        };
        if self.widths() == 1 {
            return of_column(0);
        }
        let [along, across] = self.roughness;
        let width = (along * x).hypot(across * y) / x.hypot(y).max(1e-12);
        let part = (width - along) / (across - along);
        let (column, aside) = knot_before(part.clamp(0.0, 1.0), WIDTHS);
        of_column(column) + (of_column(column + 1) - of_column(column)) * aside
    }

    /// The mean of the values over azimuth.
    pub fn around(&self, cosine: f64) -> f64 {
        let azimuths = if self.widths() == 1 { 1 } else { AZIMUTHS };
        let of_azimuth = |i| {
            let azimuth = FRAC_PI_2 * (f64::from(i) + 0.5) / f64::from(azimuths);
            self.at(facet_direction(cosine, azimuth))
        };
        (0..azimuths).map(of_azimuth).sum::<f64>() / f64::from(azimuths)
    }
}

/// The unit vector of a cosine and an azimuth.
pub fn facet_direction(cosine: f64, azimuth: f64) -> [f64; 3] {
    let sine = (1.0 - cosine * cosine).sqrt();
    [sine * azimuth.cos(), sine * azimuth.sin(), cosine]
}

/// The azimuth from the grain at which the width is this fraction of the way from `along` to `across`, which differ: width² = along² cos² +
/// across² sin².
fn azimuth_of([along, across]: [f64; 2], part: f64) -> f64 {
    let width = along + (across - along) * part;
    let sin2 = (width * width - along * along) / (across * across - along * along);
    sin2.clamp(0.0, 1.0).sqrt().asin()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Widths that differ only by rounding have a value in every direction, rounded or not: that of equal widths.
    #[test]
    fn nearly_equal_widths_are_a_table_too() {
        let even = FacetTable::new([0.3; 2], |[.., z]| z);
        for roughness in [
            [0.3, 0.3],
            [0.3, 0.3 + 1e-9],
            [0.3 + 1e-9, 0.3],
            [0.02, 0.020_000_01],
            [1.0, 1.0 - 6e-8],
        ] {
            let table = FacetTable::new(roughness, |[.., z]| z);
            for table in [&table, &table.rounded()] {
                for i in 0..=100 {
                    let cosine = f64::from(i) / 100.0;
                    let seen = facet_direction(cosine, 0.37 * f64::from(i));
                    let off = (table.at(seen) - even.at(seen)).abs();
                    assert!(off < 1e-12, "{roughness:?} {seen:?}: {off}");
                }
                assert!((table.around(0.5) - even.around(0.5)).abs() < 1e-12);
            }
        }
    }

    /// Between its knots the table is linear in the width and in the square root of the cosine; not at the normal, which has no azimuth.
    #[test]
    fn what_is_linear_is_exact() {
        let roughness = [0.5, 0.1];
        let width =
            |[x, y, z]: [f64; 3]| (0.5 * x).hypot(0.1 * y) / (1.0 - z * z).sqrt().max(1e-12);
        let of = |seen: [f64; 3]| width(seen) + (1.0 + width(seen)) * seen[2].sqrt();
        let table = FacetTable::new(roughness, of);
        for i in 0..100 {
            let seen = facet_direction(0.02 + 0.009 * f64::from(i), 0.37 * f64::from(i));
            assert!((table.at(seen) - of(seen)).abs() < 1e-6, "{seen:?}");
        }
    }
}
