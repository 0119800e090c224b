//! Cook's model of a validated scene.

use crate::rounding::RoundToF32;
use crate::{Emission, SpectrumId};

/// A surface by Cook's model (Cook and Torrance 1981; Suzuki, Yokoi and Toriwaki, section 3-1): the specular term F(E·H) G / ((N·L) (N·E))
/// Σ wⱼ Dⱼ plus the Lambertian term `diffuse`.
#[derive(Clone, Debug, PartialEq)]
pub struct Cook1981 {
    /// Real part of the index.
    pub n: SpectrumId,
    /// Imaginary part of the index; 0 everywhere if the index comes from a normal reflectance.
    pub k: SpectrumId,
    /// The form of all Dⱼ.
    pub distribution: CookDistribution,
    /// The slopes, at least one.
    pub facets: Vec<CookFacets>,
    /// The Lambertian term, if any.
    pub diffuse: Option<DiffuseTerm>,
    /// Ia Ra: the reflected ambient light, the same in every direction.
    pub ambient: Option<Emission>,
    /// The ratio of reflected to incident light at normal incidence for the facets of a white metal, without masking and shadowing: s with
    /// the normalized constants, 4 s with the printed π and D₂.
    pub gain: f64,
}

/// The form of a distribution of facets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CookDistribution {
    /// D₁ = exp(−a² / m²); its constant is part of the weight.
    Gaussian,
    /// D₂ = exp(−tan²a / m²) / (m² cos⁴a).
    Beckmann,
}

/// The facets of one slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CookFacets {
    /// Root mean square slope m.
    pub slope: f64,
    /// wⱼ: the fraction of the surface times the specular fraction and the model's constant.
    pub weight: f64,
    /// The fraction of the surface; the fractions of all slopes sum to 1.
    pub part: f64,
}

/// A Lambertian term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffuseTerm {
    /// The fraction of the light, in (0, 1\].
    pub fraction: f64,
    /// The probability that a path samples this term, in (0, 1\].
    pub probability: f64,
    /// Its reflectance.
    pub reflectance: SpectrumId,
}

impl RoundToF32 for Cook1981 {
    fn rounded(&self) -> Self {
        Self {
            n: self.n,
            k: self.k,
            distribution: self.distribution,
            facets: self.facets.iter().map(RoundToF32::rounded).collect(),
            diffuse: self.diffuse.as_ref().map(RoundToF32::rounded),
            ambient: self.ambient.as_ref().map(RoundToF32::rounded),
            // Only for a note: no renderer uses it.
            gain: self.gain,
        }
    }
}

impl RoundToF32 for CookFacets {
    fn rounded(&self) -> Self {
        Self {
            slope: self.slope.rounded(),
            weight: self.weight.rounded(),
            part: self.part.rounded(),
        }
    }
}

impl RoundToF32 for DiffuseTerm {
    fn rounded(&self) -> Self {
        Self {
            fraction: self.fraction.rounded(),
            probability: self.probability.rounded(),
            reflectance: self.reflectance,
        }
    }
}
