//! A whole picture.

use crate::radiance;
use rayon::prelude::*;
use scene::Scene;
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
    let lights = scene.lights();
    let mut image = SpectralImage::new(settings.width, settings.height, settings.bands);
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

/// The running mean and the sum of squared differences of a pixel's samples.
struct Pixel {
    mean: Vec<f64>,
    deviation: Vec<f64>,
    xyz: [f64; 3],
}

impl Pixel {
    fn rendered(scene: &Scene, lights: &[usize], pixel: [u32; 2]) -> Self {
        let grid = &scene.settings().bands;
        let bands = grid.count() as usize;
        let mut sum = Self {
            mean: vec![0.0; bands],
            deviation: vec![0.0; bands],
            xyz: [0.0; 3],
        };
        let samples = scene.settings().samples;
        for sample in 0..samples {
            let path = radiance(scene, lights, pixel, sample);
            for (band, &value) in path.radiance.iter().enumerate() {
                let before = value - sum.mean[band];
                sum.mean[band] += before / f64::from(sample + 1);
                sum.deviation[band] += before * (value - sum.mean[band]);
                for (total, observer) in sum.xyz.iter_mut().zip(scene.observer()) {
                    *total += value * observer.at(band as u32, path.offset);
                }
            }
        }
        let to_xyz = KM_LUMENS_PER_WATT * grid.width_nm() / f64::from(samples);
        sum.xyz = sum.xyz.map(|total| total * to_xyz);
        sum
    }

    fn store(&self, image: &mut SpectralImage, at: (u32, u32), samples: u32) {
        let n = f64::from(samples);
        let to_variance = if samples > 1 {
            1.0 / (n * (n - 1.0))
        } else {
            0.0
        };
        let radiance: Vec<f32> = self.mean.iter().map(|&v| v as f32).collect();
        let variance: Vec<f32> = self
            .deviation
            .iter()
            .map(|&v| (v * to_variance) as f32)
            .collect();
        image.set_pixel(
            at,
            &radiance,
            &variance,
            self.xyz.map(|v| v as f32),
            samples,
        );
    }
}
