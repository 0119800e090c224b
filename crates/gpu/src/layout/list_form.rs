//! The forms in which lists are bound.

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
    /// Returns the declaration of a list's variable in WGSL.
    pub(crate) fn variable(self, name: &str, row: &str) -> String {
        match self {
            Self::Storage => format!("var<storage, read> {name}: array<{row}>"),
            Self::Uniform => {
                let count = UNIFORM_BYTES / 16;
                format!("var<uniform> {name}: array<{row}, {count}>")
            }
            Self::Texture => {
                let word = if row == "vec4u" { "u32" } else { "f32" };
                format!("var {name}: texture_2d<{word}>")
            }
        }
    }

    /// Returns the value of the list's row `row` in WGSL.
    pub(crate) fn row(self, name: &str) -> String {
        match self {
            Self::Storage | Self::Uniform => format!("{name}[row]"),
            Self::Texture => {
                format!("textureLoad({name}, vec2u(row % LIST_WIDTH, row / LIST_WIDTH), 0)")
            }
        }
    }
}
