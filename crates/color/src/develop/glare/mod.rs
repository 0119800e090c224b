//! Glare: the light that bright sources scatter around themselves in the eye of a viewer.
//!
//! A display is never as bright as a lamp, so less of its light scatters in the eye. The light that the lamp would have scattered
//! is added to the picture.

mod eye;
mod mirror;
mod star;

use colorimetry::Matrix3;

use super::{DevelopError, DevelopSettings, Latent};
use picture_file::LinearImage;

pub use eye::{EyeGlare, Vision, point_spread};
pub use star::StarGlare;

/// The glare around bright light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Glare {
    /// No glare.
    #[default]
    Off,
    /// Pixels brighter than the display's peak become stars with four arms.
    Star(StarGlare),
    /// All light scatters as in a human eye.
    Eye(EyeGlare),
}

/// Adds glare to a picture that `rgb_from_xyz` computed from `latent`.
pub(super) fn add(
    image: &mut LinearImage,
    latent: &Latent<'_>,
    rgb_from_xyz: &Matrix3,
    settings: &DevelopSettings,
) -> Result<(), DevelopError> {
    if image.rgb().is_empty() {
        return Ok(());
    }
    match settings.glare {
        Glare::Off => {}
        Glare::Star(star) => star::add(image, star, &settings.display),
        Glare::Eye(eye) => eye::add(image, latent, rgb_from_xyz, eye, settings.observer)?,
    }
    Ok(())
}
