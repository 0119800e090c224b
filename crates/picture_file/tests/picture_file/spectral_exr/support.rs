//! Images to write.

use std::ops::Range;
use std::path::{Path, PathBuf};

use pellicle_picture_file::spectral_exr::{self, Metadata, WriteOptions};
use spectra::{BandGrid, ImageLayer, SpectralImage, Values};

/// A pseudorandom number in [0, 1) from an index.
pub(crate) fn noise(index: u32) -> f32 {
    let mut hash = index.wrapping_mul(0x9e37_79b9) ^ 0x85eb_ca6b;
    hash = (hash ^ (hash >> 15)).wrapping_mul(0x2c1b_3c6d);
    hash = (hash ^ (hash >> 12)).wrapping_mul(0x297a_2d39);
    ((hash ^ (hash >> 15)) >> 8) as f32 / 16_777_216.0
}

/// An image in which every number differs.
pub(crate) fn noisy(width: u32, height: u32, bands: u32) -> SpectralImage {
    let grid = BandGrid::visible(bands).unwrap();
    let mut image = SpectralImage::new(width, height, grid);
    for y in 0..height {
        for x in 0..width {
            let first = (y * width + x) * (2 * bands + 3);
            let values = |from: u32| (0..bands).map(|b| noise(from + b)).collect::<Vec<_>>();
            let xyz = [0, 1, 2].map(|i| 1e5 * noise(first + 2 * bands + i));
            let place = (x, y);
            image.set_pixel(
                place,
                &values(first),
                &values(first + bands),
                xyz,
                x + 7 * y,
            );
        }
    }
    image
}

pub(crate) fn metadata() -> Metadata {
    let mut metadata = Metadata {
        exposure_ev: -1.25,
        ..Metadata::default()
    };
    for (name, value) in [("seed", "42"), ("adapter", "Größe µ"), ("note", "")] {
        metadata.settings.insert(name.to_owned(), value.to_owned());
    }
    metadata
}

pub(crate) fn write_noisy(directory: &Path, variance: bool) -> (PathBuf, SpectralImage) {
    let path = directory.join("image.exr");
    // Neither side is a multiple of a block's 32 lines.
    let image = noisy(23, 37, 6);
    spectral_exr::write(&path, &image, &metadata(), WriteOptions { variance }).unwrap();
    (path, image)
}

/// Rows of an image as an image of their own.
pub(crate) fn rows_of(image: &SpectralImage, rows: Range<u32>) -> SpectralImage {
    let width = image.width() as usize;
    let (start, end) = (rows.start as usize * width, rows.end as usize * width);
    let bands = image.bands().count() as usize;
    let part = |layer: &ImageLayer| {
        let count = layer.values_per_pixel();
        let range = start * count..end * count;
        let values = match layer.values() {
            Values::Floats(values) => Values::Floats(values[range].to_vec()),
            Values::Counts(values) => Values::Counts(values[range].to_vec()),
        };
        ImageLayer::new(layer.key(), bands, values)
    };
    let layers = image.layers().iter().map(part).collect();
    let size = [image.width(), rows.end - rows.start];
    let groups = image.light_groups().to_vec();
    SpectralImage::from_layers(size, *image.bands(), groups, layers).unwrap()
}
