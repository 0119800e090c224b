//! Pixel filters, as tables for importance sampling: every sample then has the weight 1, wherever it is.

use crate::rounding::RoundToF32;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use spectra::linear;
use std::f64::consts::PI;

/// The reconstruction filter of the pixels: the same profile in x and in y, centered on the pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Filter {
    /// Constant over the pixel's own square.
    #[default]
    Box,
    /// A Gaussian with a standard deviation of half a pixel, truncated at 1.5 pixels.
    Gaussian,
    /// The Blackman–Harris window, 3 pixels wide (Harris, Proc. IEEE 66, 1978, four terms, −92 dB).
    BlackmanHarris,
}

/// The distribution of a pixel's samples about its center, the same in x and in y.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelFilter(Option<Vec<f64>>);

/// Half the width of the filters that are not a box, in pixels.
const RADIUS: f64 = 1.5;
/// Standard deviation of the Gaussian, in pixels.
const SIGMA: f64 = 0.5;
/// Number of steps of the numerical integral of a filter.
const STEPS: usize = 60_000;

impl PixelFilter {
    /// Number of knots.
    pub const KNOTS: usize = 257;

    /// The table of a filter.
    pub fn new(filter: Filter) -> Self {
        match filter {
            Filter::Box => Self(None),
            Filter::Gaussian => Self(Some(offsets(|x| (-0.5 * (x / SIGMA).powi(2)).exp()))),
            Filter::BlackmanHarris => Self(Some(offsets(blackman_harris))),
        }
    }

    /// Offsets from a pixel's center, in pixels, at knots that are closer where the filter has little weight (equal steps of the square
    /// root that `offset_at` computes); `None` for a box, whose offsets are uniform from −½ to ½.
    pub fn offsets(&self) -> Option<&[f64]> {
        self.0.as_deref()
    }

    /// The offset, in pixels, of a sample with the uniform number `u` in [0, 1), interpolated linearly between the knots.
    pub fn offset_at(&self, u: f64) -> f64 {
        let Some(offsets) = &self.0 else {
            return u - 0.5;
        };
        linear(offsets, warped(u))
    }
}

impl RoundToF32 for PixelFilter {
    fn rounded(&self) -> Self {
        Self(self.0.as_ref().map(RoundToF32::rounded))
    }
}

/// Maps a number so that knots are close where a filter has little weight: t = 2u − 1 becomes ±(1 − √(1 − |t|)), from −1 to 1, which is
/// then mapped to 0 to 1.
fn warped(u: f64) -> f64 {
    let t = 2.0 * u - 1.0;
    0.5 + 0.5 * t.signum() * (1.0 - (1.0 - t.abs()).max(0.0).sqrt())
}

/// The inverse of [`warped`].
fn unwarped(place: f64) -> f64 {
    let s = 2.0 * place - 1.0;
    0.5 + 0.5 * s.signum() * (1.0 - (1.0 - s.abs()).powi(2))
}

/// The minimum four-term window (Harris, On the Use of Windows for Harmonic Analysis with the Discrete Fourier Transform, Proc. IEEE 66(1),
/// 1978, equation 33), 1 at the center.
fn blackman_harris(x: f64) -> f64 {
    let terms = [0.358_75, 0.488_29, 0.141_28, 0.011_68];
    let turn = PI * x / RADIUS;
    let cosines = terms.into_iter().enumerate();
    cosines.map(|(i, a)| a * (i as f64 * turn).cos()).sum()
}

/// The offsets at which the running integral of a filter reaches the knots.
fn offsets(weight: impl Fn(f64) -> f64) -> Vec<f64> {
    let width = 2.0 * RADIUS / STEPS as f64;
    let middle = |step: usize| -RADIUS + (step as f64 + 0.5) * width;
    let whole: f64 = (0..STEPS).map(|step| weight(middle(step))).sum();
    let part = |knot: usize| unwarped(knot as f64 / (PixelFilter::KNOTS - 1) as f64);
    let mut found = vec![-RADIUS];
    let mut sum = 0.0;
    for step in 0..STEPS {
        let own = weight(middle(step)) / whole;
        while part(found.len()) <= sum + own && found.len() < PixelFilter::KNOTS - 1 {
            let inside = (part(found.len()) - sum) / own;
            found.push(middle(step) + (inside - 0.5) * width);
        }
        sum += own;
    }
    found.push(RADIUS);
    // The filters are even; averaging with the mirrored offsets removes the asymmetry of rounding errors.
    let mirrored = found.iter().rev().map(|x| -x);
    found
        .iter()
        .zip(mirrored)
        .map(|(a, b)| 0.5 * (a + b))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Mean of a power of the offset over uniform numbers.
    fn moment(filter: &PixelFilter, power: i32) -> f64 {
        let count = 100_000;
        let at = |i: i32| filter.offset_at((f64::from(i) + 0.5) / f64::from(count));
        (0..count).map(|i| at(i).powi(power)).sum::<f64>() / f64::from(count)
    }

    /// Variances: 1/12 for a box; σ² (1 − 2 a φ(a) / (2Φ(a) − 1)) = 0.973 337 σ² for the Gaussian, cut off at a = 3 deviations; r² (1/3 + Σ
    /// 2 aₖ (−1)ᵏ / (a₀ (kπ)²)) for the window, by its integrals.
    #[test]
    fn the_spread_is_that_of_the_filter() {
        let box_filter = PixelFilter::new(Filter::Box);
        assert!((moment(&box_filter, 2) - 1.0 / 12.0).abs() < 1e-6);
        let gaussian = PixelFilter::new(Filter::Gaussian);
        let expected = 0.973_337 * SIGMA * SIGMA;
        let found = moment(&gaussian, 2);
        assert!((found / expected - 1.0).abs() < 2e-3, "{found} {expected}");
        let window = PixelFilter::new(Filter::BlackmanHarris);
        let terms = [(1.0, 0.488_29), (2.0, 0.141_28), (3.0, 0.011_68)];
        let sum: f64 = terms
            .iter()
            .map(|&(k, a)| 2.0 * a * (k * PI).cos() / (0.358_75 * (k * PI).powi(2)))
            .sum();
        let expected = RADIUS * RADIUS * (1.0 / 3.0 + sum);
        let found = moment(&window, 2);
        assert!((found / expected - 1.0).abs() < 2e-3, "{found} {expected}");
        for filter in [box_filter, gaussian, window] {
            assert!(moment(&filter, 1).abs() < 1e-9);
            assert!(filter.offset_at(0.5).abs() < 1e-12);
        }
    }

    /// Chi-square of the offsets against the filter itself, over 30 cells of equal width: 29 degrees of freedom, at the 0.1 % level. The
    /// table's error is far below the noise of 20 000 samples.
    #[test]
    fn samples_are_spread_by_the_filter() {
        let chi2 = |filter: &PixelFilter, weight: &dyn Fn(f64) -> f64| {
            const CELLS: usize = 30;
            let width = 2.0 * RADIUS / CELLS as f64;
            let mut met = [0.0; CELLS];
            let count = 20_000;
            for i in 0..count {
                let u = (f64::from(i) * (TAU.sqrt() - 1.0)).fract();
                met[((filter.offset_at(u) + RADIUS) / width) as usize] += 1.0;
            }
            let fine = |cell: usize| {
                let at = |i: i32| -RADIUS + width * (cell as f64 + (f64::from(i) + 0.5) / 100.0);
                (0..100).map(|i| weight(at(i))).sum::<f64>()
            };
            let whole: f64 = (0..CELLS).map(fine).sum();
            let of_cell = |cell: usize| {
                let expected = f64::from(count) * fine(cell) / whole;
                (met[cell] - expected).powi(2) / expected.max(1.0)
            };
            (0..CELLS).map(of_cell).sum::<f64>()
        };
        let normal = |x: f64| (-0.5 * (x / SIGMA).powi(2)).exp();
        let gaussian = PixelFilter::new(Filter::Gaussian);
        let window = PixelFilter::new(Filter::BlackmanHarris);
        assert!(chi2(&gaussian, &normal) < 58.3);
        assert!(chi2(&window, &blackman_harris) < 58.3);
        assert!(
            chi2(&gaussian, &blackman_harris) > 58.3,
            "another filter is noticed"
        );
    }
}
