//! Noise at equal samples and at equal time: what each way to draw paths gains.

use crate::print;
use miette::IntoDiagnostic;
use pellicle::Renderer;
use pellicle::scene::description::{Render, Sampler};
use pellicle::scene::{Scene, SceneFile};
use pellicle::seen::{Seen, seen};
use pellicle::spectra::SpectralImage;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

/// A way to draw paths: its name, and how it is set.
type Variant = (&'static str, fn(&mut Render));

/// The first is what the others are compared with.
const VARIANTS: [Variant; 2] = [
    ("independent", |render| {
        render.sampler = Sampler::Independent;
    }),
    ("sobol", |render| render.sampler = Sampler::Sobol),
];

/// Width of the pictures; a pixel's noise does not depend on how many there are.
const WIDTH: u32 = 64;

/// Prints, of each scene, the variance of each way over that of the first.
///
/// The variance of a pixel is that of its mean over renders with different seeds: what samples say of themselves holds only
/// where they are independent.
pub(super) fn run(
    scenes: &[impl AsRef<Path>],
    renderer: &Renderer,
    (samples, seeds): (u32, u32),
) -> miette::Result<()> {
    print::result(format_args!(
        "\nvariance at {samples} samples, over {seeds} seeds, and time, of {}: first / this, so that more is better;\n\
         of all pixels and of those that show a film: by the mean variance, and the median of the pixels' own quotients",
        renderer.description()
    ))?;
    print::result(format_args!(
        "{:<16}{:<16}{:>8}{:>9}{:>8}{:>9}{:>8}{:>22}",
        "scene", "samples", "mean", "median", "film", "median", "speed", "film, at equal time"
    ))?;
    for path in scenes {
        scene(path.as_ref(), renderer, samples, seeds)?;
    }
    Ok(())
}

fn scene(path: &Path, renderer: &Renderer, samples: u32, seeds: u32) -> miette::Result<()> {
    let mut file = SceneFile::read(path)?;
    let [width, height] = file.description.render.size;
    file.description.render.size = [WIDTH, (WIDTH * height / width.max(1)).max(1)];
    file.description.render.samples = samples;
    let original = file.description.render.clone();
    let shows_film = film_pixels(&file, path.parent().unwrap_or(Path::new(".")))?;
    let mut sums: Vec<Spread> = VARIANTS.iter().map(|_| Spread::default()).collect();
    for seed in 0..seeds {
        for ((_, set), spread) in VARIANTS.iter().zip(&mut sums) {
            file.description.render = original.clone();
            file.description.render.seed = seed + 1;
            set(&mut file.description.render);
            spread.add(renderer, &file.validate()?)?;
        }
    }
    let first = sums[0].variances();
    for ((name, _), spread) in VARIANTS.iter().zip(&sums) {
        let variances = spread.variances();
        let all = gains(&first, &variances, &vec![true; first.len()]);
        let film = gains(&first, &variances, &shows_film);
        let mut speeds: Vec<f64> = sums[0]
            .seconds
            .iter()
            .zip(&spread.seconds)
            .map(|(a, b)| a / b)
            .collect();
        let speed = median(&mut speeds);
        print::result(format_args!(
            "{:<16}{name:<16}{:>8.2}{:>9.2}{:>8.2}{:>9.2}{speed:>8.2}{:>22.2}",
            path.file_stem().unwrap_or_default().to_string_lossy(),
            all.0,
            all.1,
            film.0,
            film.1,
            film.0 * speed,
        ))?;
    }
    Ok(())
}

/// Whether the middle of each pixel shows a film.
fn film_pixels(file: &SceneFile, directory: &Path) -> miette::Result<Vec<bool>> {
    let scene = file.validate()?;
    let [width, height] = file.description.render.size;
    let mut found = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let place = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let seen = seen(&file.description, &scene, directory, place);
            found.push(matches!(seen, Ok(Seen::Film(_))));
        }
    }
    Ok(found)
}

/// Mean variance of some pixels over that of others, and the median of their own quotients; NaN where there are none.
fn gains(first: &[f64], other: &[f64], counts: &[bool]) -> (f64, f64) {
    let pairs = first.iter().zip(other).zip(counts);
    let counted: Vec<(f64, f64)> = pairs
        .filter_map(|((&a, &b), &counts)| counts.then_some((a, b)))
        .collect();
    let (a, b) = counted
        .iter()
        .fold((0.0, 0.0), |sum, pair| (sum.0 + pair.0, sum.1 + pair.1));
    let noisy = counted.iter().filter(|pair| pair.1 > 0.0);
    (
        a / b,
        median(&mut noisy.map(|(a, b)| a / b).collect::<Vec<_>>()),
    )
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Sums over renders with different seeds.
#[derive(Default)]
struct Spread {
    /// Of each value of the picture: the mean, and the sum of squared differences from it (Welford 1962).
    values: Vec<(f64, f64)>,
    bands: usize,
    seconds: Vec<f64>,
}

impl Spread {
    fn add(&mut self, renderer: &Renderer, scene: &Scene) -> miette::Result<()> {
        let mut started: Option<(Instant, u64)> = None;
        let mut last = 0;
        let begun = Instant::now();
        let image = renderer
            .render(scene, &mut |done| {
                started.get_or_insert((Instant::now(), done));
                last = done;
                ControlFlow::Continue(())
            })
            .into_diagnostic()?;
        // What comes before the first batch is compiling.
        let (start, before) = started.filter(|first| first.1 < last).unwrap_or((begun, 0));
        self.seconds
            .push(start.elapsed().as_secs_f64() / (last - before) as f64);
        self.add_values(&image);
        Ok(())
    }

    fn add_values(&mut self, image: &SpectralImage) {
        self.bands = image.bands().count() as usize;
        self.values.resize(image.radiance().len(), (0.0, 0.0));
        let count = self.seconds.len() as f64;
        for ((mean, squares), &value) in self.values.iter_mut().zip(image.radiance()) {
            let before = f64::from(value) - *mean;
            *mean += before / count;
            *squares += before * (f64::from(value) - *mean);
        }
    }

    /// Of each pixel the mean variance of its bands.
    fn variances(&self) -> Vec<f64> {
        let pixels = self.values.chunks(self.bands.max(1));
        let degrees = (self.seconds.len().max(2) - 1) as f64;
        let of_pixel = |values: &[(f64, f64)]| {
            let sum: f64 = values.iter().map(|(_, squares)| squares).sum();
            sum / (degrees * values.len() as f64)
        };
        pixels.map(of_pixel).collect()
    }
}
