//! `pellicle bench`: samples per second on every adapter and on the CPU.

use miette::IntoDiagnostic;
use pellicle::gpu::{AdapterChoice, adapters};
use pellicle::scene::{Scene, SceneFile};
use pellicle::{Backend, Renderer};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scenes to render
    #[arg(default_values = ["scenes/soap_bubble.toml", "scenes/film_wedge.toml", "scenes/metal_spheres.toml"])]
    scenes: Vec<PathBuf>,
    /// Seconds that each measurement takes at least
    #[arg(long, default_value_t = 2.0)]
    seconds: f64,
}

/// The numbers of bands that are compared.
const BANDS: [u32; 2] = [4, 40];
/// Rounds of the measurement: machines are noisy, so the variants take turns and the best round of each counts.
const ROUNDS: usize = 3;

/// Measures and prints a table.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    let mut renderers = Vec::new();
    for adapter in adapters() {
        let choice = AdapterChoice::Named(adapter.info.name.clone());
        renderers.push(Renderer::open(&Backend::Gpu(choice)).into_diagnostic()?);
    }
    renderers.push(Renderer::open(&Backend::Cpu).into_diagnostic()?);
    for (index, renderer) in renderers.iter().enumerate() {
        println!("{}: {}", index + 1, renderer.description());
    }
    println!("\nmillion samples/s, best of {ROUNDS} rounds");
    println!(
        "{:<16}{:>10}{:>10}{:>10}{:>14}{:>18}",
        "scene", "renderer", "4 bands", "40 bands", "time 40 / 4", "40 bands to CPU"
    );
    for path in &arguments.scenes {
        let rates = measure(path, &renderers, arguments.seconds / ROUNDS as f64)?;
        let on_cpu = rates[rates.len() - 1][1];
        for (index, [few, many]) in rates.iter().enumerate() {
            println!(
                "{:<16}{:>10}{few:>10.3}{many:>10.3}{:>14.2}{:>18.2}",
                path.file_stem().unwrap_or_default().to_string_lossy(),
                index + 1,
                few / many,
                many / on_cpu,
            );
        }
    }
    Ok(())
}

/// Million samples per second of each renderer with each number of bands.
fn measure(path: &PathBuf, renderers: &[Renderer], seconds: f64) -> miette::Result<Vec<[f64; 2]>> {
    let mut best = vec![[0.0_f64; 2]; renderers.len()];
    let file = SceneFile::read(path)?;
    for _ in 0..ROUNDS {
        for (renderer, best) in renderers.iter().zip(&mut best) {
            for (bands, best) in BANDS.into_iter().zip(best) {
                let mut file = file.clone();
                file.description.render.bands = bands;
                file.description.render.samples = 1 << 20;
                *best = best.max(rate(renderer, &file.validate()?, seconds)?);
            }
        }
    }
    Ok(best)
}

/// Renders until the time is over; what is counted begins after the first batches, when everything is compiled and the sizes are found.
fn rate(renderer: &Renderer, scene: &Scene, seconds: f64) -> miette::Result<f64> {
    const WARM_UP: f64 = 0.5;
    let mut begun: Option<(Instant, u64)> = None;
    let mut first: Option<Instant> = None;
    let mut rate = 0.0;
    let stopped = renderer.render(scene, &mut |done| {
        let now = Instant::now();
        let warm = now - *first.get_or_insert(now);
        match begun {
            None if warm.as_secs_f64() >= WARM_UP => begun = Some((now, done)),
            None => {}
            Some((start, before)) => {
                let took = (now - start).as_secs_f64();
                rate = (done - before) as f64 / took * 1e-6;
                if took >= seconds {
                    return ControlFlow::Break(());
                }
            }
        }
        ControlFlow::Continue(())
    });
    match stopped {
        Err(pellicle::RenderError::Stopped) | Ok(_) => Ok(rate),
        Err(error) => Err(error).into_diagnostic(),
    }
}
