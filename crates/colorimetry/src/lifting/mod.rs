//! Smooth reflectances for RGB colors: "lifting".
//!
//! W. Jakob and J. Hanika, A Low-Dimensional Function Space for Efficient Spectral Upsampling, Computer Graphics Forum 38 (2),
//! 2019: a reflectance is the sigmoid of a quadratic in wavelength,
//!
//! R(λ) = S(c₀ t² + c₁ t + c₂), S(x) = 1/2 + x / (2 √(1 + x²)) (equations 4 and 5), with t = (λ − 580 nm) / 200 nm here.
//!
//! It always lies between 0 and 1, and every color of linear sRGB within \[0, 1\]³ has one. The authors tabulate coefficients
//! and interpolate; here each color's own are worked out by their method of fitting (section 4), which takes microseconds and is
//! exact. A color is what the reflectance has under D65 for the observer of 1931, and (1, 1, 1) is the perfect reflector's: grays
//! come out flat.
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
    /// Where t is 0, nm.
    pub const MIDDLE_NM: f64 = 580.0;
    /// By how much λ grows from t = 0 to t = 1, nm.
    pub const HALF_RANGE_NM: f64 = 200.0;

    /// The reflectance of a color in linear sRGB. What lies outside \[0, 1\] is taken to the nearest end.
    pub fn of_linear_srgb(rgb: [f64; 3]) -> Self {
        fit(Colors::shared(), within(rgb)).reflectance
    }

    /// Its color in linear sRGB.
    pub fn linear_srgb(self) -> [f64; 3] {
        Colors::shared().known(self.coefficients).rgb
    }

    /// The reflectance at a wavelength, from 0 to 1.
    pub fn at(self, nm: f64) -> f64 {
        let t = place(nm);
        let [c0, c1, c2] = self.coefficients;
        sigmoid((c0 * t + c1) * t + c2)
    }
}

/// Reflectances of colors one after another, each found sooner where it is near the one before.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lifting {
    /// The color before, its reflectance, and where its fit ended.
    before: Option<([f64; 3], SigmoidReflectance, Known)>,
}

impl Lifting {
    /// The reflectance of the next color in linear sRGB, like [`SigmoidReflectance::of_linear_srgb`]'s.
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

/// t of a wavelength.
fn place(nm: f64) -> f64 {
    (nm - SigmoidReflectance::MIDDLE_NM) / SigmoidReflectance::HALF_RANGE_NM
}

/// S(x), without cancellation where it is small.
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

    /// ΔE2000 between colors and what their reflectances have by sums at 1 nm, the largest over steps of 1/16 of the codes.
    fn largest_error(lift: impl Fn([f64; 3]) -> SigmoidReflectance) -> f64 {
        const STEPS: u32 = 16;
        let d65 = spectra::illuminant("D65").unwrap().data;
        let light = Weights::new(&d65, Observer::Cie1931Deg2, Rule::OneNm).unwrap();
        let white = light.white();
        let error = |rgb: [f64; 3]| {
            let reflectance = lift(rgb);
            let found = light.xyz((380..=780).map(|nm| reflectance.at(f64::from(nm))));
            // The standard's white has four decimals of x and y; the perfect reflector is white here.
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

    /// Smooth: no reflectance turns more than once, and all stay within 0 to 1 far outside what is seen.
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

    /// Small steps, leaps, repetitions and the ends: each color comes back, whatever was before it.
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
