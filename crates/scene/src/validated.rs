//! The validated scene.

use crate::description::Description;
use crate::rounding::RoundToF32;
use crate::{
    Camera, EmitterTree, Environment, Estimate, Folder, Hierarchy, Light, Material, Object,
    Problems, RenderSettings, Sheet, validate,
};
use spectra::{BandTable, LightGroup, SpectralImage};

/// Index of a spectrum in [`Scene::spectra`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SpectrumId(pub(crate) u32);

impl SpectrumId {
    /// The position in the list.
    pub fn index(self) -> usize {
        self.0 as usize
    }

    /// The spectrum that stands this many places after this one.
    #[must_use]
    pub fn after(self, places: usize) -> Self {
        Self(self.0 + places as u32)
    }
}

/// Index of a light group in [`Scene::light_groups`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LightGroupId(pub(crate) u32);

impl LightGroupId {
    /// The position in the list.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Index of a material in [`Scene::materials`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MaterialId(pub(crate) u32);

impl MaterialId {
    /// The position in the list.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A scene that can be rendered.
///
/// Spectra are tables on the band grid of [`RenderSettings::bands`]; nothing refers to a name or a file any more.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    pub(crate) settings: RenderSettings,
    pub(crate) camera: Camera,
    pub(crate) spectra: Vec<BandTable>,
    pub(crate) observer: [BandTable; 3],
    pub(crate) light_groups: Vec<LightGroup>,
    pub(crate) materials: Vec<Material>,
    pub(crate) objects: Vec<Object>,
    /// Of each object, or of none.
    pub(crate) sheets: Vec<Option<Sheet>>,
    pub(crate) lights: Vec<Light>,
    pub(crate) environment: Environment,
    /// Of each material.
    pub(crate) estimates: Vec<Estimate>,
    pub(crate) hierarchy: Hierarchy,
    pub(crate) emitter_tree: EmitterTree,
    /// What was assumed of its files, a line each.
    pub(crate) assumptions: Vec<String>,
}

impl Scene {
    /// The scene that `description` describes. Files are looked for from `folder` and must lie in it.
    ///
    /// # Errors
    /// Everything that is wrong with the description. For one that comes from a file,
    /// [`SceneFile::validate`](crate::SceneFile::validate) also knows the lines.
    pub fn new(description: &Description, folder: impl Into<Folder>) -> Result<Self, Problems> {
        validate::scene(description, &folder.into()).map_err(Problems::of_program)
    }

    /// How it is to be rendered.
    pub fn settings(&self) -> &RenderSettings {
        &self.settings
    }

    /// Where it is seen from.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// All spectra that materials and lights refer to.
    pub fn spectra(&self) -> &[BandTable] {
        &self.spectra
    }

    /// One of the spectra.
    pub fn spectrum(&self, id: SpectrumId) -> &BandTable {
        &self.spectra[id.index()]
    }

    /// The CIE 1931 2° color-matching functions x̄, ȳ, z̄.
    pub fn observer(&self) -> &[BandTable; 3] {
        &self.observer
    }

    /// The light groups of what shines, at least one; a scene that is all dark has one too.
    pub fn light_groups(&self) -> &[LightGroup] {
        &self.light_groups
    }

    /// Bytes that the picture takes in memory.
    pub fn image_bytes(&self) -> u128 {
        let settings = self.settings();
        let bands = settings.bands.count();
        SpectralImage::bytes(
            settings.width,
            settings.height,
            bands,
            self.light_groups.len(),
        )
    }

    /// All materials.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// The material of an object.
    pub fn material(&self, id: MaterialId) -> &Material {
        &self.materials[id.index()]
    }

    /// How each material divides light, roughly.
    pub fn estimates(&self) -> &[Estimate] {
        &self.estimates
    }

    /// How a material divides light, roughly.
    pub fn estimate(&self, id: MaterialId) -> &Estimate {
        &self.estimates[id.index()]
    }

    /// All objects.
    pub fn objects(&self) -> &[Object] {
        &self.objects
    }

    /// The places of objects in stacks of coincident surfaces, by object; empty where no two surfaces coincide.
    pub fn sheets(&self) -> &[Option<Sheet>] {
        &self.sheets
    }

    /// Boxes around the objects.
    pub fn hierarchy(&self) -> &Hierarchy {
        &self.hierarchy
    }

    /// Groups of what light is sent from.
    pub fn emitter_tree(&self) -> &EmitterTree {
        &self.emitter_tree
    }

    /// Lights that are no objects, disks first. See [`Scene::emitters`] for all that shines.
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// What surrounds the objects.
    pub fn environment(&self) -> &Environment {
        &self.environment
    }

    /// The same scene with every number rounded to the nearest `f32`, as a GPU receives it.
    ///
    /// Axes are then orthonormal to within that rounding, and a polar film that thins out to nothing at its far
    /// pole may come to a rounding below 0 there.
    #[must_use]
    pub fn rounded_to_f32(&self) -> Self {
        self.rounded()
    }
}
