//! The facets of a rough surface: light that meets one of them, and light that meets several.

use crate::sample_cone;
use glam::DVec3;
use scene::{Energy, Microsurface};
use std::f64::consts::PI;

/// The facets of a rough surface.
#[derive(Clone, Copy, Debug)]
pub struct Facets<'a> {
    surface: optics::Microsurface,
    energy: &'a Energy,
}

/// How facets scatter between two directions, without their colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacetScattering {
    /// Light that met one facet: D G / (4 (N·E)), the reflection function times the light's cosine.
    pub single: f64,
    /// Light that met several, times the light's cosine.
    pub multiple: f64,
    /// Cosine at the facet.
    pub cosine: f64,
    /// Density with which [`Facets::sample`] finds the light's direction, sr⁻¹.
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

    /// Scattering from `light` to `eye`, unit vectors; none where either is below the surface. The light that met several
    /// facets leaves by (1 − E(eye)) (1 − E(light)) / (π (1 − E mean)), so that with the rest everything is there (Kelemen and
    /// Szirmay-Kalos 2001; Kulla and Conty 2017).
    pub fn between(&self, eye: DVec3, light: DVec3) -> Option<FacetScattering> {
        if eye.z <= 0.0 || light.z <= 0.0 {
            return None;
        }
        let share = self.lost(eye);
        let all = (1.0 - self.energy.mean()).max(1e-6);
        let (eye_array, light_array) = (eye.to_array(), light.to_array());
        let pdf = self.surface.pdf(eye_array, light_array);
        Some(FacetScattering {
            single: self.surface.reflection(eye_array, light_array) * light.z,
            multiple: share * self.lost(light) / (PI * all) * light.z,
            cosine: eye.dot((eye + light).normalize()),
            pdf: (1.0 - share) * pdf + share / (2.0 * PI),
        })
    }

    /// A direction of light: mirrored by a visible facet, or with the share 1 − E(eye) any over the hemisphere alike.
    pub fn sample(&self, eye: DVec3, [u, v, choice, _]: [f64; 4]) -> DVec3 {
        if choice < self.lost(eye) {
            return sample_cone(u, v, 1.0);
        }
        let facet = DVec3::from_array(self.surface.sample(eye.to_array(), u, v));
        (2.0 * eye.dot(facet) * facet - eye).normalize()
    }
}
