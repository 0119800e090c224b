//! Tests of the stacks and options that `pellicle film` refuses.

use crate::assert_says;
use crate::film::{STEP, film};
use crate::place::Place;

/// `film` fails with all of `words` and leaves no file.
fn refused(stack: &str, arguments: &str, words: &[&str]) {
    let place = Place::default();
    assert_says(&place.film(stack, arguments).failed(), words);
    assert!(place.names().is_empty(), "{:?}", place.names());
}

fn refused_stack(stack: &str, words: &[&str]) {
    refused(stack, "", words);
}

cases! { refused_stack:
    an_empty_stack("", &["no stack file", "air | silica 300nm | silicon"]);
    a_stack_of_one_medium("silica 300nm", &["no stack file \"silica 300nm\"", "has | between"]);
    a_missing_file("nowhere.toml", &["no stack file \"nowhere.toml\""]);
    a_stack_without_media("|", &["no medium", "stack:1:1"]);
    a_misspelled_medium("1 | silca 300nm | silicon", &["did you mean \"silica\"", "stack:1:5"]);
    a_negative_thickness("1 | silica -3nm | silicon", &["-3 nm", "from 0 to 100000 nm", "stack:1:5"]);
    a_layer_without_a_thickness("1 | silica | silicon", &["has no thickness", "stack:1:5"]);
    an_absorbing_first_medium("gold | silica 3nm | 1", &["gold absorbs", "stack:1:1"]);
    a_last_medium_with_a_thickness("1 | silica 3nm", &["are half spaces", "stack:1:5"]);
    a_folder(".", &["is a directory"]);
}

#[test]
fn all_mistakes_of_a_stack_file_are_reported_with_their_lines() {
    let place = Place::default();
    let text = "incident = \"gold\"\nsubstrate = \"silicon\"\n[[layer]]\nindex = \"silca\"\nthickness_nm = -3\n";
    std::fs::write(place.path("bad.toml"), text).unwrap();
    let words = [
        "3 problems",
        "bad.toml:1:12",
        "bad.toml:4:9",
        "\"silica\"",
        "bad.toml:5:16",
        "found -3",
    ];
    assert_says(&place.film("bad.toml", "").failed(), &words);
}

fn refused_arguments(arguments: &str, words: &[&str]) {
    refused(STEP, arguments, words);
}

cases! { refused_arguments:
    an_angle_of_90_degrees("--angles 90", &["90°", "less than 90°"]);
    an_angle_below_0("--angles -1", &["-1°"]);
    an_angle_that_is_no_number("--angles x", &["--angles", "\"x\" is not a number"]);
    wavelengths_that_run_backwards("--wavelengths 780:380:10", &["runs backwards", "380:780:10"]);
    wavelengths_without_data("--wavelengths 100:200:10", &["100 nm", "layer 1, silica", "210 to 6700 nm"]);
    a_wavelength_of_0("--wavelengths 0", &["0 nm", "1 to 1e6 nm"]);
    a_step_of_0("--wavelengths 380:780:0", &["a step of 0"]);
    a_chart_of_a_missing_layer("--chart a.png --vary 2:0:100", &["no layer 2", "one layer"]);
    a_chart_of_layer_0("--chart a.png --vary 0:0:100", &["no layer 0"]);
    a_chart_that_runs_backwards("--chart a.png --vary 1:100:0", &["from 100 to 0 nm"]);
    a_chart_without_an_end("--chart a.png --vary 1:100", &["LAYER:FROM:TO"]);
    a_color_by_name("--match blue --vary 1:0:100", &["\"blue\" is not a color", "#2e6fd0"]);
    a_match_without_a_layer("--match #123456", &["--vary"]);
    a_chromaticity_of_black(
        "--match #000000 --vary 1:0:100 --match-by chromaticity",
        &["black has no chromaticity"],
    );
    a_match_at_two_angles("--match #123456 --vary 1:0:100 --angles 0,1", &["one angle"]);
    a_plot_of_an_unknown_type("--plot a.jpg", &["a.jpg", ".svg or .png"]);
    a_plot_in_a_missing_folder("--plot no/a.png", &["no folder no"]);
    a_folder_as_plot("--plot .", &["--plot ."]);
    a_plot_of_one_wavelength("--plot a.png --wavelengths 500", &["two or more wavelengths"]);
    a_plot_of_too_many_angles("--plot a.png --angles 0:80:1", &["81 angles"]);
    a_chart_of_an_unknown_type("--chart a.svg", &["a.svg", ".png"]);
    a_plot_and_a_chart_in_one_file("--plot a.png --chart a.png", &["same file"]);
    a_plot_and_a_chart_in_one_file_by_two_paths("--plot ./a.png --chart a.png", &["same file"]);
    a_backend_without_effect("--sensitivity --backend gpu", &["--backend gpu has no effect", "R and T"]);
    wavelengths_without_effect(
        "--match #123456 --vary 1:0:100 --wavelengths 500",
        &["--wavelengths has no effect", "R and T"],
    );
    absorptance_without_effect(
        "--plot a.png --absorptance",
        &["--absorptance has no effect", "--format table"],
    );
    a_layer_without_effect("--vary 1:0:100", &["--vary has no effect", "--match and --chart"]);
    too_many_rows("--angles 0:89:0.001 --wavelengths 380:780:0.1", &["rows", "at most 4000000"]);
    a_misspelled_illuminant("--illuminant d65", &["did you mean \"D65\""]);
    an_impossible_exposure("--exposure 99", &["-32 to 32"]);
    a_tolerance_without_a_unit("--tolerance 2", &["2%"]);
    a_tolerance_of_0("--tolerance 0%", &["more than 0"]);
    no_trials("--tolerance 2% --trials 0", &["0 trials"]);
    a_design_wavelength_without_data("--sensitivity --design 1", &["1 nm", "210 to 6700"]);
    a_match_as_csv("--match #123456 --vary 1:0:100 --format csv", &["cannot be used with"]);
}

#[test]
fn too_many_rows_of_layers() {
    let many = format!("1 | {}1.5", "1.5 10nm | ".repeat(65));
    let words = [
        "--absorptance",
        "80001 rows of 65 layers",
        "at most 4000000",
    ];
    let ran = film(&many, "--wavelengths 380:780:0.005 --absorptance");
    assert_says(&ran.failed(), &words);
}

fn refused_without_layers(report: &str) {
    refused("1 | 1.5", report, &["no layer"]);
}

cases! { refused_without_layers:
    a_tolerance_without_layers("--tolerance 1%");
    a_sensitivity_without_layers("--sensitivity");
    a_chart_without_layers("--chart a.png");
}

#[test]
fn a_stack_file_is_not_overwritten() {
    let place = Place::default();
    let text = "substrate = 1.5\n";
    std::fs::write(place.path("stack.png"), text).unwrap();
    assert_says(
        &place.film("stack.png", "--plot stack.png").failed(),
        &["overwrite"],
    );
    assert_eq!(
        std::fs::read_to_string(place.path("stack.png")).unwrap(),
        text
    );
}
