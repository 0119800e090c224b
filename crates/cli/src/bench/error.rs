//! `pellicle bench --error`: seconds to a picture with a given error, for comparison with another renderer.

use crate::print;
use miette::IntoDiagnostic;
use pellicle::Renderer;
use pellicle::convergence::{self, error_between_seeds};
use pellicle::reference::SimdLevel;
use pellicle::scene_file::SceneFile;
use pellicle::spectra::SpectralImage;
use serde_json::json;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The largest number of samples per pixel that is tried.
const MAX_SAMPLES: u32 = 16_384;
/// The factor by which the samples increase from one measurement to the next.
const STEP: u32 = 4;

/// The requested measurement.
pub(super) struct Wanted {
    /// The error, as [`convergence`] defines it.
    pub(super) error: f64,
    pub(super) seeds: u32,
    pub(super) as_json: bool,
    pub(super) allow_outside: bool,
}

/// The measurements of a scene.
struct Measured {
    scene: String,
    bands: u32,
    pixels: u64,
    start_up_s: f64,
    /// One step for each number of samples.
    steps: Vec<Step>,
}

/// The renders with one number of samples.
struct Step {
    samples: u32,
    /// Seconds for one picture.
    seconds: f64,
    error: convergence::Error,
}

impl Measured {
    fn seconds_to(&self, error: f64) -> Option<f64> {
        let measured: Vec<_> = self
            .steps
            .iter()
            .map(|s| (s.seconds, s.error.mean))
            .collect();
        convergence::seconds_to(error, &measured)
    }

    /// Samples per second of the longest render.
    fn samples_per_second(&self) -> f64 {
        self.steps.last().map_or(0.0, |step| {
            self.pixels as f64 * f64::from(step.samples) / step.seconds
        })
    }

    fn json(&self, wanted: &Wanted) -> serde_json::Value {
        let step = |step: &Step| {
            json!({
                "samples": step.samples,
                "seconds": step.seconds,
                "error": step.error.mean,
                "error_of_worst_band": step.error.worst,
            })
        };
        json!({
            "scene": self.scene,
            "bands": self.bands,
            "pixels": self.pixels,
            "start_up_s": self.start_up_s,
            "samples_per_s": self.samples_per_second(),
            "seconds_to_error": self.seconds_to(wanted.error),
            "measured": self.steps.iter().map(step).collect::<Vec<_>>(),
        })
    }
}

/// Measures and prints a table or JSON.
pub(super) fn run(scenes: &[PathBuf], renderer: &Renderer, wanted: &Wanted) -> miette::Result<()> {
    let mut all = Vec::new();
    for path in scenes {
        print::note(format_args!("measuring {}", path.display()));
        all.push(measure(path, renderer, wanted)?);
    }
    if wanted.as_json {
        let of_all: Vec<_> = all.iter().map(|of| of.json(wanted)).collect();
        let report = json!({
            "renderer": renderer.description(),
            "processor": processor(),
            "threads": threads(),
            "instructions": SimdLevel::best().name(),
            "version": env!("CARGO_PKG_VERSION"),
            "commit": env!("PELLICLE_COMMIT"),
            "error": wanted.error,
            "seeds": wanted.seeds,
            "peak_memory_bytes": peak_memory_bytes(),
            "scenes": of_all,
        });
        let text = serde_json::to_string_pretty(&report).into_diagnostic()?;
        return print::result(format_args!("{text}"));
    }
    table(&all, renderer, wanted)
}

fn table(all: &[Measured], renderer: &Renderer, wanted: &Wanted) -> miette::Result<()> {
    print::result(format_args!("{}", renderer.description()))?;
    print::result(format_args!(
        "{}, {} threads, {}; pellicle {} ({})",
        processor().unwrap_or_else(|| "unknown processor".to_owned()),
        threads(),
        SimdLevel::best().name(),
        env!("CARGO_PKG_VERSION"),
        env!("PELLICLE_COMMIT"),
    ))?;
    let percent = 100.0 * wanted.error;
    print::result(format_args!(
        "\n{:<16}{:>8}{:>14}{:>18}{:>14}",
        "scene",
        "bands",
        format!("s to {percent} %"),
        "million samples/s",
        "start-up, s"
    ))?;
    for of in all {
        print::result(format_args!(
            "{:<16}{:>8}{:>14}{:>18.3}{:>14.2}",
            of.scene,
            of.bands,
            of.seconds_to(wanted.error)
                .map_or_else(String::new, |s| format!("{s:.3}")),
            of.samples_per_second() * 1e-6,
            of.start_up_s,
        ))?;
    }
    if let Some(bytes) = peak_memory_bytes() {
        let megabytes = bytes as f64 * 1e-6;
        print::result(format_args!(
            "\npeak memory {megabytes:.0} MB, including the pictures of {} seeds",
            wanted.seeds
        ))?;
    }
    Ok(())
}

fn measure(path: &Path, renderer: &Renderer, wanted: &Wanted) -> miette::Result<Measured> {
    let started = Instant::now();
    let mut file = SceneFile::read(path)?.allow_outside(wanted.allow_outside);
    file.description.render.samples = 1;
    let first = timed(renderer, &file)?.0;
    let mut measured = Measured {
        scene: path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned(),
        bands: first.bands().count(),
        pixels: u64::from(first.width()) * u64::from(first.height()),
        start_up_s: started.elapsed().as_secs_f64(),
        steps: Vec::new(),
    };
    let mut samples = 1;
    while samples <= MAX_SAMPLES {
        let mut images = Vec::new();
        let mut seconds = 0.0;
        for seed in 0..wanted.seeds {
            let render = &mut file.description.render;
            (render.samples, render.seed) = (samples, seed);
            let (image, took) = timed(renderer, &file)?;
            images.push(image);
            seconds += took;
        }
        let error = error_between_seeds(&images);
        let seconds = seconds / f64::from(wanted.seeds);
        measured.steps.push(Step {
            samples,
            seconds,
            error,
        });
        if error.mean <= wanted.error {
            break;
        }
        samples *= STEP;
    }
    Ok(measured)
}

/// A picture, and the seconds that it took to render.
fn timed(renderer: &Renderer, file: &SceneFile) -> miette::Result<(SpectralImage, f64)> {
    let scene = file.validate()?;
    let started = Instant::now();
    let image = renderer
        .render(&scene, &mut |_| ControlFlow::Continue(()))
        .into_diagnostic()?;
    Ok((image, started.elapsed().as_secs_f64()))
}

fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// The name of the processor, if the system reports it.
fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// The peak memory of this process, if the system reports it.
fn peak_memory_bytes() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kilobytes * 1024)
}
