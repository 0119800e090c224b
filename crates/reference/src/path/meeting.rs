//! What a surface does with a path that meets it.

use super::walk::{Scattered, mirrored};
use super::{Path, Use};
use crate::interference::LayersAt;
use crate::scatter::{Conductor, Scatterer, coat_share};
use crate::spectra::Film;
use crate::{Hit, Ray, SurfacePoint, reflected_share, surface_frame, surface_point};
use glam::DVec3;
use scene::{Material, SourceKind};

impl Path<'_> {
    /// Meets a surface; says whether the path goes on.
    pub(super) fn meet(&mut self, hit: Hit) -> bool {
        let scene = self.scene;
        let object = &scene.objects()[hit.object];
        let point = surface_point(&object.shape, &self.walk.ray, hit.distance);
        match scene.material(object.material) {
            Material::Emitter { emission, .. } => {
                let share = self.share_of_scattering(SourceKind::Object(hit.object));
                self.add(*emission, share);
            }
            Material::Cook(cook) => {
                if let Some(ambient) = cook.ambient {
                    self.add(ambient, 1.0);
                }
            }
            Material::Film {
                layers,
                interference,
                ..
            } => {
                let film = Film {
                    layers: LayersAt::new(layers, &object.shape, &point),
                    interference: *interference,
                };
                return self.meet_film(hit.object, point, &film);
            }
            Material::Conductor {
                n,
                k,
                layers,
                microsurface: None,
            } => {
                let conductor = Conductor {
                    index: (*n, *k),
                    coating: LayersAt::new(layers, &object.shape, &point),
                };
                return self.meet_mirror(hit.object, point, &conductor, 1.0);
            }
            Material::Diffuse { .. } | Material::CoatedBody(_) | Material::Conductor { .. } => {}
        }
        let random = self.random(Use::Scattering);
        let scatterer = Scatterer::new(scene, hit.object, &point, random[3]);
        scatterer
            .is_some_and(|scatterer| self.meet_scattering(hit.object, point, &scatterer, random))
    }

    /// A mirror that was chosen with probability `chance`.
    fn meet_mirror(
        &mut self,
        object: usize,
        point: SurfacePoint,
        conductor: &Conductor<'_>,
        chance: f64,
    ) -> bool {
        self.attenuate(|spectra, band| spectra.reflectance(conductor, point.cosine, band) / chance);
        let direction = mirrored(self.walk.ray.direction, point.normal);
        self.leave(object, point.position, direction, None);
        self.walk.estimate *= self.albedo(object);
        true
    }

    /// A film: the path is mirrored or goes straight on, or does both.
    fn meet_film(&mut self, object: usize, point: SurfacePoint, film: &Film<'_>) -> bool {
        let values: Vec<_> = self
            .bands()
            .map(|band| self.spectra.film(film, band))
            .collect();
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

    /// A diffuse or rough surface: light is sent to it, and the path is scattered by `random` numbers.
    fn meet_scattering(
        &mut self,
        object: usize,
        point: SurfacePoint,
        scatterer: &Scatterer<'_>,
        random: [f64; 4],
    ) -> bool {
        let met = &self.scene.objects()[object];
        let world_from_local = surface_frame(self.scene.material(met.material), &met.shape, &point);
        let local_from_world = world_from_local.transpose();
        let eye = local_from_world * -self.walk.ray.direction;
        let chances = self.chances(&point);
        if let Some(sent) = self.send_to_light(object, &point, &chances) {
            let towards = scatterer.between(eye, local_from_world * sent.direction);
            let share = sent.factor * self.share_of_sending(&sent, towards.pdf);
            self.add_connection(&sent, |spectra, band| {
                share * spectra.scattered_value(scatterer, eye, &towards.lobes, band)
            });
        }
        if let Scatterer::CoatedBody(coat, body, _) = scatterer {
            let share = coat_share(body, eye.z);
            if random[2] < share {
                return self.meet_mirror(object, point, coat, share);
            }
        }
        let light = scatterer.sample(eye, random);
        let onward = scatterer.between(eye, light);
        if onward.pdf <= 0.0 || !onward.lobes.is_lit() {
            return false;
        }
        self.attenuate(|spectra, band| {
            spectra.scattered_value(scatterer, eye, &onward.lobes, band) / onward.pdf
        });
        self.walk.splits = 0;
        let lobes = &onward.lobes;
        let weight = (lobes.single + lobes.multiple + lobes.body) / onward.pdf;
        self.walk.estimate *= weight * self.albedo(object);
        let scattered = Scattered {
            position: point.position,
            pdf: onward.pdf,
            chances,
        };
        let direction = (world_from_local * light).normalize();
        self.leave(object, point.position, direction, Some(scattered));
        true
    }

    /// Sends the path on from an object.
    fn leave(
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

    /// About what part of the light goes on from an object.
    fn albedo(&self, object: usize) -> f64 {
        let material = self.scene.objects()[object].material;
        self.scene.estimate(material).albedo
    }
}
