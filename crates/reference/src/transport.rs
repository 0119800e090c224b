//! What a path tells of itself: the interface between tracing, which never sees a band, and spectra, which never see a ray.

use crate::bsdf::{Bsdf, Lobes};
use crate::layers::FilmAt;
use scene::{Emission, EnvironmentPicture};

/// Which way a path takes at a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// It is mirrored.
    Reflected,
    /// It goes straight on.
    Transmitted,
}

/// Light that something emits toward a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Emitted<'a> {
    /// Its spectrum, scale and light group.
    pub(crate) emission: Emission,
    /// The pixel of the environment that it comes from, whose value is a factor.
    pub(crate) pixel: Option<(&'a EnvironmentPicture, [u32; 2])>,
}

/// What light does along a path, which starts at the camera: everything that depends on wavelength.
///
/// A path has a throughput, at first 1. Weights, of which probabilities are the greatest part, do not depend on wavelength: they
/// stay with the tracer until light is found.
pub(crate) trait Transport {
    /// A path begins, with its wavelengths at `offset` in their bands, in [0, 1).
    fn begin(&mut self, offset: f64);
    /// At a film the path goes on mirrored; what is transmitted waits for [`Self::resume`].
    fn split(&mut self, film: &FilmAt<'_>);
    /// The path that was split off last goes on.
    fn resume(&mut self);
    /// A film multiplies the throughput by its reflectance or its transmittance.
    fn film(&mut self, film: &FilmAt<'_>, side: Side);
    /// A surface multiplies the throughput by its BSDF's value of `lobes`.
    fn scatter(&mut self, bsdf: &Bsdf<'_>, lobes: &Lobes);
    /// The path meets a light.
    fn emit(&mut self, light: &Emitted<'_>, weight: f64);
    /// The path finds a light from the surface that it is on, through `films`.
    fn connect(
        &mut self,
        scattering: (&Bsdf<'_>, &Lobes),
        light: &Emitted<'_>,
        weight: f64,
        films: &[FilmAt<'_>],
    );
}
