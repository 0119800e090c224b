//! Glare: what bright light does to its environment in the eye that sees it.
//!
//! A display is never as bright as a lamp, and scatters less light in the eye than the lamp would. What the lamp would have
//! scattered is put into the picture.

mod eye;
mod mirror;
mod star;

use colorimetry::Matrix3;

use super::{DevelopError, DevelopSettings, Latent, LinearImage};

pub use eye::{EyeGlare, Vision, point_spread};
pub use star::StarGlare;

/// What bright light does to its environment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Glare {
    /// Nothing.
    #[default]
    Off,
    /// What is brighter than the display becomes a star with four arms.
    Star(StarGlare),
    /// All light scatters as in a human eye.
    Eye(EyeGlare),
}

/// Adds glare to a picture that `rgb_from_xyz` made of `latent`.
pub(super) fn add(
    image: &mut LinearImage,
    latent: &Latent<'_>,
    rgb_from_xyz: &Matrix3,
    settings: &DevelopSettings,
) -> Result<(), DevelopError> {
    if image.rgb.is_empty() {
        return Ok(());
    }
    match settings.glare {
        Glare::Off => {}
        Glare::Star(star) => star::add(image, star, &settings.display),
        Glare::Eye(eye) => eye::add(image, latent, rgb_from_xyz, eye, settings.observer)?,
    }
    Ok(())
}
