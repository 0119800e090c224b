//! Metals, smooth and rough.

use crate::comparison::{DOWN, WHITE, check, pictures, render, scene};
use optics::Complex64;
use pellicle_tests::device::open;
use pellicle_tests::tolerances::{
    CLOSED_FORM, CLOSED_FORM_EXACT, FURNACE_ROUGH, ROUGH_FORM, Z_MEAN,
};
use scene::Scene;
use std::f64::consts::{FRAC_PI_2, TAU};

const GOLD: &str = r#"
[materials.metal]
type = "conductor"
index = "gold"
"#;

const METAL_FLOOR: &str = r#"
[[objects]]
type = "rectangle"
material = "metal"
center = [0, 0, 0]
normal = [0, 1, 0]
size = [2, 2]
"#;

/// Index of the one conductor at a wavelength, as the scene has it.
fn metal(scene: &Scene, band: u32, offset: f64) -> Complex64 {
    let found = scene.materials().iter().find_map(|m| match *m {
        scene::Material::Conductor { n, k, .. } => Some((n, k)),
        _ => None,
    });
    let (n, k) = found.expect("there is a conductor");
    Complex64::new(
        scene.spectrum(n).at(band, offset),
        scene.spectrum(k).at(band, offset),
    )
}

fn metal_mean(scene: &Scene, band: u32, f: impl Fn(Complex64) -> f64) -> f64 {
    let steps = 200;
    let at = |i| f(metal(scene, band, (f64::from(i) + 0.5) / f64::from(steps)));
    (0..steps).map(at).sum::<f64>() / f64::from(steps)
}

#[test]
fn a_mirror_reflects_its_reflectance() {
    // Looks down at 60° from the normal.
    const ASLANT: &str = r#"
[camera]
type = "orthographic"
position = [1.7320508075688772, 1, 0]
look_at = [0, 0, 0]
height = 0.01
"#;
    let gpu = open();
    for (what, camera, cosine) in [("from above", DOWN, 1.0), ("aslant", ASLANT, 0.5)] {
        let reflectance = |index| optics::reflectance_unpolarised(index, cosine);
        let drawn = scene(&[camera, &render(64, 2, "random"), GOLD, METAL_FLOOR, WHITE]);
        check(&gpu, what, &drawn, CLOSED_FORM, |band| {
            metal_mean(&drawn, band, reflectance)
        });
        let fixed = scene(&[camera, &render(4, 2, "centre"), GOLD, METAL_FLOOR, WHITE]);
        check(&gpu, what, &fixed, CLOSED_FORM_EXACT, |band| {
            reflectance(metal(&fixed, band, 0.5))
        });
    }
}

/// Directional albedo of a rough conductor seen along its normal: ∫ f R cos θ dω by quadrature, and of what is left the colour of
/// light that met several facets. Under the environment the light comes by scattering alone, in a luminous sphere by
/// connections too.
#[test]
fn a_rough_metal_reflects_its_albedo() {
    const SHELL: &str = r#"
[materials.lamp]
type = "emitter"
emission = { constant = 1 }

[[objects]]
type = "sphere"
material = "lamp"
center = [0, 0.5, 0]
radius = 10
"#;
    let gpu = open();
    for roughness in [0.1, 0.3, 0.8] {
        let rough = format!("{GOLD}roughness = {roughness}\n");
        let surface = optics::Microsurface {
            distribution: optics::Distribution::Beckmann,
            alpha: [roughness; 2],
        };
        let mean_energy = mean_energy(&surface);
        let lost = 1.0 - surface.albedo([0.0, 0.0, 1.0], 200);
        let albedo = |index| {
            let steps = 2000;
            let at = |i| {
                let angle = (f64::from(i) + 0.5) / f64::from(steps) * FRAC_PI_2;
                let light = [angle.sin(), 0.0, angle.cos()];
                let facet = surface.reflection([0.0, 0.0, 1.0], light);
                let fresnel = optics::reflectance_unpolarised(index, (angle / 2.0).cos());
                facet * fresnel * angle.cos() * angle.sin()
            };
            let once = TAU * (0..steps).map(at).sum::<f64>() * FRAC_PI_2 / f64::from(steps);
            let mean = optics::mean_reflectance(|c| optics::reflectance_unpolarised(index, c));
            once + lost * optics::multiple_colour(mean, mean_energy)
        };
        for (where_, light) in [("environment", WHITE), ("shell", SHELL)] {
            let lit = scene(&[DOWN, &render(64, 2, "random"), &rough, METAL_FLOOR, light]);
            let what = format!("roughness {roughness}, {where_}");
            check(&gpu, &what, &lit, ROUGH_FORM, |band| {
                metal_mean(&lit, band, albedo)
            });
        }
    }
}

/// The albedo of facets averaged over a hemisphere, ∫ E d(cos²θ).
fn mean_energy(surface: &optics::Microsurface) -> f64 {
    let steps = 100;
    let at = |i| {
        let cos2 = (f64::from(i) + 0.5) / f64::from(steps);
        surface.albedo([(1.0 - cos2).sqrt(), 0.0, cos2.sqrt()], 64)
    };
    (0..steps).map(at).sum::<f64>() / f64::from(steps)
}

/// Spheres of a metal that absorbs next to nothing (n = 0.001, k = 1000: 4e-9), bare and under a film, smooth to rough, brushed or
/// not, before a white environment: nothing of them is to be seen.
#[test]
fn lossless_rough_surfaces_are_white() {
    const TILES: [u32; 2] = [4, 2];
    let rough = [
        "roughness = 0.05",
        "roughness = 0.3",
        "roughness = 1",
        "roughness = [0.05, 0.4]\nbrushed = { along = [1, 1, 0] }",
    ];
    let lossless = "index = [0.001, 1000]\ntype = \"conductor\"";
    let under_a_film =
        "substrate = [0.001, 1000]\nindex = 2.2\nthickness_nm = 300\ntype = \"coated\"";
    let mut text = String::from(
        "[camera]\ntype = \"orthographic\"\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nheight = 2\n\
         [render]\nsize = [64, 32]\nsamples = 256\nbands = 2\nmax_path_segments = 24\n",
    );
    for tile in 0..TILES[0] * TILES[1] {
        let (column, row) = (tile % TILES[0], tile / TILES[0]);
        let body = if column % 2 == row {
            lossless
        } else {
            under_a_film
        };
        let distribution = if row == 0 { "beckmann" } else { "ggx" };
        text += &format!(
            "[materials.m{tile}]\n{body}\ndistribution = \"{distribution}\"\n{}\n\
             [[objects]]\ntype = \"sphere\"\nmaterial = \"m{tile}\"\ncenter = [{}, {}, 0]\nradius = 0.45\n",
            rough[column as usize],
            f64::from(column) - 1.5,
            0.5 - f64::from(row),
        );
    }
    let gpu = open();
    let white = scene(&[&text, WHITE]);
    for (who, image) in pictures(&gpu, &white) {
        for tile in 0..TILES[0] * TILES[1] {
            let (left, top) = (16 * (tile % TILES[0]), 16 * (tile / TILES[0]));
            let first_bands = (0..256).map(|i| 2 * (64 * (top + i / 16) + left + i % 16) as usize);
            let sum =
                |values: &[f32]| -> f64 { first_bands.clone().map(|i| f64::from(values[i])).sum() };
            let mean = sum(image.radiance()) / 256.0;
            let error = sum(image.variance()).sqrt() / 256.0;
            println!("{who}, tile {tile}: {mean:.5} ± {error:.5}");
            let off = (mean - 1.0).abs();
            assert!(
                off < FURNACE_ROUGH + Z_MEAN * error,
                "{who}, tile {tile}: {mean}"
            );
            assert!(error < FURNACE_ROUGH, "{who}, tile {tile}: {error}");
        }
    }
}
