//! Noise at equal samples and at equal time: what each way of sampling paths gains.

use crate::print;
use miette::IntoDiagnostic;
use pellicle::Renderer;
use pellicle::pick::{Picked, pick};
use pellicle::scene_file::SceneFile;
use pellicle::scene_file::description::{Render, Sampler};
use pellicle::variance::{Gain, SeedVariance, median};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

/// A way of sampling paths.
type Way = fn(&mut Render);

/// The ways that are compared. Each starts from the settings of the scene file, and is rendered once for each seed.
const WAYS: [Way; 7] = [
    |render| {
        render.sampler = Sampler::Independent;
        plain(render);
    },
    plain,
    |render| {
        plain(render);
        render.roulette_after = Render::default().roulette_after;
    },
    |render| {
        plain(render);
        render.film_splits = 1;
    },
    |render| {
        plain(render);
        render.film_splits = 2;
    },
    |render| render.sampler = Sampler::Independent,
    |_| {},
];

/// Turns off splits and roulette; leaves the sampler unchanged.
fn plain(render: &mut Render) {
    render.film_splits = 0;
    render.roulette_after = render.max_path_segments;
}

/// Two ways that differ in one setting.
struct Change {
    name: &'static str,
    before: usize,
    after: usize,
    /// Whether it changes what a sample does at films, and so what it costs: then both are also compared at equal time.
    splits: bool,
}

const fn change(name: &'static str, before: usize, after: usize, splits: bool) -> Change {
    Change {
        name,
        before,
        after,
        splits,
    }
}

const CHANGES: [Change; 5] = [
    change("independent to Sobol", 0, 1, false),
    change("the same, file's settings", 5, 6, false),
    change("no roulette to roulette", 1, 2, false),
    change("no split to 1 split", 1, 3, true),
    change("no split to 2 splits", 1, 4, true),
];

/// The largest width of the pictures; the noise of a pixel does not depend on the number of pixels.
const WIDTH: u32 = 64;

/// The largest number of samples of the renders that take as much time as others took.
const MAX_SAMPLES: f64 = 65_536.0;

/// The requested measurement.
pub(super) struct Wanted {
    /// Samples per pixel.
    pub(super) samples: u32,
    /// Renders of each kind.
    pub(super) seeds: u32,
    pub(super) allow_outside: bool,
}

/// Prints what each change does to the variance of each scene.
///
/// The variance of a pixel is that of its mean over renders with different seeds: an estimate from the samples of one render
/// is valid only if they are independent.
pub(super) fn run(
    scenes: &[impl AsRef<Path>],
    renderer: &Renderer,
    wanted: &Wanted,
) -> miette::Result<()> {
    let Wanted { samples, seeds, .. } = wanted;
    print::result(format_args!(
        "\nvariance at {samples} samples, over {seeds} seeds, on {}: before / after the change, so higher is better;\n\
         for all pixels and for those that show a film at their center: ratio of the mean variances, and median of the ratios per pixel;\n\
         time of a sample, after / before; at equal time: before the change with that many times the samples, rounded up to a power of two",
        renderer.description()
    ))?;
    print::result(format_args!(
        "{:<16}{:<26}{:>8}{:>9}{:>8}{:>9}{:>8}{:>9}{:>18}",
        "scene", "change", "all", "median", "film", "median", "time", "samples", "film, equal time"
    ))?;
    for path in scenes {
        scene(path.as_ref(), renderer, wanted)?;
    }
    Ok(())
}

fn scene(path: &Path, renderer: &Renderer, wanted: &Wanted) -> miette::Result<()> {
    let &Wanted { samples, seeds, .. } = wanted;
    let mut file = SceneFile::read(path)?.allow_outside(wanted.allow_outside);
    let [width, height] = file.description.render.size;
    let narrow = width.min(WIDTH);
    file.description.render.size = [narrow, (narrow * height / width.max(1)).max(1)];
    file.description.render.samples = samples;
    let shows_film = film_pixels(&file, path.parent().unwrap_or(Path::new(".")))?;
    let has_film = shows_film.contains(&true);
    let changes = || CHANGES.iter().filter(|change| has_film || !change.splits);
    let mut spreads: Vec<Spread> = WAYS.iter().map(|_| Spread::default()).collect();
    for seed in 1..=seeds {
        for (index, (way, spread)) in WAYS.iter().zip(&mut spreads).enumerate() {
            if changes().any(|change| change.before == index || change.after == index) {
                spread.add(renderer, &file, *way, seed)?;
            }
        }
    }
    for change in changes() {
        let (before, after) = (&spreads[change.before], &spreads[change.after]);
        let time = after.time() / before.time();
        let all = before.gain(after, &vec![true; shows_film.len()]);
        let mut line = format!(
            "{:<16}{:<26}{:>8.2}{:>9.2}",
            path.file_stem().unwrap_or_default().to_string_lossy(),
            change.name,
            all.of_mean,
            all.median,
        );
        if has_film {
            let film = before.gain(after, &shows_film);
            line += &format!("{:>8.2}{:>9.2}", film.of_mean, film.median);
        } else {
            line += &format!("{:>8}{:>9}", "", "");
        }
        line += &format!("{time:>8.2}");
        if change.splits {
            let more = equal_time(&file, f64::from(samples) * time);
            let mut longer = Spread::default();
            for seed in 1..=seeds {
                longer.add(renderer, &more, WAYS[change.before], seed)?;
            }
            let gain = longer.gain(after, &shows_film).of_mean;
            line += &format!("{:>9}{gain:>18.2}", more.description.render.samples);
        }
        print::result(format_args!("{line}"))?;
    }
    Ok(())
}

/// The scene with at least this many samples: Sobol points are best if their number is a power of two.
fn equal_time(file: &SceneFile, samples: f64) -> SceneFile {
    let mut more = file.clone();
    more.description.render.samples =
        (samples.clamp(1.0, MAX_SAMPLES).ceil() as u32).next_power_of_two();
    more
}

/// Whether the center of each pixel shows a film.
fn film_pixels(file: &SceneFile, directory: &Path) -> miette::Result<Vec<bool>> {
    let scene = file.validate()?;
    let [width, height] = file.description.render.size;
    let mut found = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let place = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let picked = pick(&file.description, &scene, directory, place);
            found.push(matches!(picked, Ok(Picked::Film(_))));
        }
    }
    Ok(found)
}

/// The noise and the time of renders with different seeds.
#[derive(Default)]
struct Spread {
    variance: SeedVariance,
    /// The seconds of a sample of each render.
    seconds: Vec<f64>,
}

impl Spread {
    fn add(
        &mut self,
        renderer: &Renderer,
        file: &SceneFile,
        way: Way,
        seed: u32,
    ) -> miette::Result<()> {
        let mut file = file.clone();
        file.description.render.seed = seed;
        way(&mut file.description.render);
        let scene = file.validate()?;
        let mut started: Option<(Instant, u64)> = None;
        let mut last = 0;
        let begun = Instant::now();
        let image = renderer
            .render(&scene, &mut |done| {
                if done > 0 {
                    started.get_or_insert((Instant::now(), done));
                }
                last = done;
                ControlFlow::Continue(())
            })
            .into_diagnostic()?;
        // The time before the first batch is spent on compilation.
        let (start, before) = started.filter(|first| first.1 < last).unwrap_or((begun, 0));
        self.seconds
            .push(start.elapsed().as_secs_f64() / (last - before) as f64);
        self.variance.add(&image);
        Ok(())
    }

    /// What a change from this to another gains over the pixels that count.
    fn gain(&self, after: &Self, counts: &[bool]) -> Gain {
        Gain::new(&self.variance, &after.variance, counts)
    }

    /// The median of the seconds per sample.
    fn time(&self) -> f64 {
        median(&self.seconds)
    }
}
