//! The values of the options of developing, and their parsers.

use crate::lamp;
use clap::ValueEnum;
use miette::{IntoDiagnostic, WrapErr};
use pellicle::color::develop::{Exposure, GamutMapping, SceneWhite, Vision};
use pellicle::colorimetry::chromaticity::xy_of_xyz;
use pellicle::colorimetry::{Display, tristimulus};
use pellicle::spectra::stokes::Polarizer;
use pellicle::spectra::{Observer, Spectrum};
use std::ops::RangeInclusive;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ExposureOption {
    Fixed(Exposure),
    /// The luminance of the display's own white.
    Display,
}

/// A white to adapt from. The white of a lamp depends on the observer.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum White {
    Of(SceneWhite),
    Lamp(String, Spectrum),
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(super) enum GlareName {
    Off,
    Star,
    Photopic,
    Mesopic,
    Scotopic,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(super) enum GamutName {
    Perceptual,
    White,
    Clip,
    Keep,
}

/// The allowed stops of an exposure.
pub(super) const STOPS: RangeInclusive<f64> = -40.0..=40.0;
/// The luminances that can become the white.
pub(super) const LUMINANCES: RangeInclusive<f64> = 1e-9..=1e12;
pub(super) const FOV_DEG: RangeInclusive<f64> = 0.01..=170.0;
pub(super) const ANGLES_DEG: RangeInclusive<f64> = -360.0..=360.0;
pub(super) const STAR_LENGTHS: RangeInclusive<f64> = 1e-4..=10.0;

/// Parses a number within a range.
pub(super) fn number(text: &str, range: &RangeInclusive<f64>) -> Option<f64> {
    text.trim().parse().ok().filter(|v| range.contains(v))
}

pub(super) fn exposure(text: &str) -> Result<ExposureOption, String> {
    let fixed = match text.split_once(':') {
        _ if text == "display" => return Ok(ExposureOption::Display),
        _ if text == "auto" => Some(Exposure::Percentile(99.0)),
        Some(("auto", percent)) => number(percent, &(0.0..=100.0)).map(Exposure::Percentile),
        _ => match text.strip_suffix("cd") {
            Some(luminance) => number(luminance, &LUMINANCES).map(Exposure::White),
            None => number(text, &STOPS).map(Exposure::Stops),
        },
    };
    fixed.map(ExposureOption::Fixed).ok_or_else(|| {
        "write stops from -40 to 40 (3), a luminance in cd/m² (250cd), display, auto, or auto with a percentage \
         (auto:95)"
            .to_owned()
    })
}

pub(super) fn display(text: &str) -> Result<Display, String> {
    Display::open(text).map_err(|error| error.to_string())
}

pub(super) fn white(text: &str) -> Result<White, String> {
    if text == "mean" {
        return Ok(White::Of(SceneWhite::Mean));
    }
    if let Some((x, y)) = text.split_once(',') {
        let share = 1e-3..=1.0;
        let xy = number(x, &share).zip(number(y, &share));
        return match xy.filter(|(x, y)| x + y <= 1.0) {
            Some((x, y)) => Ok(White::Of(SceneWhite::Chromaticity([x, y]))),
            None => Err(
                "a chromaticity is two numbers above 0 with a sum up to 1, as in 0.3127,0.3290"
                    .to_owned(),
            ),
        };
    }
    let (name, spectrum) = lamp::spectrum(text)?;
    Ok(White::Lamp(name, spectrum))
}

impl White {
    /// Returns the white as the observer sees it. A lamp's table is linear between its points, as in the renderer, even for
    /// lamps with lines.
    pub(super) fn seen_by(&self, observer: Observer) -> miette::Result<SceneWhite> {
        let (name, spectrum) = match self {
            Self::Of(white) => return Ok(*white),
            Self::Lamp(name, spectrum) => (name, spectrum),
        };
        let xyz = tristimulus::xyz_of_emission(spectrum, observer, tristimulus::Rule::OneNm);
        let xyz = xyz
            .into_diagnostic()
            .wrap_err_with(|| format!("--adapt-from {name}"))?;
        Ok(SceneWhite::Chromaticity(xy_of_xyz(xyz)))
    }
}

pub(super) fn polarizer(text: &str) -> Result<Polarizer, String> {
    let angle_deg = number(text, &ANGLES_DEG)
        .ok_or_else(|| "the angle of a polarizer is -360 to 360 degrees".to_owned())?;
    Ok(Polarizer {
        angle_deg,
        retarder: None,
    })
}

pub(super) fn fov(text: &str) -> Result<f64, String> {
    number(text, &FOV_DEG).ok_or_else(|| "a field of view is 0.01 to 170 degrees".to_owned())
}

pub(super) fn star_length(text: &str) -> Result<f64, String> {
    number(text, &STAR_LENGTHS).ok_or_else(|| "a fraction of the height is 0.0001 to 10".to_owned())
}

pub(super) fn bits(text: &str) -> Result<u8, String> {
    match text {
        "8" => Ok(8),
        "16" => Ok(16),
        "32" => Ok(32),
        _ => Err("a channel has 8 or 16 bits in a .png, 16 or 32 in an .exr".to_owned()),
    }
}

impl From<GamutName> for GamutMapping {
    fn from(name: GamutName) -> Self {
        match name {
            GamutName::Perceptual => Self::Perceptual,
            GamutName::White => Self::TowardWhite,
            GamutName::Clip => Self::Clip,
            GamutName::Keep => Self::Keep,
        }
    }
}

impl GlareName {
    pub(super) fn vision(self) -> Option<Vision> {
        match self {
            Self::Off | Self::Star => None,
            Self::Photopic => Some(Vision::Photopic),
            Self::Mesopic => Some(Vision::Mesopic),
            Self::Scotopic => Some(Vision::Scotopic),
        }
    }
}
