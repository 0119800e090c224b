//! Materials of a validated scene.

use crate::rounding::RoundToF32;
use crate::{CoatedBody, Cook1981, Emission, Microsurface, Pattern, SpectrumId, Thickness};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a surface is made of. Every surface has two sides, which behave alike, except those of an absorbing film of several layers: from
/// behind, light meets its layers in the reverse order.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// Lambertian reflection.
    Diffuse {
        /// Reflectance, in \[0, 1\] at every wavelength.
        reflectance: Pattern,
    },
    /// An opaque metal (or any opaque medium) of complex index n + ik, under a stack of layers.
    Interface {
        /// Real part of the index.
        n: SpectrumId,
        /// Imaginary part of the index, k ≥ 0.
        k: SpectrumId,
        /// The layers on it, the outermost first; empty for a bare surface.
        layers: Vec<Layer>,
        /// Its facets; `None` if it is smooth.
        microsurface: Option<Microsurface>,
    },
    /// An opaque metal by the model of Cook and Torrance.
    Cook(Cook1981),
    /// A diffuse body below a clear coat.
    CoatedBody(CoatedBody),
    /// A free thin film with air on both sides. It reflects rays and transmits them in a straight line.
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
        /// Its Lambertian reflectance; `None` is black.
        reflectance: Option<SpectrumId>,
    },
}

impl Material {
    /// Its layers, the outermost first; empty if it has no layers.
    pub fn layers(&self) -> &[Layer] {
        match self {
            Self::Interface { layers, .. } | Self::Film { layers, .. } => layers,
            _ => &[],
        }
    }

    /// Its facets; `None` if it is smooth or diffuse.
    pub fn microsurface(&self) -> Option<&Microsurface> {
        match self {
            Self::Interface { microsurface, .. }
            | Self::CoatedBody(CoatedBody { microsurface, .. }) => microsurface.as_ref(),
            _ => None,
        }
    }

    /// What it emits; `None` if it is not an emitter.
    pub fn emission(&self) -> Option<Emission> {
        match self {
            Self::Emitter { emission, .. } => Some(*emission),
            _ => None,
        }
    }

    /// Whether it scatters light only in single directions, as smooth metals and films do.
    pub fn is_mirror(&self) -> bool {
        match self {
            Self::Film { .. } => true,
            Self::Interface { microsurface, .. } => microsurface.is_none(),
            _ => false,
        }
    }

    /// The thicknesses of its layers.
    pub fn thicknesses(&self) -> impl Iterator<Item = &Thickness> {
        self.layers().iter().map(|layer| &layer.thickness)
    }
}

impl Material {
    /// A mutable reference to its emission, or to the ambient light that it reflects.
    pub fn emission_mut(&mut self) -> Option<&mut Emission> {
        match self {
            Self::Emitter { emission, .. } => Some(emission),
            Self::Cook(Cook1981 { ambient, .. }) => ambient.as_mut(),
            _ => None,
        }
    }
}

impl RoundToF32 for Material {
    fn rounded(&self) -> Self {
        match self {
            Self::Diffuse { reflectance } => Self::Diffuse {
                reflectance: reflectance.rounded(),
            },
            Self::Interface {
                n,
                k,
                layers,
                microsurface,
            } => Self::Interface {
                n: *n,
                k: *k,
                layers: layers.iter().map(RoundToF32::rounded).collect(),
                microsurface: microsurface.as_ref().map(RoundToF32::rounded),
            },
            Self::Cook(cook) => Self::Cook(cook.rounded()),
            Self::CoatedBody(body) => Self::CoatedBody(body.rounded()),
            Self::Film {
                layers,
                transparent,
                interference,
            } => Self::Film {
                layers: layers.iter().map(RoundToF32::rounded).collect(),
                transparent: *transparent,
                interference: *interference,
            },
            Self::Emitter {
                emission,
                reflectance,
            } => Self::Emitter {
                emission: emission.rounded(),
                reflectance: *reflectance,
            },
        }
    }
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
    /// All beams.
    Exact,
    /// Two beams in reflection, and transmission without interference, in a single layer that does not absorb (Suzuki, Yokoi and Toriwaki,
    /// section 4-2).
    TwoBeam(PathDifference),
}

/// The path difference l between the two beams of a film of thickness d and index n, refracted to the angle θ₂.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PathDifference {
    /// l = 2 n d cos θ₂, the physical path difference.
    Optical,
    /// l = 2 d cos θ₂, as the paper prints it, without the index.
    AsPrinted,
}

impl RoundToF32 for Layer {
    fn rounded(&self) -> Self {
        Self {
            n: self.n,
            k: self.k,
            thickness: self.thickness.rounded(),
        }
    }
}
