//! End-to-end tests of `pellicle color`, `pellicle display` and the illuminants of `pellicle film`.

use colorimetry::{Display, srgb};
use pellicle::coating::{Angle, Stack};
use pellicle_tests::command::{Place, Ran};
use pellicle_tests::tables::{number, rows};
use serde_json::Value;
use std::fmt::Write as _;

/// Colors of stacks by an independent computation, which the head of the file describes.
const STACK_COLORS: &str = include_str!("../../crates/coating/tests/coating/data/stack_colors.csv");
/// White points by an independent computation.
const WHITE_POINTS: &str = include_str!("../../crates/colorimetry/tests/colorimetry/data/white_points.csv");

/// A table as users write it, with all digits.
fn csv(values: impl IntoIterator<Item = (f64, f64)>) -> String {
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

fn json(place: &Place, arguments: &str) -> Value {
    let ran = place.run(&format!("{arguments} --format json")).succeeded();
    serde_json::from_str(&ran.stdout).unwrap()
}

fn floats(value: &Value) -> Vec<f64> {
    let values = value.as_array().unwrap().iter();
    values.map(|value| value.as_f64().unwrap()).collect()
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
        let found = json(place, &format!("color stack.csv {options}"));
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
        let found = json(&place, &format!("color lamp.csv {options}"));
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
        let found = json(&place, &format!("color white.csv {options}"));
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
            let found = json(&place, &format!("color white.csv {options}"));
            assert_eq!(found["rgb"], serde_json::json!([255, 255, 255]));
            for value in floats(&found["linear_rgb"]) {
                assert!((value - 1.0).abs() < 1e-12, "{options}: {value}");
            }
        }
    }
    std::fs::write(place.path("gray.csv"), csv([(380.0, 0.25), (780.0, 0.25)])).unwrap();
    let found = json(&place, "color gray.csv --adapt bradford --display crt_1997");
    let expected = 0.25_f64.powf(1.0 / 2.2);
    for code in floats(&found["encoded_rgb"]) {
        assert!((code - expected).abs() < 1e-12, "{code}");
    }
    // PQ codes are luminances: 203 cd/m² is 58 %.
    let found = json(
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
    for words in [
        "under FL11, 1931_2, sums at 5nm",
        "XYZ ",
        "L*a*b*",
        "adapted from FL11 by cat16",
        "beyond the display",
    ] {
        assert!(
            ran.stdout.contains(words),
            "{words:?} is not in\n{}",
            ran.stdout
        );
    }
}

#[test]
fn black_has_no_chromaticity() {
    let place = Place::default();
    std::fs::write(place.path("black.csv"), csv([(380.0, 0.0), (780.0, 0.0)])).unwrap();
    let found = json(&place, "color black.csv");
    assert_eq!(
        (&found["xy"], &found["rgb"]),
        (&Value::Null, &serde_json::json!([0, 0, 0]))
    );
}

/// Checks that a table with this text is refused, with all of `said` in the message.
fn refused(text: &str, options: &str, said: &[&str]) {
    let place = Place::default();
    std::fs::write(place.path("t.csv"), text).unwrap();
    let ran = place.run(&format!("color t.csv {options}"));
    assert!(ran.stdout.is_empty(), "{}", ran.stdout);
    let stderr = ran.failed();
    for words in said {
        assert!(
            stderr.contains(words),
            "{text:?} {options}: {words:?} is not in\n{stderr}"
        );
    }
}

#[test]
fn unusable_tables_are_refused_with_a_reason() {
    let whole = "380,0.5\n780,0.5\n";
    refused(
        "wavelength_nm,value\n380,1.01\n780,0\n",
        "",
        &["line 2", "reflectance 1.01", "from 0 to 1"],
    );
    refused("380,-0.1\n780,0\n", "", &["line 1", "reflectance -0.1"]);
    refused("380,nan\n780,0\n", "", &["line 1", "nan"]);
    refused("380,-1\n780,0\n", "--emission", &["line 1", "power -1"]);
    refused("380,0\n780,0\n", "--emission", &["must have power"]);
    refused(
        "780,0\n380,0\n500,1\n",
        "",
        &["line 3", "500 after 380", "rise or fall throughout"],
    );
    refused(
        "nm,r,g\n380,0,0\n",
        "",
        &["3 columns, expected 2", "2 \"r\", 3 \"g\"", "--column"],
    );
    refused("", "", &["no points"]);
    refused(
        "400,0.5\n780,0.5\n",
        "",
        &["no value at 380 nm", "400 to 780 nm", "--clamp"],
    );
    refused(
        "380,0.5\n779.5,0.5\n",
        "--emission",
        &["no value at 780 nm", "--clamp"],
    );
    refused(whole, "--illuminant d65", &["did you mean \"D65\""]);
    refused(whole, "--illuminant D3000K", &["4000 to 25000 K"]);
    refused(whole, "--illuminant D65*2", &["no illuminant \"D65*2\""]);
    refused(
        whole,
        "--illuminant none.csv",
        &["none.csv: cannot be opened"],
    );
    refused(whole, "--observer 1931", &["1931_2", "2015_10"]);
    refused(whole, "--rule 10nm", &["5nm and 1nm"]);
    refused(whole, "--adapt ciecat02", &["none, bradford and cat16"]);
    refused(whole, "--display crt", &["did you mean \"crt_1997\""]);
    refused(
        whole,
        "--display none.toml",
        &["none.toml: cannot be opened"],
    );

    let place = Place::default();
    let stderr = place.run("color none.csv").failed();
    assert!(stderr.contains("none.csv: cannot be opened"), "{stderr}");
    std::fs::write(place.path("t.csv"), "400,0.5\n700,0.5\n").unwrap();
    let clamped = json(&place, "color t.csv --clamp");
    assert!((floats(&clamped["xyz"])[1] - 50.0).abs() < 1e-12);
    // A lamp whose data are too short is reported by its option.
    let stderr = place.run("color t.csv --clamp --illuminant t.csv").failed();
    assert!(
        stderr.contains("--illuminant") && stderr.contains("no value at 380 nm"),
        "{stderr}"
    );
}

#[test]
fn displays_are_listed_and_shown() {
    let place = Place::default();
    let listed = place.run("display").succeeded().stdout;
    let all = json(&place, "display");
    let names: Vec<&str> = all
        .as_array()
        .unwrap()
        .iter()
        .map(|d| d["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, Display::names());
    for name in names {
        assert!(listed.contains(name), "{name}");
        let shown = place.run(&format!("display {name}")).succeeded().stdout;
        for words in [
            "source",
            "red",
            "white",
            "M, XYZ from",
            "M⁻¹",
            "curves",
            "gamut",
        ] {
            assert!(
                shown.contains(words),
                "{name}: {words:?} is not in\n{shown}"
            );
        }
        let found = json(&place, &format!("display {name}"));
        let matrix: Vec<f64> = found["xyz_from_rgb"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(floats)
            .collect();
        // Reading JSON rounds the last digit.
        let expected = *Display::named(name).unwrap().xyz_from_rgb();
        for (found, expected) in matrix.iter().zip(expected.as_flattened()) {
            assert!((found - expected).abs() < 1e-15, "{name}: {found}");
        }
    }
    let crt = place.run("display crt_1997").succeeded().stdout;
    for words in ["0.618854", "0.313072", "γ = 2.2", "assumed"] {
        assert!(crt.contains(words), "{words:?} is not in\n{crt}");
    }
}

#[test]
fn a_custom_display_is_a_file() {
    let place = Place::default();
    std::fs::create_dir(place.path("screens")).unwrap();
    let file = "
title = 'study'
white = 'C'
primaries = { red = [0.6, 0.35], green = [0.3, 0.6], blue = [0.15, 0.07] }
response = { curve = 'gamma', gamma = [2.1, 2.2, 2.3], alpha = 0.05 }
";
    std::fs::write(place.path("screens/old.toml"), file).unwrap();
    let found = json(&place, "display screens/old.toml");
    assert_eq!(
        (&found["name"], &found["response"][2]["gamma"]),
        (&"old".into(), &2.3.into())
    );
    let white = floats(&found["white_xy"]);
    assert!((white[0] - 0.310_06).abs() < 1e-5 && (white[1] - 0.316_16).abs() < 1e-5);
    std::fs::write(place.path("gray.csv"), csv([(380.0, 0.25), (780.0, 0.25)])).unwrap();
    let found = json(
        &place,
        "color gray.csv --illuminant C --rule 5nm --display screens/old.toml",
    );
    // α + (1 − α) 0.25^(1/γ).
    for (code, gamma) in floats(&found["encoded_rgb"])
        .into_iter()
        .zip([2.1, 2.2, 2.3])
    {
        let expected = 0.05 + 0.95 * 0.25_f64.powf(1.0 / gamma);
        assert!((code - expected).abs() < 1e-12, "{code} {expected}");
    }
    std::fs::write(place.path("bad.toml"), file.replace("alpha", "alfa")).unwrap();
    let stderr = place.run("display bad.toml").failed();
    assert!(
        stderr.contains("bad.toml")
            && stderr.contains("unknown field `alfa`")
            && stderr.contains("line 5"),
        "{stderr}"
    );
}

/// Runs `film` with a stack and further arguments.
fn film(place: &Place, stack: &str, arguments: &str) -> Ran {
    let mut command = place.command("film");
    command.arg(stack).args(arguments.split_whitespace());
    Ran::of(&command.output().unwrap())
}

#[test]
fn film_and_color_agree_for_any_lamp_and_observer() {
    let place = Place::default();
    let stack = "1 | 2 120nm | 1.5";
    std::fs::write(place.path("stack.csv"), reflectance(stack, 0.0)).unwrap();
    std::fs::write(
        place.path("lamp.csv"),
        csv([(380.0, 0.2), (500.0, 3.0), (780.0, 1.0)]),
    )
    .unwrap();
    for options in [
        "--illuminant FL11",
        "--illuminant D5700K --observer 2015_2",
        "--illuminant blackbody_2400K --observer 1964_10",
        "--illuminant LED-RGB1 --observer 2015_10",
        "--illuminant lamp.csv",
    ] {
        // A reflectance in a file is summed at the 5 nm steps of a lamp with lines; a film is integrated between them.
        let allowed = if options.ends_with("FL11") {
            0.01
        } else {
            1e-9
        };
        let summed = json(&place, &format!("color stack.csv {options}"));
        let ran = film(&place, stack, &format!("{options} --format json")).succeeded();
        let film: Value = serde_json::from_str(&ran.stdout).unwrap();
        let color = &film["angles"][0]["color"];
        for (one, hundred) in floats(&color["XYZ"])
            .into_iter()
            .zip(floats(&summed["xyz"]))
        {
            assert!(
                (100.0 * one - hundred).abs() < allowed,
                "{options}: {one} {hundred}"
            );
        }
        for key in ["illuminant", "observer"] {
            assert_eq!(color[key], summed[key], "{options}");
        }
    }
    let stderr = film(&place, stack, "--illuminant none.csv").failed();
    assert!(stderr.contains("none.csv: cannot be opened"), "{stderr}");
}
