//! Directions and pixels: checks where things appear in a picture.

use super::comparison::{LAMBERT, check, pictures, render, scene};
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::CLOSED_FORM_EXACT;
use std::f64::consts::PI;

/// An emitter as large as half a pixel lights the right pixel and no other.
#[test]
fn the_picture_is_neither_mirrored_nor_rotated() {
    const PIXEL: f64 = 0.05;
    const RADIUS: f64 = 0.02;
    let gpu = lend();
    let (right, up) = (15.5 * PIXEL, 11.5 * PIXEL); // pixel (45, 8) of 60 × 40
    let looks = [
        ("along −z", "[0, 0, 5]", "[0, 1, 0]", [right, up, 0.0]),
        ("along −x", "[5, 0, 0]", "[0, 1, 0]", [0.0, up, -right]),
        ("lying down", "[0, 0, 5]", "[1, 0, 0]", [up, -right, 0.0]),
        ("from below", "[0, -5, 0]", "[0, 0, 1]", [right, 0.0, up]),
    ];
    let fov = 2.0 * 0.2_f64.atan().to_degrees();
    let lenses = [
        "type = \"orthographic\"\nheight = 2".to_owned(),
        format!("type = \"perspective\"\nfov_deg = {fov}"),
    ];
    for (what, position, upwards, center) in looks {
        // From below, right is forward × up = y × z = x.
        for lens in &lenses {
            let text = format!(
                "[camera]\n{lens}\nposition = {position}\nlook_at = [0, 0, 0]\nup = {upwards}\n\
                 [render]\nsize = [60, 40]\nsamples = 1024\nbands = 1\nmax_path_segments = 1\n\
                 [[objects]]\ntype = \"sphere\"\nmaterial = \"lamp\"\ncenter = {center:?}\nradius = {RADIUS}\n"
            );
            let seen = scene(&[&text, LAMBERT]);
            for (who, image) in pictures(&gpu, &seen) {
                let lit = (0..60 * 40).filter(|i| image.pixel(i % 60, i / 60)[0] != 0.0);
                let lit: Vec<_> = lit.map(|i| (i % 60, i / 60)).collect();
                assert_eq!(lit, [(45, 8)], "{what}, {who}: {lens}");
                // Of 1024 Sobol points about half are on the emitter, far more evenly than at random (0.016).
                // The emitter covers half of the pixel; the perspective widens it by some ten-thousandths, off the axis by 2 %.
                let covered = f64::from(image.pixel(45, 8)[0]);
                let expected = PI * RADIUS * RADIUS / (PIXEL * PIXEL);
                assert!(
                    (covered - expected).abs() < 0.05,
                    "{what}, {who}: {covered}"
                );
            }
        }
    }
}

#[test]
fn a_gradient_has_its_stated_value_in_each_direction() {
    const SKY: &str = r#"
[environment]
type = "gradient"
zenith = { constant = 3 }
horizon = { constant = 1 }
ground = { constant = 0.25 }
"#;
    let gpu = lend();
    for (toward, up, expected) in [
        ("[0, 1, 0]", "[0, 0, 1]", 3.0),
        ("[0, 0, -1]", "[0, 1, 0]", 1.0),
        ("[1, 0, 0]", "[0, 1, 0]", 1.0),
        ("[0, -1, 0]", "[0, 0, 1]", 0.25),
        ("[0.8, 0.6, 0]", "[0, 1, 0]", 0.6 * 3.0 + 0.4),
        ("[0.8, -0.6, 0]", "[0, 1, 0]", 0.6 * 0.25 + 0.4),
    ] {
        let camera = format!(
            "[camera]\ntype = \"orthographic\"\nposition = [0, 0, 0]\nlook_at = {toward}\nup = {up}\nheight = 1\n"
        );
        let sky = scene(&[&camera, &render(4, 1, "random"), SKY]);
        check(&gpu, toward, &sky, CLOSED_FORM_EXACT, |_| expected);
    }
}
