//! Renders in rounds: the same bits however they are cut, no bias where tiles get different numbers of samples, and noise that is what
//! it is said to be.

use pellicle::progressive::{End, Goal, Render, adaptive};
use pellicle::variance::SeedVariance;
use pellicle::{Backend, Renderer, Session};
use pellicle_tests::device::lend;
use pellicle_tests::frames::same_expectation;
use pellicle_tests::scenes::file;
use pellicle_tests::tolerances::NOISE_ESTIMATE;
use scene::Scene;
use scene_file::description::Sampler;
use spectra::{Accumulation, Round, SpectralImage, Window};
use std::ops::ControlFlow;

fn small(name: &str, size: [u32; 2], seed: u32, sampler: Sampler) -> Scene {
    let mut file = file(name);
    let render = &mut file.description.render;
    (render.size, render.bands, render.seed) = (size, 6, seed);
    (render.clamp, render.sampler) = (None, sampler);
    file.validate()
        .unwrap_or_else(|problems| panic!("{problems}"))
}

fn empty(scene: &Scene, first_sample: u32) -> Accumulation {
    scene.accumulation(scene.window(), first_sample)
}

fn cpu() -> Renderer {
    Renderer::open(&Backend::Cpu).unwrap()
}

fn advance(session: &mut Session<'_>, all: &mut Accumulation, rounds: &[Round]) {
    let on_progress = &mut |_| ControlFlow::Continue(());
    session.advance(all, rounds, on_progress).unwrap();
}

fn session<'a>(renderer: &Renderer, scene: &'a Scene) -> Session<'a> {
    Session::new(renderer, scene, &mut |_| ControlFlow::Continue(())).unwrap()
}

/// Cuts a picture into windows and numbers of samples, in two ways.
fn is_the_same_however_it_is_cut(renderer: &Renderer) {
    let scene = small("soap_bubble", [40, 30], 3, Sampler::Sobol);
    let mut session = session(renderer, &scene);
    let mut whole = empty(&scene, 5);
    let at_once = whole.rounds_to(whole.window(), 7);
    advance(&mut session, &mut whole, &at_once);
    let mut cut = empty(&scene, 5);
    let window = |origin, size| Window { origin, size };
    let corner = [
        cut.rounds_to(window([3, 4], [20, 9]), 2),
        cut.rounds_to(window([30, 0], [10, 30]), 5),
    ];
    advance(&mut session, &mut cut, &corner.concat());
    for samples in [3, 4, 7] {
        let rounds = cut.rounds_to(cut.window(), samples);
        assert!(samples != 3 || rounds.len() > 3, "{rounds:?}");
        advance(&mut session, &mut cut, &rounds);
    }
    assert!(cut == whole, "the bits differ");
    let mut other = empty(&scene, 6);
    advance(&mut session, &mut other, &at_once);
    assert_ne!(other.sums(), whole.sums(), "other samples gave the same");
}

#[test]
fn on_the_cpu_the_bits_do_not_depend_on_the_rounds() {
    is_the_same_however_it_is_cut(&cpu());
}

#[test]
fn on_a_gpu_the_bits_do_not_depend_on_the_rounds() {
    let gpu = lend();
    let name = gpu.description().info.name.clone();
    let choice = pellicle::gpu::AdapterChoice::Named(name);
    is_the_same_however_it_is_cut(&Renderer::open(&Backend::Gpu(choice)).unwrap());
}

/// Renders until a goal is reached.
fn rendered(session: &mut Session<'_>, mut render: Render) -> Render {
    while let Some(rounds) = render.next_rounds() {
        advance(session, render.accumulation_mut(), &rounds);
        let work = rounds.iter().map(Round::work).sum();
        // The speed decides over the cuts alone.
        render.finish_round(work, 0.1);
    }
    render
}

fn adaptive_image(seed: u32, samples: u32, change: impl Fn(&mut SpectralImage)) -> SpectralImage {
    let scene = small("soap_bubble", [64, 48], seed, Sampler::Independent);
    let renderer = cpu();
    let pilot_scene = scene.with_seed(adaptive::pilot_seed(seed));
    let mut pilot = empty(&scene, 0);
    let rounds = pilot.rounds_to(pilot.window(), adaptive::pilot_samples(samples));
    advance(&mut session(&renderer, &pilot_scene), &mut pilot, &rounds);
    let plan = adaptive::plan(&pilot, samples);
    assert!(plan.iter().max() > plan.iter().min(), "{plan:?}");
    let render = Render::new(empty(&scene, 0), Goal::samples(samples)).with_plan(plan);
    let render = rendered(&mut session(&renderer, &scene), render);
    let mean = render.done() as f64 / render.accumulation().window().pixels() as f64;
    assert!(
        (mean / f64::from(samples) - 1.0).abs() < 0.02,
        "{mean} samples"
    );
    let mut image = render.accumulation().whole_image();
    change(&mut image);
    image
}

fn plain_image(samples: u32) -> SpectralImage {
    let scene = small("soap_bubble", [64, 48], 7, Sampler::Independent);
    let render = Render::new(empty(&scene, 0), Goal::samples(samples));
    let render = rendered(&mut session(&cpu(), &scene), render);
    render.accumulation().whole_image()
}

#[test]
fn adaptive_sampling_has_no_bias() {
    let plain = plain_image(256);
    let found = adaptive_image(11, 64, |_| ());
    println!("{}", same_expectation(&found, &plain).unwrap());
}

/// The comparison can fail: an error of 2 % in all pixels is seen.
#[test]
fn a_bias_would_be_noticed() {
    let plain = plain_image(256);
    let found = adaptive_image(11, 64, |image| {
        for mut row in image.rows_mut() {
            let radiance = row.take(spectra::LayerKey::RADIANCE);
            for value in radiance {
                *value *= 1.02;
            }
        }
    });
    let noticed = same_expectation(&found, &plain);
    assert!(noticed.is_err(), "{noticed:?}");
}

/// The noise of a picture, as defined for [`pellicle::progressive::NoiseEstimator`], from renders with different seeds.
fn measured_noise(images: &[SpectralImage]) -> f64 {
    let mut variance = SeedVariance::default();
    for image in images {
        variance.add(image);
    }
    let bands = images[0].bands().count() as usize;
    let mean = |pixel: usize| {
        let of = |image: &SpectralImage| {
            let values = &image.radiance()[pixel * bands..][..bands];
            values.iter().map(|&value| f64::from(value)).sum::<f64>()
        };
        images.iter().map(of).sum::<f64>() / (images.len() * bands) as f64
    };
    let pixels = variance.of_pixels().into_iter().enumerate();
    let relative = pixels.map(|(pixel, variance)| (mean(pixel), variance.sqrt()));
    let mut lit: Vec<f64> = relative
        .filter(|(mean, _)| *mean > 0.0)
        .map(|(mean, deviation)| deviation / mean)
        .collect();
    lit.sort_by(f64::total_cmp);
    lit[lit.len() / 2]
}

/// A render that ends at a noise says a noise that renders with 16 seeds have.
fn noise_is_honest(name: &str, sampler: Sampler, wanted: f64) {
    let goal = Goal {
        noise: Some(wanted),
        ..Goal::samples(1 << 14)
    };
    let renderer = cpu();
    let scene = small(name, [96, 72], 1, sampler);
    let render = Render::new(empty(&scene, 0), goal);
    let render = rendered(&mut session(&renderer, &scene), render);
    assert_eq!(render.end(), Some(End::Noise));
    let (said, samples) = (render.noise().unwrap(), render.level());
    assert!(said <= wanted);
    let images: Vec<_> = (0..16)
        .map(|seed| {
            let scene = small(name, [96, 72], 100 + seed, sampler);
            let render = Render::new(empty(&scene, 0), Goal::samples(samples));
            rendered(&mut session(&renderer, &scene), render)
                .accumulation()
                .whole_image()
        })
        .collect();
    let measured = measured_noise(&images);
    println!("{name}: {samples} samples, said {said:.4}, measured {measured:.4}");
    let ratio = said / measured;
    assert!(
        (ratio - 1.0).abs() < NOISE_ESTIMATE,
        "{name}: {said} instead of {measured}"
    );
}

#[test]
fn the_noise_of_a_bubble_is_honest() {
    noise_is_honest("soap_bubble", Sampler::Sobol, 0.02);
}

#[test]
fn the_noise_of_metals_is_honest() {
    noise_is_honest("metals", Sampler::Sobol, 0.02);
}

#[test]
fn the_noise_of_a_disk_is_honest() {
    noise_is_honest("brushed_disk", Sampler::Sobol, 0.02);
}

#[test]
fn the_noise_of_independent_samples_is_honest() {
    noise_is_honest("soap_bubble", Sampler::Independent, 0.05);
}
