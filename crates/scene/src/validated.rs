//! The validated scene.

use crate::rounding::RoundToF32;
use crate::{
    Camera, EmitterSource, EmitterTree, Environment, EnvironmentPart, Estimate, Hierarchy, Light,
    Material, MaterialId, Object, RenderSettings, SceneParts, Sheet, SpectrumId, trees,
};
use spectra::{Accumulation, BandTable, LightGroup, PixelContent, SpectralImage, Window};

/// A scene that can be rendered.
///
/// Spectra are tables on the band grid of [`RenderSettings::bands`]; nothing refers to a name or a file anymore.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    parts: SceneParts,
    /// One for each object, or empty.
    sheets: Vec<Option<Sheet>>,
    hierarchy: Hierarchy,
    emitter_tree: EmitterTree,
}

impl Scene {
    /// The scene of these parts, with its trees. The parts must be valid, as the crate `scene_file` makes them: numbers within their
    /// domains, indices within their lists, spectra on the grid of the settings.
    pub fn new(parts: SceneParts) -> Self {
        let sheets = trees::sheets(&parts.objects);
        Self::with_sheets(parts, sheets)
    }

    /// The scene of parts that were rounded after their coincident surfaces were found.
    fn with_sheets(parts: SceneParts, sheets: Vec<Option<Sheet>>) -> Self {
        let hierarchy = Hierarchy::new(&parts.objects);
        let mut scene = Self {
            parts,
            sheets,
            hierarchy,
            emitter_tree: EmitterTree::default(),
        };
        scene.emitter_tree =
            EmitterTree::new(&scene.emitters(), &scene.parts.objects, &scene.parts.lights);
        scene
    }

    /// The render settings.
    pub fn settings(&self) -> &RenderSettings {
        &self.parts.settings
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.parts.camera
    }

    /// All spectra that materials and lights refer to.
    pub fn spectra(&self) -> &[BandTable] {
        &self.parts.spectra
    }

    /// The spectrum with this index.
    pub fn spectrum(&self, id: SpectrumId) -> &BandTable {
        &self.parts.spectra[id.index()]
    }

    /// The CIE 1931 2° color-matching functions x̄, ȳ, z̄.
    pub fn observer(&self) -> &[BandTable; 3] {
        &self.parts.observer
    }

    /// The light groups of the emitters. There is at least one, even in a scene without emitters.
    pub fn light_groups(&self) -> &[LightGroup] {
        &self.parts.light_groups
    }

    /// The same scene with other random numbers.
    #[must_use]
    pub fn with_seed(&self, seed: u32) -> Self {
        let mut scene = self.clone();
        scene.parts.settings.seed = seed;
        scene
    }

    /// Size of the spectral image in memory, in bytes.
    pub fn image_bytes(&self) -> u128 {
        let settings = self.settings();
        SpectralImage::bytes(settings.width, settings.height, self.content())
    }

    /// What a pixel of the spectral image holds: all components of polarized light, unless a polarizer is in front of the camera.
    pub fn content(&self) -> PixelContent {
        PixelContent {
            bands: self.settings().bands.count(),
            light_groups: self.light_groups().len(),
            is_polarized: self.settings().polarization && self.camera().polarizer.is_none(),
        }
    }

    /// The state of a render of a window of the picture that has not begun. Its samples are numbered from `first_sample` on.
    pub fn accumulation(&self, window: Window, first_sample: u32) -> Accumulation {
        let groups = self.light_groups().to_vec();
        let is_polarized = self.content().is_polarized;
        Accumulation::new(
            window,
            first_sample,
            self.settings().bands,
            groups,
            is_polarized,
        )
    }

    /// The whole picture.
    pub fn window(&self) -> Window {
        Window::whole([self.settings().width, self.settings().height])
    }

    /// All materials.
    pub fn materials(&self) -> &[Material] {
        &self.parts.materials
    }

    /// The material with this index.
    pub fn material(&self, id: MaterialId) -> &Material {
        &self.parts.materials[id.index()]
    }

    /// An estimate, for each material, of how much light it reflects and transmits.
    pub fn estimates(&self) -> &[Estimate] {
        &self.parts.estimates
    }

    /// An estimate of how much light a material reflects and transmits.
    pub fn estimate(&self, id: MaterialId) -> &Estimate {
        &self.parts.estimates[id.index()]
    }

    /// All objects.
    pub fn objects(&self) -> &[Object] {
        &self.parts.objects
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
        &self.parts.lights
    }

    /// The environment.
    pub fn environment(&self) -> &Environment {
        &self.parts.environment
    }

    /// The emitters that are sampled: emitting objects with bounds, parts of the environment, and lights. Dark ones are left out. So are
    /// constant environments and gradients, unless emitter sampling is the only way to find light: BSDF sampling finds them with less
    /// noise. (Their density after compensation for BSDF sampling is 0: Karlík et al., MIS Compensation, ACM Transactions on Graphics
    /// 38(6), 2019.)
    pub fn emitters(&self) -> Vec<EmitterSource> {
        self.parts.emitters()
    }

    /// What rays meet that leave the scene: the parts of the environment, then the disks of distant lights.
    pub fn environment_parts(&self) -> Vec<EnvironmentPart<'_>> {
        self.parts.environment_parts()
    }

    /// The same scene with every number rounded to the nearest `f32`, as a GPU receives it.
    ///
    /// Axes are then orthonormal to within this rounding, and a polar thickness that is 0 at its far pole may be below 0 there by a
    /// rounding error.
    #[must_use]
    pub fn rounded_to_f32(&self) -> Self {
        let parts = self.parts.rounded();
        let mut scene = Self::with_sheets(parts, self.sheets.clone());
        scene.emitter_tree = scene.emitter_tree.rounded();
        scene
    }

    /// Assumptions about its files, one line each.
    pub(crate) fn assumptions(&self) -> &[String] {
        &self.parts.assumptions
    }
}
