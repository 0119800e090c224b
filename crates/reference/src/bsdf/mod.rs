//! How surfaces scatter light: one file per BSDF, with its geometry (`eval`, `sample`, a specular part) and its value over the spectrum.
//!
//! `wo` points to the camera's side of a path and `wi` to the light's. They are unit vectors of the surface's local frame, whose z is the
//! normal on the side of `wo` and whose x runs along the grain of a brushed surface. Values are those of the BSDF times |cos θi|.

mod coated;
mod cook;
mod diffuse;
mod facets;
mod interface;
mod lobes;
mod rough;

pub use coated::coat_probability;
use coated::{Coated, CoatedAt};
use cook::Cook;
pub use cook::{CookFacets, cook_facets, sample_cook_facet};
use diffuse::Diffuse;
pub use facets::{FacetEval, Facets};
use interface::{Interface, InterfaceAt};
pub(crate) use lobes::{BsdfEval, Lobes};
use rough::Rough;

use crate::SurfacePoint;
use crate::bands::{Bands, MuellerKind, Spectrum, StoredMueller, Tables};
use crate::layers::{Film, Nanometers, SurfaceAt};
use crate::surface::{Reflectance, pattern_reflectance};
use glam::DVec3;
use pulp::Simd;
use scene::{Emission, Estimate, Material, Pattern, Shape};

/// A material in the form that paths use.
pub(crate) struct Surface<'a> {
    /// The emission of the surface.
    pub(crate) emission: Option<Emission>,
    /// Rough estimates of the albedo and of the reflected fraction.
    pub(crate) estimate: &'a Estimate,
    kind: SurfaceKind<'a>,
}

enum SurfaceKind<'a> {
    Black,
    Film(Film<'a>),
    Diffuse(Pattern),
    Interface(Interface<'a>),
    Coated(Coated<'a>),
    Cook(Cook<'a>),
}

impl<'a> Surface<'a> {
    pub(crate) fn new(tables: &mut Tables, material: &'a Material, estimate: &'a Estimate) -> Self {
        let kind = match material {
            Material::Film {
                layers,
                interference,
                ..
            } => SurfaceKind::Film(Film::new(tables, layers, *interference)),
            Material::Diffuse { reflectance } => SurfaceKind::Diffuse(reflectance.clone()),
            Material::Emitter { reflectance, .. } => match *reflectance {
                Some(spectrum) => SurfaceKind::Diffuse(Pattern::Uniform(spectrum)),
                None => SurfaceKind::Black,
            },
            Material::Interface {
                n,
                k,
                layers,
                microsurface,
            } => {
                let of = Interface::new(tables, (*n, *k), layers, microsurface.as_ref());
                SurfaceKind::Interface(of)
            }
            Material::CoatedBody(body) => SurfaceKind::Coated(Coated::new(tables, body)),
            Material::Cook(cook) => SurfaceKind::Cook(Cook::new(tables, cook)),
        };
        let ambient = match material {
            Material::Cook(cook) => cook.ambient,
            _ => None,
        };
        Self {
            emission: material.emission().or(ambient),
            estimate,
            kind,
        }
    }

    /// Returns the film, if the surface is one.
    pub(crate) fn film(&self) -> Option<&Film<'a>> {
        match &self.kind {
            SurfaceKind::Film(film) => Some(film),
            _ => None,
        }
    }

    /// Returns the BSDF at a point; `None` for films and for black surfaces. `random` in [0, 1) chooses between the texels of a picture.
    pub(crate) fn bsdf(
        &'a self,
        shape: &'a Shape,
        point: &SurfacePoint,
        random: impl FnOnce() -> f64,
    ) -> Option<Bsdf<'a>> {
        let position = point.position;
        let reflectance = |pattern: &Pattern| match *pattern {
            Pattern::Uniform(spectrum) => Reflectance::Spectrum(spectrum),
            Pattern::Checker { .. } => pattern_reflectance(pattern, shape, position, 0.0),
            Pattern::Texture { .. } => pattern_reflectance(pattern, shape, position, random()),
        };
        Some(match &self.kind {
            SurfaceKind::Black | SurfaceKind::Film(_) => return None,
            SurfaceKind::Diffuse(pattern) => Bsdf::Diffuse(Diffuse(reflectance(pattern))),
            SurfaceKind::Interface(interface) => Bsdf::Interface(InterfaceAt {
                interface,
                surface: SurfaceAt { shape, position },
            }),
            SurfaceKind::Coated(coated) => Bsdf::Coated(CoatedAt {
                coated,
                base: reflectance(&coated.body.base),
            }),
            SurfaceKind::Cook(cook) => Bsdf::Cook(cook),
        })
    }
}

/// The BSDF at a point of a surface.
pub(crate) enum Bsdf<'a> {
    /// Lambertian, with a reflectance.
    Diffuse(Diffuse),
    /// The boundary of an opaque medium, perhaps coated, smooth or rough.
    Interface(InterfaceAt<'a>),
    /// A diffuse body below a clear coat, smooth or rough.
    Coated(CoatedAt<'a>),
    /// The model of Cook and Torrance.
    Cook(&'a Cook<'a>),
}

impl Bsdf<'_> {
    /// Returns the probability with which a path takes the specular part: 1 for purely specular BSDFs, 0 for those without a specular part.
    pub(crate) fn specular_probability(&self, wo: DVec3) -> f64 {
        match self {
            Self::Diffuse(_) | Self::Cook(_) => 0.0,
            Self::Interface(interface) => interface.specular_probability(),
            Self::Coated(coated) => coated.specular_probability(wo),
        }
    }

    /// Returns the value from `wi` to `wo` and the density of [`Self::sample`].
    pub(crate) fn eval(&self, wo: DVec3, wi: DVec3) -> BsdfEval {
        match self {
            Self::Diffuse(_) => diffuse::eval(wo, wi),
            Self::Interface(interface) => interface.eval(wo, wi),
            Self::Coated(coated) => coated.eval(wo, wi),
            Self::Cook(cook) => cook.eval(wo, wi),
        }
    }

    /// Samples a direction `wi` from numbers in [0, 1): the first two determine the direction, the third and the fourth choose
    /// between parts.
    pub(crate) fn sample(&self, wo: DVec3, random: impl Fn(usize) -> f64) -> DVec3 {
        match self {
            Self::Diffuse(_) => diffuse::sample(random),
            Self::Interface(interface) => interface.sample(wo, random),
            Self::Coated(coated) => coated.sample(wo, random),
            Self::Cook(cook) => cook.sample(wo, random),
        }
    }

    /// Whether the value depends on the wavelength itself, not only on spectra at the wavelength.
    pub(crate) fn needs_wavelengths(&self) -> bool {
        let is_smooth = |reflectance| matches!(reflectance, Reflectance::Smooth(_));
        match self {
            Self::Diffuse(diffuse) => is_smooth(diffuse.0),
            Self::Interface(interface) => interface.has_layers(),
            Self::Coated(coated) => is_smooth(coated.base),
            Self::Cook(_) => false,
        }
    }

    /// Writes the thicknesses of its layers, nm, to the front of `nm` and returns them.
    pub(crate) fn thickness_nm<'b>(&self, nm: &'b mut Nanometers) -> &'b [f64] {
        match self {
            Self::Interface(interface) => interface.thickness_nm(nm),
            _ => &[],
        }
    }

    /// Multiplies a spectrum by the BSDF's value for these lobes and writes the product to `to`; `nm` comes from [`Self::thickness_nm`].
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

/// The value of a BSDF for polarized light.
impl Bsdf<'_> {
    /// Returns which elements its matrix has.
    pub(crate) fn mueller_kind(&self, lobes: &Lobes) -> MuellerKind {
        match self {
            Self::Diffuse(_) => MuellerKind::Depolarizer,
            Self::Interface(interface) => interface.mueller_kind(),
            Self::Coated(coated) => coated.mueller_kind(lobes),
            Self::Cook(cook) => cook.mueller_kind(),
        }
    }

    /// Whether its reflection has a single direction.
    pub(crate) fn is_smooth(&self) -> bool {
        match self {
            Self::Interface(at) => at.interface.is_smooth(),
            Self::Coated(at) => at.coated.is_smooth(),
            Self::Diffuse(_) | Self::Cook(_) => false,
        }
    }

    /// Whether light with these lobes passed a smooth coat, out of the body and into it, in planes of its own.
    pub(crate) fn is_from_body(&self, lobes: &Lobes) -> bool {
        matches!(self, Self::Coated(coated) if coated.is_from_body(lobes))
    }

    /// Writes the matrix for these lobes; `nm` comes from [`Self::thickness_nm`].
    #[inline(always)]
    pub(crate) fn mueller<S: Simd>(
        &self,
        bands: &Bands<'_, S>,
        (nm, lobes): (&[f64], Lobes),
        to: StoredMueller,
        rows: &mut [Spectrum],
    ) {
        match self {
            Self::Diffuse(diffuse) => {
                bands.write(&(diffuse.0, lobes.single), &mut rows[to.first]);
            }
            Self::Interface(interface) => bands.write_mueller(&(interface, nm, lobes), to, rows),
            Self::Coated(coated) => bands.write_mueller(&(coated, lobes), to, rows),
            Self::Cook(cook) => bands.write_mueller(&(*cook, lobes), to, rows),
        }
    }
}

/// Returns `wo` reflected at a facet.
fn mirrored(wo: DVec3, facet: DVec3) -> DVec3 {
    (2.0 * wo.dot(facet) * facet - wo).normalize()
}
