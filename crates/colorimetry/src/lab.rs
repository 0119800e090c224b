//! CIELAB and the color differences ΔE of 1976, 1994 and 2000, all in `f64`.
//!
//! L* is lightness; a* runs from green to red and b* from blue to yellow (CIE 015:2018, section 8.2.1).

use std::f64::consts::PI;

/// A color L*, a*, b* in CIELAB.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lab {
    /// Lightness L*: 0 for black, 100 for the white.
    pub l: f64,
    /// From green (negative) to red.
    pub a: f64,
    /// From blue (negative) to yellow.
    pub b: f64,
}

/// Below (6/29)³ the cube root is replaced by its tangent.
const LINEAR_BELOW: f64 = 216.0 / 24389.0;
/// The tangent's slope, (29/6)²/3.
const SLOPE: f64 = 841.0 / 108.0;

/// The function f of CIELAB: ∛t, or near black its tangent (841/108) t + 4/29.
fn f(t: f64) -> f64 {
    if t > LINEAR_BELOW {
        t.cbrt()
    } else {
        SLOPE * t + 4.0 / 29.0
    }
}

/// The inverse of [`f`].
fn f_inverse(f: f64) -> f64 {
    // f(216/24389) = 6/29.
    if f > 6.0 / 29.0 {
        f.powi(3)
    } else {
        (f - 4.0 / 29.0) / SLOPE
    }
}

/// The derivative df/dt.
fn f_derivative(t: f64) -> f64 {
    if t > LINEAR_BELOW {
        1.0 / (3.0 * t.cbrt().powi(2))
    } else {
        SLOPE
    }
}

impl Lab {
    /// Converts XYZ to CIELAB for a `white` whose XYZ are positive and in the same unit (CIE 015:2018, equations 8.3 to 8.8).
    pub fn from_xyz(xyz: [f64; 3], white: [f64; 3]) -> Self {
        let [x, y, z] = std::array::from_fn(|i| f(xyz[i] / white[i]));
        Self::of_roots(x, y, z, -16.0)
    }

    /// Converts to XYZ in the unit of `white`: the inverse of [`Self::from_xyz`].
    pub fn to_xyz(self, white: [f64; 3]) -> [f64; 3] {
        let y = (self.l + 16.0) / 116.0;
        let roots = [y + self.a / 500.0, y, y - self.b / 200.0];
        std::array::from_fn(|i| white[i] * f_inverse(roots[i]))
    }

    /// Creates a color from lightness L*, chroma C* and hue angle in degrees: the inverse of [`Self::chroma`] and [`Self::hue_deg`].
    pub fn from_lch(l: f64, chroma: f64, hue_deg: f64) -> Self {
        let (sin, cos) = hue_deg.to_radians().sin_cos();
        Self {
            l,
            a: chroma * cos,
            b: chroma * sin,
        }
    }

    /// Returns the derivative of [`Self::from_xyz`] at `xyz` along `d_xyz`.
    pub fn derivative(xyz: [f64; 3], white: [f64; 3], d_xyz: [f64; 3]) -> Self {
        let [x, y, z] =
            std::array::from_fn(|i| f_derivative(xyz[i] / white[i]) * d_xyz[i] / white[i]);
        Self::of_roots(x, y, z, 0.0)
    }

    fn of_roots(x: f64, y: f64, z: f64, offset: f64) -> Self {
        Self {
            l: 116.0 * y + offset,
            a: 500.0 * (x - y),
            b: 200.0 * (y - z),
        }
    }

    /// Chroma C* = √(a*² + b*²).
    pub fn chroma(self) -> f64 {
        self.a.hypot(self.b)
    }

    /// Hue angle in degrees, 0 to 360; 0 for a gray.
    pub fn hue_deg(self) -> f64 {
        hue(self.a, self.b).to_degrees()
    }
}

/// Returns the angle of (a, b) in radians, 0 to 2π; 0 at the origin.
fn hue(a: f64, b: f64) -> f64 {
    let angle = b.atan2(a);
    if angle < 0.0 { angle + 2.0 * PI } else { angle }
}

/// Returns the color difference ΔE*₇₆, the distance in CIELAB (CIE 015:2018, equation 8.17).
pub fn delta_e_76(first: Lab, second: Lab) -> f64 {
    let [l, a, b] = [first.l - second.l, first.a - second.a, first.b - second.b];
    (l * l + a * a + b * b).sqrt()
}

/// Returns the color difference ΔE*₉₄ with k_L = k_C = k_H = 1, for graphic arts (CIE 116-1995). `first` is the standard, whose
/// chroma determines the weights of chroma and hue differences; swapping the colors gives a different number.
pub fn delta_e_94(first: Lab, second: Lab) -> f64 {
    let standard = first.chroma();
    let (dl, dc) = (first.l - second.l, standard - second.chroma());
    let (da, db) = (first.a - second.a, first.b - second.b);
    // Rounding may make it negative.
    let dh2 = (da * da + db * db - dc * dc).max(0.0);
    let (s_c, s_h) = (1.0 + 0.045 * standard, 1.0 + 0.015 * standard);
    (dl * dl + (dc / s_c).powi(2) + dh2 / (s_h * s_h)).sqrt()
}

/// Returns the color difference ΔE₀₀ with k_L = k_C = k_H = 1 (CIE 142-2001; written out, including the branches of the hue,
/// in Sharma, Wu and Dalal, The CIEDE2000 color-difference formula, Color Res. Appl. 30, 21 (2005), equations 2 to 22).
pub fn delta_e_2000(first: Lab, second: Lab) -> f64 {
    let stretch = red_green_stretch(f64::midpoint(first.chroma(), second.chroma()));
    let (a1, a2) = (stretch * first.a, stretch * second.a);
    let (c1, c2) = (a1.hypot(first.b), a2.hypot(second.b));
    let (h1, h2) = (hue(a1, first.b), hue(a2, second.b));

    // A gray has no hue: the hue difference is 0, and the mean hue is that of the other color.
    let is_gray = c1 * c2 == 0.0;
    let turn = h2 - h1;
    let dh = match turn {
        _ if is_gray => 0.0,
        _ if turn > PI => turn - 2.0 * PI,
        _ if turn < -PI => turn + 2.0 * PI,
        _ => turn,
    };
    let mean_hue = match h1 + h2 {
        sum if is_gray => sum,
        sum if turn.abs() <= PI => 0.5 * sum,
        sum if sum < 2.0 * PI => 0.5 * sum + PI,
        sum => 0.5 * sum - PI,
    };
    let dh_chord = 2.0 * (c1 * c2).sqrt() * (0.5 * dh).sin();
    let weights = Weights::at(
        f64::midpoint(first.l, second.l),
        f64::midpoint(c1, c2),
        mean_hue,
    );
    weights.length(second.l - first.l, c2 - c1, dh_chord)
}

/// Returns the rate of change of ΔE₀₀ from `at` per unit of t when CIELAB changes by `d_lab` per unit of t: the limit of
/// ΔE₀₀(at, at + t d_lab) / t for t → 0 from above.
pub fn delta_e_2000_rate(at: Lab, d_lab: Lab) -> f64 {
    // Both colors have the same stretch, so its own change is of second order.
    let stretch = red_green_stretch(at.chroma());
    let (a, da) = (stretch * at.a, stretch * d_lab.a);
    let c = a.hypot(at.b);
    let weights = Weights::at(at.l, c, hue(a, at.b));
    if c == 0.0 {
        return weights.length(d_lab.l, da.hypot(d_lab.b), 0.0);
    }
    let dc = (a * da + at.b * d_lab.b) / c;
    let dh = (a * d_lab.b - at.b * da) / c;
    weights.length(d_lab.l, dc, dh)
}

/// The factor 1 + G with G = (1 − √(C⁷ / (C⁷ + 25⁷))) / 2 that stretches a* near gray.
fn red_green_stretch(chroma: f64) -> f64 {
    1.0 + 0.5 * (1.0 - toward_saturation(chroma))
}

/// The function √(C⁷ / (C⁷ + 25⁷)).
fn toward_saturation(chroma: f64) -> f64 {
    let c7 = chroma.powi(7);
    (c7 / (c7 + 25.0_f64.powi(7))).sqrt()
}

/// The weighting functions S_L, S_C, S_H of lightness, chroma and hue, and the rotation term R_T between chroma and hue.
struct Weights {
    s_l: f64,
    s_c: f64,
    s_h: f64,
    r_t: f64,
}

impl Weights {
    /// Computes the weights at mean lightness, stretched chroma and hue (radians).
    fn at(l: f64, c: f64, h: f64) -> Self {
        let t = 1.0 - 0.17 * (h - PI / 6.0).cos()
            + 0.24 * (2.0 * h).cos()
            + 0.32 * (3.0 * h + 6.0_f64.to_radians()).cos()
            - 0.20 * (4.0 * h - 63.0_f64.to_radians()).cos();
        let blue = (-((h.to_degrees() - 275.0) / 25.0).powi(2)).exp();
        let dl2 = (l - 50.0).powi(2);
        Self {
            s_l: 1.0 + 0.015 * dl2 / (20.0 + dl2).sqrt(),
            s_c: 1.0 + 0.045 * c,
            s_h: 1.0 + 0.015 * c * t,
            r_t: -(2.0 * 30.0_f64.to_radians() * blue).sin() * 2.0 * toward_saturation(c),
        }
    }

    fn length(&self, dl: f64, dc: f64, dh: f64) -> f64 {
        let (l, c, h) = (dl / self.s_l, dc / self.s_c, dh / self.s_h);
        // The quadratic form is positive; rounding may make it negative near 0.
        (l * l + c * c + h * h + self.r_t * c * h).max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn lab([l, a, b]: [f64; 3]) -> Lab {
        Lab { l, a, b }
    }

    include!("lab/sharma_2005.rs");

    #[test]
    fn the_published_pairs_have_their_differences() {
        for (first, second, published, digits) in PAIRS {
            let (first, second) = (lab(first), lab(second));
            let found = delta_e_2000(first, second);
            assert!(
                (found - published).abs() <= 0.5001e-4,
                "{first:?} {second:?}: {found}"
            );
            // The values have twelve digits.
            assert!(
                (found / digits - 1.0).abs() < 1e-11,
                "{first:?} {second:?}: {found}"
            );
            // For pairs whose hues differ by half a turn, rounding decides the direction of the difference.
            let back = delta_e_2000(second, first);
            assert!((back - found).abs() < 1e-12, "{first:?} {second:?}: {back}");
        }
    }

    #[test]
    fn grays_have_no_hue() {
        assert_eq!(
            delta_e_2000(lab([50.0, 0.0, 0.0]), lab([50.0, 0.0, 0.0])),
            0.0
        );
        assert!(delta_e_2000(lab([50.0, 0.0, 0.0]), lab([52.0, 0.0, 0.0])) > 1.9);
        assert_eq!(lab([50.0, 0.0, 0.0]).hue_deg(), 0.0);
        assert_eq!(lab([50.0, 0.0, -1.0]).hue_deg(), 270.0);
    }

    /// The white is L* = 100, and 18.4187 % is L* = 50: ((50 + 16) / 116)³.
    #[test]
    fn lightness_has_its_fixed_points() {
        let white = [0.950_42, 1.0, 1.088_6];
        assert_eq!(Lab::from_xyz(white, white), lab([100.0, 0.0, 0.0]));
        let gray = white.map(|v| v * (66.0_f64 / 116.0).powi(3));
        let found = Lab::from_xyz(gray, white);
        assert!((found.l - 50.0).abs() < 1e-13 && found.chroma() < 1e-12);
        // Near black: L* = (29/3)³ Y.
        let black = Lab::from_xyz([0.0, 0.001, 0.0], white);
        assert!((black.l - 0.001 * (29.0_f64 / 3.0).powi(3)).abs() < 1e-12);
    }

    #[test]
    fn colors_come_back() {
        let white = [0.95, 1.0, 1.09];
        for xyz in [
            [0.05, 0.07, 0.2],
            [0.5, 0.4, 0.1],
            [0.003, 0.004, 0.005],
            [-0.01, 0.2, 1.5],
        ] {
            let found = Lab::from_xyz(xyz, white);
            let polar = Lab::from_lch(found.l, found.chroma(), found.hue_deg());
            for back in [found.to_xyz(white), polar.to_xyz(white)] {
                for (back, xyz) in back.into_iter().zip(xyz) {
                    assert!((back - xyz).abs() < 1e-14, "{back} {xyz}");
                }
            }
        }
    }

    /// ΔE*₇₆ and ΔE*₉₄ (graphic arts) of three pairs of Sharma et al., by colour-science 0.4.7.
    const OLDER: [([f64; 3], [f64; 3], f64, f64); 3] = [
        (
            [50.0, 2.6772, -79.7751],
            [50.0, 0.0, -82.7485],
            4.001_063_283_68,
            1.395_038_867_86,
        ),
        (
            [50.0, 2.5, 0.0],
            [73.0, 25.0, -18.0],
            36.868_007_811_7,
            34.689_163_198,
        ),
        (
            [60.2574, -34.0099, 36.2677],
            [60.4626, -34.1751, 39.4387],
            3.181_923_801_73,
            1.390_994_709_47,
        ),
    ];

    #[test]
    fn older_differences_equal_an_independent_computation() {
        for (first, second, e76, e94) in OLDER {
            let (first, second) = (lab(first), lab(second));
            assert!((delta_e_76(first, second) / e76 - 1.0).abs() < 1e-11);
            let found = delta_e_94(first, second);
            assert!((found / e94 - 1.0).abs() < 1e-11, "{found} {e94}");
        }
    }

    #[test]
    fn derivatives_equal_differences() {
        let white = [0.95, 1.0, 1.09];
        for xyz in [[0.05, 0.07, 0.2], [0.5, 0.4, 0.1], [0.003, 0.004, 0.005]] {
            let d = [0.3, -0.2, 0.7];
            let at = |h: f64| Lab::from_xyz(std::array::from_fn(|i| xyz[i] + h * d[i]), white);
            let h = 1e-7;
            let found = Lab::derivative(xyz, white, d);
            let (up, down) = (at(h), at(-h));
            for (found, difference) in [
                (found.l, (up.l - down.l) / (2.0 * h)),
                (found.a, (up.a - down.a) / (2.0 * h)),
                (found.b, (up.b - down.b) / (2.0 * h)),
            ] {
                assert!(
                    (found / difference - 1.0).abs() < 1e-6,
                    "{found} {difference}"
                );
            }
            let rate = delta_e_2000_rate(at(0.0), found);
            let difference = delta_e_2000(at(0.0), at(h)) / h;
            assert!(
                (rate / difference - 1.0).abs() < 1e-4,
                "{rate} {difference}"
            );
        }
        let gray = lab([40.0, 0.0, 0.0]);
        let rate = delta_e_2000_rate(gray, lab([1.0, 2.0, 3.0]));
        let h = 1e-6;
        let difference = delta_e_2000(gray, lab([40.0 + h, 2.0 * h, 3.0 * h])) / h;
        assert!(
            (rate / difference - 1.0).abs() < 1e-4,
            "{rate} {difference}"
        );
    }
}
