//! Seconds from a spectral file to a picture.

use super::ROUNDS;
use crate::print;
use miette::IntoDiagnostic;
use pellicle::color::develop::{DevelopSettings, expose, gamut, quantize};
use pellicle::picture_file::png;
use pellicle::picture_file::spectral_exr::{self, Metadata, WriteOptions};
use pellicle::relight::XyzImage;
use pellicle::spectra::{BandGrid, SpectralImage};
use std::path::PathBuf;
use std::time::Instant;

const SIZE: [u32; 2] = [1920, 1080];
const BANDS: u32 = 40;

/// The steps that are timed, and whether each is needed to develop all bands, and to develop the file's own colors.
const STEPS: [(&str, bool, bool); 5] = [
    ("read every band", true, false),
    ("read the colors alone", false, true),
    ("sum the bands", true, false),
    ("develop", true, true),
    ("write the PNG", true, true),
];

/// Prints a table of the steps, with the best of several rounds.
pub(super) fn run() -> miette::Result<()> {
    let [width, height] = SIZE;
    print::result(format_args!(
        "\ndeveloping {width}×{height} pixels, {BANDS} bands; seconds, best of {ROUNDS} rounds"
    ))?;
    let files = Files::new();
    let image = films();
    let options = WriteOptions { variance: false };
    spectral_exr::write(&files.spectral, &image, &Metadata::default(), options)
        .into_diagnostic()?;
    drop(image);
    let mut best = [f64::INFINITY; STEPS.len()];
    for _ in 0..ROUNDS {
        for (best, seconds) in best.iter_mut().zip(round(&files)?) {
            *best = best.min(seconds);
        }
    }
    let total = |counts: fn(&(&str, bool, bool)) -> bool| -> f64 {
        let steps = STEPS.iter().zip(best);
        steps.filter(|(step, _)| counts(step)).map(|(_, s)| s).sum()
    };
    let totals = [total(|step| step.1), total(|step| step.2)];
    print::result(format_args!(
        "{:<24}{:>8}{:>18}{:>18}",
        "step", "seconds", "time, all bands", "time, colors"
    ))?;
    for ((name, in_all, in_colors), seconds) in STEPS.into_iter().zip(best) {
        let share = |counts: bool, total: f64| {
            if counts {
                format!("{:.0} %", 100.0 * seconds / total)
            } else {
                String::new()
            }
        };
        print::result(format_args!(
            "{name:<24}{seconds:>8.3}{:>18}{:>18}",
            share(in_all, totals[0]),
            share(in_colors, totals[1])
        ))?;
    }
    print::result(format_args!(
        "{:<24}{:>8}{:>16.3} s{:>16.3} s",
        "total", "", totals[0], totals[1]
    ))
}

/// The seconds of each step.
fn round(files: &Files) -> miette::Result<[f64; STEPS.len()]> {
    let mut clock = Instant::now();
    let mut lap = || {
        std::mem::replace(&mut clock, Instant::now())
            .elapsed()
            .as_secs_f64()
    };
    let (spectra, _) = spectral_exr::read(&files.spectral).into_diagnostic()?;
    let read = lap();
    let (_, _) = spectral_exr::read_xyz(&files.spectral).into_diagnostic()?;
    let read_colors = lap();
    let colors = XyzImage::of_bands(&spectra);
    let sum = lap();
    let settings = DevelopSettings::srgb(3.0);
    let mut linear = expose(&colors, &settings).into_diagnostic()?;
    gamut::map(&mut linear, &settings);
    let codes = quantize::codes::<u8>(&linear, &settings.display, settings.dither);
    let develop = lap();
    png::write_for_display(&files.picture, &codes, &settings.display).into_diagnostic()?;
    Ok([read, read_colors, sum, develop, lap()])
}

/// A wedge of soap film with noise, a third of it black: many of its colors lie outside sRGB.
fn films() -> SpectralImage {
    let [width, height] = SIZE;
    let grid = BandGrid::visible(BANDS).expect("the visible range has bands");
    let mut image = SpectralImage::new(width, height, grid);
    let waves: Vec<f32> = (0..BANDS)
        .map(|band| (4.0 * std::f64::consts::PI * 1.33 / grid.center_nm(band)) as f32)
        .collect();
    let mut random = 1_u32;
    let mut radiance = [0.0; BANDS as usize];
    let variance = [0.0; BANDS as usize];
    for y in 0..height {
        for x in width / 3..width {
            let thickness_nm = 100.0 + 0.5 * (x - width / 3) as f32 + 0.1 * y as f32;
            for (value, wave) in radiance.iter_mut().zip(&waves) {
                random = random.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
                let noise = 0.95 + 0.1 * (random >> 8) as f32 / (1 << 24) as f32;
                *value = 0.04 * noise * (1.0 - (wave * thickness_nm).cos());
            }
            let xyz = [radiance[21], radiance[17], radiance[7]].map(|v| 7e4 * v);
            image.set_pixel((x, y), &radiance, &variance, xyz, 1);
        }
    }
    image
}

/// Temporary files that are removed after the measurement.
struct Files {
    spectral: PathBuf,
    picture: PathBuf,
}

impl Files {
    fn new() -> Self {
        let named = |ending: &str| {
            let name = format!("pellicle-bench-{}.{ending}", std::process::id());
            std::env::temp_dir().join(name)
        };
        Self {
            spectral: named("exr"),
            picture: named("png"),
        }
    }
}

impl Drop for Files {
    fn drop(&mut self) {
        for path in [&self.spectral, &self.picture] {
            // It may never have been written.
            let _ = std::fs::remove_file(path);
        }
    }
}
