//! ICC profiles of pictures: a matrix and curves, or a gray curve.

use colorimetry::adaptation::Adaptation;
use colorimetry::matrix::product;
use colorimetry::srgb;
use moxcms::{ColorProfile, DataColorSpace, ToneReprCurve, TransferCharacteristics};

use super::{CodeColors, Curve, PngColorsError};
use crate::icc;

/// A channel's curve (ICC.1:2022, 10.6 and 10.18).
#[derive(Clone, Debug)]
pub(super) enum ProfileCurve {
    /// Values at equal steps of the code, at least two.
    Table(Vec<u16>),
    /// (a x + b)^g + e for x ≥ d, c x + f below d: `[g, a, b, c, d, e, f]`.
    Function([f64; 7]),
}

impl ProfileCurve {
    pub(super) fn new(curve: &ToneReprCurve) -> Option<Self> {
        let power = |g| Self::Function([g, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        match curve {
            ToneReprCurve::Lut(table) => Some(match **table {
                [] => power(1.0),
                // Eight fractional bits.
                [gamma] => power(f64::from(gamma) / 256.0),
                _ => Self::Table(table.clone()),
            }),
            ToneReprCurve::Parametric(numbers) => {
                let numbers: Vec<f64> = numbers.iter().map(|&number| f64::from(number)).collect();
                Some(match numbers[..] {
                    [g] => power(g),
                    [g, a, b] => Self::Function([g, a, b, 0.0, -b / a, 0.0, 0.0]),
                    [g, a, b, c] => Self::Function([g, a, b, 0.0, -b / a, c, c]),
                    [g, a, b, c, d] => Self::Function([g, a, b, c, d, 0.0, 0.0]),
                    [g, a, b, c, d, e, f] => Self::Function([g, a, b, c, d, e, f]),
                    _ => return None,
                })
            }
        }
    }

    /// Returns the amount of light of a code in \[0, 1\].
    pub(super) fn light(&self, code: f64) -> f64 {
        match self {
            Self::Table(table) => {
                let at = code * (table.len() - 1) as f64;
                let below = at.floor();
                let value = |index: usize| table.get(index).or(table.last()).copied();
                let value = |index| f64::from(value(index).unwrap_or_default()) / 65_535.0;
                let (low, high) = (value(below as usize), value(below as usize + 1));
                low + (high - low) * (at - below)
            }
            Self::Function([g, a, b, c, d, e, f]) => {
                if code >= *d {
                    (a * code + b).powf(*g) + e
                } else {
                    c * code + f
                }
            }
        }
    }
}

/// Returns the conversion that a profile describes and the note that reports it, or why the profile cannot be used.
///
/// A profile's white is (1, 1, 1), as in relative colorimetry. If a profile has both tables and a matrix, the matrix is used.
pub(super) fn colors(
    bytes: &[u8],
    is_gray: bool,
) -> Result<Result<(CodeColors, String), &'static str>, PngColorsError> {
    let Ok(profile) = ColorProfile::new_from_slice(bytes) else {
        return Ok(Err("is damaged"));
    };
    match profile.cicp.map(|points| points.transfer_characteristics) {
        Some(TransferCharacteristics::Smpte2084) => {
            return Err(PngColorsError::Light("iCCP", "PQ"));
        }
        Some(TransferCharacteristics::Hlg) => return Err(PngColorsError::Light("iCCP", "HLG")),
        _ => {}
    }
    let found = match profile.color_space {
        DataColorSpace::Rgb => of_rgb(&profile),
        DataColorSpace::Gray if is_gray => of_gray(&profile),
        DataColorSpace::Gray => Err("is for gray, but the picture has colors"),
        _ => Err("is neither for red, green and blue nor for gray"),
    };
    Ok(found.map(|colors| {
        let name = icc::description(bytes).unwrap_or_default();
        let named = if name.is_empty() {
            String::new()
        } else {
            format!(" {name:?}")
        };
        (colors, format!("read by its ICC profile{named}"))
    }))
}

fn of_rgb(profile: &ColorProfile) -> Result<CodeColors, &'static str> {
    let curves = [&profile.red_trc, &profile.green_trc, &profile.blue_trc];
    let [red, green, blue] = curves.map(|curve| curve.as_ref().and_then(ProfileCurve::new));
    let (Some(red), Some(green), Some(blue)) = (red, green, blue) else {
        return Err("has no matrix and curves (tables are not read)");
    };
    let to_d65 = Adaptation::Bradford.matrix(icc::D50, srgb::white_xyz());
    let from_d50 = product(srgb::rgb_from_xyz(), &to_d65);
    let matrix = product(&from_d50, &profile.colorant_matrix().v);
    // A matrix that does not map white to white is damaged, or is for a space that pictures do not use.
    let is_white = |row: &[f64; 3]| (row.iter().sum::<f64>() - 1.0).abs() < 0.05;
    if !matrix.iter().all(is_white) {
        return Err("has a matrix that does not map (1, 1, 1) to white");
    }
    let colors = CodeColors {
        curve: Curve::Profile(Box::new([red, green, blue])),
        to_srgb: Some(matrix),
        notes: Vec::new(),
    };
    checked(colors)
}

fn of_gray(profile: &ColorProfile) -> Result<CodeColors, &'static str> {
    let curve = profile.gray_trc.as_ref().and_then(ProfileCurve::new);
    let curve = curve.ok_or("has no curve")?;
    checked(CodeColors {
        curve: Curve::Profile(Box::new([curve.clone(), curve.clone(), curve])),
        to_srgb: None,
        notes: Vec::new(),
    })
}

/// Rejects curves whose values are NaN or far outside the range of reflectances.
fn checked(colors: CodeColors) -> Result<CodeColors, &'static str> {
    let mut codes = (0..=255).map(|i: u16| [i * 257; 3]);
    let is_sound = codes.all(|codes| {
        let linear = colors.linear_srgb(codes);
        linear.iter().all(|value| (-0.1..1.1).contains(value))
    });
    is_sound
        .then_some(colors)
        .ok_or("has curves that leave the range from 0 to 1")
}
