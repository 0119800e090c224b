//! The lists of a scene, and the forms in which they are bound.

use crate::PackedScene;
use crate::layout::bindings::{Binding, EMITTERS, RECORDS, SHAPES, SPECTRA, TREES};
use crate::layout::list_form::{ListForm, UNIFORM_BYTES};
use crate::modules::Specialization;

/// A list of a scene.
pub(crate) struct List<'a> {
    pub(crate) binding: Binding,
    /// Name in messages.
    pub(crate) what: &'static str,
    pub(crate) bytes: &'a [u8],
    /// Advice for when it is too long.
    pub(crate) advice: &'static str,
}

impl PackedScene {
    /// Returns the lists.
    pub(crate) fn lists(&self) -> [List<'_>; 5] {
        fn list<'a, T: bytemuck::Pod>(
            (binding, what): (Binding, &'static str),
            elements: &'a [T],
            advice: &'static str,
        ) -> List<'a> {
            List {
                binding,
                what,
                bytes: bytemuck::cast_slice(elements),
                advice,
            }
        }
        let fewer = "use fewer of them";
        let layers = "use fewer of them, with fewer layers";
        let spectra = "use fewer materials and emitters";
        [
            list((SHAPES, "objects"), &self.shapes, fewer),
            list((EMITTERS, "emitters"), &self.emitters, fewer),
            list((RECORDS, "materials"), &self.records, layers),
            list((TREES, "objects and emitters"), &self.trees, fewer),
            list((SPECTRA, "spectra"), &self.spectra, spectra),
        ]
    }

    /// Returns the specialization of a shader for this scene, on a device that is a software driver or not.
    pub fn specialization(&self, is_software: bool) -> Specialization {
        let lists = self.lists();
        let forms = lists.iter();
        let forms = forms.map(|list| (list.binding.name, list.form(is_software)));
        Specialization {
            limits: self.limits,
            counts: self.counts,
            features: self.features.clone(),
            forms: forms.collect(),
        }
    }
}

impl List<'_> {
    /// Returns the fastest form: software drivers read several elements of uniform buffers and textures at once, but those of
    /// storage buffers one after the other.
    pub(crate) fn form(&self, is_software: bool) -> ListForm {
        match (is_software, self.bytes.len() <= UNIFORM_BYTES) {
            (false, _) => ListForm::Storage,
            (true, true) => ListForm::Uniform,
            (true, false) => ListForm::Texture,
        }
    }

    /// Returns the format of its rows in a texture.
    pub(crate) fn texture_format(&self) -> wgpu::TextureFormat {
        if self.binding.is_float() {
            wgpu::TextureFormat::Rgba32Float
        } else {
            wgpu::TextureFormat::Rgba32Uint
        }
    }
}
