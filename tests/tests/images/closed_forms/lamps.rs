//! Area emitters above a floor, directly and through films.

use super::comparison::{
    ALBEDO, DOWN, FLOOR, LAMBERT, band_mean, check, film, lamp, render, scene,
};
use optics::Complex64;
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::{CLOSED_FORM, NEARLY_NORMAL};
use std::f64::consts::TAU;

/// A sphere of radiance 1, fully visible: ρ r² / h² (Lambert).
#[test]
fn a_sphere_light_over_a_floor() {
    let gpu = lend();
    for (height, radius) in [(3.0, 1.0), (2.5, 0.2), (4.0, 0.01)] {
        let scene = scene(&[
            DOWN,
            &render(64, 2, "random"),
            LAMBERT,
            FLOOR,
            &lamp(height, radius),
        ]);
        let expected = ALBEDO * (radius / height).powi(2);
        let what = format!("sphere of {radius} at {height}");
        check(&gpu, &what, &scene, CLOSED_FORM, |_| expected);
    }
}

/// Form factor of a differential element to a parallel rectangle whose near corner is straight above it, with sides `x` and `z`
/// at height 1; odd in both (Siegel and Howell; Howell's catalog, B-3).
fn corner_factor(x: f64, z: f64) -> f64 {
    let part = |a: f64, b: f64| {
        let root = (1.0 + a * a).sqrt();
        a / root * (b / root).atan()
    };
    (part(x, z) + part(z, x)) / TAU
}

#[test]
fn a_rectangle_light_over_a_floor() {
    const LIGHT: &str = r#"
[[objects]]
type = "rectangle"
material = "lamp"
normal = [0, -1, 0]
"#;
    let gpu = lend();
    // Width is along x and height along z; the emitter is straight above or to the side.
    for ([width, depth], height, [x, z]) in [
        ([2.0, 0.6], 1.5, [0.0, 0.0]),
        ([2.0, 0.6], 1.5, [0.8, 0.5]),
        ([0.4, 3.0], 2.0, [-0.3, 1.2]),
    ] {
        let place = format!(
            "center = [{x:?}, {height:?}, {z:?}]\nsize = [{width:?}, {depth:?}]\nup = [0, 0, -1]\n"
        );
        let scene = scene(&[
            DOWN,
            &render(128, 2, "random"),
            LAMBERT,
            FLOOR,
            LIGHT,
            &place,
        ]);
        let factor = |sx: f64, sz: f64| {
            let corner = corner_factor(
                (x + sx * width / 2.0) / height,
                (z + sz * depth / 2.0) / height,
            );
            sx * sz * corner
        };
        let all = factor(1.0, 1.0) + factor(1.0, -1.0) + factor(-1.0, 1.0) + factor(-1.0, -1.0);
        let what = format!("rectangle of {width} × {depth} at ({x}, {height}, {z})");
        check(&gpu, &what, &scene, CLOSED_FORM, |_| ALBEDO * all);
    }
}

/// Films without effect: index 1, or thickness 0. Light behind them keeps its strength.
#[test]
fn light_through_an_absent_film_keeps_its_strength() {
    const BETWEEN: &str = "type = \"sphere\"\ncenter = [0, 2, 0]\nradius = 0.5";
    const AROUND: &str = "type = \"sphere\"\ncenter = [0, 4, 0]\nradius = 1.5";
    const SHEET: &str =
        "type = \"rectangle\"\ncenter = [0, 2, 0]\nnormal = [0, 1, 0]\nsize = [5, 5]";
    let gpu = lend();
    let expected = ALBEDO * (0.5_f64 / 4.0).powi(2);
    for (what, film, segments) in [
        (
            "a sphere of index 1 between",
            film("1.0", 700.0, BETWEEN),
            4,
        ),
        ("a sphere of index 1 around", film("1.0", 700.0, AROUND), 3),
        ("a sheet of index 1", film("1.0", 500.0, SHEET), 3),
        ("a sheet of no thickness", film("1.5", 0.0, SHEET), 3),
        (
            "a gold sheet of no thickness",
            film("\"gold\"", 0.0, SHEET),
            3,
        ),
    ] {
        let lit = scene(&[
            DOWN,
            &render(128, segments, "random"),
            LAMBERT,
            FLOOR,
            &lamp(4.0, 0.5),
            &film,
        ]);
        check(&gpu, what, &lit, CLOSED_FORM, |_| expected);
    }
}

/// Light of a small emitter through real films: T at normal incidence, once or twice.
#[test]
fn light_through_a_film_loses_what_it_reflects_and_absorbs() {
    const BETWEEN: &str = "type = \"sphere\"\ncenter = [0, 2, 0]\nradius = 0.5";
    const SHEET: &str =
        "type = \"rectangle\"\ncenter = [0, 2, 0]\nnormal = [0, 1, 0]\nsize = [5, 5]";
    // A floor so small that light reflected back by the films hardly hits it.
    const SMALL_FLOOR: &str = r#"
[[objects]]
type = "rectangle"
material = "lambert"
center = [0, 0, 0]
normal = [0, 1, 0]
size = [0.02, 0.02]
"#;
    let gpu = lend();
    let bare = ALBEDO * (0.02_f64 / 4.0).powi(2);
    let glass = Complex64::new(1.5, 0.0);
    let smoke = Complex64::new(1.7, 0.2);
    for (what, index, thickness_nm, object, crossings) in [
        ("a glass sheet", glass, 400.0, SHEET, 1),
        ("a smoked sheet", smoke, 250.0, SHEET, 1),
        ("a glass sphere", glass, 400.0, BETWEEN, 2),
    ] {
        let written = format!("[{:?}, {:?}]", index.re, index.im);
        let lit = scene(&[
            DOWN,
            &render(64, 2 + crossings as u32, "random"),
            LAMBERT,
            SMALL_FLOOR,
            &lamp(4.0, 0.02),
            &film(&written, thickness_nm, object),
        ]);
        check(&gpu, what, &lit, NEARLY_NORMAL, |band| {
            let through = |nm| {
                let film = optics::film(index, thickness_nm, nm, 1.0);
                film.transmittance.unpolarized().powi(crossings)
            };
            bare * band_mean(&lit, band, through)
        });
    }
}
