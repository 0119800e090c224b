//! Gamut mapping at constant hue and lightness in Oklab.

use colorimetry::matrix::{inverse, product, times};
use colorimetry::oklab::{LAB_FROM_ROOTS, LMS_FROM_XYZ};
use colorimetry::{Display, Matrix3};

use super::Gamut;

/// A display's primaries in Oklab, adapted to its white.
///
/// Oklab is defined for the white D65. Its responses are divided here by the responses to the display's white (von Kries 1902),
/// so that the grays of every display are the grays of the space; for a display of white D65 that changes nothing.
///
/// If l, m, s are the responses, Oklab is linear in their roots r = (∛l, ∛m, ∛s), and its gray of lightness L is r = (L, L, L).
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

    /// Returns the color of the same hue and lightness with the most chroma that the display can show, at most the chroma of
    /// `rgb`. A color darker or lighter than every gray of the display takes the lightness of the nearest gray.
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

/// The cubic c₀ + c₁ t + c₂ t² + c₃ t³.
#[derive(Clone, Copy, Debug)]
struct Cubic([f64; 4]);

impl Cubic {
    /// Returns Σ mᵢ (L + t kᵢ)³, where m is a row of the matrix from responses to a channel.
    fn along(m: [f64; 3], l: f64, k: [f64; 3]) -> Self {
        let moment = |power: i32| -> f64 { (0..3).map(|i| m[i] * k[i].powi(power)).sum() };
        // Each row of the matrix sums to 1, so gray stays gray.
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

    /// Returns the smallest root above 0 of a cubic that is not negative at 0, or `end` if there is no root before it.
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

    /// Returns the turning points of the cubic between 0 and `end` in ascending order, and then `end` itself.
    fn turns_before(self, end: f64) -> impl Iterator<Item = f64> {
        let Self([_, c1, c2, c3]) = self;
        // c₁ + 2 c₂ t + 3 c₃ t² = 0, solved without cancellation (Press et al., Numerical Recipes, section 5.6).
        let q = -(c2 + (c2 * c2 - 3.0 * c1 * c3).sqrt().copysign(c2));
        let (a, b) = (q / (3.0 * c3), c1 / q);
        // Turning points that are NaN or out of range are dropped.
        [a.min(b), a.max(b)]
            .into_iter()
            .filter(move |&t| t > 0.0 && t < end)
            .chain([end])
    }

    /// Returns the root between a point where the cubic is not negative and one where it is negative, with no turning point
    /// between them: Newton's method, with bisection where a step leaves the interval. The point returned is on the side that is
    /// not negative, up to rounding.
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
