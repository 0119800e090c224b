//! The lists of a scene, and the forms in which they are bound.

use crate::PackedScene;
use crate::layout::LIST_WIDTH;
use crate::modules::Specialization;

/// A list of a scene, as `shaders/bindings.wgsl` declares it.
pub(crate) struct List<'a> {
    /// Name of the variable.
    name: &'static str,
    /// Name in messages.
    pub(crate) what: &'static str,
    pub(crate) bytes: &'a [u8],
    /// Advice for when it is too long.
    pub(crate) advice: &'static str,
}

impl PackedScene {
    /// Returns the lists in the order of their bindings, from 1 on.
    pub(crate) fn lists(&self) -> [List<'_>; 5] {
        fn list<'a, T: bytemuck::Pod>(
            [name, what]: [&'static str; 2],
            elements: &'a [T],
            advice: &'static str,
        ) -> List<'a> {
            List {
                name,
                what,
                bytes: bytemuck::cast_slice(elements),
                advice,
            }
        }
        let fewer = "use fewer of them";
        [
            list(["shapes", "objects"], &self.shapes, fewer),
            list(["emitters", "emitters"], &self.emitters, fewer),
            list(
                ["records", "materials"],
                &self.records,
                "use fewer of them, with fewer layers",
            ),
            list(["trees", "objects and emitters"], &self.trees, fewer),
            list(
                ["spectra", "spectra"],
                &self.spectra,
                "use fewer materials and emitters",
            ),
        ]
    }

    /// Returns the specialization of a shader for this scene, on a device that is a software driver or not.
    pub fn specialization(&self, is_software: bool) -> Specialization {
        let lists = self.lists();
        let forms = lists.iter().map(|list| (list.name, list.form(is_software)));
        Specialization {
            limits: self.limits,
            counts: self.counts,
            features: self.features.clone(),
            forms: forms.collect(),
        }
    }
}

/// The form in which a list is bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ListForm {
    /// In a storage buffer.
    Storage,
    /// In a uniform buffer of 64 KiB.
    Uniform,
    /// In a texture, row by row.
    Texture,
}

/// Bytes of a list in a uniform buffer: the size that every device can bind. Shaders do not depend on how much of it is used.
pub(crate) const UNIFORM_BYTES: usize = 65_536;

impl ListForm {
    /// Returns a line of `shaders/bindings.wgsl` that declares or reads one of the lists, rewritten for its form; `None` for other lines.
    pub(crate) fn fill_in(forms: &[(&'static str, Self)], line: &str) -> Option<String> {
        let form_of = |name| forms.iter().find(|(known, _)| *known == name);
        if let Some((place, declared)) = line.split_once("var<storage, read> ") {
            let (name, rows) = declared.split_once(": array<")?;
            let row = rows.strip_suffix(">;")?;
            return match form_of(name)?.1 {
                Self::Storage => None,
                Self::Uniform => {
                    let count = UNIFORM_BYTES / 16;
                    Some(format!(
                        "{place}var<uniform> {name}: array<{row}, {count}>;"
                    ))
                }
                Self::Texture => {
                    let word = if row == "vec4u" { "u32" } else { "f32" };
                    Some(format!("{place}var {name}: texture_2d<{word}>;"))
                }
            };
        }
        let name = line.strip_prefix("    return ")?.strip_suffix("[row];")?;
        (form_of(name)?.1 == Self::Texture).then(|| {
            format!("    return textureLoad({name}, vec2u(row % {LIST_WIDTH}u, row / {LIST_WIDTH}u), 0);")
        })
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
        match self.name {
            "spectra" => wgpu::TextureFormat::Rgba32Float,
            _ => wgpu::TextureFormat::Rgba32Uint,
        }
    }
}
