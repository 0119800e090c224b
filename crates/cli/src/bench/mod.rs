//! `pellicle bench`: samples and stack evaluations per second on every adapter and on the CPU; seconds to a good picture, and for
//! developing.

mod develop;
mod error;
mod stacks;
mod variance;

use crate::print;
use clap::ValueEnum;
use miette::IntoDiagnostic;
use pellicle::gpu::{AdapterChoice, adapters};
use pellicle::scene::Scene;
use pellicle::scene_file::SceneFile;
use pellicle::{Backend, Renderer};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

#[derive(clap::Args)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is an option of its own"
)]
pub(crate) struct Arguments {
    /// The scenes to render [default: soap_bubble, film_wedge and metal_spheres in the folder `scenes` of the current folder; for
    /// --variance, floating_bubble instead of film_wedge; for --error, those of `scenes/bench`]
    scenes: Vec<PathBuf>,
    /// Allow scenes to refer to files outside their folders; use this only for scenes that you trust
    #[arg(long)]
    allow_outside: bool,
    /// Measure only film stacks, no scenes
    #[arg(long)]
    stacks: bool,
    /// Measure only developing a picture from a spectral file
    #[arg(long, conflicts_with = "stacks")]
    develop: bool,
    /// Measure only how much noise the ways of sampling paths leave, on the best GPU, or on the CPU if there is none
    #[arg(long, group = "repeated", conflicts_with_all = ["stacks", "develop"])]
    variance: bool,
    /// Measure only the seconds to a picture of 40 bands with this error in percent (docs/benchmark.md), on the CPU or on --adapter
    #[arg(
        long,
        value_name = "PERCENT",
        num_args = 0..=1,
        default_missing_value = "5",
        value_parser = percent,
        group = "repeated",
        conflicts_with_all = ["stacks", "develop", "variance"]
    )]
    error: Option<f64>,
    /// The adapter for --error, by a part of its name
    #[arg(long, value_name = "NAME", requires = "error")]
    adapter: Option<String>,
    /// Output format of --error
    #[arg(long, value_enum, default_value_t = Format::Table, requires = "error")]
    format: Format,
    /// Samples per pixel for --variance
    #[arg(long, default_value_t = 256, requires = "variance")]
    samples: u32,
    /// Number of renders of each kind [default: 8 for --variance, 3 for --error]
    #[arg(long, requires = "repeated", value_parser = clap::value_parser!(u32).range(2..))]
    seeds: Option<u32>,
    /// Approximate number of seconds of each measurement
    #[arg(long, default_value_t = 4.0)]
    seconds: f64,
}

impl Arguments {
    /// The scenes that were named, or else the given ones.
    fn scenes(&self, otherwise: [&str; 3]) -> Vec<PathBuf> {
        if self.scenes.is_empty() {
            return otherwise.map(PathBuf::from).to_vec();
        }
        self.scenes.clone()
    }
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    Table,
    Json,
}

fn percent(text: &str) -> Result<f64, String> {
    let percent: Option<f64> = text.parse().ok();
    let is_some_error = |p: &f64| *p > 0.0 && *p <= 100.0;
    let percent = percent.filter(is_some_error);
    percent.ok_or_else(|| "an error is a percentage above 0, up to 100".to_owned())
}

/// The scenes for samples per second.
const SCENES: [&str; 3] = [
    "scenes/soap_bubble.toml",
    "scenes/film_wedge.toml",
    "scenes/metal_spheres.toml",
];
/// The scenes for the variance: one side of a bubble, both sides of one, and metals.
const NOISY_SCENES: [&str; 3] = [
    "scenes/soap_bubble.toml",
    "scenes/floating_bubble.toml",
    "scenes/metal_spheres.toml",
];
/// The scenes for --error, as docs/benchmark.md describes them.
const COMPARED_SCENES: [&str; 3] = [
    "scenes/bench/bubble.toml",
    "scenes/bench/metals.toml",
    "scenes/bench/wedge.toml",
];
/// The numbers of bands that are compared.
const BANDS: [u32; 2] = [4, 40];
/// Number of rounds of a measurement. Machines are noisy, so the variants take turns and the best round of each counts.
const ROUNDS: usize = 3;

/// Measures and prints a table.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    if arguments.develop {
        return develop::run();
    }
    if arguments.variance {
        let renderer = Renderer::open(&Backend::Auto).into_diagnostic()?;
        let wanted = variance::Wanted {
            samples: arguments.samples,
            seeds: arguments.seeds.unwrap_or(8),
            allow_outside: arguments.allow_outside,
        };
        return variance::run(&arguments.scenes(NOISY_SCENES), &renderer, &wanted);
    }
    if let Some(percent) = arguments.error {
        let backend = match &arguments.adapter {
            Some(name) => Backend::Gpu(AdapterChoice::Named(name.clone())),
            None => Backend::Cpu,
        };
        let wanted = error::Wanted {
            error: percent / 100.0,
            seeds: arguments.seeds.unwrap_or(3),
            as_json: arguments.format == Format::Json,
            allow_outside: arguments.allow_outside,
        };
        let renderer = Renderer::open(&backend).into_diagnostic()?;
        return error::run(&arguments.scenes(COMPARED_SCENES), &renderer, &wanted);
    }
    let mut renderers = Vec::new();
    for adapter in adapters() {
        let choice = AdapterChoice::Named(adapter.info.name.clone());
        renderers.push(Renderer::open(&Backend::Gpu(choice)).into_diagnostic()?);
    }
    renderers.push(Renderer::open(&Backend::Cpu).into_diagnostic()?);
    for (index, renderer) in renderers.iter().enumerate() {
        print::result(format_args!("{}: {}", index + 1, renderer.description()))?;
    }
    let seconds = arguments.seconds.clamp(0.1, 600.0);
    if !arguments.stacks {
        scenes(arguments, &renderers, seconds)?;
    }
    stacks::run(&renderers, seconds / 4.0)
}

/// Prints a table of samples per second.
fn scenes(arguments: &Arguments, renderers: &[Renderer], seconds: f64) -> miette::Result<()> {
    print::result(format_args!("\nmillion samples/s, best of {ROUNDS} rounds"))?;
    print::result(format_args!(
        "{:<16}{:>10}{:>10}{:>10}{:>14}{:>18}",
        "scene", "renderer", "4 bands", "40 bands", "time 40 / 4", "40 bands to CPU"
    ))?;
    for path in arguments.scenes(SCENES) {
        let file = SceneFile::read(&path)?.allow_outside(arguments.allow_outside);
        let rates = measure(file, renderers, seconds)?;
        let on_cpu = rates[rates.len() - 1][1];
        for (index, [few, many]) in rates.iter().enumerate() {
            print::result(format_args!(
                "{:<16}{:>10}{few:>10.3}{many:>10.3}{:>14.2}{:>18.2}",
                path.file_stem().unwrap_or_default().to_string_lossy(),
                index + 1,
                few / many,
                many / on_cpu,
            ))?;
        }
    }
    Ok(())
}

/// Million samples per second of each renderer with each number of bands.
fn measure(
    mut file: SceneFile,
    renderers: &[Renderer],
    seconds: f64,
) -> miette::Result<Vec<[f64; 2]>> {
    let mut best = vec![[0.0_f64; 2]; renderers.len()];
    for _ in 0..ROUNDS {
        for (renderer, best) in renderers.iter().zip(&mut best) {
            for (bands, best) in BANDS.into_iter().zip(best) {
                file.description.render.bands = bands;
                *best = best.max(rate(renderer, &mut file, seconds)?);
            }
        }
    }
    Ok(best)
}

/// Million samples per second. Renders the whole picture, first with a sample per pixel to measure the speed, then with as many
/// as fill the time.
fn rate(renderer: &Renderer, file: &mut SceneFile, seconds: f64) -> miette::Result<f64> {
    file.description.render.samples = 1;
    let scene = file.validate()?;
    let first = timed(renderer, &scene)?;
    let pixels = f64::from(scene.settings().width) * f64::from(scene.settings().height);
    let samples = (seconds * first / pixels).ceil().clamp(2.0, 4096.0);
    file.description.render.samples = samples as u32;
    Ok(timed(renderer, &file.validate()?)? * 1e-6)
}

/// Samples per second of a whole render, including the readback, from the end of the first batch: the time before it is spent
/// on compilation.
fn timed(renderer: &Renderer, scene: &Scene) -> miette::Result<f64> {
    let begun = Instant::now();
    let mut first: Option<(Instant, u64)> = None;
    let mut total = 0;
    renderer
        .render(scene, &mut |done| {
            if done > 0 {
                first.get_or_insert((Instant::now(), done));
            }
            total = done;
            ControlFlow::Continue(())
        })
        .into_diagnostic()?;
    // After a single batch there is nothing left to measure: then the whole render counts.
    let (start, before) = first.filter(|first| first.1 < total).unwrap_or((begun, 0));
    Ok((total - before) as f64 / start.elapsed().as_secs_f64())
}
