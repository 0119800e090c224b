//! Reflectances over a surface, in a validated scene.

use crate::rounding::RoundToF32;
use crate::{SpectrumId, Texels};
use std::sync::Arc;

/// A reflectance that may vary over a surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// The same everywhere.
    Uniform(SpectrumId),
    /// A checkerboard of squares (on planes, rectangles and disks, along the surface's two axes from its center) or cubes (on spheres, from
    /// the center): `even` where the sum of ⌊coordinate / size⌋ is even.
    Checker {
        /// Reflectance of the square whose corner is the center.
        even: SpectrumId,
        /// Reflectance of its neighbors.
        odd: SpectrumId,
        /// Side of a square, > 0.
        size: f64,
    },
    /// A picture whose texels are the coefficients of smooth reflectances.
    Texture {
        /// The picture.
        texels: Arc<Texels>,
        /// Width and height on planes, rectangles and disks; `None` is the whole rectangle, the square around a disk, or a square of side 1
        /// on a plane.
        size: Option<[f64; 2]>,
    },
}

impl RoundToF32 for Pattern {
    fn rounded(&self) -> Self {
        match self {
            Self::Uniform(spectrum) => Self::Uniform(*spectrum),
            Self::Checker { even, odd, size } => Self::Checker {
                even: *even,
                odd: *odd,
                size: size.rounded(),
            },
            Self::Texture { texels, size } => Self::Texture {
                texels: Arc::clone(texels),
                size: size.map(|size| size.map(|side| side.rounded())),
            },
        }
    }
}
