//! Materials as written.

use super::{Emission, Index, Reflectance, Thickness};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a surface is made of. Every surface has two sides that behave alike.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum Material {
    /// Reflects light evenly into all directions (Lambert).
    Diffuse {
        /// The reflectance, or a pattern of two.
        reflectance: DiffuseReflectance,
    },
    /// A metal, or any opaque medium of complex index.
    Conductor {
        /// The index.
        index: Index,
        /// Root mean square slope of the surface: 0 is a smooth mirror, otherwise from 0.02 to 1.
        #[serde(default)]
        #[schemars(range(min = 0.0, max = limits::ROUGHNESS.high))]
        roughness: f64,
    },
    /// A free thin film with air on both sides. Light reflects from it or passes straight through it.
    Film {
        /// The index of the layer.
        index: Index,
        /// How thick it is, in nm.
        thickness_nm: Thickness,
    },
    /// Emits the same radiance from every point in every direction, on both sides.
    Emitter {
        /// What it emits.
        emission: Emission,
        /// The part of the light falling on it that it reflects evenly besides; black when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        reflectance: Option<Reflectance>,
    },
}

/// A reflectance over a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum DiffuseReflectance {
    /// The same everywhere.
    Uniform(Reflectance),
    /// Squares of two reflectances in the axes of a plane or rectangle, or cubes around a sphere's centre.
    Checker {
        /// The two reflectances; the square whose lower corner is the origin has the first.
        checker: [Reflectance; 2],
        /// Side of a square.
        #[schemars(range(min = limits::LENGTH.low, max = limits::LENGTH.high))]
        size: f64,
    },
}
