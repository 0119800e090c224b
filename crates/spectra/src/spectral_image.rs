//! What a renderer produces: radiance per pixel and band.

use crate::BandGrid;

/// Radiance per pixel and band, with its uncertainty and its colour.
///
/// Row 0 is on top. Per-band data is pixel-major: the value of band `b` at (x, y) stands at
/// `(y·width + x)·bands + b`.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectralImage {
    width: u32,
    height: u32,
    bands: BandGrid,
    radiance: Vec<f32>,
    variance: Vec<f32>,
    xyz: Vec<[f32; 3]>,
    samples: Vec<u32>,
}

impl SpectralImage {
    /// A black image without samples.
    pub fn new(width: u32, height: u32, bands: BandGrid) -> Self {
        let pixels = width as usize * height as usize;
        let values = pixels * bands.count() as usize;
        Self {
            width,
            height,
            bands,
            radiance: vec![0.0; values],
            variance: vec![0.0; values],
            xyz: vec![[0.0; 3]; pixels],
            samples: vec![0; pixels],
        }
    }

    /// Bytes that an image of this size takes in memory.
    pub fn bytes(width: u32, height: u32, bands: u32) -> u128 {
        let per_pixel = u128::from(bands) * 8 + 12 + 4;
        u128::from(width) * u128::from(height) * per_pixel
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The bands that each pixel has.
    pub fn bands(&self) -> &BandGrid {
        &self.bands
    }

    /// Mean radiance over each band, W m⁻² sr⁻¹ nm⁻¹ up to the scene's scale; pixel-major.
    pub fn radiance(&self) -> &[f32] {
        &self.radiance
    }

    /// Variance of the mean of each value of [`Self::radiance`]; 0 where fewer than two samples were taken.
    pub fn variance(&self) -> &[f32] {
        &self.variance
    }

    /// CIE 1931 2° XYZ of each pixel, summed at the very wavelengths drawn: Y in cd/m² up to the scene's scale.
    pub fn xyz(&self) -> &[[f32; 3]] {
        &self.xyz
    }

    /// Number of samples of each pixel.
    pub fn samples(&self) -> &[u32] {
        &self.samples
    }

    /// The spectrum of pixel (x, y), a value per band.
    ///
    /// # Panics
    /// When the pixel lies outside the image.
    pub fn pixel(&self, x: u32, y: u32) -> &[f32] {
        &self.radiance[self.values_of(x, y)]
    }

    /// Writes pixel (x, y): the mean and the variance of the mean per band, XYZ and sample count.
    ///
    /// # Panics
    /// When the pixel lies outside the image or a slice has not one value per band.
    pub fn set_pixel(
        &mut self,
        (x, y): (u32, u32),
        radiance: &[f32],
        variance: &[f32],
        xyz: [f32; 3],
        samples: u32,
    ) {
        let values = self.values_of(x, y);
        self.radiance[values.clone()].copy_from_slice(radiance);
        self.variance[values].copy_from_slice(variance);
        let pixel = self.pixel_index(x, y);
        self.xyz[pixel] = xyz;
        self.samples[pixel] = samples;
    }

    fn pixel_index(&self, x: u32, y: u32) -> usize {
        assert!(
            x < self.width && y < self.height,
            "pixel ({x}, {y}) lies outside the image of {}×{}",
            self.width,
            self.height
        );
        y as usize * self.width as usize + x as usize
    }

    fn values_of(&self, x: u32, y: u32) -> std::ops::Range<usize> {
        let bands = self.bands.count() as usize;
        let start = self.pixel_index(x, y) * bands;
        start..start + bands
    }
}
