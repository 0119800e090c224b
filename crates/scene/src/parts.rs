//! What a validated scene consists of.

use crate::rounding::RoundToF32;
use crate::{
    Camera, DirectLight, Emission, EmitterKind, EmitterSource, Environment, EnvironmentPart,
    EnvironmentShape, Estimate, Light, LightShape, Material, Object, RenderSettings, Shape,
};
use spectra::{BandTable, LightGroup};

/// What a scene consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneParts {
    /// The render settings.
    pub settings: RenderSettings,
    /// The camera.
    pub camera: Camera,
    /// All spectra that materials and lights refer to.
    pub spectra: Vec<BandTable>,
    /// The CIE 1931 2° color-matching functions x̄, ȳ, z̄.
    pub observer: [BandTable; 3],
    /// The light groups of the emitters, at least one.
    pub light_groups: Vec<LightGroup>,
    /// All materials.
    pub materials: Vec<Material>,
    /// One for each material.
    pub estimates: Vec<Estimate>,
    /// All objects.
    pub objects: Vec<Object>,
    /// Lights that are not objects, disks first.
    pub lights: Vec<Light>,
    /// The environment.
    pub environment: Environment,
    /// Assumptions about its files, one line each.
    pub assumptions: Vec<String>,
}

impl SceneParts {
    /// See [`Scene::emitters`](crate::Scene::emitters).
    pub(crate) fn emitters(&self) -> Vec<EmitterSource> {
        let objects = self.objects.iter().enumerate();
        let objects = objects
            .filter(|(_, object)| !matches!(object.shape, Shape::Plane { .. }))
            .filter_map(|(index, object)| {
                let emission = self.materials[object.material.index()].emission()?;
                Some((EmitterKind::Object(index), emission, 1.0))
            });
        let parts = self.environment_parts().into_iter().enumerate();
        let samples_emitters_alone = self.settings.direct_light == DirectLight::Emitters;
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
        let lights = self.lights.iter().enumerate();
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

    /// See [`Scene::environment_parts`](crate::Scene::environment_parts).
    pub(crate) fn environment_parts(&self) -> Vec<EnvironmentPart<'_>> {
        let disks = self.lights.iter().filter_map(|light| match light.shape {
            LightShape::DistantDisk { toward, height } => Some(EnvironmentPart {
                shape: EnvironmentShape::DistantDisk { toward, height },
                emission: light.emission,
            }),
            _ => None,
        });
        self.environment.parts().into_iter().chain(disks).collect()
    }

    /// Luminance per nanometer of bandwidth, without its unit. Wavelengths that are barely visible count a little too.
    fn brightness(&self, emission: Emission) -> f64 {
        /// Weight of all wavelengths, relative to the peak of ȳ.
        const INVISIBLE: f64 = 0.05;
        let bands = self.settings.bands.count();
        let (spectrum, [_, y, _]) = (&self.spectra[emission.spectrum.index()], &self.observer);
        let steps = spectrum.steps();
        let places = (0..bands).flat_map(|band| (0..=steps).map(move |step| (band, step)));
        let values = places.map(|(band, step)| {
            let offset = f64::from(step) / f64::from(steps);
            spectrum.at(band, offset) * (y.at(band, offset) + INVISIBLE)
        });
        emission.scale * values.sum::<f64>() / f64::from(bands * (steps + 1))
    }
}

impl RoundToF32 for SceneParts {
    fn rounded(&self) -> Self {
        Self {
            settings: self.settings.rounded(),
            camera: self.camera.rounded(),
            spectra: self.spectra.rounded(),
            observer: self.observer.each_ref().map(RoundToF32::rounded),
            light_groups: self.light_groups.clone(),
            materials: self.materials.rounded(),
            estimates: self.estimates.rounded(),
            objects: self.objects.rounded(),
            lights: self.lights.rounded(),
            environment: self.environment.rounded(),
            assumptions: self.assumptions.clone(),
        }
    }
}
