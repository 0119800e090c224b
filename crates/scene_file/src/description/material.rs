//! Materials as written in a scene file.

use super::{ConductorModel, Emission, Finish, Index, Reflectance, Thickness};
use crate::limits;
use scene::PathDifference;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What a surface is made of. Every surface has two sides, which behave alike, except those of an absorbing film of several layers: from
/// behind, light meets its layers in the reverse order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum Material {
    /// Reflects light diffusely, with the same radiance in all directions (Lambert).
    Diffuse {
        /// The reflectance, or a pattern of two.
        reflectance: DiffuseReflectance,
    },
    /// A metal, or any opaque medium of complex index.
    Conductor {
        /// The index.
        index: Index,
        /// How rough it is.
        #[serde(flatten)]
        finish: Finish,
        /// The reflection model; "microfacets" when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        model: Option<ConductorModel>,
    },
    /// Glass, enamel, lacquer: a clear coat over a diffuse base; without a base, an opaque body that absorbs all light that enters it.
    Dielectric {
        /// The index of the coat or body. Above a base it must be clear: k up to 1e-5 counts as 0, and more is an error.
        index: Index,
        /// How rough it is.
        #[serde(flatten)]
        finish: Finish,
        /// The reflectance of the base below the coat, or a pattern of two. When absent, there is no base, only an opaque body.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        base: Option<DiffuseReflectance>,
    },
    /// A free thin film with air on both sides: one layer (`index` and `thickness_nm`) or several (`layers`). It reflects light and
    /// transmits it in a straight line, both with interference.
    Film {
        /// The index of the only layer.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        index: Option<Index>,
        /// Thickness of the only layer, in nm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        thickness_nm: Option<Thickness>,
        /// The layers, the first on the outside of a sphere or on the side that a plane's normal points to.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(length(min = 1, max = limits::MAX_LAYERS))]
        layers: Option<Vec<Layer>>,
        /// How interference is computed.
        #[serde(default)]
        model: FilmModel,
        /// The path difference that `model = "two_beam"` uses; "optical" when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        path_difference: Option<PathDifference>,
    },
    /// A stack of thin layers on a metal, or on any opaque medium: one layer (`index` and `thickness_nm`) or several (`layers`). The
    /// substrate absorbs all light that enters it. Each facet of a rough surface reflects as the stack does at the facet's own angle of
    /// incidence.
    Coated {
        /// The index of the substrate.
        substrate: Index,
        /// The index of the only layer.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        index: Option<Index>,
        /// Thickness of the only layer, in nm.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        thickness_nm: Option<Thickness>,
        /// The layers, the outermost first.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(length(min = 1, max = limits::MAX_LAYERS))]
        layers: Option<Vec<Layer>>,
        /// How rough it is.
        #[serde(flatten)]
        finish: Finish,
    },
    /// Emits the same radiance from every point in every direction, on both sides.
    Emitter {
        /// What it emits.
        emission: Emission,
        /// Its diffuse reflectance for incident light; black when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        reflectance: Option<Reflectance>,
        /// The light group that it belongs to: 1 to 32 ASCII letters, digits, `_` or `-`. When absent, it shares a group with all emitters
        /// of the same spectrum that name none.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        light_group: Option<String>,
    },
}

impl Material {
    /// A diffuse surface of uniform reflectance.
    pub fn diffuse(reflectance: Reflectance) -> Self {
        Self::Diffuse {
            reflectance: DiffuseReflectance::Uniform(reflectance),
        }
    }

    /// A smooth metal, or any smooth opaque medium.
    pub fn conductor(index: Index) -> Self {
        Self::Conductor {
            index,
            finish: Finish::default(),
            model: None,
        }
    }

    /// An emitter that reflects nothing.
    pub fn emitter(emission: Emission) -> Self {
        Self::Emitter {
            emission,
            reflectance: None,
            light_group: None,
        }
    }

    /// A free film of one layer.
    pub fn film(index: Index, thickness_nm: Thickness) -> Self {
        Self::Film {
            index: Some(index),
            thickness_nm: Some(thickness_nm),
            layers: None,
            model: FilmModel::Exact,
            path_difference: None,
        }
    }

    /// The thicknesses of its layers.
    pub(crate) fn thicknesses(&self) -> impl Iterator<Item = &Thickness> {
        let (only, layers) = match self {
            Self::Film {
                thickness_nm,
                layers,
                ..
            }
            | Self::Coated {
                thickness_nm,
                layers,
                ..
            } => (thickness_nm.as_ref(), layers.as_deref()),
            _ => (None, None),
        };
        let layers = layers.unwrap_or_default().iter();
        only.into_iter()
            .chain(layers.map(|layer| &layer.thickness_nm))
    }
}

/// A layer of a stack.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Layer {
    /// The index of the layer.
    pub index: Index,
    /// Thickness, in nm.
    pub thickness_nm: Thickness,
}

/// How a free film's interference is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FilmModel {
    /// All beams, in reflection and in transmission.
    #[default]
    Exact,
    /// Two beams in reflection, and transmission without interference (Suzuki, Yokoi and Toriwaki, section 4-2), for one layer that does
    /// not absorb. Energy is not conserved: near grazing incidence more is reflected than arrives.
    TwoBeam,
}

/// A reflectance that may vary over a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum DiffuseReflectance {
    /// The same everywhere.
    Uniform(Reflectance),
    /// A checkerboard of two reflectances: squares along the axes of a plane, rectangle or disk, or cubes around a sphere's center.
    Checker {
        /// The two reflectances; the first is that of the square whose lower corner is the origin.
        checker: [Reflectance; 2],
        /// Side of a square.
        #[schemars(range(min = limits::LENGTH.low, max = limits::LENGTH.high))]
        size: f64,
    },
    /// A picture of colors, each of which becomes a smooth reflectance with that color under D65. On planes, rectangles and disks it is
    /// upright and centered; on spheres it lies like a map on a globe, with its center toward +Z.
    Texture {
        /// A PNG file of 8 or 16 bits, relative to the scene file. Its color encoding is the one that it declares (cICP, iCCP, gAMA and
        /// cHRM), otherwise sRGB.
        texture: PathBuf,
        /// Width and height on planes, rectangles and disks. When absent, it covers the whole rectangle, the square around a disk, or a
        /// square of side 1 on a plane. Outside, the picture's edge continues. Not for spheres, which it always covers completely.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(inner(inner(range(min = limits::LENGTH.low, max = limits::LENGTH.high))))]
        size: Option<[f64; 2]>,
    },
}
