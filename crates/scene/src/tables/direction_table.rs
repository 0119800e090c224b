//! Sampling directions in proportion to the brightness of a picture of the environment.

use std::f64::consts::PI;

/// The maximum numbers of columns and rows of a table.
const MAX: [u32; 2] = [1024, 512];
/// Fraction of uniformly sampled directions if BSDF sampling cannot find what the table leaves out.
const EVEN: f64 = 0.02;
/// Relative to the mean brightness: what exceeds the mean by no more than rounding counts as equal to it.
const NEARLY_EVEN: f64 = 1.0 + 1e-6;

/// A density of directions that is constant within the cells of a grid of longitude and latitude.
///
/// All numbers are `f32`: differences of neighbors are exactly the probabilities of a search among them.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionTable {
    /// Number of cells in longitude.
    pub columns: u32,
    /// Number of cells in latitude.
    pub rows: u32,
    /// Heights y of the edges of rows, from 1 at the top to −1; one more than rows.
    pub heights: Vec<f32>,
    /// Probability of the rows above each edge, from 0 to 1; one more than rows.
    pub marginal: Vec<f32>,
    /// Within each row, probability of the cells to the left of each edge, from 0 to 1; one more than columns.
    pub conditional: Vec<f32>,
    /// The density, sr⁻¹, that a brightness equal to the mean corresponds to on the scale of the table's density; 0 if the table covers all
    /// light.
    pub even_density: f32,
}

/// The part of a picture's light that is importance-sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampled {
    /// All of it.
    All,
    /// What exceeds the mean: BSDF sampling finds the rest with less noise (Karlík, Šik, Vévoda, Skřivan and Křivánek, MIS Compensation,
    /// ACM Transactions on Graphics 38(6), 2019).
    Excess,
}

impl DirectionTable {
    /// The table of a picture by longitude and latitude, with a number ≥ 0 in `brightness` for each pixel, row by row; and the mean over
    /// all directions of the brightness that is importance-sampled.
    pub fn new([width, height]: [u32; 2], brightness: &[f32], sampled: Sampled) -> (Self, f64) {
        let (columns, rows) = (width.min(MAX[0]), height.min(MAX[1]));
        let picture = Brightness {
            size: [width as usize, height as usize],
            values: brightness,
        };
        let heights: Vec<f32> = (0..=rows)
            .map(|edge| (PI * f64::from(edge) / f64::from(rows)).cos() as f32)
            .collect();
        let mut cells = picture.of_cells(columns as usize, rows as usize);
        let share = |row: usize| f64::from(heights[row] - heights[row + 1]) / 2.0;
        let mean = |cells: &[f64]| -> f64 {
            let rows = cells.chunks(columns as usize).enumerate();
            let of_row = |(row, cells): (usize, &[f64])| share(row) * cells.iter().sum::<f64>();
            rows.map(of_row).sum::<f64>() / f64::from(columns)
        };
        let whole = mean(&cells);
        let (least, even) = match sampled {
            Sampled::All => (0.0, EVEN * whole),
            Sampled::Excess => (NEARLY_EVEN * whole, 0.0),
        };
        for cell in &mut cells {
            *cell = (*cell - least).max(0.0) + even;
        }
        let sampled_mean = mean(&cells);
        if sampled_mean <= 0.0 {
            cells.fill(1.0);
        }
        let in_rows = || cells.chunks(columns as usize).enumerate();
        let of_rows: Vec<f64> = in_rows()
            .map(|(row, cells)| share(row) * cells.iter().sum::<f64>())
            .collect();
        let even_density = match sampled {
            Sampled::Excess if sampled_mean > 0.0 => whole / (4.0 * PI * sampled_mean),
            _ => 0.0,
        };
        let table = Self {
            columns,
            rows,
            heights,
            marginal: running_share(&of_rows),
            conditional: in_rows()
                .flat_map(|(_, cells)| running_share(cells))
                .collect(),
            even_density: even_density as f32,
        };
        (table, sampled_mean)
    }
}

/// The fraction of the sum before each number, from 0 to 1; equal steps if all are 0.
fn running_share(numbers: &[f64]) -> Vec<f32> {
    let total: f64 = numbers.iter().sum();
    let mut sum = 0.0;
    let before = numbers.iter().enumerate().map(|(index, number)| {
        let share = if total > 0.0 {
            sum / total
        } else {
            index as f64 / numbers.len() as f64
        };
        sum += number;
        share as f32
    });
    before.chain([1.0]).collect()
}

/// The brightness of a picture.
struct Brightness<'a> {
    size: [usize; 2],
    values: &'a [f32],
}

impl Brightness<'_> {
    /// Means over cells, from points that are at most half a pixel apart.
    fn of_cells(&self, columns: usize, rows: usize) -> Vec<f64> {
        let [width, height] = self.size;
        let points = [2 * width.div_ceil(columns), 2 * height.div_ceil(rows)];
        let place = |cell: usize, point: usize, points: usize, cells: usize, pixels: usize| {
            (cell as f64 + (point as f64 + 0.5) / points as f64) * pixels as f64 / cells as f64
        };
        let mut means = Vec::with_capacity(columns * rows);
        for row in 0..rows {
            for column in 0..columns {
                let mut sum = 0.0;
                for down in 0..points[1] {
                    let y = place(row, down, points[1], rows, height);
                    for right in 0..points[0] {
                        sum += self.between(place(column, right, points[0], columns, width), y);
                    }
                }
                means.push(sum / (points[0] * points[1]) as f64);
            }
        }
        means
    }

    /// Bilinear interpolation between the centers of pixels, at a position in pixels.
    fn between(&self, x: f64, y: f64) -> f64 {
        let [width, height] = self.size;
        let (x, y) = (x - 0.5, (y - 0.5).clamp(0.0, (height - 1) as f64));
        let left = (x + width as f64) as usize % width;
        let (above, part_x, part_y) = (y as usize, x - x.floor(), y.fract());
        let below = (above + 1).min(height - 1);
        let row = |row: usize| {
            let at = |column: usize| f64::from(self.values[row * width + column % width]);
            at(left) * (1.0 - part_x) + at(left + 1) * part_x
        };
        row(above) * (1.0 - part_y) + row(below) * part_y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [16, 8];

    /// Probability of a cell.
    fn probability(table: &DirectionTable, column: usize, row: usize) -> f32 {
        let edges = table.columns as usize + 1;
        let conditional = &table.conditional[row * edges..(row + 1) * edges];
        (table.marginal[row + 1] - table.marginal[row])
            * (conditional[column + 1] - conditional[column])
    }

    #[test]
    fn only_what_is_brighter_than_the_mean_is_sampled() {
        // The upper half is three times as bright as the lower.
        let brightness: Vec<f32> = (0..16 * 8)
            .map(|i| if i < 16 * 4 { 3.0 } else { 1.0 })
            .collect();
        let (all, mean) = DirectionTable::new(SIZE, &brightness, Sampled::All);
        assert!((mean - 2.0 * (1.0 + EVEN)).abs() < 1e-6, "{mean}");
        // Three quarters, less the part of the lower half in the row at the edge.
        assert!(
            (0.72..0.75).contains(&all.marginal[4]),
            "{:?}",
            all.marginal
        );
        let (excess, mean) = DirectionTable::new(SIZE, &brightness, Sampled::Excess);
        // Half of the directions exceed the mean of 2 by 1; rows between the halves mix both.
        assert!((0.4..=0.5).contains(&mean), "{mean}");
        let even = 2.0 / (4.0 * PI * mean);
        assert!((f64::from(excess.even_density) / even - 1.0).abs() < 1e-3);
        assert_eq!(all.even_density, 0.0);
        assert_eq!(probability(&excess, 3, 6), 0.0);
        assert!(probability(&excess, 3, 1) > 1.3 * probability(&all, 3, 1));
    }

    #[test]
    fn nothing_even_is_sampled() {
        for value in [0.0, 1.0, 0.1] {
            let (table, mean) = DirectionTable::new(SIZE, &[value; 16 * 8], Sampled::Excess);
            assert_eq!(mean, 0.0, "{value}");
            // The table is still valid.
            assert!(
                table
                    .marginal
                    .iter()
                    .chain(&table.conditional)
                    .all(|p| (0.0..=1.0).contains(p))
            );
        }
    }
}
