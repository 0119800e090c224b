//! Paths from the camera to emitters.
//!
//! A path is traced without its spectrum: each event is passed to a [`Transport`].

mod emitter_sampling;
mod path_state;

use crate::bsdf::{Bsdf, Lobes};
use crate::emitter_choice::Weighted;
use crate::layers::FilmAt;
use crate::sobol::{SobolNumbers, SobolPixel};
use crate::transport::{Emitted, Scattering, Side, Transport};
use crate::{
    Hit, PreparedScene, SurfacePoint, environment_pixel, environment_strength, nearest_hit,
    random4, reflection_probability, rr_survival_probability, sampled_camera_ray, surface_frame,
    surface_point,
};
use path_state::{PathState, Scattered};
use scene::{EmitterKind, EnvironmentShape, Estimate, RenderSettings, Sampler, WavelengthSampling};

/// Dimensions of a branch of a path: more than three for each of its segments.
const BRANCH_DIMENSIONS: u32 = 128;
/// The dimension of the camera's lens: beyond those of all branches.
const LENS_DIMENSION: u32 = 0xffff;

/// The purposes of the random numbers at a vertex.
#[derive(Clone, Copy)]
enum Use {
    Emitter,
    Bsdf,
    Roulette,
}

/// Four numbers in [0, 1), computed on demand.
#[derive(Clone, Copy)]
enum Numbers {
    Sobol(SobolNumbers),
    Independent([f64; 4]),
}

impl Numbers {
    #[inline]
    fn get(&self, lane: usize) -> f64 {
        match self {
            Self::Sobol(numbers) => numbers.get(lane),
            Self::Independent(numbers) => numbers[lane],
        }
    }
}

/// Traces paths, one after the other.
pub(crate) struct PathTracer<'a, T> {
    prepared: &'a PreparedScene<'a>,
    pub(crate) transport: T,
    pixel: [u32; 2],
    sample: u32,
    sobol: SobolPixel,
    path: PathState,
    /// Paths that start where films split the current one, to be followed when the current one has ended.
    waiting: Vec<PathState>,
    /// Emitters and groups of them, for the choice of one.
    weighted: Vec<Weighted>,
    /// The films between a surface and an emitter.
    films: Vec<FilmAt<'a>>,
}

impl<'a, T: Transport> PathTracer<'a, T> {
    pub(crate) fn new(prepared: &'a PreparedScene<'a>, transport: T) -> Self {
        Self {
            prepared,
            transport,
            pixel: [0; 2],
            sample: 0,
            sobol: SobolPixel::new(prepared.scene.settings().seed),
            path: PathState::default(),
            waiting: Vec::new(),
            weighted: Vec::new(),
            films: Vec::new(),
        }
    }

    /// Traces one sample of a pixel.
    pub(crate) fn trace_path(&mut self, pixel: [u32; 2], sample: u32) {
        let scene = self.prepared.scene;
        let settings = scene.settings();
        (self.pixel, self.sample) = (pixel, sample);
        self.sobol.begin(pixel);
        let numbers = self.numbers_of(0);
        let on_lens = match scene.camera().lens {
            Some(_) => {
                let numbers = self.numbers_of(LENS_DIMENSION);
                [numbers.get(0), numbers.get(1)]
            }
            None => [0.0; 2],
        };
        let ray = sampled_camera_ray(scene, pixel, [numbers.get(0), numbers.get(1)], on_lens);
        let offset = match settings.sampling {
            WavelengthSampling::Random => numbers.get(2),
            WavelengthSampling::Center => 0.5,
        };
        self.transport.begin(offset, &ray);
        self.path = PathState::new(ray, settings.film_splits);
        self.follow_path();
        while let Some(path) = self.waiting.pop() {
            self.path = path;
            self.transport.resume();
            self.follow_path();
        }
    }

    /// Follows the current path to its end.
    fn follow_path(&mut self) {
        let most = self.settings().max_path_segments;
        while self.path.segment <= most && self.extend_path() {
            self.path.segment += 1;
        }
    }

    fn settings(&self) -> &'a RenderSettings {
        self.prepared.scene.settings()
    }

    /// Returns four numbers in [0, 1) for a dimension of the sample.
    #[inline]
    fn numbers_of(&mut self, dimension: u32) -> Numbers {
        let settings = self.settings();
        match settings.sampler {
            Sampler::Sobol => Numbers::Sobol(self.sobol.numbers(self.sample, dimension)),
            Sampler::Independent => {
                Numbers::Independent(random4(self.pixel, self.sample, dimension, settings.seed))
            }
        }
    }

    #[inline]
    fn random_at(&mut self, use_of: Use) -> Numbers {
        let path = &self.path;
        self.numbers_of(BRANCH_DIMENSIONS * path.branch + 3 * path.segment - 2 + use_of as u32)
    }

    /// Extends the path by one segment, and shades what it meets. Returns whether the path continues.
    fn extend_path(&mut self) -> bool {
        let settings = self.settings();
        let path = &self.path;
        let Some(hit) = nearest_hit(self.prepared.scene, &path.ray, path.from_object) else {
            self.shade_environment();
            return false;
        };
        if !self.shade_object(hit) {
            return false;
        }
        let is_last = self.path.segment == settings.max_path_segments;
        let has_roulette = self.path.segment >= settings.roulette_after && !is_last;
        !has_roulette || self.russian_roulette()
    }

    /// Plays Russian roulette: ends the path at random, or increases its weight. Returns whether the path continues.
    fn russian_roulette(&mut self) -> bool {
        let probability = rr_survival_probability(self.path.rr_throughput);
        if probability < 1.0 {
            if self.random_at(Use::Roulette).get(0) >= probability {
                return false;
            }
            self.path.rr_throughput /= probability;
            self.path.weight /= probability;
        }
        true
    }

    /// Adds the radiance of the environment, part by part, where the path leaves the scene.
    fn shade_environment(&mut self) {
        for (index, part) in self.prepared.environment.iter().enumerate() {
            let direction = self.path.ray.direction;
            let strength = environment_strength(part.shape, direction);
            let mis = self.mis_weight_of_hit(EmitterKind::Environment(index));
            let pixel = match part.shape {
                EnvironmentShape::Picture(picture) => {
                    let random = self.random_at(Use::Emitter).get(3);
                    Some((picture, environment_pixel(picture, direction, random)))
                }
                _ => None,
            };
            let light = Emitted {
                emission: part.emission,
                pixel,
                toward: direction,
            };
            self.emit(&light, strength * mis);
        }
    }

    fn emit(&mut self, light: &Emitted<'_>, weight: f64) {
        if weight > 0.0 {
            self.transport.emit(light, self.path.weight * weight);
        }
    }

    /// Handles the hit of an object. Returns whether the path continues.
    fn shade_object(&mut self, hit: Hit) -> bool {
        let prepared = self.prepared;
        let object = &prepared.scene.objects()[hit.object];
        let surface = prepared.surface(object.material);
        let point = surface_point(&object.shape, &self.path.ray, hit.distance);
        if let Some(emission) = surface.emission {
            let mis = self.mis_weight_of_hit(EmitterKind::Object(hit.object));
            let light = Emitted {
                emission,
                pixel: None,
                toward: self.path.ray.direction,
            };
            self.emit(&light, mis);
        }
        if let Some(film) = surface.film() {
            let film = film.at(&object.shape, &point, self.path.ray.direction);
            self.shade_film(hit.object, &point, &film, surface.estimate);
            return true;
        }
        let random = || self.random_at(Use::Bsdf).get(3);
        let bsdf = surface.bsdf(&object.shape, &point, random);
        bsdf.is_some_and(|bsdf| self.shade_surface(hit.object, &point, &bsdf, surface.estimate))
    }

    /// Handles a film: the path is reflected or transmitted, or both.
    fn shade_film(
        &mut self,
        object: usize,
        point: &SurfacePoint,
        film: &FilmAt<'_>,
        estimate: &Estimate,
    ) {
        let reflected = estimate.reflected_at(point.cosine);
        self.path.rr_throughput *= estimate.albedo;
        if self.path.splits > 0 && self.path.segment < self.settings().max_path_segments {
            self.path.splits -= 1;
            let mut through = self.path;
            through.branch += 1 << through.splits;
            through.segment += 1;
            through.rr_throughput *= 1.0 - reflected;
            through.pass_through(object, point);
            self.waiting.push(through);
            self.transport.split(film);
            self.path.rr_throughput *= reflected;
            self.path.mirror(object, point);
            return;
        }
        let reflects_with = reflection_probability(reflected);
        let (side, part, probability) = if self.random_at(Use::Bsdf).get(0) < reflects_with {
            self.path.mirror(object, point);
            (Side::Reflected, reflected, reflects_with)
        } else {
            self.path.pass_through(object, point);
            (Side::Transmitted, 1.0 - reflected, 1.0 - reflects_with)
        };
        self.transport.film(film, side);
        self.path.weight /= probability;
        self.path.rr_throughput *= part / probability;
    }

    /// Handles a specular or scattering surface: an emitter is sampled, and the path continues in a direction sampled from the BSDF.
    fn shade_surface(
        &mut self,
        object: usize,
        point: &SurfacePoint,
        bsdf: &Bsdf<'_>,
        estimate: &Estimate,
    ) -> bool {
        let scene = self.prepared.scene;
        let met = &scene.objects()[object];
        let world_from_local = surface_frame(scene.material(met.material), &met.shape, point);
        let local_from_world = world_from_local.transpose();
        let wo = local_from_world * -self.path.ray.direction;
        let specular = bsdf.specular_probability(wo);
        let mut emitter_weight_sum = 0.0;
        if specular < 1.0 {
            let (sample, sum) = self.sample_emitter(point);
            emitter_weight_sum = sum;
            if let Some(sample) = sample {
                self.connect((object, point), &sample, bsdf, (local_from_world, wo));
            }
        }
        let random = self.random_at(Use::Bsdf);
        if specular > 0.0 && (specular >= 1.0 || random.get(2) < specular) {
            let wo = -self.path.ray.direction;
            self.path.mirror(object, point);
            self.transport.scatter(&Scattering {
                bsdf,
                lobes: Lobes::specular(point.cosine),
                wo,
                wi: self.path.ray.direction,
                normal: point.normal,
            });
            self.path.weight /= specular;
            self.path.rr_throughput *= estimate.albedo;
            return true;
        }
        let wi = bsdf.sample(wo, |lane| random.get(lane));
        let onward = bsdf.eval(wo, wi);
        let weight = onward.lobes.sum() / onward.pdf;
        if onward.pdf <= 0.0 || weight <= 0.0 {
            return false;
        }
        let direction = (world_from_local * wi).normalize();
        self.transport.scatter(&Scattering {
            bsdf,
            lobes: onward.lobes,
            wo: -self.path.ray.direction,
            wi: direction,
            normal: point.normal,
        });
        self.path.weight /= onward.pdf;
        self.path.rr_throughput *= weight * estimate.albedo;
        let scattered = Scattered {
            position: point.position,
            normal: point.normal,
            pdf: onward.pdf,
            emitter_weight_sum,
        };
        self.path.scatter(object, direction, scattered);
        true
    }
}
