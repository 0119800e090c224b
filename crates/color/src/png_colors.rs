//! The colors that the codes of a PNG file are.
//!
//! Of what a file says the first counts that can be used: `cICP`, `iCCP`, `sRGB`, `gAMA` with `cHRM` (PNG specification, third
//! edition, 4.3). A file that says nothing is in sRGB. White, the largest codes, stays white: where it is not D65 the colors are
//! adapted to it by Bradford's matrix, as ICC profiles have it.

mod icc_profile;
#[cfg(test)]
mod tests;

use std::io::Cursor;

use colorimetry::adaptation::Adaptation;
use colorimetry::chromaticity::xyz_of_xy;
use colorimetry::display::xyz_from_rgb_of;
use colorimetry::matrix::{product, times};
use colorimetry::{Matrix3, srgb};
use thiserror::Error;

use crate::cicp;
use icc_profile::ProfileCurve;

/// The most bytes that a file's tags may take.
const MAX_TAG_BYTES: usize = 64 << 20;
/// How far linear values may be from those of sRGB and be the same: profiles of sRGB hold rounded figures.
const SAME: f64 = 1e-3;
/// The gammas (of `gAMA`) that pictures have.
const GAMMA: std::ops::RangeInclusive<f64> = 0.1..=10.0;

/// Why the codes of a file are no colors.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PngColorsError {
    /// The file cannot be decoded.
    #[error("is not a PNG picture that can be read: {0}")]
    Decode(#[from] ::png::DecodingError),
    /// A chunk is damaged.
    #[error("its {0} chunk is damaged, or says what PNG does not allow")]
    Chunk(&'static str),
    /// The codes are no amounts of light that a surface could reflect.
    #[error(
        "its {0} chunk says that its codes are {1}, which no reflectance is; convert it to sRGB"
    )]
    Light(&'static str, &'static str),
    /// A number of H.273 that is not read.
    #[error(
        "its cICP chunk has {what} {number}, which is not read; primaries 1, 4 to 7, 9, 11 and 12 are, and transfer functions 1, 4, 5, 6, 8, 13, \
         14 and 15"
    )]
    CodePoint {
        /// What the number is of.
        what: &'static str,
        /// The number.
        number: u8,
    },
    /// Narrow range.
    #[error(
        "its cICP chunk says that its codes have the narrow range of video; convert it to the full range"
    )]
    NarrowRange,
    /// `gAMA` is out of all bounds.
    #[error("its gAMA chunk says {0}; from 0.1 to 10 is possible")]
    Gamma(f64),
    /// `cHRM` is no three primaries.
    #[error("its cHRM chunk has no three primaries that mix to a white")]
    Primaries,
}

/// What the codes of a picture are.
#[derive(Debug)]
pub struct CodeColors {
    curve: Curve,
    /// From the picture's primaries to those of sRGB; `None` where they are that.
    to_srgb: Option<Matrix3>,
    notes: Vec<String>,
}

/// From codes to light.
#[derive(Debug)]
enum Curve {
    Srgb,
    /// A code to this power.
    Power(f64),
    /// The camera's curve of BT.709 backwards, with the constants of H.273, table 3.
    Camera,
    /// Those of an ICC profile for red, green and blue.
    Profile(Box<[ProfileCurve; 3]>),
}

impl CodeColors {
    /// Codes of sRGB.
    pub fn srgb() -> Self {
        Self {
            curve: Curve::Srgb,
            to_srgb: None,
            notes: Vec::new(),
        }
    }

    /// What a PNG file says of its codes.
    ///
    /// # Errors
    /// When it cannot be decoded, or says what cannot be honored.
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

    /// What was honored, and what could not be, a line each; nothing of a picture in sRGB.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Linear red, green and blue of sRGB of codes of 16 bits: below 0 or above 1 where sRGB does not reach.
    pub fn linear_srgb(&self, codes: [u16; 3]) -> [f64; 3] {
        let codes = codes.map(|code| f64::from(code) / 65_535.0);
        let linear = std::array::from_fn(|i| self.curve.light(codes[i], i));
        match &self.to_srgb {
            None => linear,
            Some(matrix) => times(matrix, linear),
        }
    }

    /// Whether it makes no difference to read it as sRGB.
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

/// The first of a file's statements that can be used, and how it is told.
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

/// The name of a chunk and what it holds.
type Chunk<'a> = ([u8; 4], &'a [u8]);

/// The chunks before the first `IDAT`.
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

/// The name of a chunk about colors of which the decoder could only say that it is wrong.
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
            "the camera's curve of BT.709 backwards (not a screen's, BT.1886)",
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

/// From amounts of these primaries to those of sRGB, white to white; `None` where they are the same.
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
    // Points on one line, or nearly, have no such matrix.
    let mut numbers = matrix.iter().chain(&to_xyz).flatten();
    if numbers.all(|m| m.is_finite() && m.abs() < 100.0) {
        Ok(Some(matrix))
    } else {
        Err(PngColorsError::Primaries)
    }
}
