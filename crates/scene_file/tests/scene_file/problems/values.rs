//! Problems of numbers, tables and directions.

use super::{Expected, assert_problem, assert_problems, problems_of, with_camera, with_material};
use pellicle_scene_file::SceneFile;
use std::path::Path;

/// The line below `[render]` is a problem, with these phrases. An element of a pair is six columns further on than the pair.
fn setting(line: &str, field: &str, phrases: &[&str]) {
    let column = line.find('=').unwrap() + 3;
    let inner = if field.ends_with("[1]") {
        column + 6
    } else {
        column
    };
    assert_problem(
        &with_camera(&format!("[render]\n{line}\n")),
        &format!("7:{inner}"),
        &format!("render.{field}"),
        phrases,
    );
}

cases! { setting:
    no_samples("samples = 0", "samples", &["found 0", "1 to 16777216"]);
    too_many_samples("samples = 16777217", "samples", &["found 16777217"]);
    half_a_sample("samples = 4.5", "samples", &["the number 4.5", "a whole number"]);
    more_samples_than_a_number_can_be("samples = 99999999999999999999", "samples", &["1 to 16777216"]);
    no_bands("bands = 0", "bands", &["1 to 1024"]);
    too_many_bands("bands = 1025", "bands", &["1 to 1024"]);
    a_picture_that_is_too_high("size = [640, 32769]", "size[1]", &["1 to 32768"]);
    a_size_of_one_number("size = [640]", "size", &["an array of 1", "2 whole numbers"]);
    too_many_segments("max_path_segments = 33", "max_path_segments", &["1 to 32"]);
    an_infinite_exposure("exposure_ev = inf", "exposure_ev", &["found inf", "-32 to 32 stops"]);
    an_exposure_beyond_all_numbers("exposure_ev = 1e999", "exposure_ev", &["-32 to 32 stops"]);
    a_wavelength_that_is_too_long("wavelengths_nm = [380, 831]", "wavelengths_nm[1]", &["360 to 830 nm"]);
    wavelengths_that_run_backwards(
        "wavelengths_nm = [700, 400]",
        "wavelengths_nm",
        &["700 to 400 nm", "above the first"],
    );
    wavelengths_that_are_too_close("wavelengths_nm = [500, 500.5]", "wavelengths_nm", &["at least 1 nm"]);
    an_old_name_of_a_sampling(
        "sampling = 'centre'",
        "sampling",
        &["\"centre\"", "was renamed to \"center\""],
    );
    an_old_name_of_a_direct_light(
        "direct_light = 'surfaces'",
        "direct_light",
        &["\"surfaces\"", "was renamed to \"bsdf\""],
    );
}

/// A reflectance has these problems: places, fields within the material, phrases.
fn reflectance(table: &str, expected: &[Expected<'_>]) {
    let fields: Vec<_> = expected
        .iter()
        .map(|(_, field, _)| format!("materials.x.{field}"))
        .collect();
    let expected: Vec<Expected<'_>> = expected
        .iter()
        .zip(&fields)
        .map(|((place, _, phrases), field)| (*place, field.as_str(), *phrases))
        .collect();
    let text = with_material(&format!("type = 'diffuse'\nreflectance = {table}"));
    assert_problems(&text, &expected);
}

cases! { reflectance:
    a_table_with_two_bad_points(
        "{ nm = [380, 500, 500, 780], values = [0, 1, 0, 2] }",
        &[
            ("8:33", "reflectance.nm[2]", &["500 nm after 500 nm", "must increase"]),
            ("8:63", "reflectance.values[3]", &["found 2", "0 to 1"]),
        ],
    );
    a_table_with_a_value_missing(
        "{ nm = [380, 780], values = [0.5] }",
        &[("8:43", "reflectance.values", &["1 values for 2 wavelengths"])],
    );
    an_empty_table("{ nm = [], values = [] }", &[("8:22", "reflectance.nm", &["no points"])]);
    a_table_that_is_too_short(
        "{ nm = [400, 700], values = [0, 1] }",
        &[("8:15", "reflectance", &["400 to 700 nm", "380 to 780 nm", "extrapolate = \"clamp\""])],
    );
    a_table_of_impossible_wavelengths(
        "{ nm = [0.5, nan, inf], values = [0, 1, 1], extrapolate = 'claamp' }",
        &[
            ("8:23", "reflectance.nm[0]", &["found 0.5", "1 to 1e6 nm"]),
            ("8:28", "reflectance.nm[1]", &["found nan"]),
            ("8:33", "reflectance.nm[2]", &["found inf"]),
            ("8:73", "reflectance.extrapolate", &["did you mean \"clamp\"?"]),
        ],
    );
    a_table_without_values(
        "{ nm = [400, 700] }",
        &[("8:15", "reflectance.values", &["is missing", "an array of numbers"])],
    );
}

#[test]
fn a_named_spectrum_outside_its_table_says_how_to_go_on() {
    let narrow = "{ nm = [400, 700], n = [1.3, 1.3] }";
    let text = with_material(&format!("type = 'conductor'\nindex = {narrow}"));
    // n and k come from one table, so its range is reported once.
    let problems = problems_of(&text);
    assert_eq!(problems.iter().len(), 1, "{problems:#}");
    let wide = with_camera(
        "[render]\nwavelengths_nm = [360, 830]\n[environment]\ntype = 'constant'\nemission = { illuminant = 'FL2' }\n",
    );
    assert_problems(
        &wide,
        &[(
            "10:12",
            "environment.emission",
            &["380 to 780 nm", "360 to 830 nm", "clamp"],
        )],
    );
    let clamped = wide.replace("'FL2'", "'FL2', extrapolate = 'clamp'");
    SceneFile::parse("good.toml", &clamped, Path::new(""))
        .unwrap()
        .validate()
        .unwrap();
}

#[test]
fn directions_that_span_no_plane_are_reported() {
    assert_problems(
        "[camera]\ntype = 'perspective'\nposition = [0, 3, 0]\nlook_at = [0, 0, 0]\nfov_deg = 180\n",
        &[
            ("1:1", "camera.up", &["parallel to the view direction"]),
            ("5:11", "camera.fov_deg", &["0.001 to 179.9°"]),
        ],
    );
    assert_problems(
        &with_camera(
            "[materials.x]\ntype = 'diffuse'\nreflectance = 0\n[[objects]]\ntype = 'rectangle'\nmaterial = 'x'\n\
             center = [0, 0, 2e6]\nnormal = [0, 1, 0]\nsize = [1, 0]\nup = [0, -2, 0]\n\
             [[objects]]\ntype = 'plane'\nmaterial = 'x'\npoint = [0, 0, 0]\nnormal = [0, 0, 0]",
        ),
        &[
            ("12:17", "objects[0].center[2]", &["found 2e6"]),
            ("14:12", "objects[0].size[1]", &["found 0"]),
            (
                "15:6",
                "objects[0].up",
                &["parallel to the normal", "[0, 1, 0]"],
            ),
            ("20:10", "objects[1].normal", &["[0, 0, 0]", "no direction"]),
        ],
    );
}
