//! An image of colors without spectra.

use rayon::prelude::*;
use spectra::{Observer, SpectralImage};

use crate::BandWeights;

/// XYZ per pixel, with row 0 at the top: the part of a spectral image that developing needs.
#[derive(Clone, Debug, PartialEq)]
pub struct XyzImage {
    width: u32,
    height: u32,
    xyz: Vec<[f32; 3]>,
}

impl XyzImage {
    /// Creates an image from colors, row by row, with Y in cd/m² up to the scene's scale; `None` unless there are `width` ×
    /// `height` colors.
    pub fn new(width: u32, height: u32, xyz: Vec<[f32; 3]>) -> Option<Self> {
        (xyz.len() == width as usize * height as usize).then_some(Self { width, height, xyz })
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// XYZ of each pixel, row by row; Y in cd/m² up to the scene's scale.
    pub fn xyz(&self) -> &[[f32; 3]] {
        &self.xyz
    }
}

impl XyzImage {
    /// Computes the colors from the bands of an image ([`BandWeights::observed`]). The colors that the image holds were summed at the
    /// sampled wavelengths themselves and are more accurate.
    pub fn of_bands(image: &SpectralImage) -> Self {
        let observer = BandWeights::observed(image.bands(), Observer::Cie1931Deg2);
        let bands = image.bands().count() as usize;
        let pixels = image.radiance().par_chunks_exact(bands);
        Self {
            width: image.width(),
            height: image.height(),
            xyz: pixels
                .map(|radiance| observer.xyz(radiance).map(|v| v as f32))
                .collect(),
        }
    }
}

impl From<&SpectralImage> for XyzImage {
    fn from(image: &SpectralImage) -> Self {
        Self {
            width: image.width(),
            height: image.height(),
            xyz: image.xyz().to_vec(),
        }
    }
}
