//! Pictures with a known closed form: compares both renderers with formulas and optics, scene by scene.

mod coincidence;
mod comparison;
mod delta_lights;
mod furnace;
mod lamps;
mod layers;
mod lenses;
mod metals;
mod sky;
mod views;
mod wavelengths;

use comparison::{ALBEDO, DOWN, Estimate, FLOOR, LAMBERT, lamp, pictures, render, scene};
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::CLOSED_FORM;
use std::f64::consts::PI;

/// A value two percent off, a missing cosine and too much noise are all refused.
#[test]
fn a_wrong_formula_is_noticed() {
    let gpu = lend();
    let (height, radius) = (3.0_f64, 1.0_f64);
    let lit = |samples| {
        let lamp = lamp(height, radius);
        scene(&[DOWN, &render(samples, 2, "random"), LAMBERT, FLOOR, &lamp])
    };
    let right = ALBEDO * (radius / height).powi(2);
    // Without the cosine: the solid angle over π.
    let solid = 2.0 * (1.0 - (1.0 - (radius / height).powi(2)).sqrt());
    for (who, image) in pictures(&gpu, &lit(64)) {
        let found = Estimate::of(&image, 0);
        assert!(found.agrees(right, CLOSED_FORM).is_ok(), "{who}");
        for wrong in [
            right * 1.02,
            right * 0.98,
            ALBEDO * solid,
            right * PI,
            f64::NAN,
        ] {
            assert!(found.agrees(wrong, CLOSED_FORM).is_err(), "{who}: {wrong}");
        }
    }
    let noisy = Estimate {
        mean: right,
        error: 0.01 * right,
    };
    assert!(noisy.agrees(right, CLOSED_FORM).is_err());
}
