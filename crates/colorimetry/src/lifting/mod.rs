//! Smooth reflectances for RGB colors: spectral upsampling, or "lifting".
//!
//! W. Jakob and J. Hanika, A Low-Dimensional Function Space for Efficient Spectral Upsampling, Computer Graphics Forum 38 (2),
//! 2019: a reflectance is the sigmoid of a quadratic in wavelength,
//!
//! R(λ) = S(c₀ t² + c₁ t + c₂), S(x) = 1/2 + x / (2 √(1 + x²)) (equations 4 and 5), with t = (λ − 580 nm) / 200 nm here.
//!
//! R is always between 0 and 1, and every color of linear sRGB within \[0, 1\]³ has such a reflectance. The authors tabulate and
//! interpolate coefficients; here they are fitted to each color by their method (section 4), which takes microseconds and is exact.
//! Colors are those of the reflectance under D65 for the observer of 1931, and (1, 1, 1) is the perfect reflector: grays have flat
//! reflectances.
//!
//! ```
//! use pellicle_colorimetry::lifting::SigmoidReflectance;
//!
//! let leaf = SigmoidReflectance::of_linear_srgb([0.05, 0.2, 0.03]);
//! assert!(leaf.at(550.0) > 3.0 * leaf.at(450.0));
//! assert!((leaf.linear_srgb()[1] - 0.2).abs() < 1e-5);
//! ```

mod fit;

use fit::{Colors, Known, fit, fit_from};

/// The sigmoid of a quadratic in wavelength: a smooth reflectance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SigmoidReflectance {
    /// c₀, c₁, c₂.
    pub coefficients: [f64; 3],
}

impl SigmoidReflectance {
    /// The wavelength where t is 0, nm.
    pub const MIDDLE_NM: f64 = 580.0;
    /// The range of λ from t = 0 to t = 1, nm.
    pub const HALF_RANGE_NM: f64 = 200.0;

    /// Returns the reflectance of a color in linear sRGB. Values outside \[0, 1\] are clamped.
    pub fn of_linear_srgb(rgb: [f64; 3]) -> Self {
        fit(Colors::shared(), within(rgb)).reflectance
    }

    /// Returns the color of the reflectance in linear sRGB.
    pub fn linear_srgb(self) -> [f64; 3] {
        Colors::shared().known(self.coefficients).rgb
    }

    /// Returns the reflectance at a wavelength, from 0 to 1.
    pub fn at(self, nm: f64) -> f64 {
        let t = place(nm);
        let [c0, c1, c2] = self.coefficients;
        sigmoid((c0 * t + c1) * t + c2)
    }
}

/// Computes reflectances for a sequence of colors, faster when a color is near the previous one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lifting {
    /// The previous color, its reflectance, and where its fit ended.
    before: Option<([f64; 3], SigmoidReflectance, Known)>,
}

impl Lifting {
    /// Returns the reflectance of the next color in linear sRGB, as [`SigmoidReflectance::of_linear_srgb`] does.
    pub fn next(&mut self, rgb: [f64; 3]) -> SigmoidReflectance {
        let (colors, rgb) = (Colors::shared(), within(rgb));
        let near = match self.before {
            Some((before, reflectance, _)) if before == rgb => return reflectance,
            Some((_, _, known)) => Some(fit_from(colors, rgb, known)),
            None => None,
        };
        let near = near.filter(|fit| fit.is_good);
        let found = near.unwrap_or_else(|| fit(colors, rgb));
        self.before = Some((rgb, found.reflectance, found.last));
        found.reflectance
    }
}

fn within(rgb: [f64; 3]) -> [f64; 3] {
    rgb.map(|value| value.clamp(0.0, 1.0))
}

/// Returns t of a wavelength.
fn place(nm: f64) -> f64 {
    (nm - SigmoidReflectance::MIDDLE_NM) / SigmoidReflectance::HALF_RANGE_NM
}

/// Returns S(x), without cancellation where S is small.
fn sigmoid(x: f64) -> f64 {
    let root = (1.0 + x * x).sqrt();
    let tail = 0.5 / (root * (root + x.abs()));
    if x < 0.0 { tail } else { 1.0 - tail }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{Lab, delta_e_2000};
    use crate::srgb;
    use crate::tristimulus::{Rule, Weights};
    use spectra::Observer;

    /// The largest ΔE2000 between colors and those of their reflectances by sums at 1 nm, over codes in steps of 1/16.
    fn largest_error(lift: impl Fn([f64; 3]) -> SigmoidReflectance) -> f64 {
        const STEPS: u32 = 16;
        let d65 = spectra::illuminant("D65").unwrap().data;
        let light = Weights::new(&d65, Observer::Cie1931Deg2, Rule::OneNm).unwrap();
        let white = light.white();
        let error = |rgb: [f64; 3]| {
            let reflectance = lift(rgb);
            let found = light.xyz((380..=780).map(|nm| reflectance.at(f64::from(nm))));
            // The white of the standard is rounded to four decimals of x and y; here the perfect reflector is white.
            let xyz = srgb::xyz_from_linear(rgb);
            let wanted = std::array::from_fn(|i| xyz[i] * white[i] / srgb::white_xyz()[i]);
            delta_e_2000(Lab::from_xyz(found, white), Lab::from_xyz(wanted, white))
        };
        let codes = |i: u32| {
            let code = [
                i % (STEPS + 1),
                i / (STEPS + 1) % (STEPS + 1),
                i / (STEPS + 1).pow(2),
            ];
            code.map(|code| srgb::decode(f64::from(code) / f64::from(STEPS)))
        };
        (0..(STEPS + 1).pow(3))
            .map(codes)
            .map(error)
            .fold(0.0, f64::max)
    }

    #[test]
    fn every_color_of_srgb_comes_back() {
        let error = largest_error(SigmoidReflectance::of_linear_srgb);
        assert!(error < 0.1, "{error}");
    }

    #[test]
    fn a_wrong_reflectance_is_noticed() {
        let error = largest_error(|[r, g, b]| SigmoidReflectance::of_linear_srgb([b, g, r]));
        assert!(error > 10.0, "{error}");
        let shifted = |rgb| {
            let mut reflectance = SigmoidReflectance::of_linear_srgb(rgb);
            reflectance.coefficients[2] *= 1.05;
            reflectance
        };
        assert!(largest_error(shifted) > 0.5);
    }

    #[test]
    fn grays_are_flat_and_black_and_white_are_the_ends() {
        for gray in [0.01, 0.2, 0.5, 0.9] {
            let reflectance = SigmoidReflectance::of_linear_srgb([gray; 3]);
            for nm in [380.0, 550.0, 780.0] {
                assert!((reflectance.at(nm) - gray).abs() < 1e-5, "{gray}");
            }
        }
        for end in [0.0, 1.0] {
            let reflectance = SigmoidReflectance::of_linear_srgb([end; 3]);
            assert!(
                (reflectance.at(550.0) - end).abs() < 1e-5,
                "{reflectance:?}"
            );
        }
        let bright = SigmoidReflectance::of_linear_srgb([7.0, 1.0, f64::INFINITY]);
        assert!(bright.at(550.0) > 0.999);
    }

    /// Reflectances are smooth: none has more than one extremum, and all stay within 0 to 1 far outside the visible range.
    #[test]
    fn reflectances_stay_within_0_and_1() {
        for rgb in [
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.9, 0.9, 0.02],
        ] {
            let reflectance = SigmoidReflectance::of_linear_srgb(rgb);
            let values: Vec<f64> = (300..900).map(|nm| reflectance.at(f64::from(nm))).collect();
            assert!(values.iter().all(|v| (0.0..=1.0).contains(v)), "{rgb:?}");
            let steps = values.windows(2).map(|pair| pair[1] - pair[0]);
            let signs: Vec<f64> = steps.filter(|s| s.abs() > 1e-12).map(f64::signum).collect();
            let turns = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
            assert!(turns <= 1, "{rgb:?}: {turns} turns");
        }
    }

    /// Small steps, jumps, repetitions and the extremes: each color is reproduced, whatever color came before.
    #[test]
    fn colors_one_after_another_come_back() {
        let step = |i: u32| 0.5 * f64::from(i) / 200.0;
        let near = (0..200).map(|i| [0.5, 0.45 - 0.8 * step(i), 0.05 + 0.7 * step(i)]);
        let leaps = (0..200).map(|i| [step(i * 37 % 200), 0.5, step(i * 91 % 200)]);
        let ends = [
            [0.0; 3],
            [1.0; 3],
            [0.5, 0.0, 0.0],
            [0.5, 0.0, 0.0],
            [0.3; 3],
        ];
        let mut lifting = Lifting::default();
        for rgb in near.chain(leaps).chain(ends) {
            let found = lifting.next(rgb).linear_srgb();
            for (found, wanted) in found.iter().zip(rgb) {
                assert!((found - wanted).abs() < 1e-5, "{found} {wanted} of {rgb:?}");
            }
        }
    }
}
