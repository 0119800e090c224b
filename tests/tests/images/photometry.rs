//! Lights in physical units: compares the values of a picture with closed forms. Km is 683 lm/W.

use pellicle_tests::device::lend;
use pellicle_tests::sources::root;
use reference::Emitter;
use scene::{LightShape, Scene};
use scene_file::SceneFile;
use spectra::{KM_LUMENS_PER_WATT, SpectralImage, observer_1931};
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// The promised relative error.
const PROMISE: f64 = 1e-3;

/// A scene seen from above, with a view of a hundredth of a unit.
fn scene(light: &str) -> Scene {
    let text = format!(
        "[camera]\ntype = \"orthographic\"\nposition = [0, 0.5, 0]\nlook_at = [0, 0, 0]\nup = [0, 0, -1]\nheight = 0.01\n\
         [render]\nsize = [32, 32]\nsamples = 64\nmax_path_segments = 2\n\
         [materials.white]\ntype = \"diffuse\"\nreflectance = 1.0\n{light}\n"
    );
    let file =
        SceneFile::parse("photometry.toml", &text, &root()).unwrap_or_else(|e| panic!("{e:#}"));
    file.validate().unwrap_or_else(|e| panic!("{e:#}"))
}

const FLOOR: &str = "[[objects]]\ntype = \"rectangle\"\nmaterial = \"white\"\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]\nsize = [1, 1]\n";

fn rendered(scene: &Scene) -> SpectralImage {
    gpu::render(&lend(), scene, &mut |_| ControlFlow::Continue(()))
        .unwrap_or_else(|e| panic!("{e}"))
}

/// Mean Y, summed at the wavelengths of the samples, cd/m².
fn luminance(image: &SpectralImage) -> f64 {
    let xyz = image.xyz();
    xyz.iter().map(|xyz| f64::from(xyz[1])).sum::<f64>() / xyz.len() as f64
}

/// Mean radiance of each band.
fn bands(image: &SpectralImage) -> Vec<f64> {
    let count = image.bands().count() as usize;
    let pixels = image.radiance().chunks(count);
    let mut sums = vec![0.0; count];
    for pixel in pixels.clone() {
        for (sum, &value) in sums.iter_mut().zip(pixel) {
            *sum += f64::from(value);
        }
    }
    sums.iter().map(|sum| sum / pixels.len() as f64).collect()
}

/// Km Σ L ∫ ȳ dλ over the bands.
fn luminance_of_bands(image: &SpectralImage) -> f64 {
    let (grid, [_, y, _]) = (image.bands(), observer_1931());
    let mean_y = |band| {
        let places = (0..100).map(|i| (f64::from(i) + 0.5) / 100.0);
        places
            .map(|at| y.at(grid.wavelength_nm(band, at)).unwrap())
            .sum::<f64>()
            / 100.0
    };
    let sum: f64 = (0..)
        .zip(bands(image))
        .map(|(band, value)| value * mean_y(band))
        .sum();
    KM_LUMENS_PER_WATT * grid.width_nm() * sum
}

fn radiance(image: &SpectralImage) -> f64 {
    image.bands().width_nm() * bands(image).iter().sum::<f64>()
}

fn assert_near(what: &str, found: f64, expected: f64) {
    println!("{what}: {found:.4}, expected {expected:.4}");
    assert!(
        (found / expected - 1.0).abs() < PROMISE,
        "{what}: {found} instead of {expected}"
    );
}

fn panel(emission: &str) -> String {
    format!(
        "[materials.panel]\ntype = \"emitter\"\nemission = {{ {emission} }}\n\
         [[objects]]\ntype = \"rectangle\"\nmaterial = \"panel\"\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]\nsize = [1, 1]\n"
    )
}

#[test]
fn a_panel_of_1000_candelas_reads_1000() {
    for lamp in [
        "illuminant = \"D65\"",
        "illuminant = \"A\"",
        "constant = 3",
        "illuminant = \"FL11\"",
    ] {
        let image = rendered(&scene(&panel(&format!("{lamp}, luminance_cd_m2 = 1000"))));
        assert_near(&format!("{lamp}, XYZ"), luminance(&image), 1000.0);
        // The lines of a fluorescent lamp are narrower than a band.
        if !lamp.contains("FL11") {
            assert_near(
                &format!("{lamp}, bands"),
                luminance_of_bands(&image),
                1000.0,
            );
        }
    }
}

#[test]
fn a_wrong_luminance_is_noticed() {
    let image = rendered(&scene(&panel(
        "illuminant = \"D65\", luminance_cd_m2 = 1002",
    )));
    assert!((luminance(&image) / 1000.0 - 1.0).abs() > PROMISE);
}

#[test]
fn a_panel_of_5_watts_per_area_and_steradian_has_that_radiance() {
    let image = rendered(&scene(&panel("illuminant = \"A\", radiance = 5")));
    assert_near("radiance", radiance(&image), 5.0);
}

/// L = ρ E / π with ρ = 1.
#[test]
fn a_distant_light_gives_its_illuminance_whatever_its_diameter() {
    for diameter in [0.0, 0.533, 40.0] {
        let light = format!(
            "{FLOOR}[[lights]]\ntype = \"distant\"\nemission = {{ illuminant = \"D65\", illuminance_lux = 1000 }}\n\
             direction = [0, 2, 0]\ndiameter_deg = {diameter:?}\n"
        );
        let image = rendered(&scene(&light));
        assert_near(&format!("{diameter}°"), luminance(&image), 1000.0 / PI);
    }
    // At 60° to the normal, half of it arrives.
    let light = format!(
        "{FLOOR}[[lights]]\ntype = \"distant\"\nemission = {{ illuminant = \"D65\", irradiance_w_m2 = 100 }}\n\
         direction = [0, 0.5, {}]\n",
        0.75_f64.sqrt()
    );
    assert_near("60°", radiance(&rendered(&scene(&light))), 50.0 / PI);
}

#[test]
fn a_constant_environment_gives_its_illuminance() {
    let light = format!(
        "{FLOOR}[environment]\ntype = \"constant\"\nemission = {{ illuminant = \"D65\", illuminance_lux = 500 }}\n"
    );
    assert_near("E", luminance(&rendered(&scene(&light))), 500.0 / PI);
}

/// E = I / d².
#[test]
fn a_point_of_100_candelas_gives_25_lux_at_two_meters() {
    let point = |emission: &str| {
        format!(
            "{FLOOR}[[lights]]\ntype = \"point\"\nemission = {{ illuminant = \"A\", {emission} }}\nposition = [0, 2, 0]\n"
        )
    };
    let image = rendered(&scene(&point("intensity_cd = 100")));
    assert_near("100 cd", luminance(&image), 25.0 / PI);
    let image = rendered(&scene(&point("power_w = 60")));
    assert_near("60 W", radiance(&image), 60.0 / (4.0 * PI) / 4.0 / PI);
}

/// The power of a spot is the integral of its intensity over all directions, computed by the midpoint rule.
#[test]
fn a_spot_emits_its_power() {
    let text = format!(
        "{FLOOR}[[lights]]\ntype = \"spot\"\nemission = {{ constant = 1, power_w = 20 }}\nposition = [0, 2, 0]\n\
         direction = [0, -1, 0]\nangle_deg = 70\nfull_angle_deg = 20\n"
    );
    let scene = scene(&text);
    let light = scene.lights()[0];
    assert!(matches!(light.shape, LightShape::Spot { .. }));
    let steps = 100_000;
    let sum: f64 = (0..steps)
        .map(|i| {
            let cosine = (f64::from(i) + 0.5) / f64::from(steps);
            let direction = glam::DVec3::new((1.0 - cosine * cosine).sqrt(), cosine, 0.0);
            // At a distance of 1 the irradiance equals the intensity.
            let LightShape::Spot { position, .. } = light.shape else {
                return f64::NAN;
            };
            Emitter::Delta(light.shape).strength(position - direction, direction)
        })
        .sum();
    let watts = light.emission.scale * 400.0 * 2.0 * PI * sum / f64::from(steps);
    assert!((watts / 20.0 - 1.0).abs() < 1e-6, "{watts}");
    let image = rendered(&scene);
    assert_near(
        "on the axis",
        radiance(&image),
        light.emission.scale * 400.0 / 4.0 / PI,
    );
}

/// A sphere of power Φ gives E = Φ / (4π d²) at any distance, as a point does.
#[test]
fn a_sphere_and_a_disk_emit_their_power() {
    let lamp =
        "[materials.lamp]\ntype = \"emitter\"\nemission = { illuminant = \"A\", power_w = 60 }\n";
    let sphere = format!(
        "{FLOOR}{lamp}[[objects]]\ntype = \"sphere\"\nmaterial = \"lamp\"\ncenter = [0, 2, 0]\nradius = 0.3\n"
    );
    assert_near(
        "sphere",
        radiance(&rendered(&scene(&sphere))),
        60.0 / (4.0 * PI) / 4.0 / PI,
    );
    // A point on the axis of a disk: E = π L r² / (d² + r²), with Φ = 2 π² r² L for both sides.
    let disk = format!(
        "{FLOOR}{lamp}[[objects]]\ntype = \"disk\"\nmaterial = \"lamp\"\ncenter = [0, 2, 0]\nnormal = [0, 1, 0]\nradius = 0.3\n"
    );
    let expected = 60.0 / (2.0 * PI) / (4.0 + 0.09) / PI;
    assert_near("disk", radiance(&rendered(&scene(&disk))), expected);
}
