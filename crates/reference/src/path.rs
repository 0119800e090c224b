//! A path through the scene with its spectrum.

use crate::environment_picture::pixel_value;
use crate::interference::{LayersAt, Light};
use crate::picture::smooth_value;
use crate::scatter::{Conductor, Lobes, Scatterer, coat_share};
use crate::{
    Facets, Hit, Ray, Reflectance, Source, SurfacePoint, chance_to_go_on, choice_probabilities,
    choose_light, environment_pixel, environment_share, nearest_hit, pattern_reflectance, random4,
    reflected_share, sampled_camera_ray, scattering_share, sobol4, surface_frame, surface_point,
};
use glam::DVec3;
use optics::Complex64;
use scene::{
    CoatedBody, DirectLight, Emission, EnvironmentPicture, EnvironmentShape, Interference,
    LightSource, Material, Pattern, RenderSettings, Sampler, Scene, SourceKind, SpectrumId,
    WavelengthSampling,
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
    lights: &'a [LightSource],
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
    /// How a surface last scattered the path; none after the camera or a mirror.
    scattered: Option<Scattered>,
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
            self.radiance[light_group][band] += self.walk.throughput[band] * weight * light;
        }
    }

    fn attenuate(&mut self, factor: impl Fn(&Self, usize) -> f64) {
        for band in self.bands() {
            self.walk.throughput[band] *= factor(self, band);
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
                self.add(
                    emission,
                    self.share_of_scattering(SourceKind::Object(hit.object)),
                );
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
                if let Some(microsurface) = microsurface {
                    let rough = Scatterer::RoughConductor(conductor, Facets::new(microsurface));
                    self.meet_scattering(hit.object, point, &rough)
                } else {
                    self.meet_mirror(hit.object, point, &conductor)
                }
            }
            Material::CoatedBody(ref body) => {
                let conductor = Conductor {
                    index: (body.n, body.k),
                    coating: LayersAt::new(&[], &object.shape, &point),
                };
                let random = self.random(Use::Scattering)[3];
                let base = pattern_reflectance(&body.base, &object.shape, point.position, random);
                let surface = match &body.microsurface {
                    None => Scatterer::CoatedBody(conductor, body, base),
                    Some(microsurface) => {
                        let facets = Facets::new(microsurface);
                        Scatterer::RoughCoatedBody(conductor, body, base, facets)
                    }
                };
                self.meet_scattering(hit.object, point, &surface)
            }
            Material::Cook(ref cook) => {
                if let Some(ambient) = cook.ambient {
                    self.add(ambient, 1.0);
                }
                let conductor = Conductor {
                    index: (cook.n, cook.k),
                    coating: LayersAt::new(&[], &object.shape, &point),
                };
                self.meet_scattering(hit.object, point, &Scatterer::Cook(conductor, cook))
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

    fn scatter(
        &mut self,
        object: usize,
        position: DVec3,
        direction: DVec3,
        scattered: Option<Scattered>,
    ) {
        self.walk.ray = Ray {
            origin: position,
            direction,
        };
        self.walk.from_object = Some(object);
        self.walk.scattered = scattered;
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
        let [.., random] = self.random(Use::Scattering);
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
        let met = &self.scene.objects()[object];
        let world_from_local = surface_frame(self.scene.material(met.material), &met.shape, &point);
        let local_from_world = world_from_local.transpose();
        let eye = local_from_world * -self.walk.ray.direction;
        let chances = self.chances(&point);
        if let Some(sent) = self.send_to_light(object, &point, &chances) {
            let towards = scatterer.between(eye, local_from_world * sent.direction);
            let share = sent.factor * self.share_of_sending(&sent, towards.pdf);
            self.add_connection(&sent, |path, band| {
                share * path.scattered_value(scatterer, eye, &towards.lobes, band)
            });
        }
        let random = self.random(Use::Scattering);
        if let Scatterer::CoatedBody(coat, body, _) = scatterer {
            let share = coat_share(body, eye.z);
            if random[2] < share {
                self.attenuate(|path, band| path.reflectance(coat, eye.z, band) / share);
                let direction = mirrored(self.walk.ray.direction, point.normal);
                self.scatter(object, point.position, direction, None);
                self.walk.estimate *= self.albedo(object);
                return true;
            }
        }
        let light = scatterer.sample(eye, random);
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
        let scattered = Scattered {
            position: point.position,
            pdf: onward.pdf,
            chances,
        };
        self.scatter(object, point.position, direction, Some(scattered));
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

    /// P of a body below a coat.
    fn below_coat(&self, body: &CoatedBody, base: Reflectance, band: usize) -> f64 {
        let base = self.diffuse(base, band);
        let outer = self.spectrum(body.mean_reflectance, band);
        base * optics::coated_albedo_factor(base, self.spectrum(body.n, band), outer)
    }

    /// The reflectance of a rough coat, from its table.
    fn rough_coat(&self, body: &CoatedBody, cosine: f64, band: usize) -> f64 {
        let place = cosine.clamp(0.0, 1.0).sqrt() * (CoatedBody::COSINES - 1) as f64;
        let knot = (place as usize).min(CoatedBody::COSINES - 2);
        let at = |knot| {
            let spectrum = body.reflectances.map(|first| first.after(knot));
            spectrum.map_or(0.0, |spectrum| self.spectrum(spectrum, band))
        };
        at(knot) + (at(knot + 1) - at(knot)) * (place - knot as f64)
    }

    /// What lobes make of the spectra of a surface in a band.
    fn scattered_value(
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

    /// Share of a light that belongs to a path which happens to meet it: the rest is what connections to that light bring.
    fn share_of_scattering(&self, kind: SourceKind) -> f64 {
        let number = self.lights.iter().position(|light| light.kind == kind);
        let (Some(scattered), Some(number)) = (&self.walk.scattered, number) else {
            return 1.0;
        };
        let source = Source::of(self.scene, kind);
        let sent = source.pdf(scattered.position, self.walk.ray.direction);
        let sent = scattered.chances[number] * sent.unwrap_or(0.0);
        match self.scene.settings().direct_light {
            DirectLight::Both => scattering_share(scattered.pdf, sent),
            DirectLight::Lights => 0.0,
            DirectLight::Surfaces => 1.0,
        }
    }

    /// Share of a connection: the rest is what scattering brings that happens to meet the light.
    fn share_of_sending(&self, sent: &Sent<'_>, scattered: f64) -> f64 {
        match (self.scene.settings().direct_light, sent.pdf) {
            (DirectLight::Both, Some(pdf)) => 1.0 - scattering_share(scattered, pdf),
            _ => 1.0,
        }
    }

    /// Probabilities of the lights at a point.
    fn chances(&self, point: &SurfacePoint) -> Vec<f64> {
        choice_probabilities(self.scene, self.lights, point.position, point.normal)
    }

    /// Chooses a light, a direction towards it, and follows it there. None where nothing arrives.
    fn send_to_light(
        &self,
        object: usize,
        point: &SurfacePoint,
        chances: &[f64],
    ) -> Option<Sent<'a>> {
        let settings = self.scene.settings();
        let max_segments = settings.max_path_segments;
        let sends = settings.direct_light != DirectLight::Surfaces;
        if !sends || self.walk.segment >= max_segments {
            return None;
        }
        let [pick, u, v, w] = self.random(Use::Light);
        let choice = choose_light(chances, pick)?;
        let light = &self.lights[choice.source];
        let source = Source::of(self.scene, light.kind);
        let direction = source.sample(point.position, u, v);
        let pdf = source
            .pdf(point.position, direction)
            .map(|pdf| choice.probability * pdf);
        let strength = source.share(point.position, direction);
        if direction.dot(point.normal) <= 0.0
            || pdf.is_some_and(|pdf| pdf <= 0.0)
            || strength <= 0.0
        {
            return None;
        }
        let ray = Ray {
            origin: point.position,
            direction,
        };
        let films = self.films_on_the_way(
            ray,
            object,
            light.kind,
            max_segments - self.walk.segment - 1,
        )?;
        let pixel = match source {
            Source::Surrounding(EnvironmentShape::Picture(picture)) => {
                Some((picture, environment_pixel(picture, direction, w)))
            }
            _ => None,
        };
        Some(Sent {
            emission: light.emission,
            pixel,
            direction,
            pdf,
            factor: strength / pdf.unwrap_or(choice.probability),
            films,
        })
    }

    /// The films that a ray crosses before it reaches a light; none where something opaque is in the way or
    /// more films than `allowed`.
    fn films_on_the_way(
        &self,
        mut ray: Ray,
        object: usize,
        light: SourceKind,
        allowed: u32,
    ) -> Option<Vec<Film<'a>>> {
        let mut films = Vec::new();
        let mut from = object;
        loop {
            let hit = nearest_hit(self.scene, &ray, Some(from));
            if self.has_arrived(&ray, light, hit) {
                return Some(films);
            }
            let hit = hit?;
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

    /// Whether a ray to a light meets nothing before it.
    fn has_arrived(&self, ray: &Ray, light: SourceKind, hit: Option<Hit>) -> bool {
        if let SourceKind::Object(index) = light {
            return hit.is_some_and(|hit| hit.object == index);
        }
        match (Source::of(self.scene, light).distance(ray.origin), hit) {
            (_, None) => true,
            (Some(distance), Some(hit)) => hit.distance >= distance,
            (None, Some(_)) => false,
        }
    }

    fn add_connection(&mut self, sent: &Sent<'_>, factor: impl Fn(&Self, usize) -> f64) {
        let emission = sent.emission;
        for band in self.bands() {
            let mut arriving = emission.scale * self.spectrum(emission.spectrum, band);
            if let Some((picture, pixel)) = sent.pixel {
                arriving *= pixel_value(picture, pixel, band, self.light(band).wavelength_nm);
            }
            for film in &sent.films {
                arriving *= self.film(film, band).1;
            }
            let light_group = emission.light_group.index();
            self.radiance[light_group][band] +=
                self.walk.throughput[band] * factor(self, band) * arriving;
        }
    }
}

/// How a surface scattered a path.
#[derive(Clone)]
struct Scattered {
    position: DVec3,
    /// Density of the direction.
    pdf: f64,
    /// Probabilities of the lights there.
    chances: Vec<f64>,
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
    emission: Emission,
    /// The pixel of the surroundings that it comes from.
    pixel: Option<(&'a EnvironmentPicture, [u32; 2])>,
    direction: DVec3,
    /// Density of the direction, the choice among the lights included; none for light from a single direction.
    pdf: Option<f64>,
    /// What the light's emission is multiplied by, besides what the surface does.
    factor: f64,
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
