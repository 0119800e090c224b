//! A diffuse body below a clear coat, smooth or rough.

use super::{BsdfEval, Lobes, Rough};
use crate::bands::{At, BandMueller, BandValue, Bands, Mueller, MuellerKind, Row, Tables};
use crate::layers::{Coating, GRAZING, Layers, Medium};
use crate::sample_cosine_hemisphere;
use crate::surface::Reflectance;
use glam::DVec3;
use optics::wide::{Lanes, Real, interface_reflectance};
use pulp::Simd;
use scene::CoatedBody;
use spectra::knot_before;
use std::f64::consts::FRAC_1_PI;

/// A coated body, independent of any point.
pub(crate) struct Coated<'a> {
    pub(crate) body: &'a CoatedBody,
    coat: Coating<'a>,
    /// The facets of a rough coat.
    rough: Option<Rough<'a>>,
}

impl<'a> Coated<'a> {
    pub(crate) fn new(tables: &mut Tables, body: &'a CoatedBody) -> Self {
        let coat = Coating {
            medium: Medium::new(tables, body.n, body.k),
            layers: Layers::new(tables, &[]),
        };
        let rough = body.microsurface.as_ref();
        let rough = rough.map(|of| Rough::new(tables, &coat, of));
        Self { body, coat, rough }
    }

    /// Whether the coat is smooth.
    pub(super) fn is_smooth(&self) -> bool {
        self.rough.is_none()
    }
}

/// A coated body at a point.
pub(crate) struct CoatedAt<'a> {
    pub(crate) coated: &'a Coated<'a>,
    pub(crate) base: Reflectance,
}

impl CoatedAt<'_> {
    pub(super) fn mueller_kind(&self, lobes: &Lobes) -> MuellerKind {
        if self.coated.is_smooth() && lobes.single > 0.0 {
            return MuellerKind::Amplitudes;
        }
        MuellerKind::General
    }

    /// Whether light with these lobes came from the body below a smooth coat.
    pub(super) fn is_from_body(&self, lobes: &Lobes) -> bool {
        self.coated.is_smooth() && lobes.single <= 0.0
    }

    /// Returns the probability of the specular reflection, which only a smooth coat has.
    pub(super) fn specular_probability(&self, wo: DVec3) -> f64 {
        match self.coated.rough {
            None => coat_probability(self.coated.body, wo.z),
            Some(_) => 0.0,
        }
    }

    pub(super) fn eval(&self, wo: DVec3, wi: DVec3) -> BsdfEval {
        let Coated { body, rough, .. } = self.coated;
        let probability = coat_probability(body, wo.z);
        let lambert = wi.z.max(0.0) * FRAC_1_PI;
        let mut eval = BsdfEval::dark(wo, wi);
        let Some(Rough { facets, .. }) = rough else {
            eval.lobes.body = lambert;
            eval.pdf = (1.0 - probability) * lambert;
            return eval;
        };
        if let Some(found) = facets.eval(wo, wi) {
            eval.lobes.single = found.single;
            eval.lobes.multiple = found.multiple;
            eval.lobes.cosine = found.cosine;
            eval.lobes.body =
                body.transmittance_scale_at(wo) * body.transmittance_scale_at(wi) * lambert;
            eval.pdf = probability * found.pdf + (1.0 - probability) * lambert;
        }
        eval
    }

    pub(super) fn sample(&self, wo: DVec3, random: impl Fn(usize) -> f64) -> DVec3 {
        let (u, v) = (random(0), random(1));
        let probability = coat_probability(self.coated.body, wo.z);
        match &self.coated.rough {
            Some(rough) if random(2) < probability => {
                rough.facets.sample(wo, [u, v, random(2) / probability])
            }
            _ => sample_cosine_hemisphere(u, v),
        }
    }

    /// P of the body (see [`optics::coated_albedo_factor`]).
    #[inline(always)]
    fn below_coat<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S> {
        let body = self.coated.body;
        let base = self.base.at(bands, at);
        let n = bands.spectrum(body.n.into(), at);
        let outer = bands.spectrum(body.mean_reflectance.into(), at);
        base * optics::coated_albedo_factor(base, n, outer)
    }
}

impl BandValue for (&CoatedAt<'_>, Lobes) {
    #[inline(always)]
    fn value<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S> {
        let (surface, lobes) = self;
        let Coated { body, coat, rough } = surface.coated;
        let Some(rough) = rough else {
            // A smooth coat reflects or transmits.
            if lobes.single > 0.0 {
                let mirrored = coat.medium.reflectance(bands, at, lobes.cosine);
                return mirrored.times(lobes.single);
            }
            let out = coat.medium.reflectance(bands, at, lobes.wo_cosine);
            let into = coat.medium.reflectance(bands, at, lobes.wi_cosine);
            let inside = surface.below_coat(bands, at).times(lobes.body);
            return out.complement() * into.complement() * inside;
        };
        let once = coat.medium.reflectance(bands, at, lobes.cosine);
        let inside = surface.below_coat(bands, at).times(lobes.body);
        let several = rough.color(coat, (bands, at), &[]).times(lobes.multiple);
        let out = rough_coat(body, bands, at, lobes.wo_cosine);
        let into = rough_coat(body, bands, at, lobes.wi_cosine);
        let body = out.complement() * into.complement() * inside;
        once.times(lobes.single) + several + body
    }
}

/// A smooth coat reflects by its amplitudes, and transmits s and p each by its own part into the body, which depolarizes, and out of it
/// (Baek, Jeon, Tong and Kim, Simultaneous acquisition of polarimetric SVBRDF and normals, 2018, section 4). Facets reflect by their amplitudes; a
/// rough coat transmits and depolarizes.
impl BandMueller for (&CoatedAt<'_>, Lobes) {
    #[inline(always)]
    fn mueller<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Mueller<Lanes<S>> {
        let (surface, lobes) = self;
        let Coated { body, coat, rough } = surface.coated;
        let Some(rough) = rough else {
            if lobes.single > 0.0 {
                let mirrored = coat.medium.polarized(bands, at, lobes.cosine);
                return Mueller::of(&mirrored, lobes.single);
            }
            let inside = surface.below_coat(bands, at).times(lobes.body);
            let out = coat.medium.polarized(bands, at, lobes.wo_cosine);
            let into = coat.medium.polarized(bands, at, lobes.wi_cosine);
            return Mueller::product(
                [out.s.complement(), out.p.complement()],
                [into.s.complement(), into.p.complement()],
                inside,
            );
        };
        let once = coat.medium.polarized(bands, at, lobes.cosine);
        let inside = surface.below_coat(bands, at).times(lobes.body);
        let several = rough.color(coat, (bands, at), &[]).times(lobes.multiple);
        let out = rough_coat(body, bands, at, lobes.wo_cosine);
        let into = rough_coat(body, bands, at, lobes.wi_cosine);
        let body = out.complement() * into.complement() * inside;
        Mueller::of(&once, lobes.single).and_depolarizer(several + body)
    }
}

/// Returns the reflectance of a rough coat, from its table.
#[inline(always)]
fn rough_coat<S: Simd>(body: &CoatedBody, bands: &Bands<'_, S>, at: At, cosine: f64) -> Lanes<S> {
    let Some(table) = body.reflectances else {
        return bands.splat(0.0);
    };
    let (knot, part) = knot_before(cosine.clamp(0.0, 1.0).sqrt(), CoatedBody::COSINES);
    let low = bands.spectrum(Row::from(table.after(knot)), at);
    let high = bands.spectrum(Row::from(table.after(knot + 1)), at);
    (high - low).mul_add(bands.splat(part), low)
}

/// Returns the probability that a path is reflected by the coat rather than scattered by the body below it, from an estimate of the
/// contribution of each.
pub fn coat_probability(body: &CoatedBody, cosine: f64) -> f64 {
    let reflected = interface_reflectance(body.estimate.n, 0.0, cosine.max(GRAZING));
    let probability = reflected / (reflected + (1.0 - reflected) * body.estimate.base).max(1e-6);
    match body.microsurface {
        // Near grazing it reflects less than a smooth coat: both choices need a probability well above 0.
        Some(_) => probability.clamp(0.1, 0.9),
        None => probability,
    }
}
