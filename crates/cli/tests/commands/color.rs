//! Tests of `pellicle color`, and of the illuminants of `pellicle film`.

use crate::place::Place;
use crate::{assert_says, floats, json, number, rows};
use colorimetry::srgb;
use pellicle::coating::{Angle, Stack};
use serde_json::Value;
use std::fmt::Write as _;

/// Colors of stacks by an independent computation, which the head of the file describes.
const STACK_COLORS: &str = include_str!("../../../../tests/tests/colors/data/stack_colors.csv");
/// White points by an independent computation.
const WHITE_POINTS: &str = include_str!("../../../../tests/tests/colors/data/white_points.csv");

/// A table as users write it, with all digits.
pub(crate) fn csv(values: impl IntoIterator<Item = (f64, f64)>) -> String {
    let mut text = "wavelength_nm,value\n".to_owned();
    for (nm, value) in values {
        writeln!(text, "{nm},{value:e}").unwrap();
    }
    text
}

/// The unpolarized reflectance of a stack at 380, 381 … 780 nm.
fn reflectance(stack: &str, angle_deg: f64) -> String {
    let nm: Vec<f64> = (380..=780).map(f64::from).collect();
    let stack = Stack::parse(stack).unwrap();
    let angle = Angle::from_degrees(angle_deg).unwrap();
    let powers = stack
        .sampled(&nm)
        .unwrap()
        .powers(stack.thicknesses_nm(), angle);
    csv(nm
        .into_iter()
        .zip(powers.iter().map(|p| p.reflectance.unpolarized())))
}

/// The output of the command as JSON.
pub(crate) fn printed(place: &Place, arguments: &str) -> Value {
    json(place.run(&format!("{arguments} --format json")))
}

/// The largest difference between the figures of `color` and a row of the table: relative for XYZ, absolute for the rest, over 100 for
/// CIELAB.
fn difference(place: &Place, row: &[&str], illuminant: &str) -> f64 {
    let expected: Vec<f64> = row[4..].iter().map(|cell| number(cell)).collect();
    let rule = row[3];
    let mut worst: f64 = 0.0;
    for (adapt, rgb) in [("none", 6), ("bradford", 9)] {
        let options =
            format!("--illuminant {illuminant} --observer 1931_2 --rule {rule} --adapt {adapt}");
        let found = printed(place, &format!("color stack.csv {options}"));
        let of = |key: &str, from: usize, unit: f64| {
            let pairs = floats(&found[key])
                .into_iter()
                .zip(expected[from..].to_vec());
            pairs.map(|(a, b)| (a - b).abs() / unit).fold(0.0, f64::max)
        };
        let [x, y, z] = [expected[0], expected[1], expected[2]];
        let xy = floats(&found["xy"]);
        worst = worst
            .max(of("xyz", 0, x.min(y).min(z)))
            .max(
                (xy[0] - x / (x + y + z))
                    .abs()
                    .max((xy[1] - y / (x + y + z)).abs()),
            )
            .max(of("lab", 3, 100.0))
            .max(of("linear_rgb", rgb, 1.0));
        let linear: Vec<f64> = floats(&found["linear_rgb"]);
        let codes: Vec<u8> = linear.into_iter().map(srgb::to_u8).collect();
        assert_eq!(found["rgb"], serde_json::json!(codes));
    }
    worst
}

#[test]
fn stacks_have_the_colors_of_an_independent_computation() {
    let place = Place::default();
    let mut written = String::new();
    let mut count = 0;
    for row in rows(STACK_COLORS).filter(|row| row[1] == "0" || row[1] == "60") {
        let of = format!("{} {}", row[0], row[1]);
        if of != written {
            std::fs::write(place.path("stack.csv"), reflectance(row[0], number(row[1]))).unwrap();
            written = of;
        }
        let worst = difference(&place, &row, row[2]);
        // The table has twelve digits.
        assert!(worst < 1e-9, "{row:?}: {worst:e}");
        if count == 0 {
            // Another illuminant is noticed.
            assert!(difference(&place, &row, "D55") > 1e-3);
        }
        count += 1;
    }
    assert_eq!(count, 14 * 2 * 3 * 2);
}

/// The tables of the illuminants themselves as emissions: their white points for every observer in the table.
#[test]
fn emissions_have_the_white_points_of_an_independent_computation() {
    let place = Place::default();
    for row in
        rows(WHITE_POINTS).filter(|row| ["A", "D65", "FL11", "LED-B3", "HP1"].contains(&row[1]))
    {
        let light = spectra::find_illuminant(row[1]).unwrap().data;
        let nm = (380..=780).step_by(5).map(f64::from);
        let table = csv(nm.map(|nm| (nm, light.at(nm).unwrap())));
        std::fs::write(place.path("lamp.csv"), table).unwrap();
        let options = format!("--emission --observer {} --rule {}", row[0], row[2]);
        let found = printed(&place, &format!("color lamp.csv {options}"));
        let figures = floats(&found["xyz"])
            .into_iter()
            .chain(floats(&found["xy"]));
        for (found, expected) in figures.zip(row[3..].iter().map(|cell| number(cell))) {
            assert!((found - expected).abs() < 1e-9, "{row:?}: {found}");
        }
        if row[0] == "1931_2" && row[1] == "D65" {
            let kelvin = found["cct_k"].as_f64().unwrap();
            assert!((kelvin - 6504.0).abs() < 4.0, "{kelvin}");
        }
        // A file as the illuminant is that illuminant: the perfect reflector is white under it.
        std::fs::write(place.path("white.csv"), csv([(380.0, 1.0), (780.0, 1.0)])).unwrap();
        let options = format!(
            "--illuminant lamp.csv --observer {} --rule {}",
            row[0], row[2]
        );
        let found = printed(&place, &format!("color white.csv {options}"));
        for (found, expected) in floats(&found["xyz"]).into_iter().zip(&row[3..]) {
            assert!((found - number(expected)).abs() < 1e-9, "{row:?}: {found}");
        }
        let lab = floats(&found["lab"]);
        assert!(
            (lab[0] - 100.0).abs() < 1e-10 && lab[1].abs() < 1e-10,
            "{lab:?}"
        );
    }
}

#[test]
fn lamps_with_lines_are_summed_at_5_nm_by_default() {
    let place = Place::default();
    std::fs::write(place.path("gray.csv"), csv([(380.0, 0.5), (780.0, 0.5)])).unwrap();
    let rule = |options: &str| {
        let ran = place
            .run(&format!("color gray.csv {options} --format json"))
            .succeeded();
        let found: Value = serde_json::from_str(&ran.stdout).unwrap();
        (found["rule"].as_str().unwrap().to_owned(), ran.stderr)
    };
    assert_eq!(rule(""), ("1nm".to_owned(), String::new()));
    assert_eq!(rule("--illuminant F11"), ("5nm".to_owned(), String::new()));
    assert_eq!(rule("--illuminant HP2").0, "5nm");
    let (found, said) = rule("--illuminant FL11 --rule 1nm");
    assert!(
        found == "1nm" && said.contains("defined by sums at 5 nm"),
        "{said}"
    );
    assert_eq!(rule("--illuminant blackbody_3000K").0, "1nm");
}

#[test]
fn white_is_adapted_to_the_display_and_codes_follow_its_curve() {
    let place = Place::default();
    std::fs::write(place.path("white.csv"), csv([(380.0, 1.0), (780.0, 1.0)])).unwrap();
    for adapt in ["bradford", "cat16"] {
        for display in ["srgb", "crt_1997", "ntsc_1953"] {
            let options = format!("--illuminant A --adapt {adapt} --display {display}");
            let found = printed(&place, &format!("color white.csv {options}"));
            assert_eq!(found["rgb"], serde_json::json!([255, 255, 255]));
            for value in floats(&found["linear_rgb"]) {
                assert!((value - 1.0).abs() < 1e-12, "{options}: {value}");
            }
        }
    }
    std::fs::write(place.path("gray.csv"), csv([(380.0, 0.25), (780.0, 0.25)])).unwrap();
    let found = printed(&place, "color gray.csv --adapt bradford --display crt_1997");
    let expected = 0.25_f64.powf(1.0 / 2.2);
    for code in floats(&found["encoded_rgb"]) {
        assert!((code - expected).abs() < 1e-12, "{code}");
    }
    // PQ codes are luminances: 203 cd/m² is 58 %.
    let found = printed(
        &place,
        "color white.csv --adapt bradford --display bt2100_pq",
    );
    assert!(
        (floats(&found["encoded_rgb"])[0] - 0.58).abs() < 0.005,
        "{found}"
    );
}

#[test]
fn a_table_says_the_same_in_text() {
    let place = Place::default();
    std::fs::write(
        place.path("red.csv"),
        csv([(380.0, 0.0), (600.0, 0.0), (601.0, 0.9), (780.0, 0.9)]),
    )
    .unwrap();
    let ran = place
        .run("color red.csv --illuminant F11 --adapt cat16")
        .succeeded();
    let words = [
        "under FL11, 1931_2, sums at 5nm",
        "XYZ ",
        "L*a*b*",
        "adapted from FL11 by cat16",
        "beyond the display",
    ];
    assert_says(&ran.stdout, &words);
}

#[test]
fn black_has_no_chromaticity() {
    let place = Place::default();
    std::fs::write(place.path("black.csv"), csv([(380.0, 0.0), (780.0, 0.0)])).unwrap();
    let found = printed(&place, "color black.csv");
    assert_eq!(
        (&found["xy"], &found["rgb"]),
        (&Value::Null, &serde_json::json!([0, 0, 0]))
    );
}

/// A film has the color of its reflectance in a file, up to a difference in XYZ over 100.
fn film_and_color_agree(options: &str, allowed: f64) {
    let place = Place::default();
    let stack = "1 | 2 120nm | 1.5";
    std::fs::write(place.path("stack.csv"), reflectance(stack, 0.0)).unwrap();
    let lamp = csv([(380.0, 0.2), (500.0, 3.0), (780.0, 1.0)]);
    std::fs::write(place.path("lamp.csv"), lamp).unwrap();
    let summed = printed(&place, &format!("color stack.csv {options}"));
    let film = json(place.film(stack, &format!("{options} --format json")));
    let color = &film["angles"][0]["color"];
    let pairs = floats(&color["XYZ"])
        .into_iter()
        .zip(floats(&summed["xyz"]));
    for (one, hundred) in pairs {
        assert!((100.0 * one - hundred).abs() < allowed, "{one} {hundred}");
    }
    for key in ["illuminant", "observer"] {
        assert_eq!(color[key], summed[key]);
    }
}

cases! { film_and_color_agree:
    // A reflectance in a file is summed at the 5 nm steps of a lamp with lines; a film is integrated between them.
    film_and_color_agree_for_a_lamp_with_lines("--illuminant FL11", 0.01);
    film_and_color_agree_for_daylight("--illuminant D5700K --observer 2015_2", 1e-9);
    film_and_color_agree_for_a_blackbody("--illuminant blackbody_2400K --observer 1964_10", 1e-9);
    film_and_color_agree_for_an_led("--illuminant LED-RGB1 --observer 2015_10", 1e-9);
    film_and_color_agree_for_a_lamp_from_a_file("--illuminant lamp.csv", 1e-9);
}

#[test]
fn a_film_in_a_missing_lamp_is_refused() {
    let stderr = Place::default()
        .film("1 | 1.5", "--illuminant none.csv")
        .failed();
    assert_says(&stderr, &["none.csv: cannot be opened"]);
}
