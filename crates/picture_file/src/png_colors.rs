//! The colors of the codes of a PNG file.
//!
//! The first usable declaration of a file counts: `cICP`, `iCCP`, `sRGB`, `gAMA` with `cHRM` (PNG specification, third
//! edition, 4.3). A file without a declaration is in sRGB. White, the largest codes, stays white: if it is not D65, the colors are
//! adapted to D65 by Bradford's matrix, as in ICC profiles.

mod icc_profile;
#[cfg(test)]
mod tests;

use std::io::Cursor;

use colorimetry::adaptation::Adaptation;
use colorimetry::chromaticity::{xyz_from_rgb_of, xyz_of_xy};
use colorimetry::matrix::{product, times};
use colorimetry::{Matrix3, srgb};
use thiserror::Error;

use crate::cicp;
use icc_profile::ProfileCurve;

/// The most bytes that a file's tags may take.
const MAX_TAG_BYTES: usize = 64 << 20;
/// Largest difference of linear values that count as those of sRGB: profiles of sRGB hold rounded numbers.
const SAME: f64 = 1e-3;
/// The range of plausible gammas of `gAMA`.
const GAMMA: std::ops::RangeInclusive<f64> = 0.1..=10.0;

/// Why the codes of a file cannot be converted to colors.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PngColorsError {
    /// The file cannot be decoded.
    #[error("is not a PNG picture that can be read: {0}")]
    Decode(#[from] ::png::DecodingError),
    /// A chunk is damaged.
    #[error("its {0} chunk is damaged, or has a value that PNG does not allow")]
    Chunk(&'static str),
    /// The codes do not stand for amounts of light that a surface could reflect.
    #[error(
        "its {0} chunk says that its codes are {1}, which does not encode reflectances; convert it to sRGB"
    )]
    Light(&'static str, &'static str),
    /// A code point of H.273 that is not supported.
    #[error(
        "its cICP chunk has {what} {number}, which is not supported; use primaries 1, 4 to 7, 9, 11 or 12 and transfer function 1, 4, 5, 6, 8, \
         13, 14 or 15"
    )]
    CodePoint {
        /// What the number denotes.
        what: &'static str,
        /// The number.
        number: u8,
    },
    /// The codes have narrow range.
    #[error(
        "its cICP chunk says that its codes have the narrow range of video; convert it to the full range"
    )]
    NarrowRange,
    /// `gAMA` is out of range.
    #[error("its gAMA chunk says {0}; it must be from 0.1 to 10")]
    Gamma(f64),
    /// `cHRM` does not describe three primaries.
    #[error("its cHRM chunk does not have three primaries that mix to a white")]
    Primaries,
}

/// The conversion from the codes of a picture to colors.
#[derive(Debug)]
pub struct CodeColors {
    curve: Curve,
    /// From the picture's primaries to those of sRGB; `None` if they are the same.
    to_srgb: Option<Matrix3>,
    notes: Vec<String>,
}

/// A function from codes to light.
#[derive(Debug)]
enum Curve {
    Srgb,
    /// The code to this power.
    Power(f64),
    /// The inverse of the camera curve of BT.709, with the constants of H.273, table 3.
    Camera,
    /// The curves of an ICC profile for red, green and blue.
    Profile(Box<[ProfileCurve; 3]>),
}

impl CodeColors {
    /// The conversion of sRGB codes.
    pub fn srgb() -> Self {
        Self {
            curve: Curve::Srgb,
            to_srgb: None,
            notes: Vec::new(),
        }
    }

    /// The conversion that a PNG file declares for its codes.
    ///
    /// # Errors
    /// When the file cannot be decoded, or declares a color space that is not supported.
    pub fn of_png(file: &[u8]) -> Result<Self, PngColorsError> {
        let limits = ::png::Limits {
            bytes: MAX_TAG_BYTES,
        };
        let decoder = ::png::Decoder::new_with_limits(Cursor::new(file), limits);
        let chunks = chunks_before_data(file);
        if let Some(name) = chunks.iter().find_map(damaged) {
            return Err(PngColorsError::Chunk(name));
        }
        let reader = decoder.read_info()?;
        let info = reader.info();
        let mut notes = Vec::new();
        let found = first_said(info, &chunks, &mut notes)?;
        let (mut colors, said) = found.unwrap_or((Self::srgb(), String::new()));
        if colors.is_srgb() {
            colors = Self::srgb();
        } else {
            notes.push(said);
        }
        colors.notes = notes;
        Ok(colors)
    }

    /// The declarations that were used and those that could not be, one line each; empty for a picture in sRGB.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Converts 16-bit codes to linear red, green and blue of sRGB; values are below 0 or above 1 outside the gamut of sRGB.
    pub fn linear_srgb(&self, codes: [u16; 3]) -> [f64; 3] {
        let codes = codes.map(|code| f64::from(code) / 65_535.0);
        let linear = std::array::from_fn(|i| self.curve.light(codes[i], i));
        match &self.to_srgb {
            None => linear,
            Some(matrix) => times(matrix, linear),
        }
    }

    /// Whether reading the codes as sRGB makes no difference.
    fn is_srgb(&self) -> bool {
        let steps = (0..=32).map(|i| i * 2047_u16);
        let codes = steps.flat_map(|v| [[v, v, v], [v, 0, 0], [0, v, 0], [0, 0, v]]);
        let srgb = Self::srgb();
        codes.into_iter().all(|codes| {
            let pair = self
                .linear_srgb(codes)
                .into_iter()
                .zip(srgb.linear_srgb(codes));
            pair.into_iter().all(|(a, b)| (a - b).abs() < SAME)
        })
    }
}

impl Curve {
    fn light(&self, code: f64, channel: usize) -> f64 {
        match self {
            Self::Srgb => srgb::decode(code),
            Self::Power(power) => code.powf(*power),
            Self::Camera => {
                let (alpha, beta) = (1.099_296_826_809_442, 0.018_053_968_510_807);
                if code < 4.5 * beta {
                    code / 4.5
                } else {
                    ((code + alpha - 1.0) / alpha).powf(1.0 / 0.45)
                }
            }
            Self::Profile(curves) => curves.get(channel).map_or(code, |curve| curve.light(code)),
        }
    }
}

/// Returns the first usable declaration of a file, and the note that reports it.
fn first_said(
    info: &::png::Info,
    chunks: &[Chunk],
    notes: &mut Vec<String>,
) -> Result<Option<(CodeColors, String)>, PngColorsError> {
    let has = |name: &[u8; 4]| chunks.iter().any(|(found, _)| found == name);
    if has(b"cICP") {
        let points = info.coding_independent_code_points;
        let points = points.ok_or(PngColorsError::Chunk("cICP"))?;
        let numbers = [points.color_primaries, points.transfer_function];
        if numbers.contains(&2) {
            notes.push("its cICP chunk leaves open what its codes are, and is not used".to_owned());
        } else {
            return of_code_points(points).map(Some);
        }
    }
    if has(b"iCCP") {
        let is_gray = matches!(
            info.color_type,
            ::png::ColorType::Grayscale | ::png::ColorType::GrayscaleAlpha
        );
        let profile = info.icc_profile.as_deref().unwrap_or_default();
        match icc_profile::colors(profile, is_gray)? {
            Ok(found) => return Ok(Some(found)),
            Err(problem) => notes.push(format!("its ICC profile {problem}, and is not used")),
        }
    }
    if has(b"sRGB") {
        return Ok(None);
    }
    of_gamma_and_primaries(info, has(b"gAMA"), has(b"cHRM"))
}

/// The name of a chunk and its data.
type Chunk<'a> = ([u8; 4], &'a [u8]);

/// Returns the chunks before the first `IDAT`.
fn chunks_before_data(file: &[u8]) -> Vec<Chunk<'_>> {
    let mut chunks = Vec::new();
    let mut rest = file.get(8..).unwrap_or_default();
    while let Some((length, after)) = rest.split_first_chunk::<4>() {
        let Some((name, after)) = after.split_first_chunk::<4>() else {
            break;
        };
        let length = u32::from_be_bytes(*length) as usize;
        let Some((data, after)) = after.split_at_checked(length) else {
            break;
        };
        if name == b"IDAT" {
            break;
        }
        chunks.push((*name, data));
        rest = after.get(4..).unwrap_or_default();
    }
    chunks
}

/// Returns the name of a damaged color chunk, for which the decoder gives no specific error.
fn damaged((name, data): &Chunk) -> Option<&'static str> {
    let (name, is_sound) = match name {
        b"cICP" => ("cICP", matches!(data, [_, _, 0, 0 | 1])),
        b"sRGB" => ("sRGB", matches!(data, [0..=3])),
        b"gAMA" => ("gAMA", data.len() == 4 && *data != [0; 4]),
        b"cHRM" => ("cHRM", data.len() == 32),
        _ => return None,
    };
    (!is_sound).then_some(name)
}

fn of_code_points(
    points: ::png::CodingIndependentCodePoints,
) -> Result<(CodeColors, String), PngColorsError> {
    if !points.is_video_full_range_image {
        return Err(PngColorsError::NarrowRange);
    }
    let unknown = |what, number| PngColorsError::CodePoint { what, number };
    let number = points.transfer_function;
    let (curve, name) = match number {
        1 | 6 | 14 | 15 => (
            Curve::Camera,
            "the inverse of the camera curve of BT.709 (not the display curve of BT.1886)",
        ),
        4 => (Curve::Power(2.2), "gamma 2.2"),
        5 => (Curve::Power(2.8), "gamma 2.8"),
        8 => (Curve::Power(1.0), "linear"),
        13 => (Curve::Srgb, "the curve of sRGB"),
        16 => return Err(PngColorsError::Light("cICP", "PQ")),
        18 => return Err(PngColorsError::Light("cICP", "HLG")),
        number => return Err(unknown("transfer function", number)),
    };
    let number = points.color_primaries;
    let [red, green, blue, white] =
        cicp::primaries(number).ok_or_else(|| unknown("primaries", number))?;
    let colors = CodeColors {
        curve,
        to_srgb: to_srgb([red, green, blue], white)?,
        notes: Vec::new(),
    };
    let said = format!(
        "read by its cICP chunk: {name}, primaries {number} of H.273 (1 is sRGB, 9 is BT.2020, 12 is P3)"
    );
    Ok((colors, said))
}

fn of_gamma_and_primaries(
    info: &::png::Info,
    has_gamma: bool,
    has_primaries: bool,
) -> Result<Option<(CodeColors, String)>, PngColorsError> {
    if !has_gamma && !has_primaries {
        return Ok(None);
    }
    let (mut colors, mut said) = (CodeColors::srgb(), Vec::new());
    if has_gamma {
        let gamma = info.gama_chunk.ok_or(PngColorsError::Chunk("gAMA"))?;
        let gamma = f64::from(gamma.into_scaled()) / 100_000.0;
        if !GAMMA.contains(&gamma) {
            return Err(PngColorsError::Gamma(gamma));
        }
        colors.curve = Curve::Power(1.0 / gamma);
        said.push(format!("gAMA {gamma}: codes to the power 1/{gamma}"));
    }
    if has_primaries {
        let found = info.chrm_chunk.ok_or(PngColorsError::Chunk("cHRM"))?;
        let point = |(x, y): (::png::ScaledFloat, ::png::ScaledFloat)| {
            [x, y].map(|value| f64::from(value.into_scaled()) / 100_000.0)
        };
        let primaries = [found.red, found.green, found.blue].map(point);
        colors.to_srgb = to_srgb(primaries, point(found.white))?;
        said.push("cHRM: primaries converted to those of sRGB".to_owned());
    }
    Ok(Some((colors, said.join("; "))))
}

/// Returns the matrix from amounts of these primaries to those of sRGB, white to white; `None` if they are the same.
fn to_srgb(primaries: [[f64; 2]; 3], white: [f64; 2]) -> Result<Option<Matrix3>, PngColorsError> {
    if primaries == srgb::PRIMARIES && white == srgb::WHITE {
        return Ok(None);
    }
    let to_xyz = xyz_from_rgb_of(primaries, white);
    let adapted = if white == srgb::WHITE {
        to_xyz
    } else {
        let to_d65 = Adaptation::Bradford.matrix(xyz_of_xy(white), srgb::white_xyz());
        product(&to_d65, &to_xyz)
    };
    let matrix = product(srgb::rgb_from_xyz(), &adapted);
    // Points on one line, or nearly on one, have no such matrix.
    let mut numbers = matrix.iter().chain(&to_xyz).flatten();
    if numbers.all(|m| m.is_finite() && m.abs() < 100.0) {
        Ok(Some(matrix))
    } else {
        Err(PngColorsError::Primaries)
    }
}
