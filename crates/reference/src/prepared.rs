//! A scene in the form that paths need: spectra in chunks, materials by how paths use them, emitters by index.

use crate::Emitter;
use crate::bands::Tables;
use crate::bsdf::Surface;
use scene::{EmitterKind, EmitterSource, EnvironmentPart, MaterialId, Scene};

/// A scene prepared for tracing paths.
pub struct PreparedScene<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) tables: Tables,
    surfaces: Vec<Surface<'a>>,
    /// The parts of the environment, including the disks of distant lights.
    pub(crate) environment: Vec<EnvironmentPart<'a>>,
    /// All emitters that are sampled for direct light.
    pub(crate) emitters: Vec<SceneEmitter<'a>>,
    /// Indices of the emitters, for each object and for each part of the environment.
    object_emitters: Vec<Option<usize>>,
    environment_emitters: Vec<Option<usize>>,
}

/// One of a scene's emitters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SceneEmitter<'a> {
    pub(crate) source: EmitterSource,
    pub(crate) emitter: Emitter<'a>,
}

impl<'a> PreparedScene<'a> {
    /// Prepares a scene.
    pub fn new(scene: &'a Scene) -> Self {
        let mut tables = Tables::new(scene);
        let materials = scene.materials().iter().zip(scene.estimates());
        let surfaces = materials
            .map(|(material, estimate)| Surface::new(&mut tables, material, estimate))
            .collect();
        let environment = scene.environment_parts();
        let sources = scene.emitters();
        let object = |kind| match kind {
            EmitterKind::Object(index) => Some(index),
            _ => None,
        };
        let part = |kind| match kind {
            EmitterKind::Environment(index) => Some(index),
            _ => None,
        };
        let emitter = |source: &EmitterSource| SceneEmitter {
            source: *source,
            emitter: Emitter::of(scene, source.kind),
        };
        Self {
            scene,
            tables,
            surfaces,
            object_emitters: numbers(&sources, scene.objects().len(), object),
            environment_emitters: numbers(&sources, environment.len(), part),
            emitters: sources.iter().map(emitter).collect(),
            environment,
        }
    }

    /// Returns the surface of a material.
    pub(crate) fn surface(&self, material: MaterialId) -> &Surface<'a> {
        &self.surfaces[material.index()]
    }

    /// Returns the index of the emitter that a path can hit here.
    pub(crate) fn emitter_number(&self, kind: EmitterKind) -> Option<usize> {
        match kind {
            EmitterKind::Object(index) => self.object_emitters[index],
            EmitterKind::Environment(index) => self.environment_emitters[index],
            EmitterKind::Light(_) => None,
        }
    }
}

/// Returns, for each of `things` objects or parts of the environment, the index of its emitter.
fn numbers(
    emitters: &[EmitterSource],
    things: usize,
    thing: impl Fn(EmitterKind) -> Option<usize>,
) -> Vec<Option<usize>> {
    let mut numbers = vec![None; things];
    for (number, emitter) in emitters.iter().enumerate() {
        if let Some(thing) = thing(emitter.kind) {
            numbers[thing] = Some(number);
        }
    }
    numbers
}
