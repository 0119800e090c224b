//! Tests of `pellicle display`.

use crate::color::{csv, printed};
use crate::place::Place;
use crate::{assert_says, floats};
use colorimetry::Display;

#[test]
fn displays_are_listed_and_shown() {
    let place = Place::default();
    let listed = place.run("display").succeeded().stdout;
    let all = printed(&place, "display");
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
        let words = ["source", "red", "white", "M, XYZ from", "M⁻¹"];
        assert_says(&shown, &words);
        assert_says(&shown, &["curves", "gamut"]);
        let found = printed(&place, &format!("display {name}"));
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
    assert_says(&crt, &["0.618854", "0.313072", "γ = 2.2", "assumed"]);
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
    let found = printed(&place, "display screens/old.toml");
    assert_eq!(
        (&found["name"], &found["response"][2]["gamma"]),
        (&"old".into(), &2.3.into())
    );
    let white = floats(&found["white_xy"]);
    assert!((white[0] - 0.310_06).abs() < 1e-5 && (white[1] - 0.316_16).abs() < 1e-5);
    std::fs::write(place.path("gray.csv"), csv([(380.0, 0.25), (780.0, 0.25)])).unwrap();
    let found = printed(
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
    assert_says(
        &stderr,
        &[
            "bad.toml:5:",
            "response.alfa: unknown field; did you mean `alpha`?",
        ],
    );
}
