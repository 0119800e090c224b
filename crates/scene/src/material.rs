//! What a surface is made of, in a validated scene.

use crate::SpectrumId;
use crate::description::PathDifference;
use glam::DVec3;

/// What a surface is made of. Every surface has two sides that behave alike.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// Lambertian reflection.
    Diffuse {
        /// Reflectance, in \[0, 1\] at every wavelength.
        reflectance: Pattern,
    },
    /// An opaque metal (or any opaque medium) of complex index n + ik, under a stack of layers.
    Conductor {
        /// Real part of the index.
        n: SpectrumId,
        /// Imaginary part of the index, k ≥ 0.
        k: SpectrumId,
        /// What lies on it, the outermost layer first; none on a bare surface.
        layers: Vec<Layer>,
        /// Root mean square slope m of the Beckmann distribution; 0 is a smooth mirror.
        roughness: f64,
    },
    /// A free thin film between air and air. Rays reflect from it and pass straight through it.
    Film {
        /// Its layers, at least one: the first on the outside of a sphere or on the side of a plane's normal.
        layers: Vec<Layer>,
        /// Whether k is 0 at every wavelength in every layer, so that R + T = 1.
        transparent: bool,
        /// How its reflectance and transmittance are computed.
        interference: Interference,
    },
    /// A surface that emits the same radiance from every point in every direction, on both sides.
    Emitter {
        /// What it emits.
        emission: Emission,
        /// Lambertian reflectance besides; `None` is black.
        reflectance: Option<SpectrumId>,
    },
}

/// A layer of a film or of a coating.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Real part of its index.
    pub n: SpectrumId,
    /// Imaginary part of its index, k ≥ 0.
    pub k: SpectrumId,
    /// Thickness over the surface.
    pub thickness: Thickness,
}

/// How the interference of a free film is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interference {
    /// All passes of the light.
    Exact,
    /// Two beams in reflection, none in transmission, in a single layer that does not absorb
    /// (Suzuki, Yokoi and Toriwaki, section 4-2).
    TwoBeam(PathDifference),
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

/// The thickness of a film over its surface, nm, ≥ 0 everywhere.
#[derive(Clone, Debug, PartialEq)]
pub enum Thickness {
    /// The same everywhere.
    Constant {
        /// Thickness, nm.
        nm: f64,
    },
    /// Linear in the polar angle θ seen from a sphere's centre: `pole_nm` at θ = 0, `equator_nm` at
    /// θ = 90°, and on at the same rate (Suzuki, Yokoi and Toriwaki, section 4-4 (2)).
    Polar {
        /// Direction of the pole, a unit vector.
        axis: DVec3,
        /// Thickness at the pole, nm.
        pole_nm: f64,
        /// Thickness at 90° from the pole, nm.
        equator_nm: f64,
    },
    /// Linear along a line in space from `start` to `end`, constant beyond its ends.
    Linear {
        /// Where the thickness is `start_nm`.
        start: DVec3,
        /// Where the thickness is `end_nm`, different from `start`.
        end: DVec3,
        /// Thickness at and before `start`, nm.
        start_nm: f64,
        /// Thickness at and beyond `end`, nm.
        end_nm: f64,
    },
}
