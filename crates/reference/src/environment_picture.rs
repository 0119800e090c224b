//! An environment given as a picture of all directions.

use crate::picture::{chosen_pixel, half_turns};
use glam::DVec3;
use scene::{DirectionTable, EnvironmentPicture};
use std::f64::consts::TAU;

/// Returns the position of a direction in the picture, from its upper left corner, in units of its width and height.
pub(crate) fn environment_uv(picture: &EnvironmentPicture, direction: DVec3) -> [f64; 2] {
    let longitude = direction
        .dot(picture.right)
        .atan2(direction.dot(picture.forward));
    [0.5 + longitude / TAU, half_turns(direction, DVec3::Y)]
}

/// Returns the pixel that a path uses for a direction, chosen by a random number.
pub fn environment_pixel(picture: &EnvironmentPicture, direction: DVec3, random: f64) -> [u32; 2] {
    chosen_pixel(
        &picture.texels,
        environment_uv(picture, direction),
        true,
        random,
    )
}

/// Samples a direction in proportion to the brightness of the cells of the picture's table.
pub(crate) fn sample_environment_picture(picture: &EnvironmentPicture, u: f64, v: f64) -> DVec3 {
    let table = &picture.table;
    let (row, down) = inverted(&table.marginal, u);
    let (column, across) = inverted(columns_of(table, row), v);
    let [top, bottom] = [table.heights[row], table.heights[row + 1]].map(f64::from);
    let height = top + (bottom - top) * down;
    let longitude = TAU * ((column as f64 + across) / f64::from(table.columns) - 0.5);
    let radius = (1.0 - height * height).max(0.0).sqrt();
    let around = picture.right * longitude.sin() + picture.forward * longitude.cos();
    around * radius + DVec3::Y * height
}

/// Returns the density of [`sample_environment_picture`], sr⁻¹: the probability of the direction's cell over its solid angle.
pub(crate) fn environment_picture_pdf(picture: &EnvironmentPicture, direction: DVec3) -> f64 {
    let table = &picture.table;
    let [across, down] = environment_uv(picture, direction);
    let cell =
        |place: f64, count: u32| ((place * f64::from(count)) as usize).min(count as usize - 1);
    let (row, column) = (cell(down, table.rows), cell(across, table.columns));
    let step = |edges: &[f32], i: usize| f64::from(edges[i + 1]) - f64::from(edges[i]);
    let probability = step(&table.marginal, row) * step(columns_of(table, row), column);
    let solid_angle = -step(&table.heights, row) * TAU / f64::from(table.columns);
    probability / solid_angle
}

fn columns_of(table: &DirectionTable, row: usize) -> &[f32] {
    let edges = table.columns as usize + 1;
    &table.conditional[row * edges..(row + 1) * edges]
}

/// Returns the interval between edges that contains a number, and the position within it.
fn inverted(edges: &[f32], u: f64) -> (usize, f64) {
    let index = edges.partition_point(|&edge| f64::from(edge) <= u) - 1;
    let [low, high] = [edges[index], edges[index + 1]].map(f64::from);
    (index, (u - low) / (high - low))
}
