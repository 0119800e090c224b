//! What surrounds the objects, in a validated scene.

use crate::prepared::DirectionTable;
use crate::{Emission, Texels};
use glam::DVec3;
use std::sync::Arc;

/// What surrounds the objects.
#[derive(Clone, Debug, PartialEq)]
pub enum Environment {
    /// The same radiance from every direction.
    Constant(Emission),
    /// A mixture by the height h = dot(direction, +Y): `horizon` at 0, `zenith` at 1, `ground` at −1,
    /// linear in h between.
    Gradient {
        /// Radiance from straight above.
        zenith: Emission,
        /// Radiance from the horizon.
        horizon: Emission,
        /// Radiance from straight below.
        ground: Emission,
    },
    /// A picture of all directions: the emission times what the picture has.
    Picture {
        /// The factor of the picture.
        emission: Emission,
        /// The picture.
        picture: Arc<EnvironmentPicture>,
    },
}

/// A picture of all directions by longitude and latitude, +Y on top.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentPicture {
    /// Its pixels.
    pub texels: Texels,
    /// What they hold.
    pub spectra: PictureSpectra,
    /// The direction of its middle, horizontal.
    pub forward: DVec3,
    /// The direction of the middle of its right half, horizontal.
    pub right: DVec3,
    /// Mean radiance, over all directions and wavelengths, of what light is sent for.
    pub sampled_mean: f64,
    /// For drawing directions in proportion to that.
    pub table: DirectionTable,
}

/// What the texels of a picture hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureSpectra {
    /// One each: coefficients of a smooth spectrum, and its factor.
    Smooth,
    /// A value for each band, four to a texel; the last texel is filled up with its last band.
    Bands,
}

/// Where the radiance of a part of the environment comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EnvironmentShape<'a> {
    /// Every direction alike.
    Everywhere,
    /// All around, by 1 − |h| with h the height of the direction.
    Horizon,
    /// About a pole, by the cosine with it; nothing from the other side.
    Pole(DVec3),
    /// By a picture.
    Picture(&'a EnvironmentPicture),
    /// A disk about a unit vector.
    DistantDisk {
        /// Toward its middle.
        toward: DVec3,
        /// 1 − cos of the angle between middle and edge, > 0.
        height: f64,
    },
}

/// A part of the environment: its radiance is its emission times the share that its shape has in the direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnvironmentPart<'a> {
    /// Where it comes from.
    pub shape: EnvironmentShape<'a>,
    /// Its radiance where the share is 1.
    pub emission: Emission,
}

impl Environment {
    /// The parts whose radiances add up to that of the environment, dark ones too.
    pub fn parts(&self) -> Vec<EnvironmentPart<'_>> {
        let part = |shape, emission| EnvironmentPart { shape, emission };
        match *self {
            Self::Picture {
                emission,
                ref picture,
            } => vec![part(EnvironmentShape::Picture(picture), emission)],
            Self::Constant(everywhere) => vec![part(EnvironmentShape::Everywhere, everywhere)],
            Self::Gradient {
                zenith,
                horizon,
                ground,
            } if zenith == horizon && horizon == ground => {
                vec![part(EnvironmentShape::Everywhere, horizon)]
            }
            Self::Gradient {
                zenith,
                horizon,
                ground,
            } => vec![
                part(EnvironmentShape::Horizon, horizon),
                part(EnvironmentShape::Pole(DVec3::Y), zenith),
                part(EnvironmentShape::Pole(DVec3::NEG_Y), ground),
            ],
        }
    }
}
