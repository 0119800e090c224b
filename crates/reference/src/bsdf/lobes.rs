//! The results that all BSDFs return.

use glam::DVec3;

/// A BSDF's value as weights of the spectra that it consists of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lobes {
    /// Weight of the reflectance at `cosine`: single scattering.
    pub(crate) single: f64,
    /// Weight of the color of multiple scattering between the facets of a rough surface.
    pub(crate) multiple: f64,
    /// Weight of the color of the base below a coat, or beside facets.
    pub(crate) body: f64,
    /// Cosine at the facet, or at a smooth surface.
    pub(crate) cosine: f64,
    /// Cosine of `wo` with the normal.
    pub(crate) wo_cosine: f64,
    /// Cosine of `wi` with the normal.
    pub(crate) wi_cosine: f64,
}

/// The value and density of a BSDF between two directions, without its specular part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BsdfEval {
    /// The value.
    pub(crate) lobes: Lobes,
    /// Density with which [`Bsdf::sample`](super::Bsdf::sample) finds `wi`, sr⁻¹.
    pub(crate) pdf: f64,
}

impl BsdfEval {
    /// Returns an evaluation without any scattering.
    pub(super) fn dark(wo: DVec3, wi: DVec3) -> Self {
        Self {
            lobes: Lobes {
                single: 0.0,
                multiple: 0.0,
                body: 0.0,
                cosine: 1.0,
                wo_cosine: wo.z,
                wi_cosine: wi.z,
            },
            pdf: 0.0,
        }
    }
}

impl Lobes {
    /// Returns the lobes of a smooth, purely specular surface.
    pub(crate) fn specular(cosine: f64) -> Self {
        Self {
            single: 1.0,
            multiple: 0.0,
            body: 0.0,
            cosine,
            wo_cosine: cosine,
            wi_cosine: cosine,
        }
    }

    /// Returns the sum of the weights.
    pub(crate) fn sum(&self) -> f64 {
        self.single + self.multiple + self.body
    }
}
