//! Chromatic adaptation: the corresponding color under another white.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use crate::matrix::{IDENTITY, Matrix3, inverse, product, times};

/// A model of chromatic adaptation, which scales three responses so that one white becomes the other (von Kries 1902).
/// Adaptation is complete, at any luminance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Adaptation {
    /// No adaptation: colors are unchanged.
    None,
    /// In the sharpened responses of Lam, Metamerism and Colour Constancy (Bradford, 1985), linear as in ICC.1:2022, annex E.
    #[default]
    Bradford,
    /// In the responses of CIECAM16, with complete adaptation, D = 1 (Li et al., Comprehensive color solutions: CAM16, CAT16, and
    /// CAM16-UCS, Color Res. Appl. 42, 703 (2017), appendix A).
    Cat16,
}

/// The name is not that of an adaptation.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("there is no adaptation {0:?}; known names: none, bradford and cat16")]
pub struct UnknownAdaptation(String);

/// The matrix from XYZ to the responses of Lam (1985).
pub const BRADFORD: Matrix3 = [
    [0.8951, 0.2664, -0.1614],
    [-0.7502, 1.7135, 0.0367],
    [0.0389, -0.0685, 1.0296],
];

/// The matrix from XYZ to the responses of Li et al. (2017).
pub const CAT16: Matrix3 = [
    [0.401_288, 0.650_173, -0.051_461],
    [-0.250_268, 1.204_414, 0.045_854],
    [-0.002_079, 0.048_952, 0.953_127],
];

impl Adaptation {
    /// All adaptations.
    pub const ALL: [Self; 3] = [Self::None, Self::Bradford, Self::Cat16];

    /// The name: `none`, `bradford`, `cat16`.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Bradford => "bradford",
            Self::Cat16 => "cat16",
        }
    }

    /// Returns the matrix from XYZ under `from_white` to the corresponding XYZ under `to_white`: B⁻¹ diag(B w′ / B w) B for the whites w
    /// and w′. It maps w to w′, including their luminance. Give both with Y = 1 to preserve luminances.
    ///
    /// The whites must have positive responses, as real illuminants do; otherwise the numbers are not finite.
    pub fn matrix(self, from_white: [f64; 3], to_white: [f64; 3]) -> Matrix3 {
        let responses = match self {
            Self::None => return IDENTITY,
            Self::Bradford => &BRADFORD,
            Self::Cat16 => &CAT16,
        };
        let (from, to) = (times(responses, from_white), times(responses, to_white));
        let scaled = std::array::from_fn(|row| responses[row].map(|v| v * to[row] / from[row]));
        product(&inverse(responses), &scaled)
    }
}

impl fmt::Display for Adaptation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Adaptation {
    type Err = UnknownAdaptation;

    fn from_str(name: &str) -> Result<Self, UnknownAdaptation> {
        let known = Self::ALL.into_iter().find(|known| known.name() == name);
        known.ok_or_else(|| UnknownAdaptation(name.chars().take(40).collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [f64; 3] = [1.0985, 1.0, 0.355_85];
    const D50: [f64; 3] = [0.964_22, 1.0, 0.825_21];
    const D65: [f64; 3] = [0.950_47, 1.0, 1.088_83];

    /// The matrix from D65 to D50 for these whites in B. Lindbloom, Chromatic Adaptation (brucelindbloom.com, 2017).
    #[test]
    fn bradford_is_the_published_matrix() {
        let published = [
            [1.047_811_2, 0.022_886_6, -0.050_127_0],
            [0.029_542_4, 0.990_484_4, -0.017_049_1],
            [-0.009_234_5, 0.015_043_6, 0.752_131_6],
        ];
        let found = Adaptation::Bradford.matrix(D65, D50);
        for (found, published) in found.iter().flatten().zip(published.iter().flatten()) {
            // Seven decimals are printed.
            assert!((found - published).abs() < 2e-7, "{found} {published}");
        }
    }

    /// A color adapted from A to D65, by colour-science 0.4.7 (`chromatic_adaptation_VonKries`).
    #[test]
    fn colors_equal_an_independent_computation() {
        for (adaptation, expected) in [
            (
                Adaptation::Cat16,
                [0.122_728_767_176, 0.509_864_364_475, 0.326_198_248_227],
            ),
            (
                Adaptation::Bradford,
                [0.149_459_110_458, 0.537_652_430_420, 0.267_759_911_310],
            ),
        ] {
            let found = times(&adaptation.matrix(A, D65), [0.2, 0.5, 0.1]);
            for (found, expected) in found.into_iter().zip(expected) {
                assert!(
                    (found - expected).abs() < 1e-11,
                    "{adaptation}: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn whites_become_one_another_and_back_is_the_same_color() {
        for adaptation in [Adaptation::Bradford, Adaptation::Cat16] {
            let there = adaptation.matrix(A, D65);
            for (found, white) in times(&there, A).into_iter().zip(D65) {
                assert!((found - white).abs() < 1e-14, "{adaptation}: {found}");
            }
            let color = [0.2, 0.5, 0.1];
            let back = times(&adaptation.matrix(D65, A), times(&there, color));
            for (found, color) in back.into_iter().zip(color) {
                assert!((found - color).abs() < 1e-14, "{adaptation}: {found}");
            }
        }
        assert_eq!(Adaptation::None.matrix(A, D65), IDENTITY);
    }

    #[test]
    fn names_and_back() {
        for adaptation in Adaptation::ALL {
            assert_eq!(adaptation.name().parse(), Ok(adaptation));
        }
        let said = "von_kries".parse::<Adaptation>().unwrap_err().to_string();
        assert!(said.contains("none, bradford and cat16"), "{said}");
    }
}
