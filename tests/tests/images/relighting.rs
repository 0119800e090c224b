//! Pictures under other lamps: relit from bands against newly rendered, and color against the number of bands.

use colorimetry::lab::{Lab, delta_e_2000};
use gpu::Gpu;
use pellicle_tests::device::lend;
use pellicle_tests::scenes::file;
use pellicle_tests::tolerances::{BANDS_DELTA_E, METAMERS_DELTA_E, RELIT_DELTA_E};
use relight::xyz::exposure_scale;
use relight::{Relight, relight};
use scene_file::SceneFile;
use scene_file::description::{
    Emission, EmissionSpectrum, Environment, LightGroups, Material, WavelengthSampling,
};
use spectra::{Observer, SpectralImage};
use std::ops::ControlFlow;

fn on_gpu(gpu: &Gpu, file: &SceneFile) -> SpectralImage {
    let scene = file.validate().expect("valid");
    gpu::render(gpu, &scene, &mut |_| ControlFlow::Continue(()))
        .unwrap_or_else(|error| panic!("{error}"))
}

/// A scene with every illuminant replaced.
fn lit_by(name: &str, lamp: &str) -> SceneFile {
    let mut file = file(name);
    let replace = |emission: &mut Emission| {
        if let EmissionSpectrum::Illuminant { illuminant, .. } = &mut emission.spectrum {
            lamp.clone_into(illuminant);
        }
    };
    for material in file.description.materials.values_mut() {
        if let Material::Emitter { emission, .. } = material {
            replace(emission);
        }
    }
    match file.description.environment.as_mut() {
        Some(Environment::Constant { emission, .. }) => replace(emission),
        Some(Environment::Gradient {
            zenith,
            horizon,
            ground,
            ..
        }) => {
            replace(zenith);
            replace(horizon);
            if let Some(ground) = ground {
                replace(ground);
            }
        }
        Some(Environment::Image { .. } | Environment::Sky { .. }) => {
            panic!("{name} has an environment without a named lamp")
        }
        None => {}
    }
    file
}

fn sized(mut file: SceneFile, size: [u32; 2], samples: u32, bands: u32) -> SceneFile {
    let render = &mut file.description.render;
    (render.size, render.samples, render.bands, render.seed) = (size, samples, bands, 5);
    file
}

/// XYZ of a lamp on a perfect white, relative to an equal-energy radiance of 1.
fn white(lamp: &str) -> [f64; 3] {
    let lamp = spectra::illuminant(lamp).expect("carried").data;
    let mut sums = [0.0; 3];
    for nm in (380..=780).map(f64::from) {
        let power = lamp.at(nm).expect("covered");
        let seen = Observer::Cie1931Deg2.at(nm);
        sums = std::array::from_fn(|i| sums[i] + power * seen[i]);
    }
    sums.map(|sum| sum * spectra::KM_LUMENS_PER_WATT * exposure_scale(0.0))
}

/// Color differences of two lists of colors, developed at an exposure, each relative to the white of its lamp, in ascending order.
fn differences(a: &[[f64; 3]], b: &[[f64; 3]], (lamp, exposure_ev): (&str, f64)) -> Vec<f64> {
    let (white, scale) = (white(lamp), exposure_scale(exposure_ev));
    let lab = |xyz: &[f64; 3]| Lab::from_xyz(xyz.map(|v| v * scale), white);
    let pairs = a.iter().zip(b);
    let mut found: Vec<f64> = pairs.map(|(a, b)| delta_e_2000(lab(a), lab(b))).collect();
    found.sort_by(f64::total_cmp);
    found
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn colors(image: &SpectralImage) -> Vec<[f64; 3]> {
    image.xyz().iter().map(|xyz| xyz.map(f64::from)).collect()
}

const SIZE: [u32; 2] = [16, 12];
const SAMPLES: u32 = 256;

/// The bubble under a lamp, at 400 fixed wavelengths: the same paths, and no noise from sampled wavelengths, which the narrow lines
/// of a lamp would make large.
fn fresh(gpu: &Gpu, lamp: &str) -> SpectralImage {
    let mut file = sized(lit_by("soap_bubble", lamp), SIZE, SAMPLES, 400);
    let render = &mut file.description.render;
    render.sampling = WavelengthSampling::Center;
    render.light_groups = LightGroups::Single;
    on_gpu(gpu, &file)
}

fn relit(from: &SpectralImage, lamp: &str) -> SpectralImage {
    let mut image = from.clone();
    let changes = ["key", "sky"].map(|group| {
        let lamp = Some(spectra::illuminant(lamp).expect("carried").data);
        (group.to_owned(), Relight { lamp, factor: 1.0 })
    });
    relight(&mut image, &changes, Observer::Cie1931Deg2).unwrap_or_else(|error| panic!("{error}"));
    image
}

#[test]
fn a_relit_bubble_is_the_bubble_rendered_under_that_lamp() {
    let gpu = lend();
    let rendered = |bands| on_gpu(&gpu, &sized(file("soap_bubble"), SIZE, SAMPLES, bands));
    let (of_40, of_80) = (rendered(40), rendered(80));
    let exposure_ev = file("soap_bubble").description.render.exposure_ev;
    let mut wrong = Vec::new();
    for (lamp, bands, from) in [
        ("A", 40, &of_40),
        ("LED-B3", 40, &of_40),
        ("FL11", 80, &of_80),
        ("HP1", 80, &of_80),
    ] {
        let truth = colors(&fresh(&gpu, lamp));
        let found = colors(&relit(from, lamp));
        let off = differences(&found, &truth, (lamp, exposure_ev));
        let report = format!(
            "D65 to {lamp}, {bands} bands: mean ΔE2000 {:.3}, 95th percentile {:.3}, largest {:.2}",
            mean(&off),
            off[off.len() * 95 / 100],
            off[off.len() - 1]
        );
        println!("{report}");
        if mean(&off) >= RELIT_DELTA_E || off.iter().any(|e| e.is_nan()) {
            wrong.push(report);
        }
        // The comparison can fail: the picture before relighting is another one.
        let unlit = differences(&colors(from), &truth, (lamp, exposure_ev));
        assert!(mean(&unlit) > 2.0, "{lamp}: {}", mean(&unlit));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// XYZ is summed at the sampled wavelengths, so it does not depend on the bands, not even under a lamp with lines.
#[test]
fn the_color_of_a_film_does_not_depend_on_the_number_of_bands() {
    const COLUMNS: [u32; 2] = [8, 8];
    let gpu = lend();
    let columns = |bands| {
        let image = on_gpu(
            &gpu,
            &sized(lit_by("film_wedge", "FL11"), COLUMNS, 16_384, bands),
        );
        let column = |x| {
            let rows = (0..COLUMNS[1]).map(|y| image.xyz()[(y * COLUMNS[0] + x) as usize]);
            rows.fold([0.0; 3], |sum: [f64; 3], xyz| {
                std::array::from_fn(|i| sum[i] + f64::from(xyz[i]) / f64::from(COLUMNS[1]))
            })
        };
        (0..COLUMNS[0]).map(column).collect::<Vec<_>>()
    };
    let (few, many) = (columns(16), columns(80));
    let off = differences(&few, &many, ("FL11", 3.5));
    println!(
        "16 and 80 bands under FL11: mean ΔE2000 {:.3}, largest {:.3}",
        mean(&off),
        off[off.len() - 1]
    );
    assert!(off.iter().all(|&e| e < BANDS_DELTA_E), "{off:?}");
    // Neighboring columns differ by more: the comparison can fail.
    let shifted = differences(&few[1..], &many[..few.len() - 1], ("FL11", 3.5));
    assert!(mean(&shifted) > 3.0 * BANDS_DELTA_E, "{shifted:?}");
}

/// The plates of `scenes/metamers.toml` have one color under D65 alone. CIELAB under FL11 was computed independently (numpy,
/// sums at 1 nm).
#[test]
fn metamers_differ_under_another_lamp() {
    const UNDER_FL11: [[f64; 3]; 2] = [[60.404, 45.959, -20.816], [62.834, 48.951, -2.624]];
    let gpu = lend();
    let daylight = on_gpu(&gpu, &sized(file("metamers"), [8, 4], 4096, 80));
    let mut under_fl11 = daylight.clone();
    let lamp = Some(spectra::illuminant("FL11").expect("carried").data);
    let change = [("lamp".to_owned(), Relight { lamp, factor: 1.0 })];
    relight(&mut under_fl11, &change, Observer::Cie1931Deg2).unwrap();
    // Color of one pixel on either plate.
    let plates = |image: &SpectralImage, lamp| {
        let (white, scale) = (white(lamp), exposure_scale(0.0));
        [8 + 2, 8 + 5].map(|pixel| {
            let xyz = image.xyz()[pixel].map(|v| f64::from(v) * scale);
            Lab::from_xyz(xyz, white)
        })
    };
    let [left, right] = plates(&daylight, "D65");
    assert!(
        delta_e_2000(left, right) < METAMERS_DELTA_E,
        "{left:?} {right:?}"
    );
    let [left, right] = plates(&under_fl11, "FL11");
    assert!(delta_e_2000(left, right) > 5.0, "{left:?} {right:?}");
    for (found, [l, a, b]) in [left, right].into_iter().zip(UNDER_FL11) {
        let off = delta_e_2000(found, Lab { l, a, b });
        assert!(off < METAMERS_DELTA_E, "{found:?}: {off}");
    }
}
