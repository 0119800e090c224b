//! Developing a spectral image into a picture for a display.
//!
//! ```text
//! Latent            XYZ per pixel, and its spectra where a step needs them
//!   -> exposure     which luminance becomes the display's white
//!   -> adaptation   from the white of the scene to the white of the display
//!   -> glare        light scattered in the eye, or stars around pixels that are too bright
//!   -> LinearImage  red, green and blue of the display, linear, any values             -> rgb_exr
//!   -> gamut        colors that the display cannot show are mapped to colors that it can
//!   -> quantize     subtract the black level, response of each channel, codes, dither  -> png
//! ```
//!
//! [`DevelopSettings`] switches each step; a step that is off costs nothing. Arithmetic is `f64`. Between the steps pixels are
//! kept in `f32`, whose rounding error of 6e-8 is a hundredth of a step of 16 bits.

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

pub use adaptation::{LampLuminances, SceneWhite, WhiteAdaptation};
pub use exposure::Exposure;
pub use gamut::{Gamut, GamutMapping, GamutReport};
pub use glare::{EyeGlare, Glare, StarGlare, Vision};

use picture_file::{LinearImage, RgbImage8};
use relight::XyzImage;

/// How a picture is developed. The default is the sRGB display at 0 EV with gamut mapping and everything else off.
#[derive(Clone, Debug, PartialEq)]
pub struct DevelopSettings {
    /// The display that the picture is for.
    pub display: Display,
    /// The observer of the image's XYZ. It need not be the display's: a display whose primaries are known only for CIE 1931
    /// takes the XYZ of another observer as if they were of CIE 1931.
    pub observer: Observer,
    /// Which luminance becomes the display's white.
    pub exposure: Exposure,
    /// The adaptation from the scene's white to the display's; `None` leaves colors as the light makes them.
    pub adaptation: Option<WhiteAdaptation>,
    /// The glare around bright light.
    pub glare: Glare,
    /// How colors that the display cannot show are mapped.
    pub gamut: GamutMapping,
    /// Whether pixels that the display cannot show are marked with stripes.
    pub gamut_warning: bool,
    /// Whether the rounding to codes is spread over neighboring pixels.
    pub dither: bool,
}

impl DevelopSettings {
    /// The default settings for a display, with XYZ of the display's observer.
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

    /// The default settings for the sRGB display, exposed by `stops`.
    ///
    /// # Panics
    /// Never: sRGB is one of the built-in displays.
    pub fn srgb(stops: f64) -> Self {
        let display = Display::named("srgb").expect("sRGB has a name");
        Self {
            exposure: Exposure::Stops(stops),
            ..Self::new(display)
        }
    }
}

/// Why an image could not be developed.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum DevelopError {
    /// The glare depends on wavelength, and the image has no spectra.
    #[error("this glare depends on wavelength, but the image has only colors, without spectra")]
    NoSpectrum,
    /// The scene's white should be the mean color of an image that has none.
    #[error(
        "the mean color of the image is not a white to adapt from: it is black or not a number"
    )]
    NoWhite,
    /// The exposure should follow the image, which has no light.
    #[error("no pixel of the image has a finite luminance above 0: there is nothing to expose for")]
    NoLight,
}

/// An image to develop: XYZ per pixel, and the spectra from which they were computed, if available.
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

impl<'a> Latent<'a> {
    /// The same colors with their radiances, as `[pixel][band]`.
    ///
    /// # Panics
    /// When there is not one radiance for each pixel and band.
    #[must_use]
    pub fn with_bands(self, bands: &'a BandGrid, radiance: &'a [f32]) -> Self {
        let values = self.xyz.len() * bands.count() as usize;
        assert_eq!(radiance.len(), values, "each band of each pixel");
        Self {
            spectrum: Some((bands, radiance)),
            ..self
        }
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

/// Exposes, adapts and adds glare. The result is the picture in the display's red, green and blue, before anything is clipped.
///
/// # Errors
/// When a step needs data that the image lacks.
///
/// # Panics
/// Never: an image has as many colors as pixels.
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
    let [width, height] = image.size;
    let mut linear = LinearImage::new(width, height, rgb, 1.0 / scale)
        .expect("an image has as many colors as pixels");
    glare::add(&mut linear, &image, &rgb_from_xyz, settings)?;
    Ok(linear)
}

fn scaled(matrix: &Matrix3, factor: f64) -> Matrix3 {
    matrix.map(|row| row.map(|v| v * factor))
}

#[cfg(test)]
pub(crate) mod tests;
