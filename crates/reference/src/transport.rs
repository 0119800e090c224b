//! The interface between path tracing, which never sees a band, and spectra, which never see a ray.

use crate::bsdf::{Bsdf, Lobes};
use crate::layers::FilmAt;
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
}

/// The events along a path, which starts at the camera: everything that depends on wavelength.
///
/// A path has a throughput, at first 1. Weights, mostly inverse probabilities, do not depend on wavelength: the tracer keeps them
/// until light is found.
pub(crate) trait Transport {
    /// Begins a path, with its wavelengths at `offset` in their bands, in [0, 1).
    fn begin(&mut self, offset: f64);
    /// Splits the path at a film: it continues with the reflected light; the transmitted light waits for [`Self::resume`].
    fn split(&mut self, film: &FilmAt<'_>);
    /// Continues with the path that was split off last.
    fn resume(&mut self);
    /// Multiplies the throughput by a film's reflectance or transmittance.
    fn film(&mut self, film: &FilmAt<'_>, side: Side);
    /// Multiplies the throughput by the value of a surface's BSDF for `lobes`.
    fn scatter(&mut self, bsdf: &Bsdf<'_>, lobes: &Lobes);
    /// Adds the emission of an emitter that the path hits.
    fn emit(&mut self, light: &Emitted<'_>, weight: f64);
    /// Adds light of an emitter sample at the current surface, through `films`.
    fn connect(
        &mut self,
        scattering: (&Bsdf<'_>, &Lobes),
        light: &Emitted<'_>,
        weight: f64,
        films: &[FilmAt<'_>],
    );
}
