//! Tests samplers against their densities: counts in cells, and the probability of such counts.

use super::{FALSE_ALARM, TESTS};
use glam::DVec3;
use reference::random4;
use std::f64::consts::TAU;

pub(crate) const SAMPLES: u32 = 1 << 17;
const ROWS: usize = 24;
const COLUMNS: usize = 24;

/// Two uniform numbers per sample, from the renderer's own generator.
pub(crate) fn numbers(seed: u32) -> impl Iterator<Item = (f64, f64)> {
    (0..SAMPLES).map(move |i| {
        let [u, v, ..] = random4([i % 512, i / 512], i % 7, 3, seed);
        (u, v)
    })
}

/// Gauss's points and weights of order 8 on [0, 1] (Abramowitz and Stegun, table 25.4).
pub(crate) const GAUSS: [(f64, f64); 8] = {
    const HALF: [(f64, f64); 4] = [
        (0.183_434_642_495_649_8, 0.362_683_783_378_362),
        (0.525_532_409_916_329, 0.313_706_645_877_887_3),
        (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
        (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
    ];
    let mut points = [(0.0, 0.0); 8];
    let mut i = 0;
    while i < 4 {
        let (x, w) = HALF[i];
        points[2 * i] = (0.5 - 0.5 * x, 0.5 * w);
        points[2 * i + 1] = (0.5 + 0.5 * x, 0.5 * w);
        i += 1;
    }
    points
};

/// ∫ f over [a, b] × [c, d], with each side divided into `parts`.
pub(crate) fn integral(
    f: impl Fn(f64, f64) -> f64,
    (a, b): (f64, f64),
    (c, d): (f64, f64),
    parts: usize,
) -> f64 {
    let (dx, dy) = ((b - a) / parts as f64, (d - c) / parts as f64);
    let mut sum = 0.0;
    for i in 0..parts {
        for j in 0..parts {
            for (x, wx) in GAUSS {
                for (y, wy) in GAUSS {
                    let x = a + (i as f64 + x) * dx;
                    let y = c + (j as f64 + y) * dy;
                    sum += wx * wy * f(x, y);
                }
            }
        }
    }
    sum * dx * dy
}

/// Upper tail of a normal distribution (Abramowitz and Stegun, 26.2.17, absolute error below 7.5e-8).
fn normal_tail(z: f64) -> f64 {
    if z < 0.0 {
        return 1.0 - normal_tail(-z);
    }
    let t = 1.0 / (1.0 + 0.231_641_9 * z);
    let poly = t
        * (0.319_381_530
            + t * (-0.356_563_782
                + t * (1.781_477_937 + t * (-1.821_255_978 + t * 1.330_274_429))));
    (-0.5 * z * z).exp() / TAU.sqrt() * poly
}

/// Probability of a chi-square at least this large, by Wilson and Hilferty's cube root (1931).
pub(crate) fn probability(chi2: f64, freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom);
    normal_tail(((chi2 / freedom).cbrt() - (1.0 - spread)) / spread.sqrt())
}

/// Chi-square of the counts in cells, and its degrees of freedom; cells with an expected count below five are pooled.
fn chi_square(counts: &[f64], expected: &[f64]) -> (f64, f64) {
    let mut pooled = (0.0, 0.0);
    let (mut chi2, mut cells) = (0.0, 0);
    for (&count, &expect) in counts.iter().zip(expected) {
        if expect < 5.0 {
            pooled = (pooled.0 + count, pooled.1 + expect);
        } else {
            chi2 += (count - expect).powi(2) / expect;
            cells += 1;
        }
    }
    if pooled.1 >= 5.0 {
        chi2 += (pooled.0 - pooled.1).powi(2) / pooled.1;
        cells += 1;
    } else if pooled.0 > pooled.1 + 12.0 {
        // Where almost nothing is expected, so large a count does not occur by probability.
        chi2 = f64::INFINITY;
    }
    assert!(cells > 20, "only {cells} cells expect five or more samples");
    (chi2, f64::from(cells - 1))
}

/// A sampler and its density over two coordinates, `across` in the first range, `around` in the second. A direction without
/// coordinates is counted in the remaining cell.
pub(crate) struct Experiment<'a> {
    pub(crate) name: String,
    pub(crate) ranges: [(f64, f64); 2],
    /// Coordinates of the sample that two uniform numbers give.
    pub(crate) draw: &'a dyn Fn(f64, f64) -> Option<[f64; 2]>,
    /// Density over the coordinates.
    pub(crate) density: &'a dyn Fn(f64, f64) -> f64,
    /// Number of parts into which each side of a cell is divided to integrate the density.
    pub(crate) parts: usize,
    /// Fraction outside the ranges, where it is known; otherwise it is what the density leaves.
    pub(crate) outside: Option<f64>,
}

impl Experiment<'_> {
    /// The probability of so large a chi-square, and the integral of the density.
    fn probability_and_total(&self, seed: u32) -> (f64, f64) {
        let [across, around] = self.ranges;
        let mut counts = vec![0.0; ROWS * COLUMNS + 1];
        for (u, v) in numbers(seed) {
            let cell = (self.draw)(u, v).map_or(ROWS * COLUMNS, |[x, y]| {
                cell_of(x, across, ROWS) * COLUMNS + cell_of(y, around, COLUMNS)
            });
            counts[cell] += 1.0;
        }
        let mut expected: Vec<f64> = (0..ROWS * COLUMNS)
            .map(|cell| {
                let x = part(across, cell / COLUMNS, ROWS);
                let y = part(around, cell % COLUMNS, COLUMNS);
                integral(self.density, x, y, self.parts)
            })
            .collect();
        let total: f64 = expected.iter().sum();
        expected.push(self.outside.unwrap_or(1.0 - total));
        for expect in &mut expected {
            *expect *= f64::from(SAMPLES);
        }
        let (chi2, freedom) = chi_square(&counts, &expected);
        (probability(chi2, freedom), total)
    }

    /// Checks that the sampler follows its density.
    pub(crate) fn holds(&self, seed: u32) {
        let (probability, total) = self.probability_and_total(seed);
        println!(
            "{}: probability {probability:.3}, integral {total:.9}",
            self.name
        );
        let level = 1.0 - (1.0 - FALSE_ALARM).powf(1.0 / TESTS);
        assert!(
            probability > level,
            "{}: probability {probability:e}",
            self.name
        );
        let whole = total + self.outside.unwrap_or(0.0);
        assert!(
            self.outside.is_none() || (whole - 1.0).abs() < 1e-5,
            "{}: the density integrates to {whole}",
            self.name
        );
        assert!(total < 1.0 + 1e-5, "{}: {total}", self.name);
    }

    /// Checks that a sampler with another density is noticed.
    pub(crate) fn is_refused(&self, seed: u32) {
        let (probability, _) = self.probability_and_total(seed);
        assert!(probability < 1e-6, "{} passes: {probability}", self.name);
    }
}

pub(crate) fn part((from, to): (f64, f64), index: usize, parts: usize) -> (f64, f64) {
    let step = (to - from) / parts as f64;
    (from + index as f64 * step, from + (index + 1) as f64 * step)
}

pub(crate) fn cell_of(x: f64, (from, to): (f64, f64), parts: usize) -> usize {
    let place = ((x - from) / (to - from) * parts as f64) as usize;
    place.min(parts - 1)
}

/// Azimuth in turns, [0, 1].
pub(crate) fn turns(direction: DVec3) -> f64 {
    (direction.y.atan2(direction.x) / TAU).rem_euclid(1.0)
}

pub(crate) fn direction(cosine: f64, turns: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let (sin_phi, cos_phi) = (TAU * turns).sin_cos();
    DVec3::new(sine * cos_phi, sine * sin_phi, cosine)
}

#[test]
fn probabilities_of_chi_square_agree_with_tables() {
    // Upper 5 %, 1 % and 0.1 % points (Abramowitz and Stegun, table 26.8).
    for (chi2, freedom, expected) in [
        (43.773, 30.0, 0.05),
        (50.892, 30.0, 0.01),
        (59.703, 30.0, 0.001),
        (124.342, 100.0, 0.05),
        (149.449, 100.0, 0.001),
    ] {
        let found = probability(chi2, freedom);
        assert!((found / expected - 1.0).abs() < 0.03, "{found} {expected}");
    }
}
