//! Whole pictures of every scene: the GPU renderer against the reference, path by path, with the same random numbers and with different
//! ones; and against known results.

mod paths;

use gpu::Gpu;
use libtest_mimic::Trial;
use pellicle_tests::cases::{self, comparisons, report};
use pellicle_tests::device::{is_short, lend};
use pellicle_tests::frames::{
    Values, same_expectation, same_numbers, same_polarization, same_variances,
};
use pellicle_tests::scenes::{BANDS, MADE, all, all_polarized, file, made_polarized, small};
use pellicle_tests::tolerances::{FRAMES, SAME_COLOR, SUMS, VARIANCES, Z_FURNACE, Z_MEAN};
use scene::{DirectLight, Scene};
use scene_file::description::{self, Sampler, WavelengthSampling};
use spectra::stokes::{Polarizer, Retardance, Retarder};
use spectra::{LayerKey, SpectralImage, Stokes};
use std::ops::ControlFlow;
use std::process::ExitCode;

fn on_gpu(gpu: &Gpu, scene: &Scene) -> SpectralImage {
    gpu::render(gpu, scene, &mut |_| ControlFlow::Continue(()))
        .unwrap_or_else(|error| panic!("{error}"))
}

fn on_cpu(scene: &Scene) -> SpectralImage {
    reference::render(scene, &mut |_| ControlFlow::Continue(())).expect("nothing stops the render")
}

fn main() -> ExitCode {
    let mut all: Vec<Trial> = all()
        .into_iter()
        .map(|name| comparisons(name, || compared(name)))
        .collect();
    // Each is one more shader to compile: in the short form, the scenes that contain everything stand for the others.
    let polarized = if is_short() {
        made_polarized()
    } else {
        all_polarized()
    };
    all.extend(
        polarized
            .into_iter()
            .map(|name| comparisons(name, || compared_polarized(name))),
    );
    for name in ["everything_bodies", "everything_pictured"] {
        for way in [DirectLight::Emitters, DirectLight::Bsdf] {
            let what = format!("{name}, direct light by {way:?} alone");
            all.push(comparisons(what, move || vec![by_one_technique(name, way)]));
        }
    }
    all.extend(pellicle_tests::cases![
        paths::the_probe_reaches_the_whole_path_tracer,
        paths::the_renderer_reaches_all_of_polarized_light,
        a_polarizer_passes_what_the_components_say,
        light_groups_add_up_to_the_picture,
        a_wrong_picture_is_noticed,
        the_furnace_is_white,
        the_wedge_shows_the_reflectance_of_its_film,
        long_runs_of_samples_are_complete_or_refused,
        the_bits_do_not_depend_on_the_division_of_the_work,
    ]);
    cases::run(all)
}

/// Single paths, pictures with the same random numbers and with different ones, all by the same pipeline, which is compiled once.
fn compared(name: &str) -> Vec<Result<String, String>> {
    let gpu = lend();
    let mut compared = paths::compared(&gpu, name);
    compared.extend(by_the_same_numbers(&gpu, name));
    if !is_short() {
        compared.push(by_different_numbers(&gpu, name));
    }
    compared
}

/// Pictures of polarized light with the same random numbers: S0 as any picture, and the other components.
fn compared_polarized(name: &str) -> Vec<Result<String, String>> {
    let scene = small(name, [96, 72], 4, BANDS, 1);
    let (actual, expected) = (on_gpu(&lend(), &scene), on_cpu(&scene));
    let colors = (Values::of_xyz(&actual), Values::of_xyz(&expected));
    let mut compared = vec![
        same_numbers(Values::of(&actual), Values::of(&expected), &FRAMES),
        same_numbers(colors.0, colors.1, &FRAMES).map_err(|report| format!("XYZ: {report}")),
        same_variances(&actual, &expected, &VARIANCES),
        same_polarization(&actual, &expected, !DEPOLARIZED.contains(&name), &FRAMES),
    ];
    compared.extend(same_light_groups(&actual, &expected));
    compared
}

/// Scenes without any light that is polarized: at normal incidence, or between diffuse surfaces.
const DEPOLARIZED: &[&str] = &[
    "film_wedge, polarized",
    "paper_wedge, polarized",
    "silicon_steps, polarized",
    "metamers, polarized",
    "room, polarized",
    "furnace, polarized",
    "bench/wedge, polarized",
];

/// A polarizer in front of the camera, with a retarder whose phase depends on the wavelength: both renderers measure the same, and it is what the
/// components of the picture without it say.
fn a_polarizer_passes_what_the_components_say() {
    let (angle_deg, fast_axis_deg, nm) = (30.0, -20.0, 500.0);
    let polarizer = Polarizer {
        angle_deg,
        retarder: Some(Retarder {
            fast_axis_deg,
            retardance: Retardance::Path { nm },
        }),
    };
    let described = description::Polarizer {
        angle_deg,
        retarder: Some(description::Retarder {
            fast_axis_deg,
            retardance_deg: None,
            retardance_nm: Some(nm),
        }),
    };
    let scene = |has_polarizer| {
        let mut file = file("everything, polarized");
        let render = &mut file.description.render;
        (render.size, render.samples, render.bands, render.seed) = ([48, 36], 8, BANDS, 3);
        render.sampling = WavelengthSampling::Center;
        render.clamp = None;
        if has_polarizer {
            let description::Camera::Perspective { polarizer, .. } = &mut file.description.camera
            else {
                panic!("a perspective camera");
            };
            *polarizer = Some(described);
        }
        file.validate().expect("valid").rounded_to_f32()
    };
    let bare = on_cpu(&scene(false));
    let grid = *bare.bands();
    let analyzer = polarizer.analyzer();
    let [s0, s1, s2, s3] = Stokes::ALL.map(|stokes| {
        let layer = bare.layer(LayerKey::RADIANCE.component(stokes));
        layer.expect("polarized").floats()
    });
    let passed = (0..s0.len()).map(|i| {
        let light = [s0[i], s1[i], s2[i], s3[i]].map(f64::from);
        let nm = grid.center_nm((i % BANDS as usize) as u32);
        analyzer.transmitted(light, nm) as f32
    });
    let passed: Vec<f32> = passed.collect();
    let behind = scene(true);
    assert!(!behind.content().is_polarized);
    for (who, seen) in [("cpu", on_cpu(&behind)), ("gpu", on_gpu(&lend(), &behind))] {
        assert!(!seen.is_polarized());
        let expected = Values {
            bands: BANDS as usize,
            values: &passed,
        };
        let compared = same_numbers(Values::of(&seen), expected, &FRAMES);
        report(&format!(
            "{who}: {}",
            compared.unwrap_or_else(|report| panic!("{who}: {report}"))
        ));
        // Another angle is noticed.
        let all = Values {
            values: s0,
            ..expected
        };
        assert!(same_numbers(Values::of(&seen), all, &FRAMES).is_err());
    }
}

fn by_the_same_numbers(gpu: &Gpu, name: &str) -> Vec<Result<String, String>> {
    let scene = small(name, [96, 72], 16, BANDS, 1);
    let (actual, expected) = (on_gpu(gpu, &scene), on_cpu(&scene));
    let colors = (Values::of_xyz(&actual), Values::of_xyz(&expected));
    let whole = [
        same_numbers(Values::of(&actual), Values::of(&expected), &FRAMES),
        same_variances(&actual, &expected, &VARIANCES),
        same_numbers(colors.0, colors.1, &FRAMES).map_err(|report| format!("XYZ: {report}")),
        same_colors(&actual, &expected),
    ];
    let by_light = same_light_groups(&actual, &expected);
    whole.into_iter().chain(by_light).collect()
}

/// The noise is that of the reference's samples: more than two GPU samples for each of them would sharpen the test by only a tenth.
/// Sobol samples have smaller standard errors than the picture reports, which makes the test that much weaker; the scenes
/// that contain everything use independent samples.
fn by_different_numbers(gpu: &Gpu, name: &str) -> Result<String, String> {
    let seen = |samples, seed| {
        let mut file = file(name);
        let render = &mut file.description.render;
        (render.size, render.samples, render.bands, render.seed) = ([48, 36], samples, BANDS, seed);
        if MADE.contains(&name) {
            render.sampler = Sampler::Independent;
        }
        file.validate().expect("valid").rounded_to_f32()
    };
    let actual = on_gpu(gpu, &seen(128, 11));
    let expected = on_cpu(&seen(64, 22));
    same_expectation(&actual, &expected)
}

/// Compares the light of each group, if there are several.
fn same_light_groups(
    actual: &SpectralImage,
    expected: &SpectralImage,
) -> Vec<Result<String, String>> {
    if actual.light_groups() != expected.light_groups() {
        return vec![Err("the light groups differ".to_owned())];
    }
    let groups = actual.light_groups().iter().enumerate();
    let compared = groups.flat_map(|(index, group)| {
        let of = |image| Values::of_light(image, index);
        let of_xyz = |image| Values::of_light_xyz(image, index);
        let bands = same_numbers(of(actual), of(expected), &FRAMES);
        let colors = same_numbers(of_xyz(actual), of_xyz(expected), &FRAMES);
        [(bands, "bands"), (colors, "XYZ")].map(|(compared, what)| {
            let named = |report| format!("light group {}, {what}: {report}", group.name);
            compared.map(named).map_err(named)
        })
    });
    compared.collect()
}

/// Compares the mean XYZ of the pictures, because XYZ is accumulated separately from the bands.
fn same_colors(actual: &SpectralImage, expected: &SpectralImage) -> Result<String, String> {
    let mut worst = 0.0_f64;
    for axis in 0..3 {
        let sum = |image: &SpectralImage| {
            image
                .xyz()
                .iter()
                .map(|xyz| f64::from(xyz[axis]))
                .sum::<f64>()
        };
        let error = sum(actual) / sum(expected) - 1.0;
        if error.is_nan() || error.abs() > SAME_COLOR {
            return Err(format!("mean of axis {axis} of XYZ is off by {error:.1e}"));
        }
        worst = worst.max(error.abs());
    }
    Ok(format!("mean XYZ off by {worst:.1e} at most"))
}

/// Emitters found by only one of the two techniques.
fn by_one_technique(name: &str, way: DirectLight) -> Result<String, String> {
    let mut file = file(name);
    let render = &mut file.description.render;
    (render.size, render.samples, render.bands, render.seed) = ([96, 72], 4, BANDS, 5);
    render.direct_light = way;
    let scene = file.validate().expect("valid").rounded_to_f32();
    let (actual, expected) = (on_gpu(&lend(), &scene), on_cpu(&scene));
    same_numbers(Values::of(&actual), Values::of(&expected), &FRAMES)
}

/// The same picture in several light groups and in one: the sum of the groups is the total, and neither the total nor the variance
/// depends on the grouping.
fn light_groups_add_up_to_the_picture() {
    let gpu = lend();
    let mut file = file("everything");
    let render = &mut file.description.render;
    (render.size, render.samples, render.bands, render.seed) = ([64, 48], 16, BANDS, 7);
    let apart = file.validate().expect("valid").rounded_to_f32();
    file.description.render.light_groups = scene_file::description::LightGroups::Single;
    let together = file.validate().expect("valid").rounded_to_f32();
    assert_eq!(
        (apart.light_groups().len(), together.light_groups().len()),
        (4, 1)
    );
    for (who, apart, together) in [
        ("gpu", on_gpu(&gpu, &apart), on_gpu(&gpu, &together)),
        ("cpu", on_cpu(&apart), on_cpu(&together)),
    ] {
        let radiance = same_numbers(Values::of(&apart), Values::of(&together), &SUMS);
        let colors = same_numbers(Values::of_xyz(&apart), Values::of_xyz(&together), &SUMS);
        let variances = same_variances(&apart, &together, &VARIANCES);
        for compared in [radiance, colors, variances] {
            report(&format!(
                "{who}: {}",
                compared.unwrap_or_else(|report| panic!("{who}: {report}"))
            ));
        }
        // A light group that is left out or counted twice is noticed.
        let without = Values::of_light(&apart, 0);
        assert!(same_numbers(without, Values::of(&together), &SUMS).is_err());
    }
}

/// A film whose index is one percent off, or whose bands are swapped, gives another picture.
fn a_wrong_picture_is_noticed() {
    let gpu = lend();
    let right = small("film_wedge", [96, 24], 16, 10, 1);
    let mut off = file("film_wedge");
    let render = &mut off.description.render;
    (render.size, render.samples, render.bands, render.seed) = ([96, 24], 16, 10, 1);
    for material in off.description.materials.values_mut() {
        if let scene_file::description::Material::Film { index, .. } = material {
            *index = Some(scene_file::description::Index::Real(1.333 * 1.01));
        }
    }
    let off = off.validate().expect("valid").rounded_to_f32();
    let expected = on_cpu(&right);
    let actual = on_gpu(&gpu, &off);
    assert!(same_numbers(Values::of(&actual), Values::of(&expected), &FRAMES).is_err());
    let more = |scene: &Scene| on_gpu(&gpu, scene);
    assert!(same_expectation(&more(&off), &more(&right)).is_err());
}

/// Albedo 0.5 inside emission 0.5: the radiance is 1 everywhere, in every band.
fn the_furnace_is_white() {
    let gpu = lend();
    let scene = small("furnace", [32, 32], 64, 7, 5);
    for (who, image) in [("gpu", on_gpu(&gpu, &scene)), ("cpu", on_cpu(&scene))] {
        let bands = image.bands().count() as usize;
        for band in 0..bands {
            let of_band = |values: &[f32]| {
                values
                    .iter()
                    .skip(band)
                    .step_by(bands)
                    .map(|&x| f64::from(x))
                    .collect::<Vec<_>>()
            };
            let (radiance, variance) = (of_band(image.radiance()), of_band(image.variance()));
            let mean = radiance.iter().sum::<f64>() / radiance.len() as f64;
            let error = variance.iter().sum::<f64>().sqrt() / radiance.len() as f64;
            report(&format!("{who}, band {band}: {mean} ± {error}"));
            // 32 segments leave out 2⁻³² of the light; f32 rounds by 6e-8 per bounce.
            assert!(
                (mean - 1.0).abs() <= Z_FURNACE * error + 1e-6,
                "{who}, band {band}: {mean} ± {error}"
            );
        }
    }
}

/// In front of a constant light the wedge shows R(λ) L(λ): compares the picture with optics alone, without a renderer.
fn the_wedge_shows_the_reflectance_of_its_film() {
    const SIZE: [u32; 2] = [200, 50];
    // Independent samples, whose reported standard errors are exact.
    let mut file = file("film_wedge");
    let render = &mut file.description.render;
    (render.size, render.samples, render.bands, render.seed) = (SIZE, 128, 8, 9);
    (render.sampler, render.film_splits) = (scene_file::description::Sampler::Independent, 0);
    let scene = file.validate().expect("valid").rounded_to_f32();
    let image = on_gpu(&lend(), &scene);
    let (film, ends_nm) = wedge_of(&scene);
    let mut largest = 0.0_f64;
    for x in 0..SIZE[0] {
        for band in 0..8 {
            let (found, error) = column_mean(&image, x, band);
            // The film fills the picture from edge to edge, so a column is a step of its thickness.
            let thickness_nm = |part: f64| {
                let across = (f64::from(x) + part) / f64::from(SIZE[0]);
                ends_nm.0 + (ends_nm.1 - ends_nm.0) * across
            };
            let parts = [0.1, 0.3, 0.5, 0.7, 0.9].map(thickness_nm);
            let expected = parts
                .map(|nm| mean_over_band(&scene, film, band, nm))
                .iter()
                .sum::<f64>()
                / 5.0;
            let z = (found - expected).abs() / error;
            largest = if z.is_nan() {
                f64::INFINITY
            } else {
                largest.max(z)
            };
        }
    }
    report(&format!(
        "largest of 1600 deviations: {largest:.2} standard errors"
    ));
    assert!(largest < Z_MEAN, "{largest}");
    assert!(
        largest > 1.0,
        "the standard error is too large to prove anything: {largest}"
    );
}

/// Spectra of the film's index and of the light, and the thickness of the film at both ends.
fn wedge_of(scene: &Scene) -> ((scene::SpectrumId, scene::SpectrumId), (f64, f64)) {
    let film = scene
        .materials()
        .iter()
        .find_map(|material| match material {
            scene::Material::Film { layers, .. } => match &layers[0].thickness {
                scene::Thickness::Linear {
                    start_nm, end_nm, ..
                } => Some((layers[0].n, (*start_nm, *end_nm))),
                _ => None,
            },
            _ => None,
        });
    let (n, ends_nm) = film.expect("the wedge has a film");
    let scene::Environment::Constant(light) = *scene.environment() else {
        panic!("the wedge has a constant environment");
    };
    assert_eq!(light.scale, 1.0);
    ((n, light.spectrum), ends_nm)
}

/// Mean of a band over a column and its standard error.
fn column_mean(image: &SpectralImage, x: u32, band: u32) -> (f64, f64) {
    let (mut sum, mut variance) = (0.0, 0.0);
    for y in 0..image.height() {
        let i = ((y * image.width() + x) * image.bands().count() + band) as usize;
        sum += f64::from(image.radiance()[i]);
        variance += f64::from(image.variance()[i]);
    }
    let rows = f64::from(image.height());
    (sum / rows, variance.sqrt() / rows)
}

fn mean_over_band(
    scene: &Scene,
    (n, light): (scene::SpectrumId, scene::SpectrumId),
    band: u32,
    thickness_nm: f64,
) -> f64 {
    let steps = 100;
    let at = |i: i32| {
        let offset = (f64::from(i) + 0.5) / f64::from(steps);
        let index = scene.spectrum(n).at(band, offset);
        let wavelength = scene.settings().bands.wavelength_nm(band, offset);
        let film = optics::film(index.into(), thickness_nm, wavelength, 1.0);
        film.reflectance.unpolarized() * scene.spectrum(light).at(band, offset)
    };
    (0..steps).map(at).sum::<f64>() / f64::from(steps)
}

/// Some drivers silently end the loops of an invocation that runs for long. Runs of many samples in few pixels are divided to avoid
/// this; if it happens nevertheless, it must be an error.
fn long_runs_of_samples_are_complete_or_refused() {
    let gpu = lend();
    let scene = small("film_wedge", [4, 4], 20_000, 8, 1);
    let divided = |samples: Option<u32>| {
        let division = samples.map(|samples| gpu::Division { rows: 4, samples });
        gpu::render_divided(&gpu, &scene, division, &mut |_| ControlFlow::Continue(()))
    };
    let whole = divided(Some(50)).unwrap();
    assert_eq!(divided(None).unwrap(), whole);
    match divided(Some(20_000)) {
        Ok(image) => assert_eq!(image, whole),
        Err(gpu::RenderError::CutShort { counted, samples }) => {
            report(&format!(
                "the driver completed {counted} of {samples} samples in one run"
            ));
            assert!(counted < samples, "{counted} of {samples}");
        }
        Err(other) => panic!("{other}"),
    }
}

/// A pixel has the same bits however the samples are divided, and whichever tile it is in.
fn the_bits_do_not_depend_on_the_division_of_the_work() {
    let gpu = lend();
    let scene = small("soap_bubble", [600, 40], 6, 5, 3);
    let divided = |rows, samples| {
        let division = gpu::Division { rows, samples };
        gpu::render_divided(&gpu, &scene, Some(division), &mut |_| {
            ControlFlow::Continue(())
        })
        .unwrap_or_else(|error| panic!("{error}"))
    };
    let at_once = divided(40, 6);
    assert_eq!(at_once, divided(1, 1));
    assert_eq!(at_once, divided(17, 4));
    assert_eq!(at_once, on_gpu(&gpu, &scene));
    assert_eq!(at_once.light_groups().len(), 2);
    let other = small("soap_bubble", [600, 40], 6, 5, 4);
    assert_ne!(
        at_once,
        on_gpu(&gpu, &other),
        "another seed gave the same picture"
    );
}
