//! The facets of a rough surface: single and multiple scattering.

use super::mirrored;
use crate::sample_cone;
use glam::DVec3;
use scene::{Energy, Microsurface};
use std::f64::consts::{PI, TAU};

/// The facets of a rough surface.
#[derive(Clone, Copy, Debug)]
pub struct Facets<'a> {
    surface: optics::Microsurface,
    energy: &'a Energy,
}

/// How facets scatter between two directions, without their colors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacetEval {
    /// Single scattering: D G / (4 cos θo), the BSDF times cos θi.
    pub single: f64,
    /// Multiple scattering, times cos θi.
    pub multiple: f64,
    /// Cosine at the facet.
    pub cosine: f64,
    /// Density with which [`Facets::sample`] finds `wi`, sr⁻¹.
    pub pdf: f64,
}

impl<'a> Facets<'a> {
    /// The facets of a material's microsurface.
    pub fn new(microsurface: &'a Microsurface) -> Self {
        Self {
            surface: optics::Microsurface {
                distribution: match microsurface.distribution {
                    scene::Distribution::Beckmann => optics::Distribution::Beckmann,
                    scene::Distribution::Ggx => optics::Distribution::Ggx,
                },
                alpha: microsurface.roughness,
            },
            energy: &microsurface.energy,
        }
    }

    /// Returns the mean of the directional albedo over all directions.
    pub fn mean_energy(&self) -> f64 {
        self.energy.mean()
    }

    /// Returns the fraction of the light from a direction that meets several facets.
    fn lost(&self, direction: DVec3) -> f64 {
        1.0 - self.energy.at(direction.to_array())
    }

    /// Returns the scattering from `wi` to `wo`; `None` where either is below the surface. The light that met several facets leaves
    /// as (1 − E(wo)) (1 − E(wi)) / (π (1 − E mean)), so that no energy is lost (Kelemen and Szirmay-Kalos 2001; Kulla and Conty
    /// 2017).
    pub fn eval(&self, wo: DVec3, wi: DVec3) -> Option<FacetEval> {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return None;
        }
        let fraction = self.lost(wo);
        let all = (1.0 - self.energy.mean()).max(1e-6);
        let (reflection, pdf) = self.surface.scattering(wo.to_array(), wi.to_array());
        Some(FacetEval {
            single: reflection * wi.z,
            multiple: fraction * self.lost(wi) / (PI * all) * wi.z,
            cosine: wo.dot((wo + wi).normalize()),
            pdf: (1.0 - fraction) * pdf + fraction / TAU,
        })
    }

    /// Samples a direction `wi`: a reflection by a visible facet or, with probability 1 − E(wo), uniform over the hemisphere.
    pub fn sample(&self, wo: DVec3, [u, v, choice]: [f64; 3]) -> DVec3 {
        if choice < self.lost(wo) {
            return sample_cone(u, v, 1.0);
        }
        mirrored(
            wo,
            DVec3::from_array(self.surface.sample(wo.to_array(), u, v)),
        )
    }
}
