//! The polarization of the clear sky.

use super::bench::{assert_stokes, camera, pictures, render, scene, seen, settings, stokes};
use glam::DVec3;
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::SKY_POLARIZATION;

const DEGREE: f64 = 0.8;

const SKY: &str = "[environment]\ntype = \"sky\"\nsun_elevation_deg = 30\nsun_azimuth_deg = 215\nsun = false\npolarization_degree = 0.8\n";

/// A direction from its elevation and azimuth: 0° is −z, 90° is +x.
fn toward(elevation_deg: f64, azimuth_deg: f64) -> DVec3 {
    let (y, level) = elevation_deg.to_radians().sin_cos();
    let (sin, cos) = azimuth_deg.to_radians().sin_cos();
    DVec3::new(level * sin, y, -level * cos)
}

/// S1 and S2 over S0 for a camera whose horizontal is `right`: single Rayleigh scattering, sin² γ / (1 + cos² γ) at an angle γ from the sun,
/// with the field across the plane of sun and ray (Coulson, Polarization and Intensity of Light in the Atmosphere, 1988); light from the
/// ground is unpolarized.
fn expected(ray: DVec3, right: DVec3) -> [f64; 2] {
    if ray.y < 0.0 {
        return [0.0; 2];
    }
    let sun = toward(30.0, 215.0);
    let gamma = ray.angle_between(sun);
    let degree = DEGREE * gamma.sin().powi(2) / (1.0 + gamma.cos().powi(2));
    let field = ray.cross(sun).normalize();
    let angle = field.dot(right.cross(ray)).atan2(field.dot(right));
    [degree * (2.0 * angle).cos(), degree * (2.0 * angle).sin()]
}

#[test]
fn the_sky_is_polarized_across_the_plane_of_the_sun() {
    let gpu = lend();
    for (elevation, azimuth) in [
        (60.0, 35.0),
        (80.0, 100.0),
        (10.0, 125.0),
        (25.0, 260.0),
        (30.0, 200.0),
        (-20.0, 60.0),
    ] {
        let ray = toward(elevation, azimuth);
        let level = ray.cross(DVec3::Y).normalize();
        // Level, and turned about the ray.
        for right in [level, level * 0.6 + ray.cross(level) * 0.8] {
            let [s1, s2] = expected(ray, right);
            for (renderer, found) in seen(&gpu, &[&camera(-ray, right, ""), &render(1), SKY]) {
                for found in found {
                    assert!(found[0] > 0.0);
                    let found = found.map(|s| s / found[0]);
                    let what = format!("{elevation}°, {azimuth}°");
                    assert_stokes(&what, renderer, found, [1.0, s1, s2, 0.0]);
                }
            }
        }
    }
}

/// A panorama of all directions with the zenith in the middle: means over its pixels, of which those at the horizon are left out.
#[test]
fn a_panorama_of_the_sky_is_polarized() {
    const SIZE: [u32; 2] = [16, 8];
    const PLACES: u32 = 8;
    let gpu = lend();
    let view = "[camera]\ntype = \"panorama\"\nposition = [0, 0, 0]\nlook_at = [0, 1, 0]\nup = [0, 0, -1]\n";
    let drawn = scene(&[view, &settings(SIZE, 256, 2, true), SKY]);
    let up = drawn.camera().up;
    let mut compared = [0, 0];
    for (renderer, image) in pictures(&gpu, &drawn) {
        let found = stokes(&image);
        for pixel in 0..SIZE[0] * SIZE[1] {
            let at = [pixel % SIZE[0], pixel / SIZE[0]];
            let rays = (0..PLACES * PLACES).map(|i| {
                let place =
                    [i % PLACES, i / PLACES].map(|j| (f64::from(j) + 0.5) / f64::from(PLACES));
                reference::camera_ray(&drawn, at, place).direction
            });
            let rays: Vec<_> = rays.collect();
            let above = rays.iter().filter(|ray| ray.y > 0.0).count();
            if above != 0 && above != rays.len() {
                continue;
            }
            compared[usize::from(above != 0)] += 1;
            let mut mean = [0.0; 2];
            for ray in &rays {
                let of_ray = expected(*ray, ray.cross(up).normalize());
                mean = [0, 1].map(|i| mean[i] + of_ray[i] / rays.len() as f64);
            }
            let first = found[(pixel * image.bands().count()) as usize];
            let [_, s1, s2, s3] = first.map(|s| s / first[0]);
            let off = (s1 - mean[0]).abs().max((s2 - mean[1]).abs()).max(s3.abs());
            println!("panorama, {at:?}, {renderer}: off by {off:.1e}");
            assert!(
                off <= SKY_POLARIZATION,
                "{at:?}, {renderer}: [{s1}, {s2}, {s3}] instead of {mean:?}"
            );
        }
    }
    assert!(compared.iter().all(|count| *count > 40), "{compared:?}");
}
