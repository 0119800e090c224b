//! Drawing directions in proportion to the brightness of a picture of the surroundings.

use std::f64::consts::PI;

/// The most columns and rows of a table.
const MOST: [u32; 2] = [1024, 512];
/// Share of the directions that are drawn evenly, so that none is left out.
const EVEN: f64 = 0.02;

/// A density of directions that is constant within the cells of a grid of longitude and latitude.
///
/// All numbers are `f32`: differences of neighbouring ones are the very probabilities that a search among them has.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionTable {
    /// Cells around.
    pub columns: u32,
    /// Cells from top to bottom.
    pub rows: u32,
    /// Heights y of the rows' edges, from 1 at the top to −1, one more than rows.
    pub heights: Vec<f32>,
    /// Probability of the rows above each edge, from 0 to 1, one more than rows.
    pub marginal: Vec<f32>,
    /// Within each row, probability of the cells to the left of each edge, from 0 to 1, one more than columns.
    pub conditional: Vec<f32>,
}

impl DirectionTable {
    /// The table of a picture by longitude and latitude, of which `brightness` has a number ≥ 0 for each pixel, row by row.
    pub(crate) fn new(width: u32, height: u32, brightness: &[f32]) -> Self {
        let (columns, rows) = (width.min(MOST[0]), height.min(MOST[1]));
        let picture = Brightness {
            size: [width as usize, height as usize],
            values: brightness,
        };
        let heights: Vec<f32> = (0..=rows)
            .map(|edge| (PI * f64::from(edge) / f64::from(rows)).cos() as f32)
            .collect();
        let mut cells = picture.of_cells(columns as usize, rows as usize);
        let share = |row: usize| f64::from(heights[row] - heights[row + 1]) / 2.0;
        let in_rows = || cells.chunks(columns as usize).enumerate();
        let mean: f64 = in_rows()
            .map(|(row, cells)| share(row) * cells.iter().sum::<f64>() / cells.len() as f64)
            .sum();
        let even = if mean > 0.0 { EVEN * mean } else { 1.0 };
        for cell in &mut cells {
            *cell += even;
        }
        let in_rows = || cells.chunks(columns as usize).enumerate();
        let of_rows: Vec<f64> = in_rows()
            .map(|(row, cells)| share(row) * cells.iter().sum::<f64>())
            .collect();
        Self {
            columns,
            rows,
            heights,
            marginal: running_share(&of_rows),
            conditional: in_rows()
                .flat_map(|(_, cells)| running_share(cells))
                .collect(),
        }
    }
}

/// The share of the sum before each number, from 0 to 1.
fn running_share(numbers: &[f64]) -> Vec<f32> {
    let total: f64 = numbers.iter().sum();
    let mut sum = 0.0;
    let before = numbers.iter().map(|number| {
        let share = sum / total;
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
    /// Means over cells, by points that lie at most half a pixel apart.
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

    /// Bilinear between the centres of pixels, at a place in pixels.
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
