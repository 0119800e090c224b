//! ICC profiles of pictures: a matrix and curves, or a curve of gray.

use std::fmt;

use colorimetry::adaptation::Adaptation;
use colorimetry::matrix::product;
use colorimetry::srgb;
use moxcms::{
    ColorProfile, DataColorSpace, ToneCurveEvaluator, ToneReprCurve, TransferCharacteristics,
};

use super::{CodeColors, Curve, PngColorsError};
use crate::icc;

/// A channel's curve.
pub(super) struct ProfileCurve(Box<dyn ToneCurveEvaluator + Send + Sync>);

impl ProfileCurve {
    fn new(curve: Option<&ToneReprCurve>) -> Option<Self> {
        curve?.make_linear_evaluator().ok().map(Self)
    }

    /// The amount of light of a code in \[0, 1\].
    pub(super) fn light(&self, code: f64) -> f64 {
        f64::from(self.0.evaluate_value(code as f32))
    }
}

impl fmt::Debug for ProfileCurve {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("ProfileCurve")
    }
}

/// The colors that a profile says and how they are told, or why it cannot be used.
///
/// A profile's white is (1, 1, 1), as relative colorimetry has it. Where there are tables beside a matrix the matrix counts.
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
        DataColorSpace::Gray => Err("is one of gray, and the picture has colors"),
        _ => Err("is neither of red, green and blue nor of gray"),
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
    let [red, green, blue] = curves.map(|curve| ProfileCurve::new(curve.as_ref()));
    let (Some(red), Some(green), Some(blue)) = (red, green, blue) else {
        return Err("has no matrix and curves (tables are not read)");
    };
    let to_d65 = Adaptation::Bradford.matrix(icc::D50, srgb::white_xyz());
    let from_d50 = product(srgb::rgb_from_xyz(), &to_d65);
    let matrix = product(&from_d50, &profile.colorant_matrix().v);
    // A matrix of which white is none is damaged, or one of a space that no picture is in.
    let is_white = |row: &[f64; 3]| (row.iter().sum::<f64>() - 1.0).abs() < 0.05;
    if !matrix.iter().all(is_white) {
        return Err("has a matrix that makes no white of (1, 1, 1)");
    }
    let colors = CodeColors {
        curve: Curve::Profile(Box::new([red, green, blue])),
        to_srgb: Some(matrix),
        notes: Vec::new(),
    };
    checked(colors)
}

fn of_gray(profile: &ColorProfile) -> Result<CodeColors, &'static str> {
    let curve = || ProfileCurve::new(profile.gray_trc.as_ref());
    let (Some(red), Some(green), Some(blue)) = (curve(), curve(), curve()) else {
        return Err("has no curve");
    };
    checked(CodeColors {
        curve: Curve::Profile(Box::new([red, green, blue])),
        to_srgb: None,
        notes: Vec::new(),
    })
}

/// Refuses curves that give what is no number, or far from a reflectance.
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
