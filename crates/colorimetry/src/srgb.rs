//! The sRGB display: linear RGB from XYZ, the transfer curve, 8-bit codes.
//!
//! Primaries, white and curve are those of IEC 61966-2-1:1999. XYZ is relative to the display's
//! white, Y = 1. There is no chromatic adaptation: a spectrum with the chromaticity of D65 is white,
//! and every other illuminant keeps its color.

use std::sync::OnceLock;

use crate::chromaticity::{xyz_from_rgb_of, xyz_of_xy};
use crate::matrix::{Matrix3, inverse, times};

/// Chromaticities x, y of the red, green and blue primaries.
pub const PRIMARIES: [[f64; 2]; 3] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];
/// Chromaticity x, y of the white: D65 as rounded in the standard.
pub const WHITE: [f64; 2] = [0.3127, 0.3290];

/// The matrix from XYZ to linear RGB: M⁻¹ for the primaries and the white (SMPTE RP 177:1993).
pub fn rgb_from_xyz() -> &'static Matrix3 {
    static MATRIX: OnceLock<Matrix3> = OnceLock::new();
    MATRIX.get_or_init(|| inverse(&xyz_from_rgb_of(PRIMARIES, WHITE)))
}

/// Converts XYZ to linear RGB. Colors that the display cannot show have values below 0 or above 1.
pub fn linear_from_xyz(xyz: [f64; 3]) -> [f64; 3] {
    times(rgb_from_xyz(), xyz)
}

/// Converts linear RGB to XYZ, with Y = 1 for the white: the inverse of [`linear_from_xyz`].
pub fn xyz_from_linear(rgb: [f64; 3]) -> [f64; 3] {
    static MATRIX: OnceLock<Matrix3> = OnceLock::new();
    times(MATRIX.get_or_init(|| inverse(rgb_from_xyz())), rgb)
}

/// XYZ of the display's white, with Y = 1.
pub fn white_xyz() -> [f64; 3] {
    xyz_of_xy(WHITE)
}

/// The transfer curve from linear to code: 12.92 v up to 0.0031308, else 1.055 v^(1/2.4) − 0.055. For v in \[0, 1\].
pub fn encode(linear: f64) -> f64 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// The inverse transfer curve from code to linear: v/12.92 up to 0.04045, else ((v + 0.055)/1.055)^2.4.
pub fn decode(code: f64) -> f64 {
    if code <= 0.040_45 {
        code / 12.92
    } else {
        ((code + 0.055) / 1.055).powf(2.4)
    }
}

/// Returns the nearest 8-bit code of a linear value. Values outside \[0, 1\] are clipped; NaN becomes 0.
pub fn to_u8(linear: f64) -> u8 {
    // A NaN reaches the cast, which makes it 0.
    (encode(linear.clamp(0.0, 1.0)) * 255.0).round() as u8
}

/// Returns the linear value of an 8-bit code.
pub fn from_u8(code: u8) -> f64 {
    decode(f64::from(code) / 255.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_one_and_primaries_are_pure() {
        for value in linear_from_xyz(xyz_of_xy(WHITE)) {
            assert!((value - 1.0).abs() < 1e-14, "{value}");
        }
        for (index, primary) in PRIMARIES.into_iter().enumerate() {
            let rgb = linear_from_xyz(xyz_of_xy(primary));
            for (channel, value) in rgb.into_iter().enumerate() {
                assert_eq!(value.abs() > 1e-14, channel == index, "{rgb:?}");
            }
        }
    }

    #[test]
    fn the_matrix_is_the_published_one() {
        // IEC 61966-2-1:1999 prints four decimals.
        let published = [
            [3.2406, -1.5372, -0.4986],
            [-0.9689, 1.8758, 0.0415],
            [0.0557, -0.2040, 1.0570],
        ];
        for (row, expected) in rgb_from_xyz()
            .iter()
            .flatten()
            .zip(published.iter().flatten())
        {
            // The standard derives its matrix from values rounded to four decimals.
            assert!((row - expected).abs() < 4e-4, "{row} {expected}");
        }
    }

    /// XYZ (Y = 100 for a perfect mirror) and linear sRGB of films and metals under several illuminants, by
    /// double-precision sums at 1 nm computed independently (tmm, numpy).
    const COLORS: [([f64; 3], [f64; 3]); 6] = [
        // Soap film, 500 nm, normal, D65; then at 80° under A; at 30° under D65.
        (
            [3.260_339_054_46, 5.648_028_124_08, 1.741_707_246_9],
            [
                0.010_150_434_769_3,
                0.075_078_310_723_5,
                0.008_702_402_670_96,
            ],
        ),
        (
            [77.011_091_177_7, 70.021_858_124_7, 7.695_584_866_99],
            [1.381_031_035_36, 0.570_360_106_61, -0.018_646_985_464_1],
        ),
        (
            [1.871_085_275_93, 3.748_944_250_02, 5.114_394_370_68],
            [
                -0.022_495_247_512_2,
                0.054_318_890_330_5,
                0.047_451_595_382_7,
            ],
        ),
        // 300 nm of silica on silicon, normal, D65 and A.
        (
            [16.209_188_340_6, 15.457_835_042_7, 42.840_269_972_8],
            [0.074_082_570_559_2, 0.150_679_734_134, 0.430_296_212_799],
        ),
        (
            [14.317_500_390_9, 13.581_893_238_4, 13.502_709_916_2],
            [0.187_894_177_686, 0.121_631_500_686, 0.122_980_701_556],
        ),
        // Free film of index 4/3, 250 nm, D65.
        (
            [2.467_596_401, 3.044_270_922, 8.058_016_66],
            [-0.007_006_189_52, 0.036_541_025_51, 0.080_334_055_31],
        ),
    ];

    #[test]
    fn films_have_the_rgb_of_an_independent_computation() {
        for (xyz, expected) in COLORS {
            let rgb = linear_from_xyz(xyz.map(|v| v / 100.0));
            for (found, expected) in rgb.into_iter().zip(expected) {
                // The values have ten to twelve digits.
                assert!((found - expected).abs() < 1e-10, "{found} {expected}");
            }
        }
    }

    #[test]
    fn xyz_and_back_is_the_same_color() {
        for rgb in [[1.0, 1.0, 1.0], [0.2, -0.1, 0.9], [0.0; 3]] {
            for (back, there) in linear_from_xyz(xyz_from_linear(rgb)).into_iter().zip(rgb) {
                assert!((back - there).abs() < 1e-14, "{back} {there}");
            }
        }
        for (found, white) in xyz_from_linear([1.0; 3]).into_iter().zip(white_xyz()) {
            assert!((found - white).abs() < 1e-14, "{found} {white}");
        }
    }

    #[test]
    fn every_code_survives_the_way_to_linear_and_back() {
        for code in 0..=255 {
            assert_eq!(to_u8(from_u8(code)), code);
        }
    }

    #[test]
    fn the_curve_meets_itself_and_its_published_points() {
        assert!((encode(0.003_130_8) - 0.040_45).abs() < 1e-5);
        // Middle gray: code 0.5 is linear 0.21404.
        assert!((decode(0.5) - 0.214_041_14).abs() < 1e-8);
        for i in 0..=1000 {
            let v = f64::from(i) / 1000.0;
            // The standard's constants leave a step of 1e-8 where its two pieces meet.
            assert!((decode(encode(v)) - v).abs() < 1e-7);
        }
    }

    #[test]
    fn values_that_no_display_shows_are_clipped() {
        assert_eq!(to_u8(-1.0), 0);
        assert_eq!(to_u8(2.0), 255);
        assert_eq!(to_u8(f64::NAN), 0);
        assert_eq!(to_u8(f64::INFINITY), 255);
        assert_eq!(to_u8(f64::NEG_INFINITY), 0);
    }
}
