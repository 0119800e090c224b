//! Pictures of linear red, green and blue.

use rayon::prelude::*;

/// Linear red, green and blue of a display per pixel, 1 for its white; values may be below 0 and above 1. Row 0 is at the top.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearImage {
    width: u32,
    height: u32,
    rgb: Vec<[f32; 3]>,
    white_cd_m2: f64,
}

impl LinearImage {
    /// Creates a picture from amounts, row by row, and the luminance in the scene that becomes the display's white; `None` unless there
    /// are `width` × `height` pixels.
    pub fn new(width: u32, height: u32, rgb: Vec<[f32; 3]>, white_cd_m2: f64) -> Option<Self> {
        (rgb.len() == width as usize * height as usize).then_some(Self {
            width,
            height,
            rgb,
            white_cd_m2,
        })
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The amounts of each pixel, row by row.
    pub fn rgb(&self) -> &[[f32; 3]] {
        &self.rgb
    }

    /// The amounts of each pixel, row by row, to be changed.
    pub fn rgb_mut(&mut self) -> &mut [[f32; 3]] {
        &mut self.rgb
    }

    /// Number of pixels that are not finite.
    pub fn not_finite(&self) -> usize {
        let pixels = self.rgb.par_iter();
        pixels
            .filter(|rgb| !rgb.iter().all(|v| v.is_finite()))
            .count()
    }

    /// The luminance in the scene that becomes the display's white, cd/m² up to the scene's scale.
    pub fn white_cd_m2(&self) -> f64 {
        self.white_cd_m2
    }

    /// Replaces each pixel, given its position, on all cores.
    pub fn map(&mut self, change: impl Fn([usize; 2], [f64; 3]) -> [f64; 3] + Sync) {
        let width = (self.width as usize).max(1);
        let rows = self.rgb.par_chunks_mut(width).enumerate();
        rows.for_each(|(y, row)| {
            for (x, pixel) in row.iter_mut().enumerate() {
                *pixel = change([x, y], pixel.map(f64::from)).map(|v| v as f32);
            }
        });
    }
}
