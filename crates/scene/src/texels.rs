//! Pictures with four numbers per texel, in a validated scene.

use std::fmt;

/// A grid of texels that both renderers look up.
///
/// A pixel has one or several texels. The texel of an RGB color is `[c₀, c₁, c₂, scale]`: a smooth spectrum
/// (`colorimetry::lifting::SigmoidReflectance`) and a factor.
#[derive(Clone, PartialEq)]
pub struct Texels {
    /// Number of pixels per row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Number of texels per pixel.
    pub per_pixel: u32,
    /// The rows from top to bottom.
    pub values: Vec<[f32; 4]>,
}

impl Texels {
    /// The texels of a pixel.
    pub fn at(&self, [column, row]: [u32; 2]) -> &[[f32; 4]] {
        let count = self.per_pixel as usize;
        let first = (row as usize * self.width as usize + column as usize) * count;
        &self.values[first..first + count]
    }
}

impl fmt::Debug for Texels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Texels({} × {})", self.width, self.height)
    }
}
