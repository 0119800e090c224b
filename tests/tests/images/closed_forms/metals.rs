//! Smooth and rough metals.

use super::comparison::{DOWN, WHITE, check, render, scene};
use optics::Complex64;
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::{CLOSED_FORM, CLOSED_FORM_EXACT, ROUGH_FORM};
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

/// Index of the only conductor at a wavelength, as the scene has it.
fn metal(scene: &Scene, band: u32, offset: f64) -> Complex64 {
    let found = scene.materials().iter().find_map(|m| match *m {
        scene::Material::Interface { n, k, .. } => Some((n, k)),
        _ => None,
    });
    let (n, k) = found.expect("the scene has a conductor");
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
    // A camera that looks down at 60° from the normal.
    const ASLANT: &str = r#"
[camera]
type = "orthographic"
position = [1.7320508075688772, 1, 0]
look_at = [0, 0, 0]
height = 0.01
"#;
    let gpu = lend();
    for (what, camera, cosine) in [("from above", DOWN, 1.0), ("aslant", ASLANT, 0.5)] {
        let reflectance = |index| optics::reflectance_unpolarized(index, cosine);
        let drawn = scene(&[camera, &render(64, 2, "random"), GOLD, METAL_FLOOR, WHITE]);
        check(&gpu, what, &drawn, CLOSED_FORM, |band| {
            metal_mean(&drawn, band, reflectance)
        });
        let fixed = scene(&[camera, &render(4, 2, "center"), GOLD, METAL_FLOOR, WHITE]);
        check(&gpu, what, &fixed, CLOSED_FORM_EXACT, |band| {
            reflectance(metal(&fixed, band, 0.5))
        });
    }
}

/// Directional albedo of a rough conductor seen along its normal: ∫ f R cos θ dω by quadrature, plus the rest times the color of
/// light that was reflected by several facets. In the environment, light is found by BSDF sampling alone; in a luminous sphere, by emitter
/// sampling too.
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
    let gpu = lend();
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
                let fresnel = optics::reflectance_unpolarized(index, (angle / 2.0).cos());
                facet * fresnel * angle.cos() * angle.sin()
            };
            let once = TAU * (0..steps).map(at).sum::<f64>() * FRAC_PI_2 / f64::from(steps);
            let mean = optics::mean_reflectance(|c| optics::reflectance_unpolarized(index, c));
            once + lost * optics::multiple_color(mean, mean_energy)
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
