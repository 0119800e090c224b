//! Connections of a path to the lights, and how they are weighed against paths that meet a light by chance.

use super::{Path, Use};
use crate::environment_picture::pixel_value;
use crate::interference::LayersAt;
use crate::spectra::{Film, Spectra};
use crate::{
    Hit, Ray, Source, SurfacePoint, choice_probabilities, choose_light, environment_pixel,
    nearest_hit, sending_share, surface_point,
};
use glam::DVec3;
use scene::{DirectLight, Emission, EnvironmentPicture, EnvironmentShape, Material, SourceKind};

/// A connection to a light.
pub(super) struct Sent<'a> {
    emission: Emission,
    /// The pixel of the surroundings that it comes from.
    pixel: Option<(&'a EnvironmentPicture, [u32; 2])>,
    pub(super) direction: DVec3,
    source: Source<'a>,
    /// Probability of the choice among the lights.
    probability: f64,
    /// Density of the direction; none for light from a single direction.
    density: Option<f64>,
    /// What the light's emission is multiplied by, besides what the surface does.
    pub(super) factor: f64,
    /// The films that it passes straight through.
    films: Vec<Film<'a>>,
}

impl<'a> Path<'a> {
    /// Probabilities of the lights at a point.
    pub(super) fn chances(&self, point: &SurfacePoint) -> Vec<f64> {
        choice_probabilities(self.scene, self.lights, point.position, point.normal)
    }

    /// Chooses a light, a direction towards it, and follows it there. None where nothing arrives.
    pub(super) fn send_to_light(
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
        let density = source.pdf(point.position, direction);
        let strength = source.share(point.position, direction);
        if direction.dot(point.normal) <= 0.0
            || density.is_some_and(|density| density <= 0.0)
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
            source,
            probability: choice.probability,
            density,
            factor: strength / (choice.probability * density.unwrap_or(1.0)),
            films,
        })
    }

    /// The films that a ray crosses before it reaches a light; none where something opaque is in the way or
    /// more films than `allowed`.
    pub(super) fn films_on_the_way(
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
    pub(super) fn has_arrived(&self, ray: &Ray, light: SourceKind, hit: Option<Hit>) -> bool {
        if let SourceKind::Object(index) = light {
            return hit.is_some_and(|hit| hit.object == index);
        }
        match (Source::of(self.scene, light).distance(ray.origin), hit) {
            (_, None) => true,
            // A lamp may lie on a surface: what is hit just before it, within rounding, does not hide it.
            (Some(distance), Some(hit)) => hit.distance >= 0.99999 * distance,
            (None, Some(_)) => false,
        }
    }

    pub(super) fn add_connection(
        &mut self,
        sent: &Sent<'_>,
        factor: impl Fn(&Spectra<'_>, usize) -> f64,
    ) {
        let emission = sent.emission;
        for band in self.bands() {
            let mut arriving = emission.scale * self.spectra.spectrum(emission.spectrum, band);
            if let Some((picture, pixel)) = sent.pixel {
                arriving *=
                    pixel_value(picture, pixel, band, self.spectra.light(band).wavelength_nm);
            }
            for film in &sent.films {
                arriving *= self.spectra.film(film, band).1;
            }
            let light_group = emission.light_group.index();
            self.radiance[light_group][band] +=
                self.walk.throughput[band] * factor(&self.spectra, band) * arriving;
        }
    }

    /// Share of a light that belongs to a path which happens to meet it: the rest is what connections to that light bring.
    pub(super) fn share_of_scattering(&self, kind: SourceKind) -> f64 {
        let number = self.lights.iter().position(|light| light.kind == kind);
        let (Some(scattered), Some(number)) = (&self.walk.scattered, number) else {
            return 1.0;
        };
        let source = Source::of(self.scene, kind);
        let density = source.pdf(scattered.position, self.walk.ray.direction);
        let (chance, density) = (scattered.chances[number], density.unwrap_or(0.0));
        match self.scene.settings().direct_light {
            DirectLight::Both => 1.0 - sending_share(source, scattered.pdf, chance, density),
            DirectLight::Lights => 0.0,
            DirectLight::Surfaces => 1.0,
        }
    }

    /// Share of a connection: the rest is what scattering brings that happens to meet the light.
    pub(super) fn share_of_sending(&self, sent: &Sent<'_>, scattered: f64) -> f64 {
        match (self.scene.settings().direct_light, sent.density) {
            (DirectLight::Both, Some(density)) => {
                sending_share(sent.source, scattered, sent.probability, density)
            }
            _ => 1.0,
        }
    }
}
