//! Tests of the tables and options that `pellicle color` refuses.

use crate::color::printed;
use crate::place::Place;
use crate::{assert_says, floats};

/// A table with this text is refused with all of `words`.
fn refused(text: &str, options: &str, words: &[&str]) {
    let place = Place::default();
    std::fs::write(place.path("t.csv"), text).unwrap();
    let ran = place.run(&format!("color t.csv {options}"));
    assert!(ran.stdout.is_empty(), "{}", ran.stdout);
    assert_says(&ran.failed(), words);
}

cases! { refused:
    a_reflectance_above_1("wavelength_nm,value\n380,1.01\n780,0\n", "", &["line 2", "reflectance 1.01", "from 0 to 1"]);
    a_reflectance_below_0("380,-0.1\n780,0\n", "", &["line 1", "reflectance -0.1"]);
    a_reflectance_that_is_no_number("380,nan\n780,0\n", "", &["line 1", "nan"]);
    a_power_below_0("380,-1\n780,0\n", "--emission", &["line 1", "power -1"]);
    an_emission_without_power("380,0\n780,0\n", "--emission", &["must have power"]);
    wavelengths_out_of_order("780,0\n380,0\n500,1\n", "", &["line 3", "500 after 380", "rise or fall throughout"]);
    more_columns_than_one("nm,r,g\n380,0,0\n", "", &["3 columns, expected 2", "2 \"r\", 3 \"g\"", "--column"]);
    an_empty_table("", "", &["no points"]);
    a_table_that_begins_late("400,0.5\n780,0.5\n", "", &["no value at 380 nm", "400 to 780 nm", "--clamp"]);
    an_emission_that_ends_early("380,0.5\n779.5,0.5\n", "--emission", &["no value at 780 nm", "--clamp"]);
}

fn refused_option(options: &str, words: &[&str]) {
    refused("380,0.5\n780,0.5\n", options, words);
}

cases! { refused_option:
    a_misspelled_illuminant("--illuminant d65", &["did you mean \"D65\""]);
    daylight_that_is_too_warm("--illuminant D3000K", &["4000 to 25000 K"]);
    an_illuminant_with_a_factor("--illuminant D65*2", &["no illuminant \"D65*2\""]);
    a_missing_lamp("--illuminant none.csv", &["none.csv: cannot be opened"]);
    an_unknown_observer("--observer 1931", &["1931_2", "2015_10"]);
    an_unknown_rule("--rule 10nm", &["5nm and 1nm"]);
    an_unknown_adaptation("--adapt ciecat02", &["none, bradford and cat16"]);
    a_misspelled_display("--display crt", &["did you mean \"crt_1997\""]);
    a_missing_display("--display none.toml", &["none.toml: cannot be opened"]);
}

#[test]
fn a_missing_table() {
    let stderr = Place::default().run("color none.csv").failed();
    assert_says(&stderr, &["none.csv: cannot be opened"]);
}

/// A lamp whose data are too short is reported by its option.
#[test]
fn a_short_table_can_be_clamped_but_not_a_short_lamp() {
    let place = Place::default();
    std::fs::write(place.path("t.csv"), "400,0.5\n700,0.5\n").unwrap();
    let clamped = printed(&place, "color t.csv --clamp");
    assert!((floats(&clamped["xyz"])[1] - 50.0).abs() < 1e-12);
    let stderr = place.run("color t.csv --clamp --illuminant t.csv").failed();
    assert_says(&stderr, &["--illuminant", "no value at 380 nm"]);
}
