//! Cook's model in a validated scene.

use crate::{Emission, SpectrumId};
use std::f64::consts::PI;

/// A surface by Cook's model (Cook and Torrance 1981; Suzuki, Yokoi and Toriwaki, section 3-1): toward the eye goes
/// F(E·H) G / ((N·L) (N·E)) Σ wⱼ Dⱼ, and `diffuse` of the light evenly.
#[derive(Clone, Debug, PartialEq)]
pub struct Cook1981 {
    /// Real part of the index.
    pub n: SpectrumId,
    /// Imaginary part of the index; 0 everywhere where it comes from a normal reflectance.
    pub k: SpectrumId,
    /// The form of all Dⱼ.
    pub distribution: CookDistribution,
    /// The slopes, at least one.
    pub facets: Vec<CookFacets>,
    /// What is reflected evenly; `None` is nothing.
    pub diffuse: Option<DiffuseTerm>,
    /// Ia Ra: what comes of the ambient light, the same in every direction.
    pub ambient: Option<Emission>,
}

impl Cook1981 {
    /// How many times the light that falls along the normal a white metal's facets would send back, were nothing hidden: s with the
    /// normalized constants, 4 s with the printed π and D₂.
    pub fn gain(&self) -> f64 {
        let gain = |facets: &CookFacets| {
            let normalized = match self.distribution {
                CookDistribution::Gaussian => optics::gaussian_constant(facets.slope),
                CookDistribution::Beckmann => PI.recip(),
            };
            4.0 * facets.weight / normalized
        };
        self.facets.iter().map(gain).sum()
    }
}

/// The form of a distribution of facets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CookDistribution {
    /// D₁ = exp(−a² / m²), its constant being part of the weight.
    Gaussian,
    /// D₂ = exp(−tan²a / m²) / (m² cos⁴a).
    Beckmann,
}

/// The facets of one slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CookFacets {
    /// Root mean square slope m.
    pub slope: f64,
    /// wⱼ: the part of the surface, times the specular share and the model's constant.
    pub weight: f64,
    /// The part of the surface; those of all slopes sum to 1.
    pub part: f64,
}

/// A Lambertian share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffuseTerm {
    /// Which part of the light, in (0, 1\].
    pub share: f64,
    /// Which share of the paths goes there, in (0, 1\].
    pub chance: f64,
    /// How much of it comes back.
    pub reflectance: SpectrumId,
}
