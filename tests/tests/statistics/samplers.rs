//! Tests every sampler against its claimed density, by chi-square; the energy of rough surfaces; reciprocity.
//!
//! Directions are counted in cells of equal steps of z (or of a facet's own quantile) and azimuth. The expected count of a cell is the
//! density integrated over it by Gauss's rule; a last cell takes what the density leaves (directions below the horizon). All tests
//! together raise a false alarm with probability [`FALSE_ALARM`] (Šidák); the numbers are fixed, so a test that passes keeps passing.

mod chi_square;
mod emitters;
mod facets;
mod mixtures;
mod pictures;
mod slopes;

use chi_square::{Experiment, turns};
use reference::{sample_cone, sample_cosine_hemisphere};
use std::f64::consts::{PI, TAU};

/// Probability that any of the [`TESTS`] fails although every sampler is right.
const FALSE_ALARM: f64 = 1e-3;
/// Number of chi-square tests, without those that must fail: the hemisphere, four cones, and those of each file.
const TESTS: f64 =
    (1 + 4 + emitters::TESTS + slopes::TESTS + facets::TESTS + mixtures::TESTS + pictures::TESTS)
        as f64;

#[test]
fn the_cosine_hemisphere_is_sampled_by_its_cosine() {
    let of = |density: &dyn Fn(f64, f64) -> f64, refused: bool| {
        let experiment = Experiment {
            name: "cosine hemisphere".to_owned(),
            ranges: [(0.0, 1.0), (0.0, 1.0)],
            draw: &|u, v| {
                let w = sample_cosine_hemisphere(u, v);
                assert!((w.length() - 1.0).abs() < 1e-12);
                (w.z >= 0.0).then(|| [w.z, turns(w)])
            },
            density,
            parts: 2,
            outside: Some(0.0),
        };
        if refused {
            experiment.is_refused(1);
        } else {
            experiment.holds(1);
        }
    };
    of(&|z, _| TAU * z / PI, false);
    of(&|_, _| 1.0, true);
}

#[test]
fn cones_are_sampled_uniformly() {
    for (seed, height) in [(2, 2.0), (3, 1.0), (4, 0.2), (5, 1e-4)] {
        let draw = |u: f64, v: f64| {
            let w = sample_cone(u, v, height);
            assert!((w.length() - 1.0).abs() < 1e-12);
            Some([(1.0 - w.z) / height, turns(w)])
        };
        let uniform = Experiment {
            name: format!("cone of height {height}"),
            ranges: [(0.0, 1.0), (0.0, 1.0)],
            draw: &draw,
            density: &|_, _| 1.0,
            parts: 2,
            outside: Some(0.0),
        };
        uniform.holds(seed);
        let tilted = Experiment {
            density: &|x, _| 0.9 + 0.2 * x,
            ..uniform
        };
        tilted.is_refused(seed);
    }
}
