//! Spectral images that the tests make.

use picture_file::spectral_exr::{self, Metadata, WriteOptions};
use relight::BandWeights;
use spectra::{BandGrid, Observer, SpectralImage};
use std::path::Path;

/// An image with the spectra that `radiance` returns for each pixel, and a deviation of 1 %.
pub(crate) fn image(
    size: [u32; 2],
    bands: u32,
    radiance: impl Fn(u32, u32) -> Vec<f32>,
) -> SpectralImage {
    let grid = BandGrid::visible(bands).unwrap();
    let observer = BandWeights::observed(&grid, Observer::Cie1931Deg2);
    let mut image = SpectralImage::new(size[0], size[1], grid);
    for y in 0..size[1] {
        for x in 0..size[0] {
            let values = radiance(x, y);
            let variance: Vec<f32> = values.iter().map(|v| (0.01 * v).powi(2)).collect();
            let xyz = observer.xyz(&values).map(|v| v as f32);
            image.set_pixel((x, y), &values, &variance, xyz, 16);
        }
    }
    image
}

pub(crate) fn write(path: &Path, image: &SpectralImage) {
    let metadata = Metadata::default();
    spectral_exr::write(path, image, &metadata, WriteOptions::default()).unwrap();
}

/// Radiance 0.2 everywhere; at `odd` it is 1.5 times that in the first half of the bands.
pub(crate) fn gray(size: [u32; 2], bands: u32, odd: Option<(u32, u32)>) -> SpectralImage {
    image(size, bands, |x, y| {
        let bright = if odd == Some((x, y)) { 1.5 } else { 1.0 };
        let value = |band| 0.2 * if band < bands / 2 { bright } else { 1.0 };
        (0..bands).map(value).collect()
    })
}
