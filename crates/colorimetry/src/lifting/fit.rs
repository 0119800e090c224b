//! Fits the coefficients of a reflectance to a color.

use super::{SigmoidReflectance, place};
use crate::chromaticity::{xy_of_xyz, xyz_from_rgb_of};
use crate::matrix::{Matrix3, inverse, times};
use crate::srgb::PRIMARIES;
use crate::tristimulus::{Rule, Weights};
use pulp::{Arch, Simd, WithSimd};
use spectra::Observer;
use std::sync::OnceLock;

/// The largest number of steps of a fit.
const MAX_STEPS: u32 = 60;
/// A residual below this, in linear sRGB, is accepted as 0.
const GOOD_ENOUGH: f64 = 1e-6;
/// The starting gray is limited to this and 1 minus this.
const DARKEST: f64 = 1e-3;
/// The largest magnitude of a coefficient; beyond it a reflectance hardly changes.
const LARGEST: f64 = 2000.0;

/// Computes linear sRGB of reflectances, by sums at 5 nm under D65.
#[derive(Clone, Debug)]
pub(super) struct Colors {
    arch: Arch,
    /// t at each wavelength, padded with positions of weight 0.
    places: Vec<f64>,
    /// The weights of red, green and blue at these wavelengths, then the same times t, and times t².
    weights: [Vec<f64>; 9],
    /// Linear sRGB of a reflectance of 1/2.
    half: [f64; 3],
}

/// A reflectance, its color in linear sRGB, and the derivatives of the color with respect to the coefficients: a row per channel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    pub(super) coefficients: [f64; 3],
    pub(super) rgb: [f64; 3],
    jacobian: Matrix3,
}

/// Lists are padded to a multiple of this, which is a multiple of the lanes of every vector type.
const MAX_LANES: usize = 8;

impl Colors {
    /// The instance that all fits share.
    pub(super) fn shared() -> &'static Self {
        static SHARED: OnceLock<Colors> = OnceLock::new();
        SHARED.get_or_init(Self::new)
    }

    fn new() -> Self {
        let d65 = spectra::illuminant("D65").expect("D65 is built in");
        let weights = Weights::new(&d65.data, Observer::Cie1931Deg2, Rule::FiveNm);
        let weights = weights.expect("D65 covers the visible range");
        let white = xy_of_xyz(weights.white());
        let rgb_from_xyz = inverse(&xyz_from_rgb_of(PRIMARIES, white));
        let wavelengths = Rule::FiveNm.wavelengths_nm();
        let mut terms: Vec<(f64, [f64; 3])> = wavelengths
            .zip(weights.per_wavelength())
            .map(|(nm, &xyz)| (place(nm), times(&rgb_from_xyz, xyz)))
            .collect();
        terms.resize(terms.len().next_multiple_of(MAX_LANES), (0.0, [0.0; 3]));
        let list = |index: usize| {
            let power = (index / 3) as i32;
            let terms = terms.iter();
            terms.map(move |(t, weight)| weight[index % 3] * t.powi(power))
        };
        Self {
            arch: Arch::new(),
            places: terms.iter().map(|(t, _)| *t).collect(),
            weights: std::array::from_fn(|index| list(index).collect()),
            half: std::array::from_fn(|color| 0.5 * list(color).sum::<f64>()),
        }
    }

    /// Computes the color and derivatives of a reflectance.
    pub(super) fn known(&self, coefficients: [f64; 3]) -> Known {
        let sums = self.arch.dispatch(Sums {
            colors: self,
            coefficients,
        });
        Known {
            coefficients,
            rgb: std::array::from_fn(|i| self.half[i] + 0.5 * sums[i]),
            jacobian: std::array::from_fn(|i| [sums[9 + i], sums[6 + i], sums[3 + i]]),
        }
    }
}

/// With x the quadratic: the weighted sums of x/√(1 + x²), and the sums of its derivative by 2x, (1 + x²)^(−3/2) / 2, with the weights
/// times 1, t and t².
struct Sums<'a> {
    colors: &'a Colors,
    coefficients: [f64; 3],
}

impl WithSimd for Sums<'_> {
    type Output = [f64; 12];

    #[expect(
        clippy::inline_always,
        reason = "vector operations are fast only when inlined into code compiled for their instruction set"
    )]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [f64; 12] {
        let [c0, c1, c2] = self.coefficients.map(|c| simd.splat_f64s(c));
        let [one, half] = [1.0, 0.5].map(|x| simd.splat_f64s(x));
        let (places, _) = S::as_simd_f64s(&self.colors.places);
        let weights = self
            .colors
            .weights
            .each_ref()
            .map(|list| S::as_simd_f64s(list).0);
        let mut sums = [simd.splat_f64s(0.0); 12];
        for (i, &t) in places.iter().enumerate() {
            let x = simd.mul_add_e_f64s(simd.mul_add_e_f64s(c0, t, c1), t, c2);
            let cosine = simd.div_f64s(one, simd.sqrt_f64s(simd.mul_add_e_f64s(x, x, one)));
            let sine = simd.mul_f64s(x, cosine);
            let square = simd.mul_f64s(cosine, cosine);
            let slope = simd.mul_f64s(simd.mul_f64s(half, cosine), square);
            for color in 0..3 {
                sums[color] = simd.mul_add_e_f64s(weights[color][i], sine, sums[color]);
            }
            for moment in 0..9 {
                let sum = &mut sums[3 + moment];
                *sum = simd.mul_add_e_f64s(weights[moment][i], slope, *sum);
            }
        }
        sums.map(|sum| simd.reduce_sum_f64s(sum))
    }
}

/// Fits a reflectance to a color in \[0, 1\]³ by the Levenberg–Marquardt method, starting from a gray with the mean of its channels.
pub(super) fn fit(colors: &Colors, rgb: [f64; 3]) -> Fit {
    // S⁻¹(g) = (g − 1/2) / √(g (1 − g)), kept away from 0 and 1, where the derivatives vanish.
    let gray = (rgb.iter().sum::<f64>() / 3.0).clamp(DARKEST, 1.0 - DARKEST);
    let flat = [0.0, 0.0, (gray - 0.5) / (gray * (1.0 - gray)).sqrt()];
    fit_from(colors, rgb, colors.known(flat))
}

/// The result of a fit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    pub(super) reflectance: SigmoidReflectance,
    /// The last reflectance whose color was computed, at most a short step from the result.
    pub(super) last: Known,
    /// Whether the reflectance has the requested color.
    pub(super) is_good: bool,
}

/// Fits a reflectance to a color from a given start.
pub(super) fn fit_from(colors: &Colors, rgb: [f64; 3], start: Known) -> Fit {
    let mut best = start;
    let mut error = residual(rgb, best.rgb);
    let mut before = f64::INFINITY;
    let mut damping = 1e-6;
    for _ in 0..MAX_STEPS {
        if squares(error) < GOOD_ENOUGH * GOOD_ENOUGH || damping > 1e12 {
            break;
        }
        let step = damped_step(&best.jacobian, error, damping);
        let next: [f64; 3] =
            std::array::from_fn(|i| (best.coefficients[i] + step[i]).clamp(-LARGEST, LARGEST));
        if is_last_step(squares(error), before) && next.iter().all(|c| c.abs() < LARGEST) {
            let reflectance = SigmoidReflectance { coefficients: next };
            return Fit {
                reflectance,
                last: best,
                is_good: true,
            };
        }
        let next = colors.known(next);
        let next_error = residual(rgb, next.rgb);
        if squares(next_error) < squares(error) {
            before = squares(error);
            (best, error) = (next, next_error);
            damping *= 0.1;
        } else {
            damping = (damping * 10.0).max(1e-9);
        }
    }
    Fit {
        reflectance: SigmoidReflectance {
            coefficients: best.coefficients,
        },
        last: best,
        is_good: squares(error) < GOOD_ENOUGH * GOOD_ENOUGH,
    }
}

/// Whether the next step leaves an error below a third of [`GOOD_ENOUGH`], assuming that the steps converge and that it reduces the error
/// by at least the same factor as the step before it. Both arguments are squared errors.
fn is_last_step(error: f64, before: f64) -> bool {
    error * error < (GOOD_ENOUGH / 3.0).powi(2) * before && before.is_finite()
}

fn residual(wanted: [f64; 3], found: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| wanted[i] - found[i])
}

fn squares(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum()
}

/// Returns the damped step (JᵀJ + μ diag JᵀJ)⁻¹ Jᵀ e.
fn damped_step(jacobian: &Matrix3, error: [f64; 3], damping: f64) -> [f64; 3] {
    let column = |i: usize| jacobian.map(|row| row[i]);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let mut normal: Matrix3 =
        std::array::from_fn(|i| std::array::from_fn(|j| dot(column(i), column(j))));
    for (i, row) in normal.iter_mut().enumerate() {
        row[i] *= 1.0 + damping;
    }
    let right = std::array::from_fn(|i| dot(column(i), error));
    times(&inverse(&normal), right)
}
