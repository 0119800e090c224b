//! How much of the light that falls onto facets leaves at once.

use crate::Distribution;
use crate::rounding::RoundToF32;
use std::f64::consts::FRAC_PI_2;

/// Knots over the root of the cosine: close together near grazing, where masking changes fast.
const COSINES: usize = 32;
/// Knots over the width of the slopes in the direction's azimuth, where that differs.
const WIDTHS: usize = 17;
/// Facets per knot, squared.
const STEPS: u32 = 48;

/// The directional albedo E of facets that reflect everything, after a single reflection: 1 − E of the light meets
/// another facet. A table over direction, linear between its knots; its numbers are `f32` numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Energy {
    /// Width of the slopes along and across the grain.
    roughness: [f64; 2],
    /// `[width][cosine]`.
    values: Vec<f64>,
    mean: f64,
}

impl RoundToF32 for Energy {
    fn rounded(&self) -> Self {
        Self {
            roughness: self.roughness.map(|alpha| alpha.rounded()),
            values: self.values.rounded(),
            mean: self.mean.rounded(),
        }
    }
}

impl Energy {
    /// Knots over the root of the cosine.
    pub const COSINES: usize = COSINES;
    /// Knots over the width of the slopes, where that differs with the azimuth.
    pub const WIDTHS: usize = WIDTHS;

    /// The table of a distribution and its widths along and across the grain.
    pub(crate) fn new(distribution: Distribution, roughness: [f64; 2]) -> Self {
        let surface = optics::Microsurface {
            distribution: distribution.into(),
            alpha: roughness,
        };
        let columns = if roughness[0] == roughness[1] {
            1
        } else {
            WIDTHS
        };
        let mut values = Vec::with_capacity(columns * COSINES);
        for column in 0..columns {
            let azimuth = azimuth_of(roughness, column as f64 / (WIDTHS - 1) as f64);
            for row in 0..COSINES {
                let cosine = (row as f64 / (COSINES - 1) as f64).powi(2).max(1e-4);
                let sine = (1.0 - cosine * cosine).sqrt();
                let eye = [sine * azimuth.cos(), sine * azimuth.sin(), cosine];
                values.push(surface.albedo(eye, STEPS).min(1.0).rounded());
            }
        }
        let mut table = Self {
            roughness,
            values,
            mean: 0.0,
        };
        table.mean = table.integrated().rounded();
        table
    }

    /// The table's numbers: for each width, from the smallest part to the largest, those of [`Self::COSINES`] cosines; the
    /// knots are even in the root of the cosine.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Number of widths: 1 where all directions are alike.
    pub fn widths(&self) -> usize {
        self.values.len() / COSINES
    }

    /// The mean over directions, each counted with its cosine.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// E in a direction of the local frame, a unit vector whose z is the cosine with the normal and whose x runs along the grain.
    pub fn at(&self, [x, y, cosine]: [f64; 3]) -> f64 {
        let [along, across] = self.roughness;
        let sine = x.hypot(y).max(1e-12);
        let width = (along * x).hypot(across * y) / sine;
        let part = if self.widths() == 1 {
            0.0
        } else {
            (width - along) / (across - along)
        };
        self.between(cosine.clamp(0.0, 1.0).sqrt(), part.clamp(0.0, 1.0))
    }

    /// Linear between four knots.
    fn between(&self, root: f64, part: f64) -> f64 {
        let (row, down) = knot(root, COSINES);
        let of_column = |column: usize| {
            let first = column * COSINES + row;
            self.values[first] + (self.values[first + 1] - self.values[first]) * down
        };
        if self.widths() == 1 {
            return of_column(0);
        }
        let (column, aside) = knot(part, WIDTHS);
        of_column(column) + (of_column(column + 1) - of_column(column)) * aside
    }

    /// (1/π) ∫ E cos θ dω, by the midpoint rule: with t = √cos θ, 2 cos θ d(cos θ) = 4 t³ dt.
    fn integrated(&self) -> f64 {
        const ROWS: usize = 16 * (COSINES - 1);
        let columns: usize = if self.widths() == 1 { 1 } else { 64 };
        let (mut sum, mut weights) = (0.0, 0.0);
        for column in 0..columns {
            let azimuth = FRAC_PI_2 * (column as f64 + 0.5) / columns as f64;
            for row in 0..ROWS {
                let root = (row as f64 + 0.5) / ROWS as f64;
                let (cosine, weight) = (root * root, root.powi(3));
                let sine = (1.0 - cosine * cosine).sqrt();
                let direction = [sine * azimuth.cos(), sine * azimuth.sin(), cosine];
                sum += weight * self.at(direction);
                weights += weight;
            }
        }
        sum / weights
    }
}

/// The knot before a place in [0, 1], and the part of the way to the next.
fn knot(place: f64, knots: usize) -> (usize, f64) {
    let place = place * (knots - 1) as f64;
    let knot = (place as usize).min(knots - 2);
    (knot, place - knot as f64)
}

/// The azimuth from the grain in which the width has come this part of the way from along to across:
/// width² = along² cos² + across² sin².
fn azimuth_of([along, across]: [f64; 2], part: f64) -> f64 {
    let width = along + (across - along) * part;
    if along == across {
        return 0.0;
    }
    let sin2 = (width * width - along * along) / (across * across - along * along);
    sin2.clamp(0.0, 1.0).sqrt().asin()
}

impl From<Distribution> for optics::Distribution {
    fn from(distribution: Distribution) -> Self {
        match distribution {
            Distribution::Beckmann => Self::Beckmann,
            Distribution::Ggx => Self::Ggx,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// The table against the integral itself, between the knots and at all azimuths, and the white furnace: what leaves at
    /// once and (1 − E)(1 − E)/(π (1 − mean)) after more facets come to everything within 0.5 % for α from 0.05, to 85°.
    #[test]
    fn nothing_is_lost() {
        let mut worst = (0.0, 0.0_f64);
        for distribution in [Distribution::Beckmann, Distribution::Ggx] {
            for roughness in [
                [0.05, 0.05],
                [0.1, 0.1],
                [0.2, 0.2],
                [0.4, 0.4],
                [0.7, 0.7],
                [1.0, 1.0],
                [0.05, 0.2],
                [0.05, 1.0],
                [0.8, 0.3],
                [0.3, 0.35],
            ] {
                let table = Energy::new(distribution, roughness);
                let surface = optics::Microsurface {
                    distribution: distribution.into(),
                    alpha: roughness,
                };
                let lost_by_all = lost_by_cosine(&table);
                for i in 0..60 {
                    let degrees = 85.0 * f64::from(i) / 59.0;
                    let azimuth = f64::from(i * 7 % 60) / 60.0 * PI;
                    let (sine, cosine) = f64::to_radians(degrees).sin_cos();
                    let eye = [sine * azimuth.cos(), sine * azimuth.sin(), cosine];
                    let once = surface.albedo(eye, 128);
                    let more = (1.0 - table.at(eye)) * lost_by_all / (1.0 - table.mean());
                    let error = (once + more - 1.0).abs();
                    assert!(
                        error < 0.005,
                        "{distribution:?} {roughness:?} {degrees}°: {error}"
                    );
                    if error > worst.1 {
                        worst = (degrees, error);
                        println!("{distribution:?} {roughness:?} {worst:?}");
                    }
                }
            }
        }
    }

    /// (1/π) ∫ (1 − E) cos θ dω, by another rule than the table's own.
    fn lost_by_cosine(table: &Energy) -> f64 {
        let steps = 400;
        let mut sum = 0.0;
        for i in 0..steps {
            for j in 0..steps {
                let cos2 = (f64::from(i) + 0.5) / f64::from(steps);
                let azimuth = 2.0 * PI * (f64::from(j) + 0.5) / f64::from(steps);
                let sine = (1.0 - cos2).sqrt();
                sum += 1.0 - table.at([sine * azimuth.cos(), sine * azimuth.sin(), cos2.sqrt()]);
            }
        }
        sum / f64::from(steps * steps)
    }
}
