//! Next-event estimation, combined with paths that hit an emitter by BSDF sampling (multiple importance sampling).

use super::{PathTracer, Use};
use crate::bsdf::Bsdf;
use crate::emitter_choice::ShadingPoint;
use crate::prepared::SceneEmitter;
use crate::transport::{Emitted, Scattering, Transport};
use crate::{
    Emitter, Hit, Ray, SurfacePoint, environment_pixel, mis_weight_emitter, nearest_hit,
    surface_point,
};
use glam::{DMat3, DVec3};
use scene::{DirectLight, EmitterKind, EnvironmentShape};

/// A direction toward an emitter that illuminates a surface, if nothing is in the way.
pub(super) struct EmitterSample<'a> {
    emitter: SceneEmitter<'a>,
    emitted: Emitted<'a>,
    direction: DVec3,
    /// Probability with which the emitter was chosen.
    pmf: f64,
    /// Density of the direction, sr⁻¹; `None` for light from a single direction.
    density: Option<f64>,
    /// Factor of the emission, without the BSDF.
    weight: f64,
}

impl<'a, T: Transport> PathTracer<'a, T> {
    /// Connects the path to the emitter of a sample, if it is visible from the surface.
    pub(super) fn connect(
        &mut self,
        (object, point): (usize, &SurfacePoint),
        sample: &EmitterSample<'a>,
        bsdf: &Bsdf<'_>,
        (local_from_world, wo): (DMat3, DVec3),
    ) {
        let settings = self.settings();
        let eval = bsdf.eval(wo, local_from_world * sample.direction);
        if eval.lobes.sum() > 0.0 && self.is_visible(object, point, sample) {
            let mis = match (settings.direct_light, sample.density) {
                (DirectLight::Both, Some(density)) => {
                    mis_weight_emitter(sample.emitter.emitter, eval.pdf, sample.pmf, density)
                }
                _ => 1.0,
            };
            let weight = self.path.weight * sample.weight * mis;
            let scattering = Scattering {
                bsdf,
                lobes: eval.lobes,
                wo: -self.path.ray.direction,
                wi: sample.direction,
                normal: point.normal,
            };
            self.transport
                .connect(&scattering, &sample.emitted, weight, &self.films);
        }
    }

    /// Chooses an emitter and a direction toward it, if one contributes at the surface. Returns the sum of the emitters' weights too.
    pub(super) fn sample_emitter(
        &mut self,
        point: &SurfacePoint,
    ) -> (Option<EmitterSample<'a>>, f64) {
        let settings = self.settings();
        let samples = settings.direct_light != DirectLight::Bsdf;
        if !samples || self.path.segment >= settings.max_path_segments {
            return (None, 0.0);
        }
        let place = ShadingPoint {
            position: point.position,
            normal: point.normal,
        };
        let sum = self.prepared.weigh_emitters(place, &mut self.weighted);
        (self.choose_sample(place, sum), sum)
    }

    fn choose_sample(&mut self, place: ShadingPoint, weight_sum: f64) -> Option<EmitterSample<'a>> {
        let random = self.random_at(Use::Emitter);
        let weighted = (&self.weighted[..], weight_sum);
        let choice = self
            .prepared
            .choose_weighted(place, weighted, random.get(0))?;
        let chosen = self.prepared.emitters[choice.emitter];
        let emitter = chosen.emitter;
        let direction = emitter.sample(place.position, random.get(1), random.get(2));
        let density = emitter.pdf(place.position, direction);
        let strength = emitter.strength(place.position, direction);
        if direction.dot(place.normal) <= 0.0
            || density.is_some_and(|density| density <= 0.0)
            || strength <= 0.0
        {
            return None;
        }
        let pixel = match emitter {
            Emitter::Environment(EnvironmentShape::Picture(picture)) => Some((
                picture,
                environment_pixel(picture, direction, random.get(3)),
            )),
            _ => None,
        };
        let emission = chosen.source.emission;
        Some(EmitterSample {
            emitter: chosen,
            emitted: Emitted {
                emission,
                pixel,
                toward: direction,
            },
            direction,
            pmf: choice.pmf,
            density,
            weight: strength / (choice.pmf * density.unwrap_or(1.0)),
        })
    }

    /// Whether there are only films in front of an emitter, and no more than the path may still have segments; notes the films.
    fn is_visible(&mut self, object: usize, point: &SurfacePoint, sample: &EmitterSample) -> bool {
        let prepared = self.prepared;
        let allowed = self.settings().max_path_segments - self.path.segment - 1;
        let mut ray = Ray {
            origin: point.position,
            direction: sample.direction,
        };
        let mut from = object;
        self.films.clear();
        loop {
            let hit = nearest_hit(prepared.scene, &ray, Some(from));
            if has_arrived(&ray, &sample.emitter, hit) {
                return true;
            }
            let Some(hit) = hit else {
                return false;
            };
            let met = &prepared.scene.objects()[hit.object];
            let Some(film) = prepared.surface(met.material).film() else {
                return false;
            };
            if self.films.len() == allowed as usize {
                return false;
            }
            let point = surface_point(&met.shape, &ray, hit.distance);
            self.films.push(film.at(&met.shape, &point, ray.direction));
            ray.origin = point.position;
            from = hit.object;
        }
    }

    /// Returns the MIS weight of a path that hits an emitter by BSDF sampling; next-event estimation has the rest.
    pub(super) fn mis_weight_of_hit(&self, kind: EmitterKind) -> f64 {
        let number = self.prepared.emitter_number(kind);
        let (Some(scattered), Some(number)) = (&self.path.scattered, number) else {
            return 1.0;
        };
        match self.settings().direct_light {
            DirectLight::Emitters => 0.0,
            DirectLight::Bsdf => 1.0,
            DirectLight::Both => {
                let place = ShadingPoint {
                    position: scattered.position,
                    normal: scattered.normal,
                };
                let emitter = self.prepared.emitters[number].emitter;
                let sum = scattered.emitter_weight_sum;
                let pmf = self.prepared.emitter_pmf(number, place, sum);
                let density = emitter.pdf(scattered.position, self.path.ray.direction);
                1.0 - mis_weight_emitter(emitter, scattered.pdf, pmf, density.unwrap_or(0.0))
            }
        }
    }
}

/// Whether a ray to an emitter meets nothing in front of it.
fn has_arrived(ray: &Ray, emitter: &SceneEmitter<'_>, hit: Option<Hit>) -> bool {
    if let EmitterKind::Object(index) = emitter.source.kind {
        return hit.is_some_and(|hit| hit.object == index);
    }
    match (emitter.emitter.distance(ray.origin), hit) {
        (_, None) => true,
        // A lamp may lie on a surface: a hit just in front of it, within rounding, does not hide it.
        (Some(distance), Some(hit)) => hit.distance >= 0.99999 * distance,
        (None, Some(_)) => false,
    }
}
