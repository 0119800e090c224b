//! How a surface scatters light, apart from any path.

use crate::SurfacePoint;
use crate::scatter::Scatterer;
use crate::spectra::Spectra;
use glam::DVec3;
use scene::Scene;

/// How the surface of an object scatters light at a point, as paths have it. Directions are unit vectors in the local frame whose z
/// is the normal on the ray's side and, where the surface is brushed, whose x runs along the grain.
pub struct SurfaceFunction<'a> {
    spectra: Spectra<'a>,
    scatterer: Scatterer<'a>,
}

impl<'a> SurfaceFunction<'a> {
    /// That of an object of a scene; none of films, smooth conductors and black lamps, which scatter nothing. `offset` is the place of
    /// the wavelengths in their bands, `random` chooses between the texels of a picture; both lie in [0, 1).
    pub fn new(
        scene: &'a Scene,
        object: usize,
        point: &SurfacePoint,
        offset: f64,
        random: f64,
    ) -> Option<Self> {
        Some(Self {
            spectra: Spectra { scene, offset },
            scatterer: Scatterer::new(scene, object, point, random)?,
        })
    }

    /// The reflection function from `light` to `eye` times the light's cosine, sr⁻¹, in a band. What a smooth coat mirrors is
    /// no part of it.
    pub fn value(&self, eye: DVec3, light: DVec3, band: usize) -> f64 {
        let lobes = self.scatterer.between(eye, light).lobes;
        let Self { spectra, scatterer } = self;
        spectra.scattered_value(scatterer, eye, &lobes, band)
    }

    /// Density with which [`Self::sample`] finds the light's direction, sr⁻¹. Below a smooth coat it integrates to the chance that
    /// the path is not mirrored by the coat.
    pub fn pdf(&self, eye: DVec3, light: DVec3) -> f64 {
        self.scatterer.between(eye, light).pdf
    }

    /// A direction towards which light is scattered from `eye`, by four numbers in [0, 1).
    pub fn sample(&self, eye: DVec3, random: [f64; 4]) -> DVec3 {
        self.scatterer.sample(eye, random)
    }
}
