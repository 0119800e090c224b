//! A scene as paths need it: spectra in chunks, materials by what paths meet, emitters by number.

use crate::Emitter;
use crate::bsdf::Surface;
use crate::spectral::Tables;
use scene::{EmitterKind, EmitterSource, EnvironmentPart, MaterialId, Scene};

/// A scene that paths can be traced in.
pub struct PreparedScene<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) tables: Tables,
    surfaces: Vec<Surface<'a>>,
    /// What the environment is made of, disks of distant lights included.
    pub(crate) environment: Vec<EnvironmentPart<'a>>,
    /// All that is sampled for direct light.
    pub(crate) emitters: Vec<SceneEmitter<'a>>,
    /// Numbers of the emitters that objects and the parts of the environment are.
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

    /// The material of an object.
    pub(crate) fn surface(&self, material: MaterialId) -> &Surface<'a> {
        &self.surfaces[material.index()]
    }

    /// The number of the emitter that a path can meet here.
    pub(crate) fn emitter_number(&self, kind: EmitterKind) -> Option<usize> {
        match kind {
            EmitterKind::Object(index) => self.object_emitters[index],
            EmitterKind::Environment(index) => self.environment_emitters[index],
            EmitterKind::Light(_) => None,
        }
    }
}

/// Which emitter each of some things is.
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
