//! A path through the scene with its spectrum.

use crate::environment_picture::pixel_value;
use crate::interference::{LayersAt, Light};
use crate::picture::smooth_value;
use crate::scatter::{Conductor, Lobes, Scatterer};
use crate::{
    Hit, Ray, Reflectance, SurfacePoint, camera_ray, environment_pixel, environment_share,
    frame_of, light_pdf, nearest_hit, pattern_reflectance, random4, sample_light, sobol4,
    surface_point,
};
use glam::DVec3;
use optics::Complex64;
use scene::{
    Emission, EnvironmentPicture, EnvironmentShape, Interference, Material, Pattern,
    RenderSettings, Sampler, Scene, SpectrumId, WavelengthSampling,
};

/// Share of the paths that follow the reflection of a film rather than its transmission.
const REFLECTED_SHARE: f64 = 0.5;

/// What one sample of a pixel brings.
#[derive(Clone, Debug, PartialEq)]
pub struct PathSample {
    /// Place of the wavelengths in their bands, in [0, 1).
    pub offset: f64,
    /// Radiance of each light group at each band's wavelength: `[light group][band]`.
    pub radiance: Vec<Vec<f64>>,
}

/// Follows one sample of a pixel. `lights` are the scene's lights ([`Scene::lights`]).
pub fn radiance(scene: &Scene, lights: &[usize], pixel: [u32; 2], sample: u32) -> PathSample {
    let settings = scene.settings();
    let [x, y, drawn, _] = numbers_of(settings, pixel, sample, 0);
    let bands = settings.bands.count() as usize;
    let mut path = Path {
        scene,
        lights,
        pixel,
        sample,
        offset: match settings.sampling {
            WavelengthSampling::Random => drawn,
            WavelengthSampling::Centre => 0.5,
        },
        ray: camera_ray(scene, pixel, [x, y]),
        from_object: None,
        scattered: None,
        segment: 1,
        throughput: vec![1.0; bands],
        radiance: vec![vec![0.0; bands]; scene.light_groups().len()],
    };
    while path.segment <= settings.max_path_segments {
        let Some(hit) = nearest_hit(scene, &path.ray, path.from_object) else {
            path.add_environment();
            break;
        };
        if !path.meet(hit) {
            break;
        }
        path.segment += 1;
    }
    PathSample {
        offset: path.offset,
        radiance: path.radiance,
    }
}

/// Four numbers in [0, 1) for a dimension of a sample.
fn numbers_of(settings: &RenderSettings, pixel: [u32; 2], sample: u32, dimension: u32) -> [f64; 4] {
    match settings.sampler {
        Sampler::Sobol => sobol4(pixel, sample, dimension, settings.seed),
        Sampler::Independent => random4(pixel, sample, dimension, settings.seed),
    }
}

/// A path on its way.
struct Path<'a> {
    scene: &'a Scene,
    lights: &'a [usize],
    pixel: [u32; 2],
    sample: u32,
    offset: f64,
    ray: Ray,
    /// The object that the ray starts on.
    from_object: Option<usize>,
    /// Where a surface last scattered the path and with what density; none after the camera or a mirror.
    scattered: Option<(DVec3, f64)>,
    segment: u32,
    throughput: Vec<f64>,
    /// Of each light group.
    radiance: Vec<Vec<f64>>,
}

impl<'a> Path<'a> {
    fn random(&self, use_of: u32) -> [f64; 4] {
        let dimension = 2 * self.segment - 1 + use_of;
        numbers_of(self.scene.settings(), self.pixel, self.sample, dimension)
    }

    fn spectrum(&self, id: SpectrumId, band: usize) -> f64 {
        self.scene.spectrum(id).at(band as u32, self.offset)
    }

    fn index(&self, (n, k): (SpectrumId, SpectrumId), band: usize) -> Complex64 {
        Complex64::new(self.spectrum(n, band), self.spectrum(k, band))
    }

    fn bands(&self) -> std::ops::Range<usize> {
        0..self.throughput.len()
    }

    /// Light that joins the path here.
    fn add(&mut self, emission: Emission, weight: f64) {
        for band in self.bands() {
            let light = emission.scale * self.spectrum(emission.spectrum, band);
            let light_group = emission.light_group.index();
            self.radiance[light_group][band] += self.throughput[band] * weight * light;
        }
    }

    /// Light of a pixel of the surroundings that joins the path here.
    fn add_picture(
        &mut self,
        emission: Emission,
        (picture, pixel): (&EnvironmentPicture, [u32; 2]),
        weight: f64,
    ) {
        for band in self.bands() {
            let nm = self.light(band).wavelength_nm;
            let lamp = emission.scale * self.spectrum(emission.spectrum, band);
            let light = lamp * pixel_value(picture, pixel, band, nm);
            let light_group = emission.light_group.index();
            self.radiance[light_group][band] += self.throughput[band] * weight * light;
        }
    }

    fn attenuate(&mut self, factor: impl Fn(&Self, usize) -> f64) {
        for band in self.bands() {
            self.throughput[band] *= factor(self, band);
        }
    }

    fn add_environment(&mut self) {
        for part in self.scene.environment().parts() {
            let direction = self.ray.direction;
            if let EnvironmentShape::Picture(picture) = part.shape {
                let pixel = environment_pixel(picture, direction, self.random(0)[3]);
                self.add_picture(part.emission, (picture, pixel), 1.0);
                continue;
            }
            self.add(part.emission, environment_share(part.shape, direction));
        }
    }

    /// Meets a surface; says whether the path goes on.
    fn meet(&mut self, hit: Hit) -> bool {
        let scene = self.scene;
        let object = &scene.objects()[hit.object];
        let point = surface_point(&object.shape, &self.ray, hit.distance);
        match *scene.material(object.material) {
            Material::Diffuse { ref reflectance } => {
                self.meet_diffuse(hit.object, point, reflectance)
            }
            Material::Emitter {
                emission,
                reflectance,
            } => {
                self.add(emission, self.share_of_scattering(hit.object));
                reflectance.is_some_and(|spectrum| {
                    self.meet_diffuse(hit.object, point, &Pattern::Uniform(spectrum))
                })
            }
            Material::Conductor {
                n,
                k,
                ref layers,
                ref microsurface,
            } => {
                let conductor = Conductor {
                    index: (n, k),
                    coating: LayersAt::new(layers, &object.shape, &point),
                };
                if let Some(facets) = microsurface {
                    let rough = Scatterer::RoughConductor(conductor, facets.roughness[0]);
                    self.meet_scattering(hit.object, point, &rough)
                } else {
                    self.meet_mirror(hit.object, point, &conductor)
                }
            }
            Material::Film {
                ref layers,
                interference,
                ..
            } => {
                let film = Film {
                    layers: LayersAt::new(layers, &object.shape, &point),
                    interference,
                };
                self.meet_film(hit.object, point, &film)
            }
        }
    }

    fn scatter(&mut self, object: usize, position: DVec3, direction: DVec3, pdf: Option<f64>) {
        self.ray = Ray {
            origin: position,
            direction,
        };
        self.from_object = Some(object);
        self.scattered = pdf.map(|pdf| (position, pdf));
    }

    fn meet_mirror(
        &mut self,
        object: usize,
        point: SurfacePoint,
        conductor: &Conductor<'_>,
    ) -> bool {
        self.attenuate(|path, band| path.reflectance(conductor, point.cosine, band));
        let direction = mirrored(self.ray.direction, point.normal);
        self.scatter(object, point.position, direction, None);
        true
    }

    fn meet_film(&mut self, object: usize, point: SurfacePoint, film: &Film<'_>) -> bool {
        let reflects = self.random(1)[0] < REFLECTED_SHARE;
        self.attenuate(|path, band| {
            let (reflectance, transmittance) = path.film(film, band);
            if reflects {
                reflectance / REFLECTED_SHARE
            } else {
                transmittance / (1.0 - REFLECTED_SHARE)
            }
        });
        if reflects {
            let direction = mirrored(self.ray.direction, point.normal);
            self.scatter(object, point.position, direction, None);
        } else {
            // Straight on: what was said of the last scattering still holds.
            self.ray.origin = point.position;
            self.from_object = Some(object);
        }
        true
    }

    /// The light of a band, for what interferes.
    fn light(&self, band: usize) -> Light<impl Fn(SpectrumId, SpectrumId) -> Complex64> {
        let bands = &self.scene.settings().bands;
        Light {
            wavelength_nm: bands.wavelength_nm(band as u32, self.offset),
            index: move |n, k| self.index((n, k), band),
        }
    }

    /// Reflectance and transmittance of a film.
    fn film(&self, film: &Film<'_>, band: usize) -> (f64, f64) {
        film.layers.free(film.interference, &self.light(band))
    }

    /// Reflectance of a conductor with what lies on it.
    fn reflectance(&self, conductor: &Conductor<'_>, cosine: f64, band: usize) -> f64 {
        let index = self.index(conductor.index, band);
        conductor.coating.on(index, cosine, &self.light(band))
    }

    fn meet_diffuse(&mut self, object: usize, point: SurfacePoint, pattern: &Pattern) -> bool {
        let shape = &self.scene.objects()[object].shape;
        let [.., random] = self.random(1);
        let reflectance = pattern_reflectance(pattern, shape, point.position, random);
        self.meet_scattering(object, point, &Scatterer::Diffuse(reflectance))
    }

    /// A diffuse or rough surface: light is sent to it, and the path is scattered.
    fn meet_scattering(
        &mut self,
        object: usize,
        point: SurfacePoint,
        scatterer: &Scatterer<'_>,
    ) -> bool {
        let world_from_local = frame_of(point.normal);
        let local_from_world = world_from_local.transpose();
        let eye = local_from_world * -self.ray.direction;
        if let Some(sent) = self.send_to_light(object, &point) {
            let towards = scatterer.between(eye, local_from_world * sent.direction);
            let share = 1.0 / (sent.pdf + towards.pdf);
            self.add_connection(&sent, |path, band| {
                share * path.scattered_value(scatterer, eye, &towards.lobes, band)
            });
        }
        let light = scatterer.sample(eye, self.random(1));
        let onward = scatterer.between(eye, light);
        if onward.pdf <= 0.0 || !onward.lobes.is_lit() {
            return false;
        }
        self.attenuate(|path, band| {
            path.scattered_value(scatterer, eye, &onward.lobes, band) / onward.pdf
        });
        let direction = (world_from_local * light).normalize();
        self.scatter(object, point.position, direction, Some(onward.pdf));
        true
    }

    /// A reflectance in a band.
    fn diffuse(&self, reflectance: Reflectance, band: usize) -> f64 {
        match reflectance {
            Reflectance::Spectrum(spectrum) => self.spectrum(spectrum, band),
            Reflectance::Smooth(coefficients) => {
                smooth_value(coefficients, self.light(band).wavelength_nm)
            }
        }
    }

    /// What lobes make of the spectra of a surface in a band.
    fn scattered_value(
        &self,
        scatterer: &Scatterer<'_>,
        _eye: DVec3,
        lobes: &Lobes,
        band: usize,
    ) -> f64 {
        if !lobes.is_lit() {
            return 0.0;
        }
        match scatterer {
            Scatterer::Diffuse(reflectance) => lobes.single * self.diffuse(*reflectance, band),
            Scatterer::RoughConductor(conductor, _) => {
                lobes.single * self.reflectance(conductor, lobes.cosine, band)
            }
        }
    }

    /// Share of an emitter that belongs to a path which happens to hit it: p / (p + q) with p the density of
    /// the scattering and q that of connections (balance heuristic, Veach 1997, equation 9.8).
    fn share_of_scattering(&self, object: usize) -> f64 {
        let Some((position, pdf)) = self.scattered else {
            return 1.0;
        };
        if self.lights.binary_search(&object).is_err() {
            return 1.0;
        }
        let shape = &self.scene.objects()[object].shape;
        let sent = light_pdf(shape, position, self.ray.direction) / self.lights.len() as f64;
        pdf / (pdf + sent)
    }

    /// Chooses a light, a direction towards it, and follows it there. None where nothing arrives.
    fn send_to_light(&self, object: usize, point: &SurfacePoint) -> Option<Sent<'a>> {
        let max_segments = self.scene.settings().max_path_segments;
        if self.lights.is_empty() || self.segment >= max_segments {
            return None;
        }
        let [pick, u, v, _] = self.random(0);
        let light = self.lights[(pick * self.lights.len() as f64) as usize];
        let shape = &self.scene.objects()[light].shape;
        let direction = sample_light(shape, point.position, u, v);
        let pdf = light_pdf(shape, point.position, direction) / self.lights.len() as f64;
        if direction.dot(point.normal) <= 0.0 || pdf <= 0.0 {
            return None;
        }
        let ray = Ray {
            origin: point.position,
            direction,
        };
        let films = self.films_on_the_way(ray, object, light, max_segments - self.segment - 1)?;
        Some(Sent {
            light,
            direction,
            pdf,
            films,
        })
    }

    /// The films that a ray crosses before it reaches a light; none where something opaque is in the way or
    /// more films than `allowed`.
    fn films_on_the_way(
        &self,
        mut ray: Ray,
        object: usize,
        light: usize,
        allowed: u32,
    ) -> Option<Vec<Film<'a>>> {
        let mut films = Vec::new();
        let mut from = object;
        loop {
            let hit = nearest_hit(self.scene, &ray, Some(from))?;
            if hit.object == light {
                return Some(films);
            }
            let met = &self.scene.objects()[hit.object];
            let Material::Film {
                layers,
                interference,
                ..
            } = self.scene.material(met.material)
            else {
                return None;
            };
            if films.len() == allowed as usize {
                return None;
            }
            let point = surface_point(&met.shape, &ray, hit.distance);
            films.push(Film {
                layers: LayersAt::new(layers, &met.shape, &point),
                interference: *interference,
            });
            ray.origin = point.position;
            from = hit.object;
        }
    }

    fn add_connection(&mut self, sent: &Sent<'_>, factor: impl Fn(&Self, usize) -> f64) {
        let light = &self.scene.objects()[sent.light];
        let Material::Emitter { emission, .. } = *self.scene.material(light.material) else {
            return;
        };
        for band in self.bands() {
            let mut arriving = emission.scale * self.spectrum(emission.spectrum, band);
            for film in &sent.films {
                arriving *= self.film(film, band).1;
            }
            let light_group = emission.light_group.index();
            self.radiance[light_group][band] +=
                self.throughput[band] * factor(self, band) * arriving;
        }
    }
}

/// A connection to a light.
struct Sent<'a> {
    light: usize,
    direction: DVec3,
    /// Density of the direction, the choice among the lights included.
    pdf: f64,
    /// The films that it passes straight through.
    films: Vec<Film<'a>>,
}

/// A free film where a path meets it.
struct Film<'a> {
    layers: LayersAt<'a>,
    interference: Interference,
}

/// Mirrors a direction at a surface.
fn mirrored(direction: DVec3, normal: DVec3) -> DVec3 {
    (direction - 2.0 * direction.dot(normal) * normal).normalize()
}
