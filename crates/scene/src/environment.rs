//! What surrounds the objects, in a validated scene.

use crate::Emission;
use glam::DVec3;

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
}

/// Where the radiance of a part of the surroundings comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EnvironmentShape {
    /// Every direction alike.
    Everywhere,
    /// All around, by 1 − |h| with h the height of the direction.
    Horizon,
    /// About a pole, by the cosine with it; nothing from the other side.
    Pole(DVec3),
    /// A disc about a unit vector.
    Disc {
        /// Towards its middle.
        towards: DVec3,
        /// 1 − cos of the angle between middle and edge, > 0.
        height: f64,
    },
}

/// A part of the surroundings: its radiance is its emission times the share that its shape has in the direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnvironmentPart {
    /// Where it comes from.
    pub shape: EnvironmentShape,
    /// Its radiance where the share is 1.
    pub emission: Emission,
}

impl Environment {
    /// The parts whose radiances add up to that of the surroundings, dark ones too.
    pub fn parts(&self) -> Vec<EnvironmentPart> {
        let part = |shape, emission| EnvironmentPart { shape, emission };
        match *self {
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
