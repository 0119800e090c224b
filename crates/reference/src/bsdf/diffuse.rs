//! Lambertian reflection.

use super::{BsdfEval, Lobes};
use crate::bands::{At, BandValue, Bands, Spectrum};
use crate::lifting::smooth_value;
use crate::sample_cosine_hemisphere;
use crate::surface::Reflectance;
use glam::DVec3;
use optics::wide::{Lanes, Real};
use pulp::Simd;
use std::f64::consts::FRAC_1_PI;

/// A reflectance ρ: f = ρ / π.
pub(crate) struct Diffuse(pub(crate) Reflectance);

pub(super) fn eval(wo: DVec3, wi: DVec3) -> BsdfEval {
    let lambert = wi.z.max(0.0) * FRAC_1_PI;
    let mut dark = BsdfEval::dark(wo, wi);
    dark.lobes.single = lambert;
    dark.pdf = lambert;
    dark
}

pub(super) fn sample(random: impl Fn(usize) -> f64) -> DVec3 {
    sample_cosine_hemisphere(random(0), random(1))
}

impl Diffuse {
    #[inline(always)]
    pub(super) fn product<S: Simd>(
        &self,
        bands: &Bands<'_, S>,
        lobes: Lobes,
        spectrum: &Spectrum,
        to: &mut Spectrum,
    ) {
        match self.0 {
            Reflectance::Spectrum(of) => {
                let value = (bands.knots(of.into()), lobes.single);
                bands.product(spectrum, &value, to);
            }
            Reflectance::Smooth(_) => bands.product(spectrum, &(self.0, lobes.single), to),
        }
    }
}

impl BandValue for (Reflectance, f64) {
    #[inline(always)]
    fn value<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S> {
        self.0.at(bands, at).times(self.1)
    }
}

impl Reflectance {
    #[inline(always)]
    pub(super) fn at<S: Simd>(&self, bands: &Bands<'_, S>, at: At) -> Lanes<S> {
        match *self {
            Self::Spectrum(spectrum) => bands.spectrum(spectrum.into(), at),
            Self::Smooth(coefficients) => {
                smooth_value(coefficients, bands.inverse_wavelength(at).recip())
            }
        }
    }
}
