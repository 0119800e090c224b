//! How surfaces scatter light between two directions of their local frame, whose z is the normal on the ray's side.

use crate::interference::LayersAt;
use crate::{Facets, sample_cosine_hemisphere};
use glam::DVec3;
use scene::SpectrumId;
use std::f64::consts::PI;

/// What scatters light.
pub(crate) enum Scatterer<'a> {
    /// Evenly, by a reflectance.
    Diffuse(SpectrumId),
    /// A conductor by its facets.
    RoughConductor(Conductor<'a>, Facets<'a>),
}

/// A conductor where a path meets it.
pub(crate) struct Conductor<'a> {
    pub(crate) index: (SpectrumId, SpectrumId),
    pub(crate) coating: LayersAt<'a>,
}

/// How a surface scatters between two directions: weights of the spectra that it has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lobes {
    /// Of the reflectance at `cosine`: light that met the surface once.
    pub(crate) single: f64,
    /// Of the colour of light that met several facets of a rough surface.
    pub(crate) multiple: f64,
    /// Of the colour of the base below a coat.
    pub(crate) body: f64,
    /// Cosine at the facet.
    pub(crate) cosine: f64,
    /// Cosine of the light with the normal.
    pub(crate) light_cosine: f64,
}

/// Scattering between two directions.
pub(crate) struct Scattering {
    /// The surface's functions times the light's cosine, without their spectra.
    pub(crate) lobes: Lobes,
    /// Density with which [`Scatterer::sample`] finds the light's direction, sr⁻¹.
    pub(crate) pdf: f64,
}

impl Lobes {
    fn single(single: f64, cosine: f64, light: DVec3) -> Self {
        Self {
            single,
            multiple: 0.0,
            body: 0.0,
            cosine,
            light_cosine: light.z,
        }
    }

    /// Whether anything is scattered.
    pub(crate) fn is_lit(&self) -> bool {
        self.single > 0.0 || self.multiple > 0.0 || self.body > 0.0
    }
}

impl Scatterer<'_> {
    /// Scattering from `light` to `eye`, unit vectors.
    pub(crate) fn between(&self, eye: DVec3, light: DVec3) -> Scattering {
        match self {
            Self::Diffuse(_) => {
                let lambert = light.z.max(0.0) / PI;
                Scattering {
                    lobes: Lobes::single(lambert, 1.0, light),
                    pdf: lambert,
                }
            }
            Self::RoughConductor(_, facets) => facets.between(eye, light).map_or(
                Scattering {
                    lobes: Lobes::single(0.0, 1.0, light),
                    pdf: 0.0,
                },
                |found| Scattering {
                    lobes: Lobes {
                        multiple: found.multiple,
                        ..Lobes::single(found.single, found.cosine, light)
                    },
                    pdf: found.pdf,
                },
            ),
        }
    }

    /// A unit vector towards which light is scattered from `eye`.
    pub(crate) fn sample(&self, eye: DVec3, random: [f64; 4]) -> DVec3 {
        match self {
            Self::Diffuse(_) => sample_cosine_hemisphere(random[0], random[1]),
            Self::RoughConductor(_, facets) => facets.sample(eye, random),
        }
    }
}
