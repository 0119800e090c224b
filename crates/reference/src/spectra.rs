//! Spectra of what a path meets, at its wavelengths.

use crate::Reflectance;
use crate::interference::{LayersAt, Light};
use crate::picture::smooth_value;
use crate::scatter::{Conductor, Lobes, Scatterer};
use glam::DVec3;
use optics::Complex64;
use scene::{CoatedBody, Interference, Scene, SpectrumId};

/// A free film where a path meets it.
pub(crate) struct Film<'a> {
    pub(crate) layers: LayersAt<'a>,
    pub(crate) interference: Interference,
}

/// The spectra of a scene at one wavelength of each band.
#[derive(Clone, Copy)]
pub(crate) struct Spectra<'a> {
    pub(crate) scene: &'a Scene,
    /// Place of the wavelengths in their bands, in [0, 1).
    pub(crate) offset: f64,
}

impl Spectra<'_> {
    pub(crate) fn spectrum(&self, id: SpectrumId, band: usize) -> f64 {
        self.scene.spectrum(id).at(band as u32, self.offset)
    }

    pub(crate) fn index(&self, (n, k): (SpectrumId, SpectrumId), band: usize) -> Complex64 {
        Complex64::new(self.spectrum(n, band), self.spectrum(k, band))
    }

    /// The light of a band, for what interferes.
    pub(crate) fn light(&self, band: usize) -> Light<impl Fn(SpectrumId, SpectrumId) -> Complex64> {
        let bands = &self.scene.settings().bands;
        Light {
            wavelength_nm: bands.wavelength_nm(band as u32, self.offset),
            index: move |n, k| self.index((n, k), band),
        }
    }

    /// Reflectance and transmittance of a film.
    pub(crate) fn film(&self, film: &Film<'_>, band: usize) -> (f64, f64) {
        film.layers.free(film.interference, &self.light(band))
    }

    /// Reflectance of a conductor with what lies on it.
    pub(crate) fn reflectance(&self, conductor: &Conductor<'_>, cosine: f64, band: usize) -> f64 {
        let index = self.index(conductor.index, band);
        conductor.coating.on(index, cosine, &self.light(band))
    }

    /// A reflectance in a band.
    pub(crate) fn diffuse(&self, reflectance: Reflectance, band: usize) -> f64 {
        match reflectance {
            Reflectance::Spectrum(spectrum) => self.spectrum(spectrum, band),
            Reflectance::Smooth(coefficients) => {
                smooth_value(coefficients, self.light(band).wavelength_nm)
            }
        }
    }

    /// P of a body below a coat.
    pub(crate) fn below_coat(&self, body: &CoatedBody, base: Reflectance, band: usize) -> f64 {
        let base = self.diffuse(base, band);
        let outer = self.spectrum(body.mean_reflectance, band);
        base * optics::coated_albedo_factor(base, self.spectrum(body.n, band), outer)
    }

    /// The reflectance of a rough coat, from its table.
    pub(crate) fn rough_coat(&self, body: &CoatedBody, cosine: f64, band: usize) -> f64 {
        let place = cosine.clamp(0.0, 1.0).sqrt() * (CoatedBody::COSINES - 1) as f64;
        let knot = (place as usize).min(CoatedBody::COSINES - 2);
        let at = |knot| {
            let spectrum = body.reflectances.map(|first| first.after(knot));
            spectrum.map_or(0.0, |spectrum| self.spectrum(spectrum, band))
        };
        at(knot) + (at(knot + 1) - at(knot)) * (place - knot as f64)
    }

    /// What lobes make of the spectra of a surface in a band.
    pub(crate) fn scattered_value(
        &self,
        scatterer: &Scatterer<'_>,
        eye: DVec3,
        lobes: &Lobes,
        band: usize,
    ) -> f64 {
        if !lobes.is_lit() {
            return 0.0;
        }
        match scatterer {
            Scatterer::Diffuse(reflectance) => lobes.single * self.diffuse(*reflectance, band),
            Scatterer::CoatedBody(coat, body, base) => {
                let passes = |cosine: f64| 1.0 - self.reflectance(coat, cosine, band);
                let inside = self.below_coat(body, *base, band);
                lobes.body * passes(eye.z) * passes(lobes.light_cosine) * inside
            }
            Scatterer::RoughCoatedBody(coat, body, base, facets) => {
                let reflectance = |cosine| self.reflectance(coat, cosine, band);
                let mean = optics::mean_reflectance(reflectance);
                let multiple = optics::multiple_colour(mean, facets.mean_energy());
                let passes = |cosine: f64| 1.0 - self.rough_coat(body, cosine, band);
                let inside = self.below_coat(body, *base, band);
                lobes.single * reflectance(lobes.cosine)
                    + lobes.multiple * multiple
                    + lobes.body * passes(eye.z) * passes(lobes.light_cosine) * inside
            }
            Scatterer::Cook(conductor, cook) => {
                let base = cook.diffuse.map_or(0.0, |diffuse| {
                    lobes.body * self.spectrum(diffuse.reflectance, band)
                });
                lobes.single * self.reflectance(conductor, lobes.cosine, band) + base
            }
            Scatterer::RoughConductor(conductor, facets) => {
                let reflectance = |cosine| self.reflectance(conductor, cosine, band);
                let mean = optics::mean_reflectance(reflectance);
                let multiple = optics::multiple_colour(mean, facets.mean_energy());
                lobes.single * reflectance(lobes.cosine) + lobes.multiple * multiple
            }
        }
    }
}
