//! How surfaces scatter light: a file for each BSDF, with its geometry (`eval`, `sample`, a specular part) and its value over the spectrum.
//!
//! `wo` points to the camera's side of a path and `wi` to the light's. They are unit vectors of the surface's local frame, whose z is the
//! normal on the side of `wo` and whose x runs along the grain of a brushed surface. Values are those of the BSDF times |cos θi|.

mod coated;
mod cook;
mod diffuse;
mod facets;
mod interface;
mod rough;

pub use coated::coat_share;
pub(crate) use coated::{Coated, CoatedAt};
pub(crate) use cook::Cook;
pub use cook::{CookFacets, cook_facets, sample_cook_facet};
pub(crate) use diffuse::Diffuse;
pub use facets::{FacetScattering, Facets};
pub(crate) use interface::{Interface, InterfaceAt};
use rough::Rough;

use crate::layers::Nanometers;
use crate::spectral::{Bands, Spectrum};
use crate::surface::Reflectance;
use glam::DVec3;
use pulp::Simd;

/// What scatters light at a point of a surface.
pub(crate) enum Bsdf<'a> {
    /// Evenly, by a reflectance.
    Diffuse(Diffuse),
    /// The boundary of an opaque medium, perhaps coated, smooth or rough.
    Interface(InterfaceAt<'a>),
    /// A diffuse body below a clear coat, smooth or rough.
    Coated(CoatedAt<'a>),
    /// By the model of Cook and Torrance.
    Cook(&'a Cook<'a>),
}

/// A BSDF's value as weights of the spectra that it is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lobes {
    /// Of the reflectance at `cosine`: light that met the surface once.
    pub(crate) single: f64,
    /// Of the color of light that met several facets of a rough surface.
    pub(crate) multiple: f64,
    /// Of the color of the base below a coat, or beside facets.
    pub(crate) body: f64,
    /// Cosine at the facet, or at a smooth surface.
    pub(crate) cosine: f64,
    /// Cosine of `wo` with the normal.
    pub(crate) wo_cosine: f64,
    /// Cosine of `wi` with the normal.
    pub(crate) wi_cosine: f64,
}

/// A BSDF between two directions, without its specular part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BsdfEval {
    /// The value.
    pub(crate) lobes: Lobes,
    /// Density with which [`Bsdf::sample`] finds `wi`, sr⁻¹.
    pub(crate) pdf: f64,
}

impl BsdfEval {
    /// Nothing.
    fn dark(wo: DVec3, wi: DVec3) -> Self {
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
    /// A smooth surface that mirrors.
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

    /// All weights together.
    pub(crate) fn sum(&self) -> f64 {
        self.single + self.multiple + self.body
    }
}

impl Bsdf<'_> {
    /// Probability with which a path takes the specular part: 1 of what only mirrors, 0 of what has none.
    pub(crate) fn specular_probability(&self, wo: DVec3) -> f64 {
        match self {
            Self::Diffuse(_) | Self::Cook(_) => 0.0,
            Self::Interface(interface) => interface.specular_probability(),
            Self::Coated(coated) => coated.specular_probability(wo),
        }
    }

    /// Its value from `wi` to `wo` and the density of [`Self::sample`].
    pub(crate) fn eval(&self, wo: DVec3, wi: DVec3) -> BsdfEval {
        match self {
            Self::Diffuse(_) => diffuse::eval(wo, wi),
            Self::Interface(interface) => interface.eval(wo, wi),
            Self::Coated(coated) => coated.eval(wo, wi),
            Self::Cook(cook) => cook.eval(wo, wi),
        }
    }

    /// A direction `wi` by numbers in [0, 1): the first two make the direction, the third and the fourth choose between parts.
    pub(crate) fn sample(&self, wo: DVec3, random: impl Fn(usize) -> f64) -> DVec3 {
        match self {
            Self::Diffuse(_) => diffuse::sample(random),
            Self::Interface(interface) => interface.sample(wo, random),
            Self::Coated(coated) => coated.sample(wo, random),
            Self::Cook(cook) => cook.sample(wo, random),
        }
    }

    /// Whether its value depends on the wavelength itself, not on spectra at it alone.
    pub(crate) fn needs_wavelengths(&self) -> bool {
        let is_smooth = |reflectance| matches!(reflectance, Reflectance::Smooth(_));
        match self {
            Self::Diffuse(diffuse) => is_smooth(diffuse.0),
            Self::Interface(interface) => interface.has_layers(),
            Self::Coated(coated) => is_smooth(coated.base),
            Self::Cook(_) => false,
        }
    }

    /// Thicknesses of its layers, nm, written to the front of `nm`.
    pub(crate) fn thickness_nm<'b>(&self, nm: &'b mut Nanometers) -> &'b [f64] {
        match self {
            Self::Interface(interface) => interface.thickness_nm(nm),
            _ => &[],
        }
    }

    /// Multiplies a spectrum by what lobes make of the BSDF's spectra, and writes the product elsewhere; `nm` comes from
    /// [`Self::thickness_nm`].
    #[inline(always)]
    pub(crate) fn product<S: Simd>(
        &self,
        bands: &Bands<'_, S>,
        (nm, lobes): (&[f64], Lobes),
        spectrum: &Spectrum,
        to: &mut Spectrum,
    ) {
        match self {
            Self::Diffuse(diffuse) => diffuse.product(bands, lobes, spectrum, to),
            Self::Interface(interface) => bands.product(spectrum, &(interface, nm, lobes), to),
            Self::Coated(coated) => bands.product(spectrum, &(coated, lobes), to),
            Self::Cook(cook) => bands.product(spectrum, &(*cook, lobes), to),
        }
    }
}

/// `wo` mirrored at a facet.
fn mirrored(wo: DVec3, facet: DVec3) -> DVec3 {
    (2.0 * wo.dot(facet) * facet - wo).normalize()
}
