//! Pictures with four numbers in each place, in a validated scene.

use std::fmt;

/// Colors on a grid, as both renderers look them up.
///
/// A pixel is one texel or several. Of a color in RGB the texel is `[c₀, c₁, c₂, scale]`: a smooth spectrum
/// ([`SigmoidReflectance`](colorimetry::lifting::SigmoidReflectance)) and a factor.
#[derive(Clone, PartialEq)]
pub struct Texels {
    /// Pixels of a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Texels of a pixel.
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
