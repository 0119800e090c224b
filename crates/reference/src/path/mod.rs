//! A path through the scene with its spectrum.

mod connection;
mod meeting;
mod walk;

use crate::environment_picture::pixel_value;
use crate::spectra::Spectra;
use crate::{
    chance_to_go_on, environment_pixel, environment_share, nearest_hit, random4,
    sampled_camera_ray, sobol4,
};
use scene::{
    Emission, EnvironmentPicture, EnvironmentShape, LightSource, RenderSettings, Sampler, Scene,
    SourceKind, WavelengthSampling,
};
use walk::Walk;

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

/// Follows one sample of a pixel. `lights` is what light can be sent from ([`Scene::light_sources`]).
pub fn radiance(scene: &Scene, lights: &[LightSource], pixel: [u32; 2], sample: u32) -> PathSample {
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
        spectra: Spectra {
            scene,
            offset: match settings.sampling {
                WavelengthSampling::Random => drawn,
                WavelengthSampling::Centre => 0.5,
            },
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
        offset: path.spectra.offset,
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
    lights: &'a [LightSource],
    pixel: [u32; 2],
    sample: u32,
    spectra: Spectra<'a>,
    walk: Walk,
    /// Walks that begin where films split the path, to be followed when the present one has ended.
    waiting: Vec<Walk>,
    /// Of each light group.
    radiance: Vec<Vec<f64>>,
}

impl Path<'_> {
    fn random(&self, use_of: Use) -> [f64; 4] {
        let walk = &self.walk;
        let dimension = BRANCH_DIMENSIONS * walk.branch + 3 * walk.segment - 2 + use_of as u32;
        numbers_of(self.scene.settings(), self.pixel, self.sample, dimension)
    }

    fn bands(&self) -> std::ops::Range<usize> {
        0..self.walk.throughput.len()
    }

    fn attenuate(&mut self, factor: impl Fn(&Spectra<'_>, usize) -> f64) {
        for band in self.bands() {
            self.walk.throughput[band] *= factor(&self.spectra, band);
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

    /// Light that joins the path here.
    fn add(&mut self, emission: Emission, weight: f64) {
        for band in self.bands() {
            let light = emission.scale * self.spectra.spectrum(emission.spectrum, band);
            let light_group = emission.light_group.index();
            self.radiance[light_group][band] += self.walk.throughput[band] * weight * light;
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
            let nm = self.spectra.light(band).wavelength_nm;
            let lamp = emission.scale * self.spectra.spectrum(emission.spectrum, band);
            let light = lamp * pixel_value(picture, pixel, band, nm);
            let light_group = emission.light_group.index();
            self.radiance[light_group][band] += self.walk.throughput[band] * weight * light;
        }
    }

    fn add_environment(&mut self) {
        for (index, part) in self.scene.surroundings().into_iter().enumerate() {
            let direction = self.walk.ray.direction;
            let share = environment_share(part.shape, direction);
            let met = self.share_of_scattering(SourceKind::Environment(index));
            if let EnvironmentShape::Picture(picture) = part.shape {
                let pixel = environment_pixel(picture, direction, self.random(Use::Light)[3]);
                self.add_picture(part.emission, (picture, pixel), met);
            } else {
                self.add(part.emission, share * met);
            }
        }
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
}
