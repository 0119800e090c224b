//! The color appearance model CIECAM16 and its inverse.
//!
//! CIE 248:2022, The CIE 2016 colour appearance model for colour management systems: the model of Li et al., Comprehensive color
//! solutions: CAM16, CAT16, and CAM16-UCS, Color Res. Appl. 42, 703 (2017), with responses extended linearly below
//! q = 0.26 and above q = 150, so that very saturated colors also have an appearance.

use crate::adaptation::CAT16;
use crate::matrix::{inverse, times};

/// How bright the surround of a picture is (CIE 248:2022, table 1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Surround {
    /// As bright as the picture: surface colors, offices.
    #[default]
    Average,
    /// Darker than the picture: television.
    Dim,
    /// Dark: a cinema.
    Dark,
}

impl Surround {
    /// The factors F, c and N_c.
    fn factors(self) -> [f64; 3] {
        match self {
            Self::Average => [1.0, 0.69, 1.0],
            Self::Dim => [0.9, 0.59, 0.9],
            Self::Dark => [0.8, 0.525, 0.8],
        }
    }
}

/// The appearance of a color.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Appearance {
    /// Lightness J: 0 for black, 100 for the white.
    pub j: f64,
    /// Chroma C.
    pub c: f64,
    /// Hue angle h in degrees, 0 to 360.
    pub h: f64,
    /// Colorfulness M.
    pub m: f64,
    /// Saturation s.
    pub s: f64,
    /// Brightness Q.
    pub q: f64,
}

/// A color J′, a′, b′ in the uniform color space CAM16-UCS, where distances are color differences (Li et al. 2017).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ucs {
    /// Lightness J′ = 1.7 J / (1 + 0.007 J), 0 to 100.
    pub j: f64,
    /// a′ = M′ cos h with M′ = ln(1 + 0.0228 M) / 0.0228.
    pub a: f64,
    /// b′ = M′ sin h.
    pub b: f64,
}

impl Ucs {
    /// The distance to another color: the color difference.
    pub fn distance(self, other: Self) -> f64 {
        let [dj, da, db] = [self.j - other.j, self.a - other.a, self.b - other.b];
        (dj * dj + da * da + db * db).sqrt()
    }
}

/// The viewing conditions of a color.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewingConditions {
    /// Factors of R, G and B for adaptation to the white.
    adapted: [f64; 3],
    c: f64,
    n_c: f64,
    n: f64,
    n_bb: f64,
    z: f64,
    f_l: f64,
    a_w: f64,
}

impl ViewingConditions {
    /// Creates conditions from a white with Y = 100, an adapting luminance L_A in cd/m² (usually a fifth of the white's), a background of
    /// luminance Y_b relative to 100 for the white (usually 20) and a surround.
    ///
    /// The numbers must be positive; otherwise appearances are not finite.
    pub fn new(white: [f64; 3], l_a: f64, y_b: f64, surround: Surround) -> Self {
        let [f, c, n_c] = surround.factors();
        let degree = (f * (1.0 - ((-l_a - 42.0) / 92.0).exp() / 3.6)).clamp(0.0, 1.0);
        let rgb_w = times(&CAT16, white);
        let adapted = rgb_w.map(|response| degree * white[1] / response + 1.0 - degree);
        let k4 = (1.0 / (5.0 * l_a + 1.0)).powi(4);
        let f_l = 0.2 * k4 * 5.0 * l_a + 0.1 * (1.0 - k4).powi(2) * (5.0 * l_a).cbrt();
        let n = y_b / white[1];
        let n_bb = 0.725 * n.powf(-0.2);
        let mut conditions = Self {
            adapted,
            c,
            n_c,
            n,
            n_bb,
            z: 1.48 + n.sqrt(),
            f_l,
            a_w: 1.0,
        };
        conditions.a_w = conditions.achromatic(conditions.responses(white));
        conditions
    }

    /// Returns the compressed responses to XYZ.
    fn responses(&self, xyz: [f64; 3]) -> [f64; 3] {
        let rgb = times(&CAT16, xyz);
        std::array::from_fn(|i| self.compress(rgb[i] * self.adapted[i]))
    }

    /// The achromatic response A = (2R + G + B/20) N_bb, not below 0.
    fn achromatic(&self, [r, g, b]: [f64; 3]) -> f64 {
        ((2.0 * r + g + b / 20.0) * self.n_bb).max(0.0)
    }

    /// Returns the appearance of XYZ, with Y = 100 for the white.
    pub fn appearance(&self, xyz: [f64; 3]) -> Appearance {
        let [r, g, b] = self.responses(xyz);
        let (red, yellow) = (r - 12.0 * g / 11.0 + b / 11.0, (r + g - 2.0 * b) / 9.0);
        let hue = yellow.atan2(red);
        let t = self.eccentricity(hue) * red.hypot(yellow) / (r + g + 21.0 / 20.0 * b + 0.305);
        let root_j = (self.achromatic([r, g, b]) / self.a_w).powf(0.5 * self.c * self.z);
        // Beyond spectral violet the denominator may be negative; such a color is given no chroma.
        let c = t.max(0.0).powf(0.9) * root_j * self.chroma_factor();
        let q = 4.0 / self.c * root_j * (self.a_w + 4.0) * self.f_l.powf(0.25);
        let m = c * self.f_l.powf(0.25);
        Appearance {
            j: 100.0 * root_j * root_j,
            c,
            h: hue.to_degrees().rem_euclid(360.0),
            m,
            s: if q > 0.0 { 100.0 * (m / q).sqrt() } else { 0.0 },
            q,
        }
    }

    /// Returns XYZ, with Y = 100 for the white, of the lightness J, chroma C and hue angle h in degrees: the inverse of
    /// [`Self::appearance`].
    pub fn xyz(&self, j: f64, c: f64, h: f64) -> [f64; 3] {
        let hue = h.to_radians();
        let (sin, cos) = hue.sin_cos();
        let root_j = (j / 100.0).max(0.0).sqrt();
        let t = if root_j > 0.0 {
            (c / (root_j * self.chroma_factor()))
                .max(0.0)
                .powf(1.0 / 0.9)
        } else {
            0.0
        };
        let p1 = self.eccentricity(hue);
        let p2 = self.a_w * root_j.powf(2.0 / (self.c * self.z)) / self.n_bb;
        let radius = 23.0 * (p2 + 0.305) * t / (23.0 * p1 + 11.0 * t * cos + 108.0 * t * sin);
        let (red, yellow) = (radius * cos, radius * sin);
        let responses = [
            460.0 * p2 + 451.0 * red + 288.0 * yellow,
            460.0 * p2 - 891.0 * red - 261.0 * yellow,
            460.0 * p2 - 220.0 * red - 6300.0 * yellow,
        ];
        let rgb = std::array::from_fn(|i| self.expand(responses[i] / 1403.0) / self.adapted[i]);
        times(&inverse(&CAT16), rgb)
    }

    /// Converts XYZ, with Y = 100 for the white, to CAM16-UCS.
    pub fn ucs(&self, xyz: [f64; 3]) -> Ucs {
        let Appearance { j, m, h, .. } = self.appearance(xyz);
        let radius = (0.0228 * m).ln_1p() / 0.0228;
        let (sin, cos) = h.to_radians().sin_cos();
        Ucs {
            j: 1.7 * j / (1.0 + 0.007 * j),
            a: radius * cos,
            b: radius * sin,
        }
    }

    /// Converts CAM16-UCS to XYZ, with Y = 100 for the white: the inverse of [`Self::ucs`].
    pub fn xyz_of_ucs(&self, Ucs { j, a, b }: Ucs) -> [f64; 3] {
        let m = (0.0228 * a.hypot(b)).exp_m1() / 0.0228;
        let c = m / self.f_l.powf(0.25);
        self.xyz(j / (1.7 - 0.007 * j), c, b.atan2(a).to_degrees())
    }

    /// The eccentricity factor (50000/13) N_c N_cb e_t of a hue in radians, with N_cb = N_bb.
    fn eccentricity(&self, hue: f64) -> f64 {
        let e_t = 0.25 * ((hue + 2.0).cos() + 3.8);
        50_000.0 / 13.0 * self.n_c * self.n_bb * e_t
    }

    /// The factor (1.64 − 0.29ⁿ)^0.73 of chroma.
    fn chroma_factor(&self) -> f64 {
        (1.64 - 0.29_f64.powf(self.n)).powf(0.73)
    }

    /// The response f(q) = 400 p / (p + 27.13) with p = (F_L q / 100)^0.42.
    fn f(&self, q: f64) -> f64 {
        let p = (self.f_l * q / 100.0).powf(0.42);
        400.0 * p / (p + 27.13)
    }

    /// The derivative f′(q).
    fn f_derivative(&self, q: f64) -> f64 {
        let p = (self.f_l * q / 100.0).powf(0.42);
        400.0 * 27.13 * 0.42 * p / (q * (p + 27.13).powi(2))
    }

    /// The response f, extended by a straight line through the origin below [`LOW`] and by the tangent above [`HIGH`].
    fn compress(&self, q: f64) -> f64 {
        if q < LOW {
            self.f(LOW) * q / LOW
        } else if q > HIGH {
            self.f(HIGH) + self.f_derivative(HIGH) * (q - HIGH)
        } else {
            self.f(q)
        }
    }

    /// The inverse of [`Self::compress`].
    fn expand(&self, response: f64) -> f64 {
        let (low, high) = (self.f(LOW), self.f(HIGH));
        if response < low {
            LOW * response / low
        } else if response > high {
            HIGH + (response - high) / self.f_derivative(HIGH)
        } else {
            100.0 / self.f_l * (27.13 * response / (400.0 - response)).powf(1.0 / 0.42)
        }
    }
}

/// The q below which the response is linear (CIE 248:2022).
const LOW: f64 = 0.26;
/// The q above which the response is linear (CIE 248:2022).
const HIGH: f64 = 150.0;

#[cfg(test)]
mod tests {
    use super::*;

    include!("ciecam16/appearances.rs");

    fn relative(found: f64, expected: f64) -> f64 {
        (found - expected).abs() / expected.abs().max(1.0)
    }

    #[test]
    fn appearances_equal_an_independent_computation() {
        for (xyz, white, expected) in APPEARANCES {
            let conditions = ViewingConditions::new(white, 64.0, 20.0, Surround::Average);
            let Appearance { j, c, h, m, s, q } = conditions.appearance(xyz);
            for (found, expected) in [j, c, h, m, s, q].into_iter().zip(expected) {
                // The values and XYZ have twelve digits; a small chroma magnifies the rounding of XYZ.
                assert!(
                    relative(found, expected) < 1e-9,
                    "{xyz:?}: {found} {expected}"
                );
            }
        }
    }

    /// The example of CIE 248:2022 and of Li et al. (2017), table A1, by colour-science 0.4.7; dim and dark by the same program.
    #[test]
    fn other_conditions_equal_an_independent_computation() {
        let (xyz, white) = ([19.01, 20.0, 21.78], [95.05, 100.0, 108.88]);
        for (surround, l_a, y_b, expected) in CONDITIONS {
            let found = ViewingConditions::new(white, l_a, y_b, surround).appearance(xyz);
            let found = [found.j, found.c, found.h, found.m, found.s, found.q];
            for (found, expected) in found.into_iter().zip(expected) {
                assert!(
                    relative(found, expected) < 1e-9,
                    "{surround:?}: {found} {expected}"
                );
            }
        }
    }

    /// D Y_w / R_w + 1 − D: the scale factors do not depend on the luminance assigned to the white.
    #[test]
    fn adaptation_depends_on_the_white_s_chromaticity_alone() {
        let of = |scale: f64| {
            let white = [109.85, 100.0, 35.58].map(|v| v * scale);
            ViewingConditions::new(white, 64.0, 20.0 * scale, Surround::Average)
        };
        let (hundred, one) = (of(1.0), of(0.01));
        for (a, b) in hundred.adapted.iter().zip(one.adapted) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        assert!((hundred.n - one.n).abs() < 1e-15);
    }

    #[test]
    fn a_color_comes_back_from_its_looks() {
        for (xyz, white, _) in APPEARANCES {
            for surround in [Surround::Average, Surround::Dim, Surround::Dark] {
                let conditions = ViewingConditions::new(white, 64.0, 20.0, surround);
                let Appearance { j, c, h, .. } = conditions.appearance(xyz);
                let back = conditions.xyz(j, c, h);
                let uniform = conditions.xyz_of_ucs(conditions.ucs(xyz));
                for i in 0..3 {
                    assert!((back[i] - xyz[i]).abs() < 1e-9, "{xyz:?}: {back:?}");
                    assert!((uniform[i] - xyz[i]).abs() < 1e-9, "{xyz:?}: {uniform:?}");
                }
            }
        }
    }

    #[test]
    fn black_and_colors_beyond_the_spectrum_have_numbers() {
        let conditions =
            ViewingConditions::new([95.05, 100.0, 108.88], 64.0, 20.0, Surround::Average);
        assert_eq!(conditions.appearance([0.0; 3]).j, 0.0);
        assert!(
            conditions
                .xyz(0.0, 0.0, 0.0)
                .iter()
                .all(|v| v.abs() < 1e-12)
        );
        for xyz in [
            [0.0, 0.0, 50.0],
            [60.0, 5.0, 0.0],
            [-5.0, 10.0, 3.0],
            [-5.0, -5.0, 0.0],
            [500.0, 600.0, 700.0],
        ] {
            let Appearance { j, c, h, m, s, q } = conditions.appearance(xyz);
            assert!([j, c, h, m, s, q].iter().all(|v| v.is_finite()), "{xyz:?}");
        }
    }
}
