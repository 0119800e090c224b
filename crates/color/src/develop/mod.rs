//! A spectral image developed into a picture for a display.
//!
//! ```text
//! Latent            XYZ per pixel, and its spectra where a step needs them
//!   -> exposure     how much light becomes the display's white
//!   -> adaptation   from the white of the scene to that of the display
//!   -> glare        light that the eye scatters, or a star about what is too bright
//!   -> LinearImage  red, green and blue of the display, linear, of any size          -> rgb_exr
//!   -> gamut        what the display cannot show becomes what it can
//!   -> quantize     black level taken off, response of each channel, codes, dither  -> png
//! ```
//!
//! [`DevelopSettings`] switches each step; one that is off costs nothing. Arithmetic is `f64`. Between the steps a pixel is kept
//! in `f32`: its rounding, 6e-8, is a hundredth of a step of 16 bits.

pub mod adaptation;
pub mod exposure;
pub mod gamut;
pub mod glare;
pub mod quantize;

use colorimetry::matrix::{product, times};
use colorimetry::{Display, Matrix3};
use rayon::prelude::*;
use spectra::{BandGrid, Observer, SpectralImage};
use thiserror::Error;

pub use adaptation::{SceneWhite, WhiteAdaptation};
pub use exposure::Exposure;
pub use gamut::{Gamut, GamutMapping, GamutReport};
pub use glare::{EyeGlare, Glare, StarGlare, Vision};
pub use quantize::Code;

use crate::{RgbImage8, XyzImage};

/// How a picture is developed. The default is the sRGB display at 0 EV, out of gamut colors mapped, all else off.
#[derive(Clone, Debug, PartialEq)]
pub struct DevelopSettings {
    /// The display that the picture is for.
    pub display: Display,
    /// The observer that the image's XYZ are for. It need not be the display's: primaries known for CIE 1931 alone take XYZ of
    /// others as if they were of that.
    pub observer: Observer,
    /// How much light becomes its white.
    pub exposure: Exposure,
    /// From which white to its own; `None` leaves colors as the light makes them.
    pub adaptation: Option<WhiteAdaptation>,
    /// What bright light does to its environment.
    pub glare: Glare,
    /// What becomes of colors that it cannot show.
    pub gamut: GamutMapping,
    /// Mark the pixels that it cannot show with stripes.
    pub gamut_warning: bool,
    /// Spread the rounding to codes over neighboring pixels.
    pub dither: bool,
}

impl DevelopSettings {
    /// The default on a display, of XYZ of the observer that it is for.
    pub fn new(display: Display) -> Self {
        Self {
            observer: display.observer(),
            display,
            exposure: Exposure::default(),
            adaptation: None,
            glare: Glare::Off,
            gamut: GamutMapping::default(),
            gamut_warning: false,
            dither: false,
        }
    }

    /// The default on the sRGB display, exposed by `stops`.
    ///
    /// # Panics
    /// Never: sRGB is among the displays that come with this software.
    pub fn srgb(stops: f64) -> Self {
        let display = Display::named("srgb").expect("sRGB has a name");
        Self {
            exposure: Exposure::Stops(stops),
            ..Self::new(display)
        }
    }
}

/// Why an image was not developed.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum DevelopError {
    /// The glare depends on wavelength, and the image has no spectra.
    #[error("this glare depends on wavelength, and the image is one of colors without spectra")]
    NoSpectrum,
    /// The scene's white is to be the mean color of an image that has none.
    #[error("the mean color of the image is no white to adapt from: it is black, or no number")]
    NoWhite,
    /// The exposure is to follow the image, which has no light.
    #[error(
        "no pixel of the image has a luminance above 0 that is a number: there is nothing to expose for"
    )]
    NoLight,
}

/// An image to develop: XYZ per pixel, and the spectra that they came from where they are at hand.
#[derive(Clone, Copy, Debug)]
pub struct Latent<'a> {
    size: [u32; 2],
    xyz: &'a [[f32; 3]],
    spectrum: Option<(&'a BandGrid, &'a [f32])>,
}

impl<'a> From<&'a SpectralImage> for Latent<'a> {
    fn from(image: &'a SpectralImage) -> Self {
        Self {
            size: [image.width(), image.height()],
            xyz: image.xyz(),
            spectrum: Some((image.bands(), image.radiance())),
        }
    }
}

impl<'a> From<&'a XyzImage> for Latent<'a> {
    fn from(image: &'a XyzImage) -> Self {
        Self {
            size: [image.width(), image.height()],
            xyz: image.xyz(),
            spectrum: None,
        }
    }
}

/// Red, green and blue of a display per pixel, linear, 1 for its white; any values, below 0 and above 1 too. Row 0 is on top.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearImage {
    width: u32,
    height: u32,
    rgb: Vec<[f32; 3]>,
    white_cd_m2: f64,
}

impl LinearImage {
    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The amounts of each pixel, row by row.
    pub fn rgb(&self) -> &[[f32; 3]] {
        &self.rgb
    }

    /// How many pixels are no numbers.
    pub fn not_finite(&self) -> usize {
        let pixels = self.rgb.par_iter();
        pixels
            .filter(|rgb| !rgb.iter().all(|v| v.is_finite()))
            .count()
    }

    /// The luminance in the scene that is the display's white, cd/m² up to the scene's scale.
    pub fn white_cd_m2(&self) -> f64 {
        self.white_cd_m2
    }

    /// Replaces each pixel, given its place, on all cores.
    fn map(&mut self, change: impl Fn([usize; 2], [f64; 3]) -> [f64; 3] + Sync) {
        let width = (self.width as usize).max(1);
        let rows = self.rgb.par_chunks_mut(width).enumerate();
        rows.for_each(|(y, row)| {
            for (x, pixel) in row.iter_mut().enumerate() {
                *pixel = change([x, y], pixel.map(f64::from)).map(|v| v as f32);
            }
        });
    }
}

/// Develops an image into 8-bit codes: [`expose`], [`gamut::map`], [`quantize::codes`].
///
/// # Errors
/// As [`expose`].
pub fn develop<'a>(
    image: impl Into<Latent<'a>>,
    settings: &DevelopSettings,
) -> Result<RgbImage8, DevelopError> {
    let mut linear = expose(image, settings)?;
    gamut::map(&mut linear, settings);
    Ok(quantize::codes(&linear, &settings.display, settings.dither))
}

/// Exposes, adapts and adds glare: the picture in the display's red, green and blue, before anything is cut off.
///
/// # Errors
/// When a step needs what the image does not have.
pub fn expose<'a>(
    image: impl Into<Latent<'a>>,
    settings: &DevelopSettings,
) -> Result<LinearImage, DevelopError> {
    let image = image.into();
    let scale = settings.exposure.scale(image.xyz)?;
    let display = &settings.display;
    let adapted = match &settings.adaptation {
        None => colorimetry::matrix::IDENTITY,
        Some(adaptation) => adaptation.matrix(image.xyz, display.white_xyz())?,
    };
    let rgb_from_xyz = scaled(&product(display.rgb_from_xyz(), &adapted), scale);
    let rgb = image
        .xyz
        .par_iter()
        .with_min_len(4096)
        .map(|xyz| times(&rgb_from_xyz, xyz.map(f64::from)).map(|v| v as f32))
        .collect();
    let mut linear = LinearImage {
        width: image.size[0],
        height: image.size[1],
        rgb,
        white_cd_m2: 1.0 / scale,
    };
    glare::add(&mut linear, &image, &rgb_from_xyz, settings)?;
    Ok(linear)
}

fn scaled(matrix: &Matrix3, factor: f64) -> Matrix3 {
    matrix.map(|row| row.map(|v| v * factor))
}

#[cfg(test)]
pub(crate) mod tests;
