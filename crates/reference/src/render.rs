//! A whole picture.

use crate::radiance;
use rayon::prelude::*;
use scene::{LightSource, Scene};
use spectra::{KM_LUMENS_PER_WATT, SpectralImage};
use std::ops::ControlFlow;
use thiserror::Error;

/// The caller asked to stop.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("stopped before the picture was finished")]
pub struct Stopped;

/// Renders a scene on all cores, some rows at a time.
///
/// `on_progress` is told the samples taken so far (of width × height × samples per pixel), and may stop the render.
///
/// # Errors
/// [`Stopped`] when the caller stops it.
pub fn render(
    scene: &Scene,
    on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
) -> Result<SpectralImage, Stopped> {
    let settings = scene.settings();
    let lights = scene.light_sources();
    let (width, height) = (settings.width, settings.height);
    let light_groups = scene.light_groups().to_vec();
    let mut image = SpectralImage::with_light_groups(width, height, settings.bands, light_groups);
    let pixels = |y| (0..settings.width).map(move |x| [x, y]);
    let rows_at_once = 4 * rayon::current_num_threads() as u32;
    let mut done = 0;
    for first in (0..settings.height).step_by(rows_at_once as usize) {
        let rows = first..(first + rows_at_once).min(settings.height);
        let pixels: Vec<_> = rows.flat_map(pixels).collect();
        let rendered: Vec<_> = pixels
            .into_par_iter()
            .map(|pixel| (pixel, Pixel::rendered(scene, &lights, pixel)))
            .collect();
        done += rendered.len() as u64 * u64::from(settings.samples);
        for ([x, y], pixel) in rendered {
            pixel.store(&mut image, (x, y), settings.samples);
        }
        if on_progress(done).is_break() {
            return Err(Stopped);
        }
    }
    Ok(image)
}

/// The running means of a pixel's samples, and the sum of squared differences of the light of all groups together.
struct Pixel {
    /// Of each light group.
    means: Vec<Mean>,
    total: Vec<f64>,
    deviation: Vec<f64>,
}

/// The mean of a light group.
#[derive(Clone)]
struct Mean {
    radiance: Vec<f64>,
    xyz: [f64; 3],
}

impl Pixel {
    fn rendered(scene: &Scene, lights: &[LightSource], pixel: [u32; 2]) -> Self {
        let grid = &scene.settings().bands;
        let bands = grid.count() as usize;
        let mut sum = Self::dark(bands, scene.light_groups().len());
        let samples = scene.settings().samples;
        for sample in 0..samples {
            let path = radiance(scene, lights, pixel, sample);
            for band in 0..bands {
                let value: f64 = path.radiance.iter().map(|group| group[band]).sum();
                let before = value - sum.total[band];
                sum.total[band] += before / f64::from(sample + 1);
                sum.deviation[band] += before * (value - sum.total[band]);
            }
            for (mean, values) in sum.means.iter_mut().zip(&path.radiance) {
                mean.add(scene, values, sample + 1, path.offset);
            }
        }
        let to_xyz = KM_LUMENS_PER_WATT * grid.width_nm() / f64::from(samples);
        for mean in &mut sum.means {
            mean.xyz = mean.xyz.map(|total| total * to_xyz);
        }
        sum
    }

    fn dark(bands: usize, light_groups: usize) -> Self {
        let mean = Mean {
            radiance: vec![0.0; bands],
            xyz: [0.0; 3],
        };
        Self {
            means: vec![mean; light_groups],
            total: vec![0.0; bands],
            deviation: vec![0.0; bands],
        }
    }

    fn store(&self, image: &mut SpectralImage, at: (u32, u32), samples: u32) {
        let n = f64::from(samples);
        let to_variance = if samples > 1 {
            1.0 / (n * (n - 1.0))
        } else {
            0.0
        };
        let means = self.means.iter();
        let radiance: Vec<f32> = means
            .flat_map(|mean| mean.radiance.iter().map(|&v| v as f32))
            .collect();
        let variance: Vec<f32> = self
            .deviation
            .iter()
            .map(|&v| (v * to_variance) as f32)
            .collect();
        let xyz: Vec<[f32; 3]> = self
            .means
            .iter()
            .map(|mean| mean.xyz.map(|v| v as f32))
            .collect();
        image.set_pixel_by_light(at, &radiance, &variance, &xyz, samples);
    }
}

impl Mean {
    /// Adds the light of the sample that makes them `count`; XYZ is summed.
    fn add(&mut self, scene: &Scene, values: &[f64], count: u32, offset: f64) {
        for (band, (mean, &value)) in self.radiance.iter_mut().zip(values).enumerate() {
            *mean += (value - *mean) / f64::from(count);
            for (total, observer) in self.xyz.iter_mut().zip(scene.observer()) {
                *total += value * observer.at(band as u32, offset);
            }
        }
    }
}
