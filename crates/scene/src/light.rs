//! Lights that are no objects, and all that light can be sent from, in a validated scene.

use crate::{DirectLight, Emission, EnvironmentPart, EnvironmentShape, Scene, Shape};
use glam::DVec3;

/// A light that is no object. Rays do not meet it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where it is.
    pub shape: LightShape,
    /// Radiance of a disk, irradiance of a surface that faces light from a direction, intensity of a point and of a spot on its axis.
    pub emission: Emission,
}

/// Where a light that is no object is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightShape {
    /// A disk in the sky, seen where nothing is in front of it.
    DistantDisk {
        /// Unit vector toward its middle.
        toward: DVec3,
        /// 1 − cos of the angle between middle and edge, > 0.
        height: f64,
    },
    /// Light from a single direction.
    Direction {
        /// Unit vector toward the light.
        toward: DVec3,
    },
    /// A point that shines to all sides alike.
    Point {
        /// Where it is.
        position: DVec3,
    },
    /// A point that shines into a cone.
    Spot {
        /// Where it is.
        position: DVec3,
        /// Unit vector in which it shines.
        axis: DVec3,
        /// 1 − cosine with the axis, up to which the intensity is full.
        full_height: f64,
        /// 1 − cosine with the axis, beyond which there is no light; more than `full_height`.
        edge_height: f64,
    },
}

/// Something that light can be sent from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmitterSource {
    /// What it is.
    pub kind: EmitterKind,
    /// What it emits.
    pub emission: Emission,
    /// How bright that is to the eye, up to a factor that all sources share; never 0. It steers the choice among sources.
    pub brightness: f64,
}

/// Where a source of light stands in its list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EmitterKind {
    /// One of [`Scene::objects`], which has bounds.
    Object(usize),
    /// One of [`Scene::environment_parts`].
    Environment(usize),
    /// One of [`Scene::lights`] that is no disk.
    Light(usize),
}

impl Scene {
    /// All that light is sent from: emitting objects with bounds, what surrounds them, and lights. What emits nothing is not
    /// among them, nor are constant environment and gradients, unless sending is the only way to find light: scattered rays
    /// find them with less noise. (The density of a light after compensation for those rays is then 0: Karlík et al., MIS
    /// Compensation, ACM Transactions on Graphics 38(6), 2019.)
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

    /// What a ray sees that leaves the scene: the parts of the environment, then the disks of distant lights.
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

    /// Luminance per nm of bandwidth without its unit. What the eye hardly sees counts a little too.
    fn brightness(&self, emission: Emission) -> f64 {
        /// Of the peak of ȳ.
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
