//! Options of path sampling: each gives the same picture on average, and those that should reduce noise do.

use gpu::Gpu;
use pellicle::pick::{Picked, pick};
use pellicle_tests::device::lend;
use pellicle_tests::frames::same_expectation;
use pellicle_tests::scenes::file;
use pellicle_tests::sources::root;
use scene::Scene;
use scene_file::SceneFile;
use scene_file::description::{Camera, Filter, Render, Sampler};
use spectra::SpectralImage;
use std::ops::ControlFlow;
use std::sync::OnceLock;

const SIZE: [u32; 2] = [32, 24];
const BANDS: u32 = 6;

/// A small picture with custom settings.
fn small(name: &str, samples: u32, seed: u32, set: impl Fn(&mut Render)) -> SceneFile {
    let mut file = file(name);
    let render = &mut file.description.render;
    (render.size, render.bands, render.samples, render.seed) = (SIZE, BANDS, samples, seed);
    (render.clamp, render.sampler) = (None, Sampler::Independent);
    set(render);
    file
}

fn validated(file: &SceneFile) -> Scene {
    let scene = file.validate();
    scene.unwrap_or_else(|problems| panic!("{problems}"))
}

fn rendered(
    gpu: &Gpu,
    name: &str,
    samples: u32,
    seed: u32,
    set: impl Fn(&mut Render),
) -> SpectralImage {
    let scene = validated(&small(name, samples, seed, set));
    gpu::render(gpu, &scene, &mut |_| ControlFlow::Continue(()))
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Turns splits and roulette off.
fn plain(render: &mut Render) {
    render.film_splits = 0;
    render.roulette_after = render.max_path_segments;
}

/// The plain picture of a scene, rendered once.
fn expected(gpu: &Gpu, name: &'static str) -> &'static SpectralImage {
    static BUBBLE: OnceLock<SpectralImage> = OnceLock::new();
    static EVERYTHING: OnceLock<SpectralImage> = OnceLock::new();
    let picture = match name {
        "everything" => &EVERYTHING,
        _ => &BUBBLE,
    };
    picture.get_or_init(|| rendered(gpu, name, 256, 5, plain))
}

/// Compares an option with the plain picture; the reported variances are those of independent samples, or (for Sobol) larger than the
/// true ones.
fn has_the_same_expectation(
    name: &'static str,
    set: impl Fn(&mut Render),
) -> Result<String, String> {
    let gpu = lend();
    let found = rendered(&gpu, name, 192, 6, |render| {
        plain(render);
        set(render);
    });
    same_expectation(&found, expected(&gpu, name))
}

/// Each option against the plain picture, on a bubble and on everything.
macro_rules! options {
    ($($option:ident: $set:expr,)*) => {
        mod all_sampling_options_have_the_same_expectation {
            mod on_a_bubble {
                $(#[test] fn $option() {
                    println!("{}", super::super::has_the_same_expectation("floating_bubble", $set).unwrap());
                })*
            }
            mod on_everything {
                $(#[test] fn $option() {
                    println!("{}", super::super::has_the_same_expectation("everything", $set).unwrap());
                })*
            }
        }
    };
}

options! {
    one_split: |render| render.film_splits = 1,
    three_splits: |render| render.film_splits = 3,
    roulette_at_once: |render| render.roulette_after = 1,
    sobol_two_splits_and_roulette: |render| {
        render.sampler = super::super::Sampler::Sobol;
        (render.film_splits, render.roulette_after) = (2, 2);
    },
}

/// The comparison can fail: the clamp removes light.
#[test]
fn a_dimmed_picture_is_noticed() {
    for name in ["floating_bubble", "everything"] {
        let dimmed = has_the_same_expectation(name, |render| render.clamp = Some(0.2));
        assert!(dimmed.is_err(), "{name}: {dimmed:?}");
    }
}

/// Number of renders of each kind.
const SEEDS: u32 = 5;

/// Mean variance of the pixels of renders with different seeds.
fn variance(gpu: &Gpu, name: &str, set: impl Fn(&mut Render)) -> f64 {
    let images: Vec<_> = (0..SEEDS)
        .map(|seed| rendered(gpu, name, 64, seed, &set))
        .collect();
    variance_between(&images, |_| true)
}

/// Mean variance, between pictures of the same scene, of the pixels that count.
fn variance_between(images: &[SpectralImage], counts: impl Fn(usize) -> bool) -> f64 {
    let seeds = images.len() as f64;
    let of_value = |i: usize| {
        let values = images.iter().map(|image| f64::from(image.radiance()[i]));
        let mean = values.clone().sum::<f64>() / seeds;
        values.map(|v| (v - mean).powi(2)).sum::<f64>() / (seeds - 1.0)
    };
    let variances: Vec<f64> = (0..images[0].radiance().len())
        .filter(|i| counts(i / BANDS as usize))
        .map(of_value)
        .collect();
    variances.iter().sum::<f64>() / variances.len() as f64
}

/// Whether the middle of each pixel shows a film.
fn shows_film(file: &SceneFile) -> Vec<bool> {
    let scene = validated(file);
    let middle = |i: u32| [i % SIZE[0], i / SIZE[0]].map(|place| f64::from(place) + 0.5);
    (0..SIZE[0] * SIZE[1])
        .map(|i| {
            let picked = pick(&file.description, &scene, &root(), middle(i));
            matches!(picked, Ok(Picked::Film(_)))
        })
        .collect()
}

/// Requires about half of the gains that were observed (53 and 3.0) for the pixels that show a film, at equal samples, with Sobol points
/// and without roulette in both cases. Uses the reference, which compiles nothing: whole pictures prove that the shader splits paths
/// in the same way.
#[test]
fn a_split_reduces_variance_where_a_film_is_visible() {
    for (name, factor) in [("soap_bubble", 20.0), ("floating_bubble", 1.5)] {
        let variance = |splits: u32, first_seed: u32| {
            let way = |render: &mut Render| {
                plain(render);
                (render.sampler, render.film_splits) = (Sampler::Sobol, splits);
            };
            let shown = shows_film(&small(name, 64, 0, way));
            assert!(shown.contains(&true) && shown.contains(&false), "{name}");
            let images: Vec<_> = (first_seed..first_seed + SEEDS)
                .map(|seed| {
                    let scene = validated(&small(name, 64, seed, way));
                    reference::render(&scene, &mut |_| ControlFlow::Continue(()))
                        .expect("nothing stops the render")
                })
                .collect();
            variance_between(&images, |pixel| shown[pixel])
        };
        let without = variance(0, 0);
        let gain = without / variance(1, 0);
        println!("{name}: {gain:.1}");
        assert!(gain > factor, "{name}: {gain}");
        // Other seeds alone gain nothing.
        let chance = without / variance(0, SEEDS);
        println!("{name}, without splits: {chance:.2}");
        assert!((0.5..1.5).contains(&chance), "{name}: {chance}");
    }
}

/// Requires half of what `pellicle bench --variance` reports, so that chance cannot fail the test.
#[test]
fn sobol_points_halve_the_variance() {
    let gpu = lend();
    for name in ["soap_bubble", "metal_spheres"] {
        let independent = variance(&gpu, name, plain);
        let sobol = variance(&gpu, name, |render| {
            plain(render);
            render.sampler = Sampler::Sobol;
        });
        println!("{name}: {:.2}", independent / sobol);
        assert!(sobol < 0.5 * independent, "{name}: {sobol} {independent}");
    }
}

/// No sample is brighter than the clamp, and darker ones are unchanged.
#[test]
fn the_clamp_bounds_every_sample() {
    let gpu = lend();
    let single = |clamp| rendered(&gpu, "everything", 1, 3, |render| render.clamp = clamp);
    let (free, bounded) = (single(None), single(Some(0.3)));
    let bands = BANDS as usize;
    let pixels = free
        .radiance()
        .chunks(bands)
        .zip(bounded.radiance().chunks(bands));
    let mut dimmed = 0;
    for (free, bounded) in pixels {
        let brightest = free.iter().copied().fold(0.0, f32::max);
        let factor = if brightest > 0.3 {
            0.3 / brightest
        } else {
            1.0
        };
        dimmed += u32::from(factor < 1.0);
        for (a, b) in free.iter().zip(bounded) {
            assert!(
                (factor * a - b).abs() <= 1e-6,
                "{a} became {b}, not {}",
                factor * a
            );
        }
    }
    assert!(dimmed > 20, "{dimmed} pixels were dimmed");
}

/// A lens and a filter spread light without adding or removing any: a white furnace does not change, and at an edge the
/// mean of the picture stays the same.
#[test]
fn lens_and_filter_keep_the_light() {
    let gpu = lend();
    let mean = |lens: Option<scene_file::description::Lens>, filter: Filter| {
        let mut file = file("floating_bubble");
        let render = &mut file.description.render;
        (render.size, render.bands, render.samples) = (SIZE, BANDS, 256);
        if let Camera::Perspective {
            lens: l, filter: f, ..
        } = &mut file.description.camera
        {
            (*l, *f) = (lens, filter);
        }
        let scene = file
            .validate()
            .unwrap_or_else(|problems| panic!("{problems}"));
        let image = gpu::render(&gpu, &scene, &mut |_| ControlFlow::Continue(()))
            .unwrap_or_else(|error| panic!("{error}"));
        let sum: f64 = image.radiance().iter().map(|&v| f64::from(v)).sum();
        sum / image.radiance().len() as f64
    };
    let sharp = mean(None, Filter::Box);
    for filter in [Filter::Gaussian, Filter::BlackmanHarris] {
        let found = mean(None, filter);
        // The light that a filter brings in across the picture's edges differs from what it spreads out there.
        assert!(
            (found / sharp - 1.0).abs() < 0.02,
            "{filter:?}: {found} {sharp}"
        );
    }
    let lens = scene_file::description::Lens {
        radius: 0.02,
        focus_distance: None,
    };
    let found = mean(Some(lens), Filter::Box);
    assert!((found / sharp - 1.0).abs() < 0.02, "lens: {found} {sharp}");
    let wide = scene_file::description::Lens {
        radius: 3.0,
        ..lens
    };
    let other = mean(Some(wide), Filter::Box);
    assert!(
        (other / sharp - 1.0).abs() > 1e-4,
        "a wide lens changes nothing: {other} {sharp}"
    );
}
