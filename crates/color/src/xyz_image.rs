//! An image of colors without their spectra.

use rayon::prelude::*;
use spectra::{Observer, SpectralImage};

use crate::BandWeights;

/// XYZ per pixel, row 0 on top: what developing needs of a spectral image.
#[derive(Clone, Debug, PartialEq)]
pub struct XyzImage {
    width: u32,
    height: u32,
    xyz: Vec<[f32; 3]>,
}

impl XyzImage {
    /// An image of these colors, Y in cd/m² up to the scene's scale, row by row; `None` unless there are `width` × `height` of
    /// them.
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
    /// The colors that the bands of an image sum up to ([`BandWeights::observed`]). Those that the image carries are summed at the very
    /// wavelengths drawn, and are nearer to the truth.
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
