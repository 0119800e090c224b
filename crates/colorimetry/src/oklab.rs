//! Oklab, a perceptual color space with straight lines of constant hue, even in blue.
//!
//! B. Ottosson, A perceptual color space for image processing (2020, bottosson.github.io/posts/oklab).

use std::sync::OnceLock;

use crate::matrix::{Matrix3, inverse, times};

/// A color L, a, b in Oklab.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Oklab {
    /// Lightness L: 0 for black, 1 for the white D65.
    pub l: f64,
    /// From green (negative) to red.
    pub a: f64,
    /// From blue (negative) to yellow.
    pub b: f64,
}

/// The matrix from XYZ to cone responses: Ottosson's M₁.
pub const LMS_FROM_XYZ: Matrix3 = [
    [0.818_933_010_1, 0.361_866_742_4, -0.128_859_713_7],
    [0.032_984_543_6, 0.929_311_871_5, 0.036_145_638_7],
    [0.048_200_301_8, 0.264_366_269_1, 0.633_851_707_0],
];

/// The matrix from the cube roots of the responses to Lab: Ottosson's M₂.
pub const LAB_FROM_ROOTS: Matrix3 = [
    [0.210_454_255_3, 0.793_617_785_0, -0.004_072_046_8],
    [1.977_998_495_1, -2.428_592_205_0, 0.450_593_709_9],
    [0.025_904_037_1, 0.782_771_766_2, -0.808_675_766_0],
];

impl Oklab {
    /// Converts XYZ relative to the white D65 with Y = 1. Colors under another white must be adapted to D65 first. XYZ of
    /// imaginary colors is also valid: cube roots keep their sign.
    pub fn from_xyz(xyz: [f64; 3]) -> Self {
        let roots = times(&LMS_FROM_XYZ, xyz).map(f64::cbrt);
        let [l, a, b] = times(&LAB_FROM_ROOTS, roots);
        Self { l, a, b }
    }

    /// Converts to XYZ relative to the white D65 with Y = 1: the inverse of [`Self::from_xyz`].
    pub fn to_xyz(self) -> [f64; 3] {
        static BACK: OnceLock<[Matrix3; 2]> = OnceLock::new();
        let [xyz_from_lms, roots_from_lab] =
            BACK.get_or_init(|| [inverse(&LMS_FROM_XYZ), inverse(&LAB_FROM_ROOTS)]);
        let roots = times(roots_from_lab, [self.l, self.a, self.b]);
        times(xyz_from_lms, roots.map(|root| root.powi(3)))
    }

    /// Chroma C = √(a² + b²).
    pub fn chroma(self) -> f64 {
        self.a.hypot(self.b)
    }

    /// Hue angle in degrees, 0 to 360; 0 for a gray.
    pub fn hue_deg(self) -> f64 {
        self.b.atan2(self.a).to_degrees().rem_euclid(360.0)
    }

    /// Creates a color from lightness, chroma and hue angle in degrees.
    pub fn from_lch(l: f64, chroma: f64, hue_deg: f64) -> Self {
        let (sin, cos) = hue_deg.to_radians().sin_cos();
        Self {
            l,
            a: chroma * cos,
            b: chroma * sin,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The test pairs in Ottosson (2020).
    #[test]
    fn published_colors_have_their_coordinates() {
        for (xyz, lab) in [
            ([0.950, 1.000, 1.089], [1.000, 0.000, 0.000]),
            ([1.000, 0.000, 0.000], [0.450, 1.236, -0.019]),
            ([0.000, 1.000, 0.000], [0.922, -0.671, 0.263]),
            ([0.000, 0.000, 1.000], [0.153, -1.415, -0.449]),
        ] {
            let found = Oklab::from_xyz(xyz);
            for (found, published) in [found.l, found.a, found.b].into_iter().zip(lab) {
                assert!((found - published).abs() < 0.5e-3, "{xyz:?}: {found}");
            }
        }
    }

    /// A red, a green and a blue, by colour-science 0.4.7.
    #[test]
    fn colors_equal_an_independent_computation() {
        for (xyz, lab) in [
            (
                [0.206_540_08, 0.121_972_25, 0.051_369_52],
                [0.516_340_191_406, 0.154_694_999_017, 0.062_895_787_289],
            ),
            (
                [0.142_220_10, 0.230_427_68, 0.104_957_72],
                [0.599_107_456_915, -0.111_392_073_483, 0.075_084_651_007_6],
            ),
            (
                [0.078_187_80, 0.061_572_01, 0.280_993_26],
                [0.402_213_919_069, -0.008_783_644_205_03, -0.139_373_677_981],
            ),
        ] {
            let found = Oklab::from_xyz(xyz);
            for (found, expected) in [found.l, found.a, found.b].into_iter().zip(lab) {
                assert!((found - expected).abs() < 1e-11, "{xyz:?}: {found}");
            }
        }
    }

    #[test]
    fn there_and_back_is_the_same_color() {
        for xyz in [
            [0.95, 1.0, 1.089],
            [0.2, 0.1, 0.7],
            [0.1, -0.02, 0.3],
            [0.0; 3],
        ] {
            for (found, xyz) in Oklab::from_xyz(xyz).to_xyz().into_iter().zip(xyz) {
                assert!((found - xyz).abs() < 1e-14, "{found} {xyz}");
            }
        }
        let found = Oklab::from_lch(0.5, 0.1, 200.0);
        assert!((found.chroma() - 0.1).abs() < 1e-15 && (found.hue_deg() - 200.0).abs() < 1e-12);
    }
}
