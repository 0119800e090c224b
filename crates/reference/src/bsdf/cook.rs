//! The model of Cook and Torrance (1982), with a Lambertian fraction.

use super::{BsdfEval, Lobes, mirrored};
use crate::bands::{At, BandMueller, BandValue, Bands, Mueller, MuellerKind, Tables};
use crate::layers::Medium;
use crate::sample_cosine_hemisphere;
use glam::DVec3;
use optics::wide::{Lanes, Real};
use pulp::Simd;
use scene::{Cook1981, CookDistribution};
use std::f64::consts::FRAC_1_PI;

/// A surface of this model, independent of any point.
pub(crate) struct Cook<'a> {
    medium: Medium,
    model: &'a Cook1981,
}

impl<'a> Cook<'a> {
    pub(crate) fn new(tables: &Tables, model: &'a Cook1981) -> Self {
        let medium = Medium::new(tables, model.n, model.k);
        Self { medium, model }
    }

    /// The probability that a path is scattered by the Lambertian fraction.
    fn diffuse_probability(&self) -> f64 {
        self.model
            .diffuse
            .map_or(0.0, |diffuse| diffuse.probability)
    }

    pub(super) fn mueller_kind(&self) -> MuellerKind {
        match self.model.diffuse {
            None => MuellerKind::Amplitudes,
            Some(_) => MuellerKind::General,
        }
    }

    pub(super) fn eval(&self, wo: DVec3, wi: DVec3) -> BsdfEval {
        let facets = cook_facets(self.model, wo, wi);
        let lambert = wi.z.max(0.0) * FRAC_1_PI;
        let probability = self.diffuse_probability();
        let mut eval = BsdfEval::dark(wo, wi);
        eval.lobes.single = facets.reflection * wi.z;
        eval.lobes.cosine = facets.cosine;
        eval.lobes.body = self.model.diffuse.map_or(0.0, |d| d.fraction) * lambert;
        eval.pdf = probability * lambert + (1.0 - probability) * facets.pdf;
        eval
    }

    pub(super) fn sample(&self, wo: DVec3, random: impl Fn(usize) -> f64) -> DVec3 {
        let (u, v) = (random(0), random(1));
        if random(2) < self.diffuse_probability() {
            return sample_cosine_hemisphere(u, v);
        }
        mirrored(wo, sample_cook_facet(self.model, [u, v, random(3)]))
    }
}

impl BandValue for (&Cook<'_>, Lobes) {
    #[inline(always)]
    fn value<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S> {
        let (cook, lobes) = self;
        let once = cook.medium.reflectance(bands, at, lobes.cosine);
        let single = once.times(lobes.single);
        match cook.model.diffuse {
            None => single,
            Some(diffuse) => {
                let base = bands.spectrum(diffuse.reflectance.into(), at);
                single + base.times(lobes.body)
            }
        }
    }
}

/// Facets act by their amplitudes; the Lambertian fraction depolarizes.
impl BandMueller for (&Cook<'_>, Lobes) {
    #[inline(always)]
    fn mueller<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Mueller<Lanes<S>> {
        let (cook, lobes) = self;
        let once = cook.medium.polarized(bands, at, lobes.cosine);
        let once = Mueller::of(&once, lobes.single);
        match cook.model.diffuse {
            None => once,
            Some(diffuse) => {
                let base = bands.spectrum(diffuse.reflectance.into(), at);
                once.and_depolarizer(base.times(lobes.body))
            }
        }
    }
}

/// The reflection by the facets of Cook's model between two directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CookFacets {
    /// G Σ wⱼ Dⱼ / (cos θi cos θo): the reflection function without its Fresnel factor, sr⁻¹.
    pub reflection: f64,
    /// Density with which a sampled facet reflects `wo` to `wi`, sr⁻¹.
    pub pdf: f64,
    /// Cosine at the facet.
    pub cosine: f64,
}

/// Returns the reflection from `wi` to `wo`, with the density of a reflection at a facet of [`sample_cook_facet`]; black when
/// either direction is below the surface.
pub fn cook_facets(surface: &Cook1981, wo: DVec3, wi: DVec3) -> CookFacets {
    let facet = (wo + wi).normalize();
    let cosine = wo.dot(facet);
    if wo.z <= 0.0 || wi.z <= 0.0 || cosine <= 0.0 {
        return CookFacets {
            reflection: 0.0,
            pdf: 0.0,
            cosine: 1.0,
        };
    }
    let (mut distribution, mut density) = (0.0, 0.0);
    for facets in &surface.facets {
        let (d, pdf) = match surface.distribution {
            CookDistribution::Gaussian => (
                optics::gaussian_d1(facet.z, facets.slope),
                optics::gaussian_pdf(facet.z, facets.slope),
            ),
            CookDistribution::Beckmann => (
                optics::beckmann_d2(facet.z, facets.slope),
                optics::half_vector_pdf(facet.z, facets.slope),
            ),
        };
        distribution += facets.weight * d;
        density += facets.part * pdf;
    }
    let g = optics::v_groove_g(facet.z, wo.z, wi.z, cosine);
    CookFacets {
        reflection: distribution * g / (wo.z * wi.z),
        pdf: density / (4.0 * cosine),
        cosine,
    }
}

/// Samples a facet normal from two uniform numbers, for the slope that `pick` in [0, 1) chooses.
pub fn sample_cook_facet(surface: &Cook1981, [u, v, pick]: [f64; 3]) -> DVec3 {
    let mut below = 0.0;
    let chosen = surface.facets.iter().find(|facets| {
        below += facets.part;
        pick < below
    });
    let slope = chosen.or(surface.facets.last()).map_or(1.0, |f| f.slope);
    DVec3::from_array(match surface.distribution {
        CookDistribution::Gaussian => optics::sample_gaussian(u, v, slope),
        CookDistribution::Beckmann => optics::sample_beckmann(u, v, slope),
    })
}
