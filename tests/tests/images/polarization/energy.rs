//! Energy: white furnaces, and pictures in unpolarized light that polarization leaves as they are.

use super::bench::{NM, Renderer, pictures, scene, settings, stokes};
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::{IDENTITY, POLARIZED, SAME_S0_F32, Z_MEAN};
use reference::PreparedScene;

const FILM_OF_STACK: &str = "type = \"film\"\nlayers = [{ index = [2.2, 0.0], thickness_nm = 130 }, { index = [0.15, 3.5], thickness_nm = 12 }]";

/// Every kind of surface.
const MATERIALS: [(&str, &str); 14] = [
    (
        "clear film",
        "type = \"film\"\nindex = 1.5\nthickness_nm = 400",
    ),
    (
        "absorbing film",
        "type = \"film\"\nindex = [1.7, 0.2]\nthickness_nm = 200",
    ),
    ("stack film", FILM_OF_STACK),
    (
        "two beams",
        "type = \"film\"\nmodel = \"two_beam\"\nindex = 1.4\nthickness_nm = 350",
    ),
    ("smooth metal", "type = \"conductor\"\nindex = [0.2, 3.2]"),
    (
        "smooth metal under layers",
        "type = \"coated\"\nsubstrate = [0.2, 3.2]\nlayers = [{ index = 1.5, thickness_nm = 200 }, { index = [1.7, 0.1], thickness_nm = 90 }]",
    ),
    (
        "rough metal",
        "type = \"conductor\"\nindex = [0.2, 3.2]\nroughness = 0.3",
    ),
    (
        "brushed metal",
        "type = \"conductor\"\nindex = [0.2, 3.2]\nroughness = [0.1, 0.5]\nbrushed = { along = [1, 0, 0.4] }\ndistribution = \"ggx\"",
    ),
    (
        "rough metal under layers",
        "type = \"coated\"\nsubstrate = [0.2, 3.2]\nroughness = 0.4\nlayers = [{ index = 1.5, thickness_nm = 200 }]",
    ),
    (
        "smooth coat",
        "type = \"dielectric\"\nindex = 1.5\nbase = 0.6",
    ),
    (
        "rough coat",
        "type = \"dielectric\"\nindex = 1.5\nroughness = 0.3\nbase = 0.6",
    ),
    (
        "cook",
        "type = \"conductor\"\nindex = [0.2, 3.2]\n[materials.sample.model.cook1981]\nspecular = 0.7\ndiffuse = 0.3\n\
         diffuse_reflectance = 0.5\nslopes = [{ m = 0.2, weight = 0.4 }, { m = 0.6, weight = 0.6 }]",
    ),
    ("diffuse", "type = \"diffuse\"\nreflectance = 0.7"),
    ("bare glass", "type = \"dielectric\"\nindex = [1.5, 0.1]"),
];

/// A column of panels for each material and a row for each side, aslant, in front of a gradient and beside lamps: one interaction per
/// path.
fn panels(is_polarized: bool) -> scene::Scene {
    const LIGHT: &str = r#"
[environment]
type = "gradient"
zenith = { constant = 1 }
horizon = { constant = 0.3 }
ground = { constant = 0.1 }

[materials.lamp]
type = "emitter"
emission = { constant = 5 }

[[objects]]
type = "sphere"
material = "lamp"
center = [7, 4, 12]
radius = 3

[[lights]]
type = "distant"
direction = [0.2, 0.5, 1]
diameter_deg = 5
emission = { constant = 1 }
"#;
    let (columns, rows) = (MATERIALS.len() as f64, SIDES.len() as f64);
    let mut objects = String::new();
    for (column, (_, material)) in MATERIALS.iter().enumerate() {
        let material = material.replace("sample", &format!("m{column}"));
        objects += &format!("[materials.m{column}]\n{material}\n");
        for (row, side) in SIDES.iter().enumerate() {
            let [x, y] = [column, row].map(|i| i as f64 + 0.5);
            objects += &format!(
                "[[objects]]\ntype = \"rectangle\"\nmaterial = \"m{column}\"\ncenter = [{x:?}, {y:?}, 0]\nnormal = {side:?}\n\
                 size = [1, 1]\n"
            );
        }
    }
    let (x, y) = (0.5 * columns, 0.5 * rows);
    let view = format!(
        "[camera]\ntype = \"orthographic\"\nposition = [{x:?}, {y:?}, 5]\nlook_at = [{x:?}, {y:?}, 0]\nheight = {rows:?}\n"
    );
    let size = [MATERIALS.len() as u32, SIDES.len() as u32].map(|i| i * PIXELS);
    scene(&[&view, &settings(size, 4, 2, is_polarized), LIGHT, &objects])
}

/// The normals of the panels, bottom row first.
const SIDES: [[f64; 3]; 2] = [[0.5, 0.3, 1.0], [-0.5, -0.3, -1.0]];
/// The width of a panel in the picture.
const PIXELS: u32 = 4;

/// The largest difference of each material, relative to the value itself, between values of all pixels and bands.
fn furthest(plain: &[f64], polarized: &[f64]) -> Vec<f64> {
    let (mut worst, mut light) = (vec![0.0_f64; MATERIALS.len()], vec![0.0; MATERIALS.len()]);
    let row = MATERIALS.len() * PIXELS as usize;
    for (i, (plain, polarized)) in plain.iter().zip(polarized).enumerate() {
        let material = i / NM.len() % row / PIXELS as usize;
        light[material] += plain;
        worst[material] = worst[material].max((plain - polarized).abs() / plain.max(1e-3));
    }
    assert!(light.iter().all(|light| *light > 1.0), "{light:?}");
    worst
}

/// In f64, sample by sample.
#[test]
fn one_interaction_has_the_same_radiance_with_and_without_polarization() {
    let scenes = [false, true].map(panels);
    let [plain, polarized] = scenes.each_ref().map(|scene| {
        let prepared = PreparedScene::new(scene);
        let (width, height) = (scene.settings().width, scene.settings().height);
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        let found = pixels.flat_map(|pixel| prepared.sample(pixel, 0).radiance.swap_remove(0));
        found.collect::<Vec<_>>()
    });
    for ((name, _), worst) in MATERIALS.iter().zip(furthest(&plain, &polarized)) {
        println!("{name}, cpu f64: off by {worst:.1e}");
        assert!(worst <= IDENTITY, "{name}: off by {worst:.1e}");
    }
}

#[test]
fn one_interaction_makes_the_same_picture_with_and_without_polarization() {
    let gpu = lend();
    let [plain, polarized] = [false, true].map(|on| pictures(&gpu, &panels(on)));
    for ((renderer, plain), (_, polarized)) in plain.iter().zip(&polarized) {
        assert!(polarized.is_polarized() && !plain.is_polarized());
        let values = [plain, polarized].map(|image| {
            let values = image.radiance().iter().map(|&value| f64::from(value));
            values.collect::<Vec<_>>()
        });
        for ((name, _), worst) in MATERIALS.iter().zip(furthest(&values[0], &values[1])) {
            println!("{name}, {renderer}: off by {worst:.1e}");
            let allowed = match renderer {
                Renderer::Reference => POLARIZED,
                Renderer::Gpu => SAME_S0_F32,
            };
            assert!(worst <= allowed, "{name}, {renderer}: off by {worst:.1e}");
        }
    }
}

/// A film without absorption around a white ball, beside a perfect mirror, in unpolarized light of radiance 1 from everywhere: nothing can
/// be seen, and nothing is polarized. The noise is that between the pixels.
#[test]
fn a_white_furnace_stays_white_and_unpolarized() {
    const FURNACE: &str = r#"
[camera]
type = "perspective"
position = [0, 0, 4]
look_at = [0, 0, 0]
fov_deg = 32

[environment]
type = "constant"
emission = { constant = 1 }

[materials.soap]
type = "film"
index = 1.33
thickness_nm = { pole = 200, equator = 700 }

[materials.white]
type = "diffuse"
reflectance = 1

[materials.mirror]
type = "conductor"
index = [0.001, 1000]

[[objects]]
type = "sphere"
material = "soap"
center = [0, 0, 0]
radius = 1

[[objects]]
type = "sphere"
material = "white"
center = [0.3, -0.2, 0]
radius = 0.4

[[objects]]
type = "sphere"
material = "mirror"
center = [-0.4, 0.5, -0.1]
radius = 0.25
"#;
    let gpu = lend();
    let drawn = scene(&[FURNACE, &settings([16, 16], 64, 32, true)]);
    for (renderer, image) in pictures(&gpu, &drawn) {
        let found = stokes(&image);
        let bands = image.bands().count() as usize;
        for band in 0..bands {
            for (component, expected) in [1.0, 0.0, 0.0, 0.0].into_iter().enumerate() {
                let values = found.iter().skip(band).step_by(bands);
                let values: Vec<_> = values.map(|s| s[component]).collect();
                let count = values.len() as f64;
                let mean = values.iter().sum::<f64>() / count;
                let spread = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
                let error = (spread / (count - 1.0) / count).sqrt();
                println!("furnace, S{component}, {renderer}: {mean:.6} ± {error:.1e}");
                assert!(error < 2e-3, "{renderer}, S{component}: ± {error}");
                assert!(
                    (mean - expected).abs() <= Z_MEAN * error + renderer.tolerance(),
                    "{renderer}, S{component}: {mean} ± {error}"
                );
            }
        }
    }
}
