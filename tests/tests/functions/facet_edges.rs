//! Functions of microsurface.wgsl where f32 is weakest: the smoothest facets, grazing directions and the largest random numbers.

use crate::facets::{densities, facet_draws, lambdas, reflections, slopes};
use crate::{Check, lazy};
use pellicle_tests::tolerances::{FACET_TAIL, FACETS, LAMBDA, NARROW_FACETS, SLOPE_TAIL};

/// The largest random number.
const LAST: f32 = 1.0 - f32::EPSILON / 2.0;
/// The smoothest facets, those with the strongest grain, and the roughest: a tag and two widths.
const SURFACES: [[f32; 3]; 8] = [
    [0.0, 0.02, 0.02],
    [1.0, 0.02, 0.02],
    [0.0, 0.02, 1.0],
    [1.0, 0.02, 1.0],
    [0.0, 1.0, 0.02],
    [1.0, 1.0, 0.02],
    [0.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];
/// Cosines and turns: in the middle of the highlight, at its edge, beside it, and near the horizon.
const DIRECTIONS: [[f32; 2]; 6] = [
    [1.0, 0.0],
    [LAST, 0.3],
    [0.9998, 0.1],
    [0.7, 0.7],
    [1e-3, 0.1],
    [1e-3, 0.25],
];
/// Cosine of `wo`, and cosine and turn of `wi`: near the mirror direction and far from it.
const BETWEEN: [[f32; 3]; 8] = [
    [1e-3, 1e-3, 0.5],
    [1e-3, 1e-3, 0.0],
    [1e-3, 0.03, 0.5],
    [1e-3, 0.3, 0.5],
    [1e-3, 1.0, 0.0],
    [0.03, 1e-3, 0.5],
    [0.7, 0.71, 0.5],
    [1.0, 1.0, 0.0],
];
/// Cosine and turn of `wo`, and two numbers.
const DRAWS: [[f32; 4]; 9] = [
    [1e-3, 0.1, 0.5, 0.5],
    [1e-3, 0.1, 0.0, 0.0],
    [1e-3, 0.1, LAST, 0.5],
    [1e-3, 0.1, 0.5, LAST],
    [1e-3, 0.1, LAST, LAST],
    [0.7, 0.3, LAST, LAST],
    [1.0, 0.0, 0.0, 0.0],
    [1.0, 0.0, LAST, LAST],
    [LAST, 0.3, LAST, LAST],
];

/// Every surface combined with every row.
fn on_all<const N: usize>(rows: &[[f32; N]]) -> Vec<f32> {
    let of_surface = |surface: &[f32; 3]| -> Vec<f32> {
        let with_rows = rows.iter().map(|row| [&surface[..], row].concat());
        with_rows.flatten().collect()
    };
    SURFACES.iter().flat_map(of_surface).collect()
}

pub(crate) fn checks() -> Vec<Check> {
    let cosines = [1e-3, 0.1, 0.7, LAST, 1.0];
    let of_cosine = |cosine| [[cosine, LAST], [cosine, 0.5], [cosine, 0.0]].concat();
    vec![
        densities(lazy(|| on_all(&DIRECTIONS)), FACETS),
        lambdas(lazy(|| on_all(&DIRECTIONS)), LAMBDA),
        reflections(lazy(|| on_all(&BETWEEN)), NARROW_FACETS),
        facet_draws(lazy(|| on_all(&DRAWS)), FACET_TAIL),
        slopes(
            lazy(move || cosines.into_iter().flat_map(of_cosine).collect()),
            SLOPE_TAIL,
        ),
    ]
}
