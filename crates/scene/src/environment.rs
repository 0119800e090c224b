//! The environment of a validated scene.

use crate::rounding::RoundToF32;
use crate::{DirectionTable, Emission, Texels};
use glam::DVec3;
use std::sync::Arc;

/// The environment: what rays meet that leave the scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Environment {
    /// The same radiance from every direction.
    Constant(Emission),
    /// A mixture by the height h = dot(direction, +Y): `horizon` at 0, `zenith` at 1, `ground` at −1, linear in h in between.
    Gradient {
        /// Radiance from straight above.
        zenith: Emission,
        /// Radiance from the horizon.
        horizon: Emission,
        /// Radiance from straight below.
        ground: Emission,
    },
    /// A picture of all directions: the emission times the picture's radiance.
    Picture {
        /// The factor of the picture.
        emission: Emission,
        /// The picture.
        picture: Arc<EnvironmentPicture>,
    },
}

/// A picture of all directions by longitude and latitude, with +Y at the top.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentPicture {
    /// Its pixels.
    pub texels: Texels,
    /// The meaning of the texels.
    pub spectra: PictureSpectra,
    /// The direction of its center, horizontal.
    pub forward: DVec3,
    /// The direction of the center of its right half, horizontal.
    pub right: DVec3,
    /// Mean over all directions and wavelengths of the radiance that is importance-sampled.
    pub sampled_mean: f64,
    /// The table for sampling directions in proportion to this radiance.
    pub table: DirectionTable,
}

/// The meaning of the texels of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureSpectra {
    /// One texel per pixel: the coefficients of a smooth spectrum, and its factor.
    Smooth,
    /// A value for each band, four per texel; the last band pads the last texel.
    Bands,
}

/// The directional distribution of a part of the environment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EnvironmentShape<'a> {
    /// The same in every direction.
    Everywhere,
    /// Proportional to 1 − |h|, with h the height of the direction.
    Horizon,
    /// Proportional to the cosine with a pole; 0 on the other side.
    Pole(DVec3),
    /// Given by a picture.
    Picture(&'a EnvironmentPicture),
    /// A disk about a unit vector.
    DistantDisk {
        /// The direction of its center.
        toward: DVec3,
        /// 1 − cos of the angle between center and edge, > 0.
        height: f64,
    },
}

/// A part of the environment: its radiance is its emission times a weight that depends on its shape and the direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnvironmentPart<'a> {
    /// Its directional distribution.
    pub shape: EnvironmentShape<'a>,
    /// Its radiance where the weight is 1.
    pub emission: Emission,
}

impl Environment {
    /// The parts whose radiances sum to the environment's radiance, including dark ones.
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

impl RoundToF32 for Environment {
    fn rounded(&self) -> Self {
        match self {
            Self::Constant(emission) => Self::Constant(emission.rounded()),
            Self::Picture { emission, picture } => Self::Picture {
                emission: emission.rounded(),
                picture: Arc::new(EnvironmentPicture {
                    texels: picture.texels.clone(),
                    spectra: picture.spectra,
                    forward: picture.forward.rounded(),
                    right: picture.right.rounded(),
                    // A factor of brightnesses, which are rounded themselves.
                    sampled_mean: picture.sampled_mean,
                    table: picture.table.clone(),
                }),
            },
            Self::Gradient {
                zenith,
                horizon,
                ground,
            } => Self::Gradient {
                zenith: zenith.rounded(),
                horizon: horizon.rounded(),
                ground: ground.rounded(),
            },
        }
    }
}
