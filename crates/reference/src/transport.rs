//! The interface between path tracing, which never sees a band, and spectra, which never see a ray.

use crate::bsdf::{Bsdf, Lobes};
use crate::layers::FilmAt;
use crate::{Ray, axis_across};
use glam::DVec3;
use scene::{Emission, EnvironmentPicture};

/// The side on which a path leaves a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// The path is reflected.
    Reflected,
    /// The path is transmitted straight on.
    Transmitted,
}

/// Light that an emitter gives off toward a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Emitted<'a> {
    /// Its spectrum, scale and light group.
    pub(crate) emission: Emission,
    /// The pixel of the environment that the light comes from, whose value is a factor.
    pub(crate) pixel: Option<(&'a EnvironmentPicture, [u32; 2])>,
    /// Unit vector in which the path reaches it.
    pub(crate) toward: DVec3,
}

/// How a surface scatters light between two directions.
#[derive(Clone, Copy)]
pub(crate) struct Scattering<'a> {
    pub(crate) bsdf: &'a Bsdf<'a>,
    pub(crate) lobes: Lobes,
    /// Unit vectors in world space: toward the camera's side of the path, toward the light's, and the normal on the side of `wo`.
    pub(crate) wo: DVec3,
    pub(crate) wi: DVec3,
    pub(crate) normal: DVec3,
}

impl Scattering<'_> {
    /// Returns the reference axes of the light that leaves toward the camera, and of the light that arrives: across the plane of incidence at
    /// the facet or at the smooth surface, or across the planes in which light enters and leaves a coat.
    pub(crate) fn axes(&self) -> [DVec3; 2] {
        if self.bsdf.is_from_body(&self.lobes) {
            return [self.wo, self.wi].map(|direction| axis_across(direction, self.normal));
        }
        if self.bsdf.is_smooth() {
            return [axis_across(self.wo, self.normal); 2];
        }
        [axis_across(self.wo, self.wi); 2]
    }
}

/// The events along a path, which starts at the camera: everything that depends on wavelength.
///
/// A path has a throughput, at first 1. Weights, mostly inverse probabilities, do not depend on wavelength: the tracer keeps them
/// until light is found.
pub(crate) trait Transport {
    /// Begins a path with a ray from the camera, with its wavelengths at `offset` in their bands, in [0, 1).
    fn begin(&mut self, offset: f64, ray: &Ray);
    /// Splits the path at a film: it continues with the reflected light; the transmitted light waits for [`Self::resume`].
    fn split(&mut self, film: &FilmAt<'_>);
    /// Continues with the path that was split off last.
    fn resume(&mut self);
    /// Multiplies the throughput by a film's reflectance or transmittance.
    fn film(&mut self, film: &FilmAt<'_>, side: Side);
    /// Multiplies the throughput by the value of a surface's BSDF.
    fn scatter(&mut self, at: &Scattering<'_>);
    /// Adds the emission of an emitter that the path hits.
    fn emit(&mut self, light: &Emitted<'_>, weight: f64);
    /// Adds light of an emitter sample at the current surface, through `films`.
    fn connect(
        &mut self,
        at: &Scattering<'_>,
        light: &Emitted<'_>,
        weight: f64,
        films: &[FilmAt<'_>],
    );
}
