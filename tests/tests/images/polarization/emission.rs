//! Polarized light that the camera sees directly, and through its polarizer.

use super::bench::{NM, assert_stokes, camera, pictures, render, scene, seen, stokes};
use glam::DVec3;
use pellicle_tests::device::lend;

/// Looks along −z, with x to the right.
fn ahead(more: &str) -> String {
    camera(DVec3::Z, DVec3::X, more)
}

/// An environment of radiance 1, a panel of it that fills the view, and a disk in the distance.
fn sources(polarization: &str) -> [(&'static str, String); 3] {
    let emission = format!("emission = {{ constant = 1, polarization = {{ {polarization} }} }}");
    [
        (
            "environment",
            format!("[environment]\ntype = \"constant\"\n{emission}\n"),
        ),
        (
            "panel",
            format!(
                "[materials.panel]\ntype = \"emitter\"\n{emission}\n[[objects]]\ntype = \"rectangle\"\nmaterial = \"panel\"\n\
                 center = [0, 0, -1]\nnormal = [0, 0, 1]\nsize = [1, 1]\n"
            ),
        ),
        (
            "sphere",
            format!(
                "[materials.panel]\ntype = \"emitter\"\n{emission}\n[[objects]]\ntype = \"sphere\"\nmaterial = \"panel\"\n\
                 center = [0, 0, -1]\nradius = 0.5\n"
            ),
        ),
    ]
}

/// Born and Wolf, Principles of Optics, 7th ed., section 1.4.2, equation 45: S1 = p cos 2χ cos 2ψ, S2 = p cos 2χ sin 2ψ, S3 = p sin 2χ.
/// Angles are counterclockwise as the camera sees them: 45° is the direction from the lower left to the upper right.
#[test]
fn emitted_light_arrives_as_it_was_written() {
    let gpu = lend();
    let root = 0.5_f64.sqrt();
    let x = "axis = [1, 0, 0]";
    for (written, expected) in [
        ("degree = 1", [1.0, 0.0, 0.0]),
        ("degree = 0.5, angle_deg = 45", [0.0, 0.5, 0.0]),
        ("degree = 0.6, angle_deg = 90", [-0.6, 0.0, 0.0]),
        ("degree = 1, angle_deg = -22.5", [root, -root, 0.0]),
        ("degree = 1, ellipticity_deg = 45", [0.0, 0.0, 1.0]),
        ("degree = 1, ellipticity_deg = -45", [0.0, 0.0, -1.0]),
        (
            "degree = 0.8, angle_deg = 45, ellipticity_deg = 15",
            [0.0, 0.4 * 3.0_f64.sqrt(), 0.4],
        ),
        ("stokes = [0.1, -0.2, 0.3]", [0.1, -0.2, 0.3]),
    ] {
        // The part across the ray counts: the axis may lean toward the camera.
        let leaning = "axis = [0.6, 0, 0.8]";
        let vertical = "axis = [0, 1, 0]";
        let [s1, s2, s3] = expected;
        for (axis, [s1, s2]) in [(x, [s1, s2]), (leaning, [s1, s2]), (vertical, [-s1, -s2])] {
            for (name, source) in sources(&format!("{written}, {axis}")) {
                for (renderer, found) in seen(&gpu, &[&ahead(""), &render(1), &source]) {
                    let what = format!("{name}, {written}, {axis}");
                    for found in found {
                        assert_stokes(&what, renderer, found, [1.0, s1, s2, s3]);
                    }
                }
            }
        }
    }
}

/// The reference axis turned by 30° counterclockwise: ψ turns with it.
#[test]
fn angles_count_from_the_axis() {
    let gpu = lend();
    let half = 0.5 * 3.0_f64.sqrt();
    let written = format!("degree = 1, angle_deg = 15, axis = [{half:?}, 0.5, 0]");
    for (name, source) in sources(&written) {
        for (renderer, found) in seen(&gpu, &[&ahead(""), &render(1), &source]) {
            // At 45° from the horizontal.
            assert_stokes(name, renderer, found[0], [1.0, 0.0, 1.0, 0.0]);
        }
    }
}

/// What passes a polarizer in front of the camera, in all bands.
#[track_caller]
fn assert_passes(polarizer: &str, source: &str, expected: impl Fn(f64) -> f64) {
    let gpu = lend();
    let camera = ahead(&format!("polarizer = {{ {polarizer} }}"));
    let drawn = scene(&[&camera, &render(1), source]);
    for (renderer, image) in pictures(&gpu, &drawn) {
        assert!(!image.is_polarized());
        for (found, nm) in image.pixel(0, 0).iter().zip(NM) {
            let off = (f64::from(*found) - expected(nm)).abs();
            println!("{polarizer}, {renderer}, {nm} nm: off by {off:.1e}");
            assert!(
                off <= renderer.tolerance(),
                "{polarizer}, {source}, {renderer}, {nm} nm: {found} instead of {}",
                expected(nm)
            );
        }
    }
}

fn environment(polarization: &str) -> String {
    let [(_, environment), ..] = sources(&format!("{polarization}, axis = [1, 0, 0]"));
    environment
}

/// I = ½ (1 + p cos 2(φ − ψ)) (Malus 1809).
#[test]
fn a_polarizer_passes_what_malus_says() {
    for (degree, angle) in [(1.0, 0.0), (1.0, 70.0), (0.3, -20.0), (0.0, 0.0)] {
        let source = environment(&format!("degree = {degree:?}, angle_deg = {angle:?}"));
        for polarizer in [0.0_f64, 25.0, 45.0, 90.0, 160.0] {
            let expected = 0.5 * (1.0 + degree * (2.0 * (polarizer - angle)).to_radians().cos());
            assert_passes(&format!("angle_deg = {polarizer:?}"), &source, |_| expected);
        }
    }
}

/// Behind a quarter-wave plate right-handed light is polarized at +45° to the fast axis, left-handed light at −45°.
#[test]
fn a_quarter_wave_plate_tells_right_from_left() {
    for fast in [0.0, 20.0, 75.0] {
        for (sign, ellipticity) in [(1.0, 45.0), (-1.0, -45.0)] {
            let source = environment(&format!("degree = 1, ellipticity_deg = {ellipticity:?}"));
            for beside in [45.0_f64, -45.0, 0.0, 10.0] {
                let angle = fast + beside;
                let expected = 0.5 * (1.0 + sign * (2.0 * beside).to_radians().sin());
                let polarizer = format!(
                    "angle_deg = {angle:?}, retarder = {{ fast_axis_deg = {fast:?}, retardance_deg = 90 }}"
                );
                assert_passes(&polarizer, &source, |_| expected);
            }
        }
    }
}

/// A retarder at 45° between parallel polarizers: I = cos² (π Δ / λ) (Born and Wolf, section 15.4.2).
#[test]
fn a_path_difference_disperses() {
    let source = environment("degree = 1");
    for nm in [137.5, 600.0, 3000.0] {
        let polarizer =
            format!("angle_deg = 0, retarder = {{ fast_axis_deg = 45, retardance_nm = {nm:?} }}");
        assert_passes(&polarizer, &source, |wavelength| {
            (std::f64::consts::PI * nm / wavelength).cos().powi(2)
        });
    }
}

/// S1, S2 and S3 are there, and are 0.
#[test]
fn unpolarized_light_has_no_components() {
    let gpu = lend();
    let source = "[environment]\ntype = \"constant\"\nemission = { constant = 1 }\n";
    let drawn = scene(&[&ahead(""), &render(1), source]);
    for (renderer, image) in pictures(&gpu, &drawn) {
        for found in stokes(&image) {
            assert_stokes("plain", renderer, found, [1.0, 0.0, 0.0, 0.0]);
        }
    }
}
