//! Constant hue and lightness in Oklab.

use colorimetry::matrix::{inverse, product, times};
use colorimetry::oklab::{LAB_FROM_ROOTS, LMS_FROM_XYZ};
use colorimetry::{Display, Matrix3};

use super::Gamut;

/// A display's primaries in Oklab, adapted to its white.
///
/// Oklab is made for the white D65. Its responses are divided here by those to the display's white (von Kries 1902), so that the
/// grays of every display are the grays of the space; for a display of white D65 that changes nothing.
///
/// With l, m, s the responses, Oklab is linear in their roots r = (∛l, ∛m, ∛s), and its gray of lightness L is r = (L, L, L).
/// A line of constant hue and lightness is therefore r = L + t k, and red, green and blue along it are cubics in t.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Perceptual {
    lms_from_rgb: Matrix3,
    rgb_from_lms: Matrix3,
}

impl Perceptual {
    pub(super) fn new(display: &Display) -> Self {
        let lms_from_rgb = product(&LMS_FROM_XYZ, display.xyz_from_rgb());
        let lms_from_rgb = lms_from_rgb.map(|row| {
            let white: f64 = row.iter().sum();
            row.map(|v| v / white)
        });
        Self {
            rgb_from_lms: inverse(&lms_from_rgb),
            lms_from_rgb,
        }
    }

    /// The most chroma that the display shows of a color's hue and lightness, of that color's chroma at most. A color darker
    /// or lighter than every gray of the display takes the lightness of the nearest gray.
    pub(super) fn map(&self, rgb: [f64; 3], gamut: &Gamut) -> [f64; 3] {
        let roots = times(&self.lms_from_rgb, rgb).map(f64::cbrt);
        let lightness: f64 = (0..3).map(|i| LAB_FROM_ROOTS[0][i] * roots[i]).sum();
        let [darkest, lightest] = gamut.grays().map(f64::cbrt);
        let gray = lightness.max(darkest).min(lightest);
        let k = roots.map(|root| root - lightness);
        let channels: [Cubic; 3] = self.rgb_from_lms.map(|row| Cubic::along(row, gray, k));

        let mut end = 1.0;
        for (i, channel) in channels.iter().enumerate() {
            end = channel.minus(gamut.low[i]).stays_positive_to(end);
            end = channel
                .minus(gamut.high[i])
                .negated()
                .stays_positive_to(end);
        }
        channels.map(|channel| channel.at(end))
    }
}

/// c₀ + c₁ t + c₂ t² + c₃ t³.
#[derive(Clone, Copy, Debug)]
struct Cubic([f64; 4]);

impl Cubic {
    /// Σ mᵢ (L + t kᵢ)³ with m a row of the matrix from responses to a channel.
    fn along(m: [f64; 3], l: f64, k: [f64; 3]) -> Self {
        let moment = |power: i32| -> f64 { (0..3).map(|i| m[i] * k[i].powi(power)).sum() };
        // The rows of the matrix have the sum 1: gray is gray.
        Self([
            l * l * l,
            3.0 * l * l * moment(1),
            3.0 * l * moment(2),
            moment(3),
        ])
    }

    fn at(self, t: f64) -> f64 {
        let Self([c0, c1, c2, c3]) = self;
        ((c3 * t + c2) * t + c1) * t + c0
    }

    fn minus(mut self, value: f64) -> Self {
        self.0[0] -= value;
        self
    }

    fn negated(self) -> Self {
        Self(self.0.map(|c| -c))
    }

    /// How far from 0 the cubic, which is not negative there, stays so: the smallest root, or `end` if there is none before it.
    fn stays_positive_to(self, end: f64) -> f64 {
        let mut from = 0.0;
        for to in self.turns_before(end) {
            if self.at(to) < 0.0 {
                return self.root_between(from, to);
            }
            from = to;
        }
        end
    }

    /// Where the cubic changes direction between 0 and `end`, rising, and `end` itself.
    fn turns_before(self, end: f64) -> impl Iterator<Item = f64> {
        let Self([_, c1, c2, c3]) = self;
        // c₁ + 2 c₂ t + 3 c₃ t² = 0, in the form that loses no digits (Press et al., Numerical Recipes, section 5.6).
        let q = -(c2 + (c2 * c2 - 3.0 * c1 * c3).sqrt().copysign(c2));
        let (a, b) = (q / (3.0 * c3), c1 / q);
        // Turns that are not numbers, or outside, drop out.
        [a.min(b), a.max(b)]
            .into_iter()
            .filter(move |&t| t > 0.0 && t < end)
            .chain([end])
    }

    /// The root between a place where the cubic is not negative and one where it is, with no turn between them: Newton's steps,
    /// and halves where they lead out. The place returned is on the side that is not negative, up to rounding.
    fn root_between(self, mut inside: f64, mut outside: f64) -> f64 {
        let Self([_, c1, c2, c3]) = self;
        let mut t = 0.5 * (inside + outside);
        for _ in 0..60 {
            let value = self.at(t);
            if value < 0.0 {
                outside = t;
            } else {
                inside = t;
            }
            if outside - inside < 1e-12 || value == 0.0 {
                break;
            }
            let next = t - value / ((3.0 * c3 * t + 2.0 * c2) * t + c1);
            if (next - t).abs() < 1e-13 {
                return next.max(inside).min(outside);
            }
            t = if next > inside && next < outside {
                next
            } else {
                0.5 * (inside + outside)
            };
        }
        inside
    }
}
