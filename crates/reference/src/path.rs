//! A path through the scene with its spectrum.

use crate::interference::{LayersAt, Light};
use crate::scatter::{Conductor, Lobes, Scatterer};
use crate::{
    Hit, Ray, SurfacePoint, chance_to_go_on, frame_of, light_pdf, nearest_hit, random4,
    reflectance_spectrum, reflected_share, sample_light, sampled_camera_ray, sobol4, surface_point,
};
use glam::DVec3;
use optics::Complex64;
use scene::{
    Emission, Environment, Interference, Material, Pattern, RenderSettings, Sampler, Scene,
    SpectrumId, WavelengthSampling,
};

/// Dimensions of a branch of a path: more than three for each of its segments.
const BRANCH_DIMENSIONS: u32 = 128;
/// The dimension of the camera's lens: beyond those of all branches.
const LENS_DIMENSION: u32 = 0xffff;

/// What the random numbers of a vertex are for.
#[derive(Clone, Copy)]
enum Use {
    Light,
    Scattering,
    Roulette,
}

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
    let on_lens = match scene.camera().lens {
        Some(_) => {
            let [u, v, ..] = numbers_of(settings, pixel, sample, LENS_DIMENSION);
            [u, v]
        }
        None => [0.0; 2],
    };
    let mut path = Path {
        scene,
        lights,
        pixel,
        sample,
        offset: match settings.sampling {
            WavelengthSampling::Random => drawn,
            WavelengthSampling::Centre => 0.5,
        },
        walk: Walk {
            ray: sampled_camera_ray(scene, pixel, [x, y], on_lens),
            from_object: None,
            scattered: None,
            segment: 1,
            splits: settings.film_splits,
            branch: 0,
            estimate: 1.0,
            throughput: vec![1.0; bands],
        },
        waiting: Vec::new(),
        radiance: vec![vec![0.0; bands]; scene.light_groups().len()],
    };
    path.follow();
    while let Some(walk) = path.waiting.pop() {
        path.walk = walk;
        path.follow();
    }
    path.dim();
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
    walk: Walk,
    /// Walks that begin where films split the path, to be followed when the present one has ended.
    waiting: Vec<Walk>,
    /// Of each light group.
    radiance: Vec<Vec<f64>>,
}

/// One of the ways that a path takes.
#[derive(Clone)]
struct Walk {
    ray: Ray,
    /// The object that the ray starts on.
    from_object: Option<usize>,
    /// Where a surface last scattered the path and with what density; none after the camera or a mirror.
    scattered: Option<(DVec3, f64)>,
    segment: u32,
    /// Films at which it will still be split.
    splits: u32,
    /// Which of the ways that splits made of the path it is.
    branch: u32,
    /// About what part of the light comes through, in the wavelength where it is largest.
    estimate: f64,
    throughput: Vec<f64>,
}

impl<'a> Path<'a> {
    fn random(&self, use_of: Use) -> [f64; 4] {
        let walk = &self.walk;
        let dimension = BRANCH_DIMENSIONS * walk.branch + 3 * walk.segment - 2 + use_of as u32;
        numbers_of(self.scene.settings(), self.pixel, self.sample, dimension)
    }

    fn spectrum(&self, id: SpectrumId, band: usize) -> f64 {
        self.scene.spectrum(id).at(band as u32, self.offset)
    }

    fn index(&self, (n, k): (SpectrumId, SpectrumId), band: usize) -> Complex64 {
        Complex64::new(self.spectrum(n, band), self.spectrum(k, band))
    }

    fn bands(&self) -> std::ops::Range<usize> {
        0..self.walk.throughput.len()
    }

    /// Light that joins the path here.
    fn add(&mut self, emission: Emission, weight: f64) {
        for band in self.bands() {
            let light = emission.scale * self.spectrum(emission.spectrum, band);
            let light_group = emission.light_group.index();
            self.radiance[light_group][band] += self.walk.throughput[band] * weight * light;
        }
    }

    fn attenuate(&mut self, factor: impl Fn(&Self, usize) -> f64) {
        for band in self.bands() {
            self.walk.throughput[band] *= factor(self, band);
        }
    }

    fn add_environment(&mut self) {
        match *self.scene.environment() {
            Environment::Constant(everywhere) => self.add(everywhere, 1.0),
            Environment::Gradient {
                zenith,
                horizon,
                ground,
            } => {
                let height = self.walk.ray.direction.y.clamp(-1.0, 1.0);
                self.add(horizon, 1.0 - height.abs());
                self.add(if height >= 0.0 { zenith } else { ground }, height.abs());
            }
        }
    }

    /// Follows the present walk to its end.
    fn follow(&mut self) {
        let settings = self.scene.settings();
        while self.walk.segment <= settings.max_path_segments {
            let Some(hit) = nearest_hit(self.scene, &self.walk.ray, self.walk.from_object) else {
                self.add_environment();
                return;
            };
            if !self.meet(hit) {
                return;
            }
            let is_last = self.walk.segment == settings.max_path_segments;
            let plays = self.walk.segment >= settings.roulette_after && !is_last;
            if plays && !self.survives_roulette() {
                return;
            }
            self.walk.segment += 1;
        }
    }

    /// Russian roulette: ends the walk by chance, or lets it count for more.
    fn survives_roulette(&mut self) -> bool {
        let chance = chance_to_go_on(self.walk.estimate);
        if chance < 1.0 {
            if self.random(Use::Roulette)[0] >= chance {
                return false;
            }
            self.walk.estimate /= chance;
            self.attenuate(|_, _| 1.0 / chance);
        }
        true
    }

    /// Dims a sample that is brighter than the scene allows.
    fn dim(&mut self) {
        let Some(most) = self.scene.settings().clamp else {
            return;
        };
        let of_band = |band: usize| self.radiance.iter().map(|group| group[band]).sum::<f64>();
        let brightest = self.bands().map(of_band).fold(most, f64::max);
        for value in self.radiance.iter_mut().flatten() {
            *value *= most / brightest;
        }
    }

    /// Meets a surface; says whether the path goes on.
    fn meet(&mut self, hit: Hit) -> bool {
        let scene = self.scene;
        let object = &scene.objects()[hit.object];
        let point = surface_point(&object.shape, &self.walk.ray, hit.distance);
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
                roughness,
            } => {
                let conductor = Conductor {
                    index: (n, k),
                    coating: LayersAt::new(layers, &object.shape, &point),
                };
                if roughness > 0.0 {
                    let rough = Scatterer::RoughConductor(conductor, roughness);
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
        self.walk.ray = Ray {
            origin: position,
            direction,
        };
        self.walk.from_object = Some(object);
        self.walk.scattered = pdf.map(|pdf| (position, pdf));
    }

    fn meet_mirror(
        &mut self,
        object: usize,
        point: SurfacePoint,
        conductor: &Conductor<'_>,
    ) -> bool {
        self.attenuate(|path, band| path.reflectance(conductor, point.cosine, band));
        let direction = mirrored(self.walk.ray.direction, point.normal);
        self.scatter(object, point.position, direction, None);
        self.walk.estimate *= self.albedo(object);
        true
    }

    /// About what part of the light goes on from an object.
    fn albedo(&self, object: usize) -> f64 {
        let material = self.scene.objects()[object].material;
        self.scene.estimate(material).albedo
    }

    /// A film: the path is mirrored or goes straight on, or does both.
    fn meet_film(&mut self, object: usize, point: SurfacePoint, film: &Film<'_>) -> bool {
        let values: Vec<_> = self.bands().map(|band| self.film(film, band)).collect();
        let estimate = self.scene.estimate(self.scene.objects()[object].material);
        let reflected = estimate.reflected_at(point.cosine);
        self.walk.estimate *= estimate.albedo;
        let is_split =
            self.walk.splits > 0 && self.walk.segment < self.scene.settings().max_path_segments;
        if is_split {
            self.walk.splits -= 1;
            let mut through = self.walk.clone();
            through.branch += 1 << through.splits;
            through.segment += 1;
            through.go_through(object, &point, (&values, 1.0 - reflected, 1.0));
            self.waiting.push(through);
            self.walk
                .go_mirrored(object, &point, (&values, reflected, 1.0));
            return true;
        }
        let share = reflected_share(reflected);
        if self.random(Use::Scattering)[0] < share {
            self.walk
                .go_mirrored(object, &point, (&values, reflected, share));
        } else {
            let ways = (values.as_slice(), 1.0 - reflected, 1.0 - share);
            self.walk.go_through(object, &point, ways);
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
        let spectrum = reflectance_spectrum(pattern, shape, point.position);
        self.meet_scattering(object, point, &Scatterer::Diffuse(spectrum))
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
        let eye = local_from_world * -self.walk.ray.direction;
        if let Some(sent) = self.send_to_light(object, &point) {
            let towards = scatterer.between(eye, local_from_world * sent.direction);
            let share = 1.0 / (sent.pdf + towards.pdf);
            self.add_connection(&sent, |path, band| {
                share * path.scattered_value(scatterer, eye, &towards.lobes, band)
            });
        }
        let light = scatterer.sample(eye, self.random(Use::Scattering));
        let onward = scatterer.between(eye, light);
        if onward.pdf <= 0.0 || !onward.lobes.is_lit() {
            return false;
        }
        self.attenuate(|path, band| {
            path.scattered_value(scatterer, eye, &onward.lobes, band) / onward.pdf
        });
        self.walk.splits = 0;
        let Lobes {
            single,
            multiple,
            body,
            ..
        } = onward.lobes;
        self.walk.estimate *= (single + multiple + body) / onward.pdf * self.albedo(object);
        let direction = (world_from_local * light).normalize();
        self.scatter(object, point.position, direction, Some(onward.pdf));
        true
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
            Scatterer::Diffuse(spectrum) => lobes.single * self.spectrum(*spectrum, band),
            Scatterer::RoughConductor(conductor, _) => {
                lobes.single * self.reflectance(conductor, lobes.cosine, band)
            }
        }
    }

    /// Share of an emitter that belongs to a path which happens to hit it: p / (p + q) with p the density of
    /// the scattering and q that of connections (balance heuristic, Veach 1997, equation 9.8).
    fn share_of_scattering(&self, object: usize) -> f64 {
        let Some((position, pdf)) = self.walk.scattered else {
            return 1.0;
        };
        if self.lights.binary_search(&object).is_err() {
            return 1.0;
        }
        let shape = &self.scene.objects()[object].shape;
        let sent = light_pdf(shape, position, self.walk.ray.direction) / self.lights.len() as f64;
        pdf / (pdf + sent)
    }

    /// Chooses a light, a direction towards it, and follows it there. None where nothing arrives.
    fn send_to_light(&self, object: usize, point: &SurfacePoint) -> Option<Sent<'a>> {
        let max_segments = self.scene.settings().max_path_segments;
        if self.lights.is_empty() || self.walk.segment >= max_segments {
            return None;
        }
        let [pick, u, v, _] = self.random(Use::Light);
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
        let films =
            self.films_on_the_way(ray, object, light, max_segments - self.walk.segment - 1)?;
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
                self.walk.throughput[band] * factor(self, band) * arriving;
        }
    }
}

/// What a film does in each band (reflectance and transmittance), about what part goes the way taken, and the chance of that way.
type Ways<'a> = (&'a [(f64, f64)], f64, f64);

impl Walk {
    /// Mirrored by a film.
    fn go_mirrored(&mut self, object: usize, point: &SurfacePoint, (film, part, chance): Ways<'_>) {
        self.estimate *= part / chance;
        for (throughput, (reflectance, _)) in self.throughput.iter_mut().zip(film) {
            *throughput *= reflectance / chance;
        }
        self.ray = Ray {
            origin: point.position,
            direction: mirrored(self.ray.direction, point.normal),
        };
        self.from_object = Some(object);
        self.scattered = None;
    }

    /// Straight on through a film: what was said of the last scattering still holds.
    fn go_through(&mut self, object: usize, point: &SurfacePoint, (film, part, chance): Ways<'_>) {
        self.estimate *= part / chance;
        for (throughput, (_, transmittance)) in self.throughput.iter_mut().zip(film) {
            *throughput *= transmittance / chance;
        }
        self.ray.origin = point.position;
        self.from_object = Some(object);
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
