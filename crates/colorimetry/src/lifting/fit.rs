//! Finding the coefficients of a colour.

use super::{SigmoidReflectance, place, sigmoid};
use crate::chromaticity::xy_of_xyz;
use crate::display::xyz_from_rgb_of;
use crate::matrix::{Matrix3, inverse, times};
use crate::srgb::PRIMARIES;
use crate::tristimulus::{Rule, Weights};
use spectra::Observer;
use std::sync::OnceLock;

/// The most steps of a fit.
const MOST_STEPS: u32 = 60;
/// A residual below this, in linear sRGB, is none.
const GOOD_ENOUGH: f64 = 1e-6;
/// The start is a grey from this to 1 minus this.
const DARKEST: f64 = 1e-3;
/// Coefficients stay within this: a reflectance hardly changes beyond it.
const LARGEST: f64 = 2000.0;

/// What a reflectance is in linear sRGB: sums at 5 nm under D65.
#[derive(Clone, Debug)]
pub(super) struct Colours {
    /// t and the weights of red, green and blue at each wavelength.
    terms: Vec<(f64, [f64; 3])>,
}

impl Colours {
    /// The one that all fits share.
    pub(super) fn shared() -> &'static Self {
        static SHARED: OnceLock<Colours> = OnceLock::new();
        SHARED.get_or_init(Self::new)
    }

    fn new() -> Self {
        let d65 = spectra::illuminant("D65").expect("carried by the project");
        let weights = Weights::new(&d65.data, Observer::Cie1931Deg2, Rule::FiveNm);
        let weights = weights.expect("D65 covers what is visible");
        let white = xy_of_xyz(weights.white());
        let rgb_from_xyz = inverse(&xyz_from_rgb_of(PRIMARIES, white));
        let wavelengths = Rule::FiveNm.wavelengths_nm();
        let terms = wavelengths.zip(weights.per_wavelength());
        Self {
            terms: terms
                .map(|(nm, &xyz)| (place(nm), times(&rgb_from_xyz, xyz)))
                .collect(),
        }
    }

    /// Linear sRGB of a reflectance.
    pub(super) fn of(&self, reflectance: SigmoidReflectance) -> [f64; 3] {
        self.with_derivatives(reflectance.coefficients).0
    }

    /// Linear sRGB of a reflectance, and its derivatives by the coefficients: a row for each colour.
    fn with_derivatives(&self, [c0, c1, c2]: [f64; 3]) -> ([f64; 3], Matrix3) {
        let mut rgb = [0.0; 3];
        let mut jacobian = [[0.0; 3]; 3];
        for &(t, weight) in &self.terms {
            let x = (c0 * t + c1) * t + c2;
            let value = sigmoid(x);
            // dS/dx = (1 + x²)^(−3/2) / 2.
            let root = (1.0 + x * x).sqrt();
            let slope = 0.5 / (root * root * root);
            for colour in 0..3 {
                rgb[colour] += weight[colour] * value;
                let part = weight[colour] * slope;
                jacobian[colour][0] += part * t * t;
                jacobian[colour][1] += part * t;
                jacobian[colour][2] += part;
            }
        }
        (rgb, jacobian)
    }
}

/// The reflectance of a colour in \[0, 1\]³, by the method of Levenberg and Marquardt from a grey that is as bright.
pub(super) fn fit(colours: &Colours, rgb: [f64; 3]) -> SigmoidReflectance {
    // S⁻¹(g) = (g − 1/2) / √(g (1 − g)), kept from the ends, where the derivatives vanish.
    let grey = (rgb.iter().sum::<f64>() / 3.0).clamp(DARKEST, 1.0 - DARKEST);
    let flat = [0.0, 0.0, (grey - 0.5) / (grey * (1.0 - grey)).sqrt()];
    fit_from(colours, rgb, SigmoidReflectance { coefficients: flat }).0
}

/// The same from another start, and whether it came to the colour.
pub(super) fn fit_from(
    colours: &Colours,
    rgb: [f64; 3],
    start: SigmoidReflectance,
) -> (SigmoidReflectance, bool) {
    let mut best = start.coefficients;
    let (found, mut jacobian) = colours.with_derivatives(best);
    let mut error = residual(rgb, found);
    let mut damping = 1e-6;
    for _ in 0..MOST_STEPS {
        if squares(error) < GOOD_ENOUGH * GOOD_ENOUGH || damping > 1e12 {
            break;
        }
        let step = damped_step(&jacobian, error, damping);
        let next = std::array::from_fn(|i| (best[i] + step[i]).clamp(-LARGEST, LARGEST));
        let (next_found, next_jacobian) = colours.with_derivatives(next);
        let next_error = residual(rgb, next_found);
        if squares(next_error) < squares(error) {
            (best, jacobian, error) = (next, next_jacobian, next_error);
            damping *= 0.1;
        } else {
            damping = (damping * 10.0).max(1e-9);
        }
    }
    let is_good = squares(error) < GOOD_ENOUGH * GOOD_ENOUGH;
    (SigmoidReflectance { coefficients: best }, is_good)
}

fn residual(wanted: [f64; 3], found: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| wanted[i] - found[i])
}

fn squares(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum()
}

/// (JᵀJ + μ diag JᵀJ)⁻¹ Jᵀ e.
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
