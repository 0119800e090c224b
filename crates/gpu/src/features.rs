//! The features of a scene, so that its shader leaves out the rest: the values of the `override` lines of `shaders/`.

use crate::pack::is_large;
use scene::{
    DirectLight, EmitterKind, EmitterSource, EmitterTree, Environment, EnvironmentPart,
    EnvironmentShape, Material, PictureSpectra, Projection, Sampler, Scene, Shape,
};
use std::collections::{BTreeMap, BTreeSet};

/// Values of the constants of a shader: whether a scene has a feature, and how many of something it has.
///
/// The default is that of the files: every feature is present.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Features {
    has: Option<BTreeSet<&'static str>>,
    counts: BTreeMap<&'static str, u32>,
}

impl Features {
    /// Returns the features of a scene other than those of its materials.
    pub(crate) fn of(scene: &Scene) -> Self {
        let named = of_shapes(scene)
            .into_iter()
            .chain(of_lights(scene))
            .chain(of_paths(scene));
        let has = named.filter_map(|(name, has)| has.then_some(name));
        Self {
            has: Some(has.collect()),
            counts: counts(scene).into(),
        }
    }

    /// Adds features.
    pub(crate) fn add(&mut self, names: &[&'static str]) {
        self.has.get_or_insert_default().extend(names);
    }

    /// Adds the features and counts of a scene's trees; `hierarchy_rows` is 0 where there is no hierarchy of objects.
    pub(crate) fn set_trees(&mut self, scene: &Scene, hierarchy_rows: u32) {
        if hierarchy_rows > 0 {
            self.add(&["HAS_HIERARCHY"]);
            self.counts.insert("HIERARCHY_ROWS", hierarchy_rows);
        }
        let mut nodes = scene.emitter_tree().nodes.iter();
        if nodes.any(|node| node.source == EmitterTree::NONE) {
            self.add(&["HAS_EMITTER_TREE"]);
        }
    }

    /// Returns the features with one of them set or cleared, for tests.
    #[must_use]
    pub fn with(mut self, name: &'static str, has: bool) -> Self {
        let names = self.has.get_or_insert_default();
        names.remove(name);
        names.extend(has.then_some(name));
        self
    }

    /// Returns the names of all constants that have a value here.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        let counts = self.counts.keys();
        self.has.iter().flatten().chain(counts).copied()
    }

    /// Returns the line that declares an overridable constant, as a constant with its value; `None` for other lines.
    pub(crate) fn fill_in(&self, line: &str) -> Option<String> {
        let declared = line.strip_prefix("override ")?;
        let (name, rest) = declared.split_once(": ")?;
        let (kind, default) = rest.strip_suffix(';')?.split_once(" = ")?;
        let value = match (kind, &self.has, self.counts.get(name)) {
            ("bool", Some(has), _) => has.contains(name).to_string(),
            ("u32", _, Some(count)) => format!("{count}u"),
            _ => default.to_owned(),
        };
        Some(format!("const {name}: {kind} = {value};"))
    }
}

/// Returns the numbers of passes of the loops over all things of a kind.
fn counts(scene: &Scene) -> [(&'static str, u32); 6] {
    let settings = scene.settings();
    let length = |count: usize| count as u32;
    [
        ("OBJECT_COUNT", length(scene.objects().len())),
        ("EMITTER_COUNT", length(scene.emitters().len())),
        ("ENVIRONMENT_COUNT", length(scene.environment_parts().len())),
        ("GROUPS", settings.bands.count().div_ceil(4)),
        ("MAX_PATH_SEGMENTS", settings.max_path_segments),
        ("ROULETTE_AFTER", settings.roulette_after),
    ]
}

type Named = (&'static str, bool);

fn is_sphere(shape: &Shape) -> bool {
    matches!(shape, Shape::Sphere { .. })
}

fn is_rectangle(shape: &Shape) -> bool {
    matches!(shape, Shape::Rectangle { .. })
}

fn is_disk(shape: &Shape) -> bool {
    matches!(shape, Shape::Disk { .. })
}

fn of_shapes(scene: &Scene) -> Vec<Named> {
    let shape = |wanted: fn(&Shape) -> bool| scene.objects().iter().any(|o| wanted(&o.shape));
    let mut objects = scene.objects().iter();
    vec![
        ("HAS_SPHERES", shape(is_sphere)),
        ("HAS_RECTANGLES", shape(is_rectangle)),
        ("HAS_DISKS", shape(is_disk)),
        (
            "HAS_LARGE_SPHERES",
            objects.any(|object| is_large(scene, &object.shape)),
        ),
        ("HAS_STACKED_SHAPES", !scene.sheets().is_empty()),
    ]
}

fn of_lights(scene: &Scene) -> Vec<Named> {
    let sources = scene.emitters();
    let environment = scene.environment_parts();
    let light = |wanted: fn(&Shape) -> bool| {
        sources.iter().any(|source| match source.kind {
            EmitterKind::Object(index) => wanted(&scene.objects()[index].shape),
            _ => false,
        })
    };
    let is_delta = |source: &EmitterSource| matches!(source.kind, EmitterKind::Light(_));
    let is_distant_disk =
        |part: &EnvironmentPart| matches!(part.shape, EnvironmentShape::DistantDisk { .. });
    let direct = scene.settings().direct_light;
    vec![
        ("HAS_SPHERE_EMITTERS", light(is_sphere)),
        ("HAS_DISK_EMITTERS", light(is_disk)),
        ("HAS_DELTA_EMITTERS", sources.iter().any(is_delta)),
        ("HAS_DISTANT_DISKS", environment.iter().any(is_distant_disk)),
        ("HAS_EMITTERS", !sources.is_empty()),
        ("HAS_EMITTER_CHOICE", sources.len() > 1),
        (
            "HAS_ENVIRONMENT",
            environment.iter().any(|part| part.emission.scale > 0.0),
        ),
        ("SAMPLES_EMITTERS", direct != DirectLight::Bsdf),
        ("SAMPLES_BSDF", direct != DirectLight::Emitters),
        (
            "HAS_ENVIRONMENT_PICTURE",
            picture_of(scene.environment()).is_some(),
        ),
        (
            "HAS_SPECTRAL_PICTURE",
            picture_of(scene.environment()) == Some(PictureSpectra::Bands),
        ),
    ]
}

/// Returns the features of path sampling.
fn of_paths(scene: &Scene) -> Vec<Named> {
    let mut materials = scene.objects().iter().map(|o| scene.material(o.material));
    let has_films = materials.any(|material| matches!(material, Material::Film { .. }));
    vec![
        ("HAS_SPLITS", has_films && scene.settings().film_splits > 0),
        ("HAS_LENS", scene.camera().lens.is_some()),
        ("HAS_FILTER", scene.camera().filter.offsets().is_some()),
        ("HAS_CLAMP", scene.settings().clamp.is_some()),
        (
            "HAS_ROULETTE",
            scene.settings().roulette_after < scene.settings().max_path_segments,
        ),
        (
            "HAS_PANORAMA",
            scene.camera().projection == Projection::Panorama,
        ),
        (
            "HAS_ORTHOGRAPHIC",
            matches!(scene.camera().projection, Projection::Orthographic { .. }),
        ),
        (
            "HAS_SOBOL_SAMPLES",
            scene.settings().sampler == Sampler::Sobol,
        ),
    ]
}

/// Returns the kind of spectra in the pixels of an environment that is a picture.
fn picture_of(environment: &Environment) -> Option<PictureSpectra> {
    match environment {
        Environment::Picture { picture, .. } => Some(picture.spectra),
        _ => None,
    }
}
