//! The model of Cook and Torrance as the paper prints it, as written.

use super::{Emission, Reflectance};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a conductor's reflection is computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum ConductorModel {
    /// By name, with nothing to choose.
    Named(ConductorModelName),
    /// Cook's model as Suzuki, Yokoi and Toriwaki print it.
    Cook {
        /// What the model leaves open.
        cook1981: Box<Cook1981>,
    },
}

/// The name of a model of reflection.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ConductorModelName {
    /// Facets as they are everywhere else.
    Microfacets,
    /// Cook's model as Suzuki, Yokoi and Toriwaki print it, with all that it leaves open as it is when absent.
    Cook1981,
}

/// Cook's model: I = Ia Ra + Σ Il (N·L) dω (Rs + d ρ / π) with Rs = s F D G / (π (N·L) (N·E)). Only F, ρ and the lights depend on
/// wavelength.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cook1981 {
    /// D: "beckmann" is D2 = exp(−tan²a / m²) / (m² cos⁴a), "gaussian" is D1 = c exp(−a² / m²), a the angle between normal and facet.
    #[serde(default)]
    pub distribution: CookDistribution,
    /// The constant c of D1; 1 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::COOK_CONSTANT.low, max = limits::COOK_CONSTANT.high))]
    pub constant: Option<f64>,
    /// Several slopes m, each with its weight; the weights sum to 1. When absent, the material's roughness alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1, max = limits::MAX_SLOPES))]
    pub slopes: Option<Vec<Slope>>,
    /// Whether the constant is the printed one.
    #[serde(default)]
    pub normalization: CookNormalization,
    /// The share s of light that is reflected by facets; 1 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub specular: Option<f64>,
    /// The share d of light that is reflected evenly; 0 when absent. s + d is at most 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub diffuse: Option<f64>,
    /// What reflects evenly: ρ.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diffuse_reflectance: Option<Reflectance>,
    /// Ia: light from everywhere that nothing hides. Of it Ra = s F₀ + d ρ comes back in every direction, F₀ at the normal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ambient: Option<Emission>,
}

/// A slope and how much of the surface has it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Slope {
    /// The root mean square slope.
    #[schemars(range(min = limits::ROUGHNESS.low, max = limits::ROUGHNESS.high))]
    pub m: f64,
    /// Its part of the whole.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub weight: f64,
}

/// The distribution of facets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CookDistribution {
    /// D2, of Beckmann.
    #[default]
    Beckmann,
    /// D1, Gaussian in the angle.
    Gaussian,
}

/// The constant of the specular reflection.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CookNormalization {
    /// Rs = F D G / (π (N·E)) with D2 and c D1 as they are: with D2 it is four times what the facets can send.
    #[default]
    Printed,
    /// F D G / (4 (N·E)) with D so that the facets cover the surface once: D2 / π, or D1 with c such that ∫ D1 cos a dω = 1.
    Normalized,
}
