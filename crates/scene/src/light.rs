//! Lights that are not objects, and all emitters that are sampled, in a validated scene.

use crate::{DirectLight, Emission, EnvironmentPart, EnvironmentShape, Scene, Shape};
use glam::DVec3;

/// A light that is not an object. Rays do not hit it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Its position.
    pub shape: LightShape,
    /// Radiance of a disk; irradiance of a surface that faces light from a single direction; intensity of a point, or of a spot along its
    /// axis.
    pub emission: Emission,
}

/// The kind and position of a light that is not an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightShape {
    /// A disk in the sky, visible wherever nothing is in front of it.
    DistantDisk {
        /// Unit vector toward its center.
        toward: DVec3,
        /// 1 − cos of the angle between center and edge, > 0.
        height: f64,
    },
    /// Light from a single direction.
    Direction {
        /// Unit vector toward the light.
        toward: DVec3,
    },
    /// A point that emits equally in all directions.
    Point {
        /// Its position.
        position: DVec3,
    },
    /// A point that emits into a cone.
    Spot {
        /// Its position.
        position: DVec3,
        /// Unit vector in which it emits.
        axis: DVec3,
        /// 1 − cosine with the axis up to which the intensity is constant.
        full_height: f64,
        /// 1 − cosine with the axis beyond which the intensity is 0; more than `full_height`.
        edge_height: f64,
    },
}

/// An emitter that can be sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmitterSource {
    /// Its kind and index.
    pub kind: EmitterKind,
    /// What it emits.
    pub emission: Emission,
    /// Its visual brightness, up to a factor that all emitters share; never 0. It steers the choice among emitters.
    pub brightness: f64,
}

/// The kind of an emitter, and its index in the list of this kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EmitterKind {
    /// One of [`Scene::objects`] with bounds.
    Object(usize),
    /// One of [`Scene::environment_parts`].
    Environment(usize),
    /// One of [`Scene::lights`] that is not a disk.
    Light(usize),
}

impl Scene {
    /// The emitters that are sampled: emitting objects with bounds, parts of the environment, and lights. Dark ones are left out. So are
    /// constant environments and gradients, unless emitter sampling is the only way to find light: BSDF sampling finds them with less
    /// noise. (Their density after compensation for BSDF sampling is 0: Karlík et al., MIS Compensation, ACM Transactions on Graphics
    /// 38(6), 2019.)
    pub fn emitters(&self) -> Vec<EmitterSource> {
        let objects = self.objects().iter().enumerate();
        let objects = objects
            .filter(|(_, object)| !matches!(object.shape, Shape::Plane { .. }))
            .filter_map(|(index, object)| {
                let emission = self.material(object.material).emission()?;
                Some((EmitterKind::Object(index), emission, 1.0))
            });
        let parts = self.environment_parts().into_iter().enumerate();
        let samples_emitters_alone = self.settings().direct_light == DirectLight::Emitters;
        let is_uneven = |shape: &EnvironmentShape| {
            matches!(
                shape,
                EnvironmentShape::DistantDisk { .. } | EnvironmentShape::Picture(_)
            )
        };
        let parts = parts.filter(|(_, part)| samples_emitters_alone || is_uneven(&part.shape));
        let parts = parts.map(|(index, part)| {
            let mean = match part.shape {
                EnvironmentShape::Picture(picture) => picture.sampled_mean,
                _ => 1.0,
            };
            (EmitterKind::Environment(index), part.emission, mean)
        });
        let lights = self.lights().iter().enumerate();
        let is_distant_disk = |light: &Light| matches!(light.shape, LightShape::DistantDisk { .. });
        let lights = lights.filter(|(_, light)| !is_distant_disk(light));
        let lights = lights.map(|(index, light)| (EmitterKind::Light(index), light.emission, 1.0));
        objects
            .chain(parts)
            .chain(lights)
            .map(|(kind, emission, mean)| EmitterSource {
                kind,
                emission,
                brightness: mean * self.brightness(emission),
            })
            .filter(|source| source.brightness > 0.0)
            .collect()
    }

    /// What rays meet that leave the scene: the parts of the environment, then the disks of distant lights.
    pub fn environment_parts(&self) -> Vec<EnvironmentPart<'_>> {
        let disks = self.lights().iter().filter_map(|light| match light.shape {
            LightShape::DistantDisk { toward, height } => Some(EnvironmentPart {
                shape: EnvironmentShape::DistantDisk { toward, height },
                emission: light.emission,
            }),
            _ => None,
        });
        self.environment()
            .parts()
            .into_iter()
            .chain(disks)
            .collect()
    }

    /// Luminance per nanometer of bandwidth, without its unit. Wavelengths that are barely visible count a little too.
    fn brightness(&self, emission: Emission) -> f64 {
        /// Weight of all wavelengths, relative to the peak of ȳ.
        const INVISIBLE: f64 = 0.05;
        let bands = self.settings().bands.count();
        let (spectrum, [_, y, _]) = (self.spectrum(emission.spectrum), self.observer());
        let steps = spectrum.steps();
        let places = (0..bands).flat_map(|band| (0..=steps).map(move |step| (band, step)));
        let values = places.map(|(band, step)| {
            let offset = f64::from(step) / f64::from(steps);
            spectrum.at(band, offset) * (y.at(band, offset) + INVISIBLE)
        });
        emission.scale * values.sum::<f64>() / f64::from(bands * (steps + 1))
    }
}
