//! The BSDF of a surface, independent of any path.

use crate::bsdf::{Bsdf, Lobes};
use crate::spectral::SpectralPath;
use crate::transport::{Scattering, Transport};
use crate::{PreparedScene, Ray, SimdLevel, SurfacePoint};
use glam::DVec3;

/// The BSDF of an object at a point, as paths use it. `wo` points to the camera's side of a path, `wi` to the light's; both are
/// unit vectors of the local frame whose z is the normal on the side of `wo` and, where the surface is brushed, whose x runs along
/// the grain.
pub struct SurfaceFunction<'a> {
    prepared: &'a PreparedScene<'a>,
    bsdf: Bsdf<'a>,
    offset: f64,
}

impl<'a> SurfaceFunction<'a> {
    /// Returns the BSDF of an object of a scene; `None` for films and for black surfaces. `offset` is the position of the
    /// wavelengths in their bands, `random` chooses between the texels of a picture; both are in [0, 1).
    pub fn new(
        prepared: &'a PreparedScene<'a>,
        object: usize,
        point: &SurfacePoint,
        offset: f64,
        random: f64,
    ) -> Option<Self> {
        let object = &prepared.scene.objects()[object];
        let surface = prepared.surface(object.material);
        Some(Self {
            prepared,
            bsdf: surface.bsdf(&object.shape, point, || random)?,
            offset,
        })
    }

    /// Returns the BSDF from `wi` to `wo` times cos θi in each band, sr⁻¹, without a specular part.
    pub fn values(&self, wo: DVec3, wi: DVec3) -> Vec<f64> {
        let mut path = SpectralPath::new(SimdLevel::best().0, &self.prepared.tables, 1);
        path.begin(self.offset, &ANY_RAY);
        path.scatter(&self.scattering(self.bsdf.eval(wo, wi).lobes, wo, wi));
        path.throughput().to_vec()
    }

    fn scattering(&self, lobes: Lobes, wo: DVec3, wi: DVec3) -> Scattering<'_> {
        Scattering {
            bsdf: &self.bsdf,
            lobes,
            wo,
            wi,
            normal: DVec3::Z,
        }
    }

    /// Returns the density with which [`Self::sample`] finds `wi`, sr⁻¹. Below a smooth coat it integrates to the probability that
    /// the path is not reflected by the coat.
    pub fn pdf(&self, wo: DVec3, wi: DVec3) -> f64 {
        self.bsdf.eval(wo, wi).pdf
    }

    /// Samples a direction `wi` from four numbers in [0, 1).
    pub fn sample(&self, wo: DVec3, random: [f64; 4]) -> DVec3 {
        self.bsdf.sample(wo, |lane| random[lane])
    }
}

/// A ray where only what depends on the wavelength matters.
const ANY_RAY: Ray = Ray {
    origin: DVec3::ZERO,
    direction: DVec3::NEG_Z,
};

impl PreparedScene<'_> {
    /// Returns reflectance and transmittance of an object's film, for unpolarized light in each band, as paths use them. `None` for
    /// objects that are not films.
    pub fn film_powers(
        &self,
        object: usize,
        point: &SurfacePoint,
        offset: f64,
    ) -> Option<[Vec<f64>; 2]> {
        let object = &self.scene.objects()[object];
        let film =
            self.surface(object.material)
                .film()?
                .at(&object.shape, point, ANY_RAY.direction);
        let mut path = SpectralPath::new(SimdLevel::best().0, &self.tables, 1);
        path.begin(offset, &ANY_RAY);
        path.split(&film);
        let reflectance = path.throughput().to_vec();
        path.resume();
        Some([reflectance, path.throughput().to_vec()])
    }

    /// Returns the reflectance of an object's smooth surface, for unpolarized light in each band, as paths use it. `None` for
    /// objects that are not purely specular.
    pub fn mirror_reflectance(
        &self,
        object: usize,
        point: &SurfacePoint,
        offset: f64,
    ) -> Option<Vec<f64>> {
        let object = &self.scene.objects()[object];
        let bsdf = self
            .surface(object.material)
            .bsdf(&object.shape, point, || 0.0)?;
        let wo = DVec3::new(
            (1.0 - point.cosine * point.cosine).sqrt(),
            0.0,
            point.cosine,
        );
        if bsdf.specular_probability(wo) < 1.0 {
            return None;
        }
        let mut path = SpectralPath::new(SimdLevel::best().0, &self.tables, 1);
        path.begin(offset, &ANY_RAY);
        path.scatter(&Scattering {
            bsdf: &bsdf,
            lobes: Lobes::specular(point.cosine),
            wo,
            wi: wo * DVec3::new(-1.0, -1.0, 1.0),
            normal: DVec3::Z,
        });
        Some(path.throughput().to_vec())
    }
}
