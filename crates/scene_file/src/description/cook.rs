//! The model of Cook and Torrance as the paper prints it, as written in a scene file.

use super::{Emission, Reflectance};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a conductor's reflection is computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum ConductorModel {
    /// A model by its name, with default parameters.
    Named(ConductorModelName),
    /// Cook's model as Suzuki, Yokoi and Toriwaki print it, with parameters.
    Cook {
        /// The parameters that the paper leaves open.
        cook1981: Box<Cook1981>,
    },
}

/// The name of a reflection model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ConductorModelName {
    /// The microfacet model that all other rough surfaces use.
    Microfacets,
    /// Cook's model as Suzuki, Yokoi and Toriwaki print it, with default parameters.
    Cook1981,
}

/// Cook's model: I = Ia Ra + Σ Il dω (Rs + (N·L) d ρ / π) with Rs = s F D G / (π (N·E)). Only F, ρ and the lights depend on
/// wavelength.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cook1981 {
    /// D: "beckmann" is D2 = exp(−tan²a / m²) / (m² cos⁴a), "gaussian" is D1 = c exp(−a² / m²), where a is the angle between the surface
    /// normal and the facet's normal.
    #[serde(default)]
    pub distribution: CookDistribution,
    /// The constant c of D1; 1 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::COOK_CONSTANT.low, max = limits::COOK_CONSTANT.high))]
    pub constant: Option<f64>,
    /// Several slopes m with weights that sum to 1. When absent, the only slope is the material's roughness.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1, max = limits::MAX_SLOPES))]
    pub slopes: Option<Vec<Slope>>,
    /// Whether the specular term is scaled as printed or normalized.
    #[serde(default)]
    pub normalization: CookNormalization,
    /// The fraction s of the light that facets reflect; 1 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub specular: Option<f64>,
    /// The fraction d of the light that is reflected diffusely; 0 when absent. s + d is at most 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub diffuse: Option<f64>,
    /// The diffuse reflectance ρ.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diffuse_reflectance: Option<Reflectance>,
    /// Ia: ambient light from everywhere, which nothing occludes. The surface reflects Ra = s F₀ + d ρ of it in every direction, with F₀ at
    /// normal incidence.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ambient: Option<Emission>,
}

/// A slope and the fraction of the surface that has it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Slope {
    /// The root mean square slope.
    #[schemars(range(min = limits::ROUGHNESS.low, max = limits::ROUGHNESS.high))]
    pub m: f64,
    /// Its weight.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub weight: f64,
}

/// The distribution of facets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CookDistribution {
    /// D2, Beckmann's.
    #[default]
    Beckmann,
    /// D1, Gaussian in the angle.
    Gaussian,
}

/// The scale of the specular term.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CookNormalization {
    /// Rs = F D G / (π (N·E)) with D2 or c D1 as printed: with D2, four times as much as the facets can reflect.
    #[default]
    Printed,
    /// F D G / (4 (N·E)) with a normalized D, whose facets cover the surface once: D2 / π, or D1 with c such that ∫ D1 cos a dω = 1.
    Normalized,
}
