//! A scene as paths need it: spectra in chunks, materials by their BSDFs, emitters by number.

use crate::bsdf::{Bsdf, Coated, CoatedAt, Cook, Diffuse, Interface, InterfaceAt};
use crate::layers::{Film, SurfaceAt};
use crate::spectral::Tables;
use crate::surface::{Reflectance, pattern_reflectance};
use crate::{Emitter, SurfacePoint};
use scene::{
    Emission, EnvironmentPart, Estimate, LightSource, Material, MaterialId, Pattern, Scene, Shape,
    SourceKind,
};

/// A scene that paths can be traced in.
pub struct PreparedScene<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) tables: Tables,
    surfaces: Vec<Surface<'a>>,
    /// What the environment is made of, discs of distant lights included.
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
    pub(crate) source: LightSource,
    pub(crate) emitter: Emitter<'a>,
}

/// A material as paths meet it.
pub(crate) struct Surface<'a> {
    /// What it emits.
    pub(crate) emission: Option<Emission>,
    /// How it divides light, roughly.
    pub(crate) estimate: &'a Estimate,
    kind: SurfaceKind<'a>,
}

enum SurfaceKind<'a> {
    Black,
    Film(Film<'a>),
    Diffuse(Pattern),
    Interface(Interface<'a>),
    Coated(Coated<'a>),
    Cook(Cook<'a>),
}

impl<'a> Surface<'a> {
    fn new(tables: &mut Tables, material: &'a Material, estimate: &'a Estimate) -> Self {
        let kind = match material {
            Material::Film {
                layers,
                interference,
                ..
            } => SurfaceKind::Film(Film::new(tables, layers, *interference)),
            Material::Diffuse { reflectance } => SurfaceKind::Diffuse(reflectance.clone()),
            Material::Emitter { reflectance, .. } => match *reflectance {
                Some(spectrum) => SurfaceKind::Diffuse(Pattern::Uniform(spectrum)),
                None => SurfaceKind::Black,
            },
            Material::Conductor {
                n,
                k,
                layers,
                microsurface,
            } => {
                let of = Interface::new(tables, (*n, *k), layers, microsurface.as_ref());
                SurfaceKind::Interface(of)
            }
            Material::CoatedBody(body) => SurfaceKind::Coated(Coated::new(tables, body)),
            Material::Cook(cook) => SurfaceKind::Cook(Cook::new(tables, cook)),
        };
        let ambient = match material {
            Material::Cook(cook) => cook.ambient,
            _ => None,
        };
        Self {
            emission: material.emission().or(ambient),
            estimate,
            kind,
        }
    }

    /// The film that it is.
    pub(crate) fn film(&self) -> Option<&Film<'a>> {
        match &self.kind {
            SurfaceKind::Film(film) => Some(film),
            _ => None,
        }
    }

    /// How it scatters light at a point; none of films and of what is black. `random` in [0, 1) chooses between the texels of a picture.
    pub(crate) fn bsdf(
        &'a self,
        shape: &'a Shape,
        point: &SurfacePoint,
        random: impl FnOnce() -> f64,
    ) -> Option<Bsdf<'a>> {
        let position = point.position;
        let reflectance = |pattern: &Pattern| match *pattern {
            Pattern::Uniform(spectrum) => Reflectance::Spectrum(spectrum),
            Pattern::Checker { .. } => pattern_reflectance(pattern, shape, position, 0.0),
            Pattern::Texture { .. } => pattern_reflectance(pattern, shape, position, random()),
        };
        Some(match &self.kind {
            SurfaceKind::Black | SurfaceKind::Film(_) => return None,
            SurfaceKind::Diffuse(pattern) => Bsdf::Diffuse(Diffuse(reflectance(pattern))),
            SurfaceKind::Interface(interface) => Bsdf::Interface(InterfaceAt {
                interface,
                surface: SurfaceAt { shape, position },
            }),
            SurfaceKind::Coated(coated) => Bsdf::Coated(CoatedAt {
                coated,
                base: reflectance(&coated.body.base),
            }),
            SurfaceKind::Cook(cook) => Bsdf::Cook(cook),
        })
    }
}

impl<'a> PreparedScene<'a> {
    /// Prepares a scene.
    pub fn new(scene: &'a Scene) -> Self {
        let mut tables = Tables::new(scene);
        let materials = scene.materials().iter().zip(scene.estimates());
        let surfaces = materials
            .map(|(material, estimate)| Surface::new(&mut tables, material, estimate))
            .collect();
        let environment = scene.surroundings();
        let sources = scene.light_sources();
        let object = |kind| match kind {
            SourceKind::Object(index) => Some(index),
            _ => None,
        };
        let part = |kind| match kind {
            SourceKind::Environment(index) => Some(index),
            _ => None,
        };
        let emitter = |source: &LightSource| SceneEmitter {
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
    pub(crate) fn emitter_number(&self, kind: SourceKind) -> Option<usize> {
        match kind {
            SourceKind::Object(index) => self.object_emitters[index],
            SourceKind::Environment(index) => self.environment_emitters[index],
            SourceKind::Light(_) => None,
        }
    }
}

/// Which emitter each of some things is.
fn numbers(
    emitters: &[LightSource],
    things: usize,
    thing: impl Fn(SourceKind) -> Option<usize>,
) -> Vec<Option<usize>> {
    let mut numbers = vec![None; things];
    for (number, emitter) in emitters.iter().enumerate() {
        if let Some(thing) = thing(emitter.kind) {
            numbers[thing] = Some(number);
        }
    }
    numbers
}
