//! The boundary of an opaque medium, bare or below thin layers: smooth, or made of specular facets.

use super::{BsdfEval, Lobes, Rough};
use crate::bands::{At, BandMueller, BandValue, Bands, Mueller, MuellerKind, Tables};
use crate::layers::{Coating, Layers, Medium, Nanometers, SurfaceAt};
use glam::DVec3;
use optics::wide::{Lanes, Real};
use pulp::Simd;
use scene::{Microsurface, SpectrumId};

/// An interface, independent of any point.
pub(crate) struct Interface<'a> {
    coating: Coating<'a>,
    rough: Option<Rough<'a>>,
}

impl<'a> Interface<'a> {
    pub(crate) fn new(
        tables: &mut Tables,
        (n, k): (SpectrumId, SpectrumId),
        layers: &'a [scene::Layer],
        microsurface: Option<&'a Microsurface>,
    ) -> Self {
        let coating = Coating {
            medium: Medium::new(tables, n, k),
            layers: Layers::new(tables, layers),
        };
        let rough = microsurface.map(|of| Rough::new(tables, &coating, of));
        Self { coating, rough }
    }

    /// Whether the interface is purely specular.
    pub(crate) fn is_smooth(&self) -> bool {
        self.rough.is_none()
    }
}

/// An interface at a point.
pub(crate) struct InterfaceAt<'a> {
    pub(crate) interface: &'a Interface<'a>,
    pub(crate) surface: SurfaceAt<'a>,
}

impl InterfaceAt<'_> {
    pub(super) fn specular_probability(&self) -> f64 {
        f64::from(u8::from(self.interface.is_smooth()))
    }

    pub(super) fn eval(&self, wo: DVec3, wi: DVec3) -> BsdfEval {
        let facets = self.interface.rough.as_ref().map(|rough| &rough.facets);
        let mut eval = BsdfEval::dark(wo, wi);
        if let Some(found) = facets.and_then(|facets| facets.eval(wo, wi)) {
            eval.lobes.single = found.single;
            eval.lobes.multiple = found.multiple;
            eval.lobes.cosine = found.cosine;
            eval.pdf = found.pdf;
        }
        eval
    }

    pub(super) fn sample(&self, wo: DVec3, random: impl Fn(usize) -> f64) -> DVec3 {
        match &self.interface.rough {
            Some(rough) => rough.facets.sample(wo, [random(0), random(1), random(2)]),
            None => wo * DVec3::new(-1.0, -1.0, 1.0),
        }
    }

    pub(super) fn mueller_kind(&self) -> MuellerKind {
        match self.interface.rough {
            None => MuellerKind::Amplitudes,
            Some(_) => MuellerKind::General,
        }
    }

    pub(super) fn has_layers(&self) -> bool {
        !self.interface.coating.layers.is_empty()
    }

    pub(super) fn thickness_nm<'b>(&self, nm: &'b mut Nanometers) -> &'b [f64] {
        self.interface
            .coating
            .layers
            .thickness_nm(&self.surface, nm)
    }
}

impl BandValue for (&InterfaceAt<'_>, &[f64], Lobes) {
    #[inline(always)]
    fn value<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S> {
        let (InterfaceAt { interface, .. }, nm, lobes) = self;
        let Interface { coating, rough } = interface;
        let once = coating.reflectance(bands, at, (nm, lobes.cosine));
        match rough {
            None => once.times(lobes.single),
            Some(rough) => {
                let color = rough.color(coating, (bands, at), nm);
                once.times(lobes.single) + color.times(lobes.multiple)
            }
        }
    }
}

/// Facets and smooth surfaces act by their amplitudes; light that met several facets is unpolarized.
impl BandMueller for (&InterfaceAt<'_>, &[f64], Lobes) {
    #[inline(always)]
    fn mueller<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Mueller<Lanes<S>> {
        let (InterfaceAt { interface, .. }, nm, lobes) = self;
        let Interface { coating, rough } = interface;
        let once = coating.polarized(bands, at, (nm, lobes.cosine));
        let once = Mueller::of(&once, lobes.single);
        match rough {
            None => once,
            Some(rough) => {
                let color = rough.color(coating, (bands, at), nm);
                once.and_depolarizer(color.times(lobes.multiple))
            }
        }
    }
}
