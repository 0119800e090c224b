//! The validated scene.

use crate::description::Description;
use crate::rounding::RoundToF32;
use crate::{
    Camera, EmitterTree, Environment, Estimate, Hierarchy, Light, Material, Object, RenderSettings,
    Sheet, validate,
};
use document::{Folder, Problems};
use spectra::{BandTable, LightGroup, SpectralImage};

/// Index of a spectrum in [`Scene::spectra`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SpectrumId(pub(crate) u32);

impl SpectrumId {
    /// The position in the list.
    pub fn index(self) -> usize {
        self.0 as usize
    }

    /// The spectrum this many positions after this one.
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
/// Spectra are tables on the band grid of [`RenderSettings::bands`]; nothing refers to a name or a file anymore.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    pub(crate) settings: RenderSettings,
    pub(crate) camera: Camera,
    pub(crate) spectra: Vec<BandTable>,
    pub(crate) observer: [BandTable; 3],
    pub(crate) light_groups: Vec<LightGroup>,
    pub(crate) materials: Vec<Material>,
    pub(crate) objects: Vec<Object>,
    /// One for each object, or empty.
    pub(crate) sheets: Vec<Option<Sheet>>,
    pub(crate) lights: Vec<Light>,
    pub(crate) environment: Environment,
    /// One for each material.
    pub(crate) estimates: Vec<Estimate>,
    pub(crate) hierarchy: Hierarchy,
    pub(crate) emitter_tree: EmitterTree,
    /// Assumptions about its files, one line each.
    pub(crate) assumptions: Vec<String>,
}

impl Scene {
    /// Validates `description` and builds its scene. Paths of files are relative to `folder`, and the files must be in it.
    ///
    /// # Errors
    /// All problems of the description. For a description from a file, [`SceneFile::validate`](crate::SceneFile::validate) also knows the
    /// lines.
    pub fn new(description: &Description, folder: impl Into<Folder>) -> Result<Self, Problems> {
        validate::scene(description, &folder.into())
            .map_err(|list| Problems::of_program("the scene", list))
    }

    /// The render settings.
    pub fn settings(&self) -> &RenderSettings {
        &self.settings
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// All spectra that materials and lights refer to.
    pub fn spectra(&self) -> &[BandTable] {
        &self.spectra
    }

    /// The spectrum with this index.
    pub fn spectrum(&self, id: SpectrumId) -> &BandTable {
        &self.spectra[id.index()]
    }

    /// The CIE 1931 2° color-matching functions x̄, ȳ, z̄.
    pub fn observer(&self) -> &[BandTable; 3] {
        &self.observer
    }

    /// The light groups of the emitters. There is at least one, even in a scene without emitters.
    pub fn light_groups(&self) -> &[LightGroup] {
        &self.light_groups
    }

    /// Size of the spectral image in memory, in bytes.
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

    /// The material with this index.
    pub fn material(&self, id: MaterialId) -> &Material {
        &self.materials[id.index()]
    }

    /// An estimate, for each material, of how much light it reflects and transmits.
    pub fn estimates(&self) -> &[Estimate] {
        &self.estimates
    }

    /// An estimate of how much light a material reflects and transmits.
    pub fn estimate(&self, id: MaterialId) -> &Estimate {
        &self.estimates[id.index()]
    }

    /// All objects.
    pub fn objects(&self) -> &[Object] {
        &self.objects
    }

    /// The position of each object in a stack of coincident surfaces; empty if no two surfaces coincide.
    pub fn sheets(&self) -> &[Option<Sheet>] {
        &self.sheets
    }

    /// The bounding volume hierarchy of the objects.
    pub fn hierarchy(&self) -> &Hierarchy {
        &self.hierarchy
    }

    /// The tree of the emitters that are sampled.
    pub fn emitter_tree(&self) -> &EmitterTree {
        &self.emitter_tree
    }

    /// Lights that are not objects, disks first. See [`Scene::emitters`] for all emitters that are sampled.
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// The environment.
    pub fn environment(&self) -> &Environment {
        &self.environment
    }

    /// The same scene with every number rounded to the nearest `f32`, as a GPU receives it.
    ///
    /// Axes are then orthonormal to within this rounding, and a polar thickness that is 0 at its far pole may be below 0 there by a
    /// rounding error.
    #[must_use]
    pub fn rounded_to_f32(&self) -> Self {
        self.rounded()
    }
}
