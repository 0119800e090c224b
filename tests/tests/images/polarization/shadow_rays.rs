//! Polarized lights without extent that a diffuse floor sees through films.

use super::bench::{
    NM, about, angle_between, assert_stokes, camera, in_plane, render, seen, written,
};
use super::oracle::{Pair, airy};
use glam::DVec3;
use optics::{Complex64, Layer, Mueller};
use pellicle_tests::device::lend;
use std::f64::consts::PI;

const ALBEDO: f64 = 0.7;
const DISTANCE: f64 = 8.0;
const DEGREES: f64 = 60.0;
const GLASS: Layer = Layer {
    index: Complex64::new(1.5, 0.0),
    thickness_nm: 100.0,
};
const METAL: Layer = Layer {
    index: Complex64::new(0.15, 3.5),
    thickness_nm: 12.0,
};

/// Looks straight down at the floor, from below the films. Each film that a shadow ray passes counts as a segment.
fn room(films: u32) -> String {
    let floor = format!(
        "[materials.floor]\ntype = \"diffuse\"\nreflectance = {ALBEDO:?}\n[[objects]]\ntype = \"rectangle\"\nmaterial = \"floor\"\n\
         center = [0, 0, 0]\nnormal = [0, 1, 0]\nsize = [0.1, 0.1]\n"
    );
    [&camera(DVec3::Y, DVec3::X, ""), &render(1 + films), &floor]
        .map(String::as_str)
        .join("\n")
}

/// A film with its center and normal.
fn film(name: &str, layers: &[Layer], center: DVec3, normal: DVec3) -> String {
    format!(
        "[materials.{name}]\ntype = \"film\"\n{}\n[[objects]]\ntype = \"rectangle\"\nmaterial = \"{name}\"\ncenter = {:?}\nnormal = {:?}\n\
         size = [2, 2]\n",
        written(layers),
        center.to_array(),
        normal.to_array()
    )
}

/// Lights toward [`in_plane`], and their irradiance across the ray.
fn lights(stokes: [f64; 3], axis: DVec3) -> [(&'static str, String, f64); 3] {
    let toward = in_plane(DEGREES);
    let position = (toward * DISTANCE).to_array();
    let emission = format!("emission = {{ constant = 1, {} }}", about(stokes, axis));
    let of =
        |kind: &str, more: String| format!("[[lights]]\ntype = \"{kind}\"\n{emission}\n{more}\n");
    let direction = |d: DVec3| format!("direction = {:?}", d.to_array());
    let spot = format!(
        "position = {position:?}\nangle_deg = 20\n{}",
        direction(-toward)
    );
    let distant = format!("diameter_deg = 0\n{}", direction(toward));
    let near = DISTANCE.powi(-2);
    [
        (
            "point",
            of("point", format!("position = {position:?}")),
            near,
        ),
        ("spot", of("spot", spot), near),
        ("distant", of("distant", distant), 1.0),
    ]
}

/// ρ/π E cos θ with E = ½ (1 + S1) Tₛ + ½ (1 − S1) Tₚ, whatever S2 and S3 are; a diffuse surface leaves no polarization.
#[test]
fn a_floor_below_a_film_is_lit_by_what_passes() {
    let gpu = lend();
    let normal = DVec3::Y;
    for (name, layers) in [("glass", &[GLASS][..]), ("metal", &[GLASS, METAL])] {
        let sheet = film("sheet", layers, in_plane(DEGREES) * 5.0, normal);
        for stokes in [
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.3, 0.7, -0.4],
        ] {
            for (kind, light, irradiance) in lights(stokes, DVec3::Z) {
                for (renderer, found) in seen(&gpu, &[&room(1), &sheet, &light]) {
                    for (found, nm) in found.into_iter().zip(NM) {
                        let [_, t] = airy(layers, Complex64::ONE, nm, DEGREES);
                        let [t_s, t_p] = t.powers();
                        let passes = 0.5 * ((1.0 + stokes[0]) * t_s + (1.0 - stokes[0]) * t_p);
                        let cosine = DEGREES.to_radians().cos();
                        let expected = ALBEDO / PI * cosine * passes;
                        let found = found.map(|component| component / irradiance);
                        let what = format!("{name}, {kind}, {stokes:?}, {nm} nm");
                        assert_stokes(&what, renderer, found, [expected, 0.0, 0.0, 0.0]);
                    }
                }
            }
        }
    }
}

/// Two films whose planes of incidence are turned against each other: the second one analyzes what the first one leaves.
#[test]
fn films_on_the_way_to_a_light_are_passed_in_their_order() {
    let gpu = lend();
    let toward = in_plane(DEGREES);
    let (tilt_sin, tilt_cos) = 65.0_f64.to_radians().sin_cos();
    let up = (DVec3::Y - toward * toward.y).normalize();
    let layers = [GLASS, METAL];
    for turn in [0.0_f64, 40.0, 90.0] {
        let (sin, cos) = turn.to_radians().sin_cos();
        let tilted = toward * tilt_cos + (up * cos + DVec3::Z * sin) * tilt_sin;
        let outer = film("outer", &layers, toward * 7.0, tilted);
        let inner = film("inner", &layers, toward * 3.0, DVec3::Y);
        // The axes of light on its way down.
        let axis = DVec3::Y.cross(toward).normalize();
        let outer_axis = tilted.cross(toward).normalize();
        let turned = |from, to| Mueller::rotation(angle_between(from, to, -toward));
        for stokes in [[0.0; 3], [0.5, 0.8, 0.1], [0.0, 0.0, 1.0]] {
            let source = (DVec3::X - toward * toward.x).normalize();
            let [(kind, light, irradiance), ..] = lights(stokes, source);
            let [s1, s2, s3] = stokes;
            for (renderer, found) in seen(&gpu, &[&room(2), &outer, &inner, &light]) {
                for (found, nm) in found.into_iter().zip(NM) {
                    let through =
                        |degrees| -> Pair { airy(&layers, Complex64::ONE, nm, degrees)[1] };
                    let arrives = turned(source, outer_axis).apply([1.0, s1, s2, s3]);
                    let between = turned(outer_axis, axis).apply(through(65.0).apply(arrives));
                    let [passes, ..] = through(DEGREES).apply(between);
                    let cosine = DEGREES.to_radians().cos();
                    let expected = ALBEDO / PI * cosine * passes;
                    let found = found.map(|component| component / irradiance);
                    let what = format!("{kind}, {turn}°, {stokes:?}, {nm} nm");
                    assert_stokes(&what, renderer, found, [expected, 0.0, 0.0, 0.0]);
                }
            }
        }
    }
}
