//! The facets of a rough surface: light that meets one of them, and light that meets several.

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
    /// Light that met one facet: D G / (4 cos θo), the BSDF times cos θi.
    pub single: f64,
    /// Light that met several, times cos θi.
    pub multiple: f64,
    /// Cosine at the facet.
    pub cosine: f64,
    /// Density with which [`Facets::sample`] finds `wi`, sr⁻¹.
    pub pdf: f64,
}

impl<'a> Facets<'a> {
    /// Those of a material.
    pub fn new(microsurface: &'a Microsurface) -> Self {
        Self {
            surface: optics::Microsurface {
                distribution: microsurface.distribution.into(),
                alpha: microsurface.roughness,
            },
            energy: &microsurface.energy,
        }
    }

    /// Mean of the directional albedo over all directions.
    pub fn mean_energy(&self) -> f64 {
        self.energy.mean()
    }

    /// The part of light from a direction that meets several facets.
    fn lost(&self, direction: DVec3) -> f64 {
        1.0 - self.energy.at(direction.to_array())
    }

    /// Scattering from `wi` to `wo`; none where either is below the surface. The light that met several facets leaves by
    /// (1 − E(wo)) (1 − E(wi)) / (π (1 − E mean)), so that with the rest everything is there (Kelemen and Szirmay-Kalos 2001; Kulla and
    /// Conty 2017).
    pub fn eval(&self, wo: DVec3, wi: DVec3) -> Option<FacetEval> {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return None;
        }
        let share = self.lost(wo);
        let all = (1.0 - self.energy.mean()).max(1e-6);
        let (reflection, pdf) = self.surface.scattering(wo.to_array(), wi.to_array());
        Some(FacetEval {
            single: reflection * wi.z,
            multiple: share * self.lost(wi) / (PI * all) * wi.z,
            cosine: wo.dot((wo + wi).normalize()),
            pdf: (1.0 - share) * pdf + share / TAU,
        })
    }

    /// A direction `wi`: mirrored by a visible facet, or with the share 1 − E(wo) any over the hemisphere alike.
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
