//! Campaigns for OpenEXR files of spectra and of colors.

use crate::radiance::surrounded;
use crate::scenes;
use crate::support::refused;
use colorimetry::Display;
use pellicle_fuzz::{Campaign, Outcome};
use picture_file::rgb_exr::{self, RgbFile, Samples};
use picture_file::spectral_exr::{self, Metadata, WriteOptions};
use spectra::{BandGrid, SpectralImage};
use std::fs;
use std::path::Path;

/// An image with a gradient, as a file.
fn spectral(folder: &Path, bands: u32, variance: bool) -> Vec<u8> {
    let grid = BandGrid::visible(bands).unwrap();
    let mut image = SpectralImage::new(4, 2, grid);
    for (x, y) in [(0, 0), (1, 0), (3, 1)] {
        let values: Vec<f32> = (0..bands).map(|band| 0.5 * (band + x + y) as f32).collect();
        image.set_pixel((x, y), &values, &values, [1.0, 2.0, 3.0], 4);
    }
    let path = folder.join("seed.exr");
    spectral_exr::write(
        &path,
        &image,
        &Metadata::default(),
        WriteOptions { variance },
    )
    .unwrap();
    fs::read(path).unwrap()
}

fn rgb(folder: &Path) -> Vec<u8> {
    let grid = BandGrid::visible(3).unwrap();
    let mut image = SpectralImage::new(4, 2, grid);
    image.set_pixel((1, 1), &[1.0, 0.5, 0.25], &[0.0; 3], [40.0, 50.0, 60.0], 4);
    let display = Display::named("srgb").unwrap();
    let linear = color::develop::expose(&image, &color::DevelopSettings::srgb(0.0)).unwrap();
    let path = folder.join("rgb.exr");
    rgb_exr::write(&path, &linear, &display, Samples::Half).unwrap();
    fs::read(path).unwrap()
}

/// The file with the four bytes `skip` bytes after a key replaced by `value`.
fn patched(bytes: &[u8], key: &[u8], skip: usize, value: i32) -> Vec<u8> {
    let at = bytes
        .windows(key.len())
        .position(|piece| piece == key)
        .unwrap()
        + key.len()
        + skip;
    let mut copy = bytes.to_vec();
    copy[at..at + 4].copy_from_slice(&value.to_le_bytes());
    copy
}

/// Files whose headers promise large data.
fn bombs(bytes: &[u8]) -> Vec<Vec<u8>> {
    let window = b"dataWindow\0box2i\0\x10\0\0\0";
    let shown = b"displayWindow\0box2i\0\x10\0\0\0";
    let mut files = Vec::new();
    for (x, y) in [
        (1 << 29, 1),
        (3, 1 << 29),
        (1 << 15, 1 << 15),
        (i32::MAX, i32::MAX),
        (-5, -5),
    ] {
        let data = patched(&patched(bytes, window, 8, x), window, 12, y);
        files.push(patched(&patched(&data, shown, 8, x), shown, 12, y));
        files.push(patched(&patched(bytes, shown, 8, x), shown, 12, y));
        files.push(data);
    }
    for size in [i32::MAX, -1, 1 << 28, 1 << 20] {
        files.push(patched(bytes, b"channels\0chlist\0", 0, size));
        files.push(patched(bytes, b"chromaticities\0chromaticities\0", 0, size));
    }
    files
}

fn read_spectral(path: &Path) -> Outcome {
    let (sizes, xyz) = (spectral_exr::read_size(path), spectral_exr::read_xyz(path));
    match spectral_exr::read(path) {
        Ok((image, _)) => {
            let size = [image.width(), image.height()];
            if sizes.is_err() || xyz.is_err() || size.contains(&0) {
                return Outcome::Unsound(format!("{size:?}; {:?}; {:?}", sizes.err(), xyz.err()));
            }
            let values = image.radiance().len() + image.variance().len();
            Outcome::Accepted {
                kept: 4 * values + 32 * image.samples().len(),
            }
        }
        Err(error) => refused(&error),
    }
}

fn read_rgb(path: &Path) -> Outcome {
    let file = match RgbFile::open(path, None) {
        Ok(file) => file,
        Err(error) => return refused(&error),
    };
    let [width, height] = file.size();
    // The callers check the size.
    if u64::from(width) * u64::from(height) > 1 << 26 {
        return Outcome::Refused("it is too large".to_owned());
    }
    match file.read() {
        Ok(pixels) if pixels.len() != width as usize * height as usize => {
            Outcome::Unsound(format!("{} pixels of {width} × {height}", pixels.len()))
        }
        Ok(pixels) => Outcome::Accepted {
            kept: pixels.len() * 12,
        },
        Err(error) => refused(&error),
    }
}

fn seeds(folder: &Path) -> Vec<Vec<u8>> {
    let spectral = [(2, true), (3, false), (9, true)]
        .map(|(bands, variance)| spectral(folder, bands, variance));
    [spectral.to_vec(), vec![rgb(folder)]].concat()
}

#[test]
fn spectral_exr_files() {
    let folder = tempfile::tempdir().unwrap();
    let mut seeds = seeds(folder.path());
    let bombs = bombs(&seeds[0]);
    seeds.extend(bombs);
    let path = folder.path().join("a.exr");
    let campaign = Campaign {
        seeds,
        ..Campaign::new("spectral_exr", 1000)
    };
    campaign.run(|bytes| {
        fs::write(&path, bytes).unwrap();
        read_spectral(&path)
    });
}

#[test]
fn rgb_exr_files() {
    let folder = tempfile::tempdir().unwrap();
    let rgb = rgb(folder.path());
    let mut seeds = bombs(&rgb);
    seeds.extend([rgb, spectral(folder.path(), 2, false)]);
    let path = folder.path().join("a.exr");
    let campaign = Campaign {
        seeds,
        ..Campaign::new("rgb_exr", 1000)
    };
    campaign.run(|bytes| {
        fs::write(&path, bytes).unwrap();
        read_rgb(&path)
    });
}

#[test]
fn exr_environment() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sky.exr");
    let text = surrounded("sky.exr");
    let campaign = Campaign {
        seeds: seeds(folder.path()),
        ..Campaign::new("exr_environment", 300)
    };
    campaign.run(|bytes| {
        fs::write(&path, bytes).unwrap();
        scenes::read(&text, folder.path())
    });
}
