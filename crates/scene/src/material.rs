//! What a surface is made of, in a validated scene.

use crate::{SpectrumId, Thickness};

/// What a surface is made of. Every surface has two sides that behave alike.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// Lambertian reflection.
    Diffuse {
        /// Reflectance, in \[0, 1\] at every wavelength.
        reflectance: Pattern,
    },
    /// An opaque metal (or any opaque medium) of complex index n + ik.
    Conductor {
        /// Real part of the index.
        n: SpectrumId,
        /// Imaginary part of the index, k ≥ 0.
        k: SpectrumId,
        /// Root mean square slope m of the Beckmann distribution; 0 is a smooth mirror.
        roughness: f64,
    },
    /// A free thin film: air, one layer, air. Rays reflect from it and pass straight through it.
    Film {
        /// Real part of the layer's index.
        n: SpectrumId,
        /// Imaginary part of the layer's index, k ≥ 0.
        k: SpectrumId,
        /// Whether k is 0 at every wavelength, so that R + T = 1.
        transparent: bool,
        /// Thickness over the surface.
        thickness: Thickness,
    },
    /// A surface that emits the same radiance from every point in every direction, on both sides.
    Emitter {
        /// What it emits.
        emission: Emission,
        /// Lambertian reflectance besides; `None` is black.
        reflectance: Option<SpectrumId>,
    },
}

impl Material {
    /// The thicknesses of its layers.
    pub fn thicknesses(&self) -> impl Iterator<Item = &Thickness> {
        let only = match self {
            Self::Film { thickness, .. } => Some(thickness),
            _ => None,
        };
        only.into_iter()
    }
}

/// A spectrum of radiance and its scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Spectrum at scale 1, ≥ 0.
    pub spectrum: SpectrumId,
    /// Factor, ≥ 0.
    pub scale: f64,
}

/// A reflectance over a surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// The same everywhere.
    Uniform(SpectrumId),
    /// Squares (on planes and rectangles, in the surface's two axes from its centre) or cubes (on
    /// spheres, from the centre) of two reflectances: `even` where the sum of ⌊coordinate / size⌋ is even.
    Checker {
        /// Reflectance of the square whose corner is the centre.
        even: SpectrumId,
        /// Reflectance of its neighbours.
        odd: SpectrumId,
        /// Side of a square, > 0.
        size: f64,
    },
}
