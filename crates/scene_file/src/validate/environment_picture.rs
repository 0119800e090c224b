//! Pictures of the environment: from files to texels and a direction table.

use super::checks::Checks;
use super::picture_file::{PanoramaFile, PictureFileError, read_panorama};
use crate::limits;
use colorimetry::lifting::{Lifting, SigmoidReflectance};
use document::{FieldPath, Problem, ProblemKind, Shown};
use glam::DVec3;
use rayon::prelude::*;
use scene::{DirectionTable, Sampled};
use scene::{EnvironmentPicture, PictureSpectra, Texels};
use spectra::{BandGrid, SpectralImage};
use std::path::Path;
use thiserror::Error;

/// A picture of all directions as read from a file.
pub(super) struct Sphere {
    pub(super) texels: Texels,
    pub(super) spectra: PictureSpectra,
    /// Mean radiance over wavelength of each pixel.
    pub(super) brightness: Vec<f32>,
}

impl Sphere {
    /// The picture with its center rotated from −Z by an angle.
    pub(super) fn turned(self, rotation_deg: f64, sampled: Sampled) -> EnvironmentPicture {
        let (sine, cosine) = rotation_deg.to_radians().sin_cos();
        let size = [self.texels.width, self.texels.height];
        let (table, sampled_mean) = DirectionTable::new(size, &self.brightness, sampled);
        EnvironmentPicture {
            texels: self.texels,
            spectra: self.spectra,
            forward: DVec3::new(-sine, 0.0, -cosine),
            right: DVec3::new(cosine, 0.0, -sine),
            sampled_mean,
            table,
        }
    }
}

/// Reads a picture of all directions, from the given layer if the file has several.
pub(super) fn read(
    checks: &mut Checks,
    field: &FieldPath,
    (file, layer): (&Path, Option<&str>),
    grid: Option<BandGrid>,
) -> Option<Sphere> {
    let path = checks.path(field, file)?;
    let grid = grid?;
    let mut notes = Vec::new();
    let found = read_panorama(&path, layer, &grid, &mut notes);
    for note in notes {
        checks.note(field, format_args!("{}: {note}", file.display()));
    }
    let message = match found {
        Ok(PanoramaFile::Colors { width, rgb }) => match lifted(width, &rgb) {
            Ok(sphere) => return Some(sphere),
            Err(pixel) => format!("{}: {pixel}", path.display()),
        },
        Ok(PanoramaFile::Spectra(image)) => match resampled(&image, &grid) {
            Ok(sphere) => return Some(sphere),
            Err(pixel) => format!("{}: {pixel}", path.display()),
        },
        // The message already names the file.
        Err(PictureFileError::Exr(message)) => message,
        Err(error) => format!("{}: {error}", path.display()),
    };
    checks.report(Problem::new(ProblemKind::File, field, message));
    None
}

/// A pixel whose value is not a radiance.
#[derive(Debug, Error)]
#[error(
    "the pixel in column {column} of row {row}, counted from 1, has a value of {}; it must be a number of at most {}",
    Shown(shortest(*value)), Shown(limits::EMISSION.high)
)]
struct BadPixel {
    column: usize,
    row: usize,
    value: f32,
}

/// The shortest decimal number that rounds to this one in `f32`.
fn shortest(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(f64::NAN)
}

/// Checks all values, `per_pixel` for each pixel.
fn check_pixels(values: &[f32], per_pixel: usize, width: u32) -> Result<(), BadPixel> {
    let is_sound = |value: f32| value.is_finite() && f64::from(value) <= limits::EMISSION.high;
    match values.iter().position(|&value| !is_sound(value)) {
        None => Ok(()),
        Some(index) => Err(BadPixel {
            column: index / per_pixel % width as usize + 1,
            row: index / per_pixel / width as usize + 1,
            value: values[index],
        }),
    }
}

/// Colors as smooth spectra: each is a factor, twice its largest component, times a reflectance of at most one half, which is smoother than
/// a higher one would be.
fn lifted(width: u32, rgb: &[[f32; 3]]) -> Result<Sphere, BadPixel> {
    check_pixels(rgb.as_flattened(), 3, width)?;
    let fill_row = |(texels, row): (&mut [[f32; 4]], &[[f32; 3]])| {
        let mut lifting = Lifting::default();
        for (texel, color) in texels.iter_mut().zip(row) {
            let color = color.map(|value| f64::from(value.max(0.0)));
            let scale = 2.0 * color.into_iter().fold(0.0, f64::max);
            let reflectance = if scale > 0.0 {
                lifting.next(color.map(|value| value / scale))
            } else {
                SigmoidReflectance::default()
            };
            let [c0, c1, c2] = reflectance.coefficients;
            *texel = [c0, c1, c2, scale].map(|value| value as f32);
        }
    };
    // Filled in place: a picture may have many pixels.
    let mut values = vec![[0.0; 4]; rgb.len()];
    let rows = rgb.par_chunks(width as usize);
    let texels = values.par_chunks_mut(width as usize);
    texels.zip(rows).for_each(fill_row);
    let brightness = rgb.iter().map(|color| {
        let sum: f32 = color.iter().map(|value| value.max(0.0)).sum();
        sum / 3.0
    });
    Ok(Sphere {
        texels: Texels {
            width,
            height: (rgb.len() / width as usize) as u32,
            per_pixel: 1,
            values,
        },
        spectra: PictureSpectra::Smooth,
        brightness: brightness.collect(),
    })
}

/// Spectra as means over the bands of a grid, which the picture's bands cover.
fn resampled(image: &SpectralImage, grid: &BandGrid) -> Result<Sphere, BadPixel> {
    let own = image.bands();
    check_pixels(image.radiance(), own.count() as usize, image.width())?;
    let weights: Vec<Vec<(usize, f32)>> = (0..grid.count())
        .map(|band| overlaps(own, grid, band))
        .collect();
    let count = own.count() as usize;
    let pixels: Vec<Vec<f32>> = image
        .radiance()
        .par_chunks(count)
        .map(|own| {
            let mean = |weights: &Vec<(usize, f32)>| {
                weights.iter().map(|&(i, w)| own[i].max(0.0) * w).sum()
            };
            weights.iter().map(mean).collect()
        })
        .collect();
    Ok(banded(image.width(), image.height(), &pixels))
}

/// A picture from the bands of each pixel.
pub(super) fn banded(width: u32, height: u32, pixels: &[Vec<f32>]) -> Sphere {
    let of_pixel = |bands: &Vec<f32>| {
        let last = bands.last().copied().unwrap_or_default();
        let groups = bands.chunks(4);
        groups
            .map(|group| std::array::from_fn(|lane| group.get(lane).copied().unwrap_or(last)))
            .collect::<Vec<[f32; 4]>>()
    };
    let mean = |bands: &Vec<f32>| bands.iter().sum::<f32>() / bands.len().max(1) as f32;
    Sphere {
        texels: Texels {
            width,
            height,
            per_pixel: pixels.first().map_or(0, |bands| bands.len().div_ceil(4)) as u32,
            values: pixels.iter().flat_map(of_pixel).collect(),
        },
        spectra: PictureSpectra::Bands,
        brightness: pixels.iter().map(mean).collect(),
    }
}

/// The bands of `own` that overlap a band of `grid`, each with the fraction of the band that it covers.
fn overlaps(own: &BandGrid, grid: &BandGrid, band: u32) -> Vec<(usize, f32)> {
    let ends =
        |grid: &BandGrid, band: u32| (grid.wavelength_nm(band, 0.0), grid.wavelength_nm(band, 1.0));
    let (low, high) = ends(grid, band);
    let share = |index: u32| {
        let (own_low, own_high) = ends(own, index);
        let width = own_high.min(high) - own_low.max(low);
        (width > 0.0).then_some((index as usize, (width / (high - low)) as f32))
    };
    (0..own.count()).filter_map(share).collect()
}
