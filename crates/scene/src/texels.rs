//! Pictures with four numbers in each place, in a validated scene.

use std::fmt;

/// Colours on a grid, as both renderers look them up.
///
/// A pixel is one texel or several. Of a colour in RGB the texel is `[c₀, c₁, c₂, scale]`: a smooth spectrum
/// ([`SigmoidReflectance`](colorimetry::lifting::SigmoidReflectance)) and a factor.
#[derive(Clone, PartialEq)]
pub struct Texels {
    /// Pixels of a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The rows from top to bottom.
    pub values: Vec<[f32; 4]>,
}

impl Texels {
    /// The texel of a pixel of one texel.
    pub fn at(&self, column: u32, row: u32) -> [f32; 4] {
        self.values[row as usize * self.width as usize + column as usize]
    }
}

impl fmt::Debug for Texels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Texels({} × {})", self.width, self.height)
    }
}
