//! The features of a scene, so that its shader leaves out the rest.
//!
//! The table below is the only declaration of a feature. `shaders/features.wgsl` is generated from it and declares that a scene has
//! everything; a scene's shader has the same lines with the scene's values.

use crate::layout::constant;
use scene::{
    DirectLight, EmitterKind, EmitterTree, Environment, EnvironmentShape, Material, PictureSpectra,
    Projection, Sampler, Scene, Shape,
};
use std::collections::BTreeSet;

/// What the table says about a feature.
struct Declared {
    doc: &'static str,
    /// The name of its constant in WGSL.
    name: &'static str,
    /// Whether a scene has it; `None` for what only surfaces need: `pack/surface` has the features of each material.
    of_scene: Option<fn(&Scene) -> bool>,
}

macro_rules! features {
    ($(#[doc = $doc:literal] $feature:ident = $name:literal, $of_scene:expr;)*) => {
        /// Something that a scene has or lacks: a constant on which branches of the shader depend.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Feature {
            $(#[doc = $doc] $feature,)*
        }

        impl Feature {
            /// All features.
            pub const ALL: &[Self] = &[$(Self::$feature,)*];

            fn declared(self) -> Declared {
                match self {
                    $(Self::$feature => Declared {
                        doc: $doc,
                        name: $name,
                        of_scene: $of_scene,
                    },)*
                }
            }
        }
    };
}

features! {
    /// A sphere among the objects.
    Spheres = "HAS_SPHERES", Some(|scene| has_object(scene, is_sphere));
    /// A rectangle among the objects.
    Rectangles = "HAS_RECTANGLES", Some(|scene| has_object(scene, is_rectangle));
    /// A disk among the objects.
    Disks = "HAS_DISKS", Some(|scene| has_object(scene, is_disk));
    /// A sphere that is given by its curvature, because its center is too far away.
    LargeSpheres = "HAS_LARGE_SPHERES", Some(has_large_spheres);
    /// Objects that coincide.
    StackedShapes = "HAS_STACKED_SHAPES", Some(|scene| !scene.sheets().is_empty());
    /// A hierarchy of boxes around many objects.
    Hierarchy = "HAS_HIERARCHY", Some(|scene| !scene.hierarchy().nodes.is_empty());

    /// An emitter that is sampled.
    Emitters = "HAS_EMITTERS", Some(|scene| !scene.emitters().is_empty());
    /// Several emitters, of which each sample chooses one.
    EmitterChoice = "HAS_EMITTER_CHOICE", Some(|scene| scene.emitters().len() > 1);
    /// A tree of many emitters.
    EmitterTree = "HAS_EMITTER_TREE", Some(has_emitter_groups);
    /// An object that emits and is a sphere.
    SphereEmitters = "HAS_SPHERE_EMITTERS", Some(|scene| has_glowing_object(scene, is_sphere));
    /// An object that emits and is a disk.
    DiskEmitters = "HAS_DISK_EMITTERS", Some(|scene| has_glowing_object(scene, is_disk));
    /// A light with a single direction at each point.
    DeltaEmitters = "HAS_DELTA_EMITTERS", Some(has_lights);
    /// A disk in the sky.
    DistantDisks = "HAS_DISTANT_DISKS", Some(has_distant_disks);
    /// An environment that emits.
    Environment = "HAS_ENVIRONMENT", Some(has_bright_environment);
    /// An environment that is a picture.
    EnvironmentPicture = "HAS_ENVIRONMENT_PICTURE", Some(|scene| picture_of(scene).is_some());
    /// A picture of the environment with a spectrum in each pixel.
    SpectralPicture = "HAS_SPECTRAL_PICTURE", Some(|scene| picture_of(scene) == Some(PictureSpectra::Bands));

    /// Direct light is found by emitter sampling.
    SamplesEmitters = "SAMPLES_EMITTERS", Some(|scene| scene.settings().direct_light != DirectLight::Bsdf);
    /// Direct light is found by BSDF sampling.
    SamplesBsdf = "SAMPLES_BSDF", Some(|scene| scene.settings().direct_light != DirectLight::Emitters);
    /// Films that split a path.
    Splits = "HAS_SPLITS", Some(has_splits);
    /// Russian roulette before the last segment.
    Roulette = "HAS_ROULETTE", Some(has_roulette);
    /// A bound on the radiance of a sample.
    Clamp = "HAS_CLAMP", Some(|scene| scene.settings().clamp.is_some());
    /// Samples by Sobol's sequence.
    SobolSamples = "HAS_SOBOL_SAMPLES", Some(|scene| scene.settings().sampler == Sampler::Sobol);

    /// Light that is traced with its polarization.
    Polarization = "HAS_POLARIZATION", Some(|scene| scene.settings().polarization);
    /// Emitters of polarized light.
    EmittedPolarization = "HAS_EMITTED_POLARIZATION", Some(has_emitted_polarization);
    /// A polarizer in front of the camera.
    Polarizer = "HAS_POLARIZER", Some(|scene| scene.settings().polarization && scene.camera().polarizer.is_some());

    /// A camera that sees all directions.
    Panorama = "HAS_PANORAMA", Some(|scene| scene.camera().projection == Projection::Panorama);
    /// A camera with parallel directions of view.
    Orthographic = "HAS_ORTHOGRAPHIC", Some(has_orthographic_camera);
    /// A camera with a lens.
    Lens = "HAS_LENS", Some(|scene| scene.camera().lens.is_some());
    /// A filter that distributes a pixel's samples unevenly.
    Filter = "HAS_FILTER", Some(|scene| scene.camera().filter.offsets().is_some());

    /// A surface with a BSDF: neither black nor a film.
    Bsdfs = "HAS_BSDFS", None;
    /// A surface that scatters light in directions that are sampled by a density.
    Scattering = "HAS_SCATTERING", None;
    /// A surface that also scatters in a single direction.
    Specular = "HAS_SPECULAR", None;
    /// A surface that both emits and reflects.
    Glow = "HAS_GLOW", None;
    /// A body below a coat, or a Lambertian fraction beside facets.
    Bases = "HAS_BASES", None;
    /// A reflectance that is a checker.
    Checkers = "HAS_CHECKERS", None;
    /// A reflectance that is a picture.
    Textures = "HAS_TEXTURES", None;
    /// A conductor.
    Interfaces = "HAS_INTERFACES", None;
    /// A smooth conductor.
    Mirrors = "HAS_MIRRORS", None;
    /// A rough conductor.
    RoughConductors = "HAS_ROUGH_CONDUCTORS", None;
    /// Layers on a conductor.
    Coatings = "HAS_COATINGS", None;
    /// A diffuse body below a smooth coat.
    CoatedBodies = "HAS_COATED_BODIES", None;
    /// A diffuse body below a rough coat.
    RoughCoats = "HAS_ROUGH_COATS", None;
    /// The model of Cook and Torrance.
    Cook = "HAS_COOK", None;
    /// Facets of Beckmann's distribution.
    Beckmann = "HAS_BECKMANN", None;
    /// Facets of the distribution of Trowbridge and Reitz.
    Ggx = "HAS_GGX", None;
    /// A brushed surface.
    Grain = "HAS_GRAIN", None;

    /// A free film.
    Films = "HAS_FILMS", None;
    /// A free film of one layer of any index.
    LossyFilms = "HAS_LOSSY_FILMS", None;
    /// A free film of several layers.
    Stacks = "HAS_STACKS", None;
    /// A free film by two beams.
    TwoBeamFilms = "HAS_TWO_BEAM_FILMS", None;
    /// A layer whose thickness varies over a surface.
    Fields = "HAS_FIELDS", None;
    /// A thickness that is a sum or a product.
    CombinedFields = "HAS_COMBINED_FIELDS", None;
    /// A thickness that varies along the polar angle.
    PolarFields = "HAS_POLAR_FIELDS", None;
    /// A thickness that varies along a line.
    LineFields = "HAS_LINE_FIELDS", None;
    /// A thickness in steps, or by a table.
    SampledFields = "HAS_SAMPLED_FIELDS", None;
    /// A thickness with swirls.
    Swirls = "HAS_SWIRLS", None;
    /// A thickness that is a picture.
    Pictures = "HAS_PICTURES", None;
}

impl Feature {
    /// Whether only surfaces need it: each material has the features that its surface needs.
    pub fn is_of_surfaces(self) -> bool {
        self.declared().of_scene.is_none()
    }
}

/// The features that a scene has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Features(BTreeSet<Feature>);

impl Features {
    /// Returns all features.
    pub fn all() -> Self {
        Self(Feature::ALL.iter().copied().collect())
    }

    /// Returns the features of a scene other than those of its materials.
    pub(crate) fn of(scene: &Scene) -> Self {
        let has = |feature: &Feature| feature.declared().of_scene.is_some_and(|has| has(scene));
        Self(Feature::ALL.iter().copied().filter(has).collect())
    }

    /// Adds the features of a surface.
    pub(crate) fn add(&mut self, features: &[Feature]) {
        self.0.extend(features);
    }

    /// Whether the scene has a feature.
    pub fn has(&self, feature: Feature) -> bool {
        self.0.contains(&feature)
    }

    /// Returns the features with one of them set or cleared, for tests.
    #[must_use]
    pub fn with(mut self, feature: Feature, has: bool) -> Self {
        self.0.remove(&feature);
        self.0.extend(has.then_some(feature));
        self
    }

    /// Returns the constants of all features as WGSL.
    pub(crate) fn wgsl(&self) -> String {
        let declare = |&feature: &Feature| {
            let Declared { doc, name, .. } = feature.declared();
            constant(doc, name, "bool", &self.has(feature).to_string())
        };
        Feature::ALL.iter().map(declare).collect()
    }
}

fn has_emitted_polarization(scene: &Scene) -> bool {
    let materials = scene.objects().iter().map(|o| scene.material(o.material));
    let of_objects = materials.filter_map(Material::emission);
    let of_environment = scene.environment_parts();
    let of_environment = of_environment.iter().map(|part| part.emission);
    let of_lights = scene.lights().iter().map(|light| light.emission);
    let mut all = of_objects.chain(of_environment).chain(of_lights);
    scene.settings().polarization && all.any(|emission| emission.polarization.is_some())
}

fn is_sphere(shape: &Shape) -> bool {
    matches!(shape, Shape::Sphere { .. })
}

fn is_rectangle(shape: &Shape) -> bool {
    matches!(shape, Shape::Rectangle { .. })
}

fn is_disk(shape: &Shape) -> bool {
    matches!(shape, Shape::Disk { .. })
}

fn has_object(scene: &Scene, wanted: fn(&Shape) -> bool) -> bool {
    scene.objects().iter().any(|object| wanted(&object.shape))
}

fn has_large_spheres(scene: &Scene) -> bool {
    let mut objects = scene.objects().iter();
    objects.any(|object| is_large(scene, &object.shape))
}

fn has_glowing_object(scene: &Scene, wanted: fn(&Shape) -> bool) -> bool {
    scene.emitters().iter().any(|source| match source.kind {
        EmitterKind::Object(index) => wanted(&scene.objects()[index].shape),
        _ => false,
    })
}

fn has_lights(scene: &Scene) -> bool {
    let sources = scene.emitters();
    let mut sources = sources.iter();
    sources.any(|source| matches!(source.kind, EmitterKind::Light(_)))
}

fn has_emitter_groups(scene: &Scene) -> bool {
    let mut nodes = scene.emitter_tree().nodes.iter();
    nodes.any(|node| node.source == EmitterTree::NONE)
}

fn has_distant_disks(scene: &Scene) -> bool {
    let parts = scene.environment_parts();
    let mut parts = parts.iter();
    parts.any(|part| matches!(part.shape, EnvironmentShape::DistantDisk { .. }))
}

fn has_bright_environment(scene: &Scene) -> bool {
    let parts = scene.environment_parts();
    let mut parts = parts.iter();
    parts.any(|part| part.emission.scale > 0.0)
}

/// Returns the kind of spectra in the pixels of an environment that is a picture.
fn picture_of(scene: &Scene) -> Option<PictureSpectra> {
    match scene.environment() {
        Environment::Picture { picture, .. } => Some(picture.spectra),
        _ => None,
    }
}

fn has_splits(scene: &Scene) -> bool {
    let mut materials = scene.objects().iter().map(|o| scene.material(o.material));
    let has_films = materials.any(|material| matches!(material, Material::Film { .. }));
    has_films && scene.settings().film_splits > 0
}

fn has_roulette(scene: &Scene) -> bool {
    scene.settings().roulette_after < scene.settings().max_path_segments
}

fn has_orthographic_camera(scene: &Scene) -> bool {
    matches!(scene.camera().projection, Projection::Orthographic { .. })
}

/// A sphere is large if its radius is more than this times the distance of its surface from the camera: an `f32` then loses a
/// hundred thousandth of that distance between the surface and the center.
const LARGE: f64 = 100.0;

/// Whether a sphere is given by its curvature and its point nearest to the camera, because its center is too far away.
pub(crate) fn is_large(scene: &Scene, shape: &Shape) -> bool {
    match *shape {
        Shape::Sphere { center, radius } => {
            let height = (scene.camera().origin.distance(center) - radius).abs();
            radius > LARGE * height.max(scene.camera().origin.length())
        }
        _ => false,
    }
}
