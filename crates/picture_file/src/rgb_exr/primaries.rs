//! The primaries of an `OpenEXR` file's red, green and blue.

use colorimetry::Matrix3;
use colorimetry::chromaticity::xyz_from_rgb_of;
use colorimetry::matrix::product;
use colorimetry::srgb;
use exr::math::Vec2;
use exr::meta::attribute::Chromaticities;
use thiserror::Error;

/// Largest difference of chromaticities that count as equal: writers round them to three decimals.
const SAME: f32 = 6e-4;

/// A file's chromaticities are not those of three primaries and a white.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error(
    "its `chromaticities`, red {red:?}, green {green:?}, blue {blue:?} and white {white:?}, are not three primaries that mix to a white"
)]
pub struct BadPrimaries {
    /// x, y of red.
    pub red: [f32; 2],
    /// x, y of green.
    pub green: [f32; 2],
    /// x, y of blue.
    pub blue: [f32; 2],
    /// x, y of the white.
    pub white: [f32; 2],
}

/// Returns the matrix from a file's red, green and blue to those of sRGB, without chromatic adaptation, so colors are unchanged.
/// `None` if the header has no chromaticities (the format's default is the primaries of Rec. ITU-R BT.709, which are those of
/// sRGB) or those of sRGB.
///
/// # Errors
/// When the header's chromaticities are not primaries.
pub(super) fn srgb_from(found: Option<Chromaticities>) -> Result<Option<Matrix3>, BadPrimaries> {
    let Some(found) = found else {
        return Ok(None);
    };
    if is_srgb(found) {
        return Ok(None);
    }
    let point = |Vec2(x, y): Vec2<f32>| [f64::from(x), f64::from(y)];
    let primaries = [found.red, found.green, found.blue].map(point);
    let to_xyz = xyz_from_rgb_of(primaries, point(found.white));
    let matrix = product(srgb::rgb_from_xyz(), &to_xyz);
    let numbers = || to_xyz.iter().flatten();
    // Points on one line, or nearly on one, have no such matrix.
    let is_sound = numbers().all(|m| m.is_finite() && m.abs() < 100.0);
    is_sound.then_some(Some(matrix)).ok_or(BadPrimaries {
        red: [found.red.x(), found.red.y()],
        green: [found.green.x(), found.green.y()],
        blue: [found.blue.x(), found.blue.y()],
        white: [found.white.x(), found.white.y()],
    })
}

fn is_srgb(found: Chromaticities) -> bool {
    let [red, green, blue] = srgb::PRIMARIES;
    [
        (found.red, red),
        (found.green, green),
        (found.blue, blue),
        (found.white, srgb::WHITE),
    ]
    .iter()
    .all(|(found, own)| {
        (found.x() - own[0] as f32).abs() < SAME && (found.y() - own[1] as f32).abs() < SAME
    })
}
