//! Problems of polarizers and of the polarization of light.

use super::{assert_problem, assert_problems, with_camera};

const TRACED: &str = "[render]\npolarization = true\n";

/// Line 7 is `type = 'point'`, line 9 the emission with this polarization, which starts in column 41.
fn emitted(polarization: &str, place: usize, field: &str, phrases: &[&str]) {
    let light = format!(
        "[[lights]]\ntype = 'point'\nposition = [0, 1, 0]\nemission = {{ constant = 1, polarization = {polarization} }}\n"
    );
    assert_problem(
        &with_camera(&light),
        &format!("9:{place}"),
        &format!("lights[0].emission.polarization{field}"),
        phrases,
    );
}

cases! { emitted:
    a_stokes_vector_that_is_too_long(
        "{ stokes = [0.8, 0, 0.8], axis = [0, 1, 0] }", 54, ".stokes",
        &["found [0.8, 0, 0.8]", "the length 1.131371", "at most 1"],
    );
    a_component_beyond_1(
        "{ stokes = [0, -2, 0], axis = [0, 1, 0] }", 58, ".stokes[1]",
        &["found -2", "-1 to 1"],
    );
    a_component_that_is_no_number(
        "{ stokes = [0, 0, nan], axis = [0, 1, 0] }", 61, ".stokes[2]",
        &["-1 to 1"],
    );
    a_stokes_vector_with_s0(
        "{ stokes = [1, 1, 0, 0], axis = [0, 1, 0] }", 54, ".stokes",
        &["an array of 4", "3 numbers"],
    );
    an_axis_without_a_direction(
        "{ stokes = [1, 0, 0], axis = [0, 0, 0] }", 72, ".axis",
        &["[0, 0, 0]", "no direction"],
    );
    no_axis("{ stokes = [1, 0, 0] }", 43, ".axis", &["is missing"]);
    neither_a_stokes_vector_nor_a_degree(
        "{ axis = [0, 1, 0] }", 43, "",
        &["neither `stokes` nor `degree`", "one of them", "degree = 1"],
    );
    an_angle_without_a_degree(
        "{ angle_deg = 45, axis = [0, 1, 0] }", 43, "",
        &["`angle_deg` without `degree`", "degree = 1"],
    );
    two_forms_at_once(
        "{ stokes = [1, 0, 0], ellipticity_deg = 3, axis = [0, 1, 0] }", 43, "",
        &["`stokes` and `ellipticity_deg`", "either `stokes`, or `degree`"],
    );
    a_degree_above_1("{ degree = 1.5, axis = [0, 1, 0] }", 54, ".degree", &["found 1.5", "0 to 1"]);
    an_angle_beyond_a_turn(
        "{ degree = 1, angle_deg = 361, axis = [0, 1, 0] }", 69, ".angle_deg",
        &["found 361", "-360 to 360°"],
    );
    an_ellipticity_beyond_circular(
        "{ degree = 1, ellipticity_deg = 46, axis = [0, 1, 0] }", 75, ".ellipticity_deg",
        &["found 46", "-45 to 45°"],
    );
    an_unknown_word(
        "{ degree = 1, angle = 45, axis = [0, 1, 0] }", 57, ".angle",
        &["did you mean `angle_deg`"],
    );
}

#[test]
fn several_bad_numbers_of_a_polarization_are_all_reported() {
    let light = "[[lights]]\ntype = 'point'\nposition = [0, 1, 0]\nemission = { constant = 1, polarization = { degree = 2, ellipticity_deg = 90, axis = [0, 0, 0] } }\n";
    assert_problems(
        &with_camera(light),
        &[
            (
                "9:54",
                "lights[0].emission.polarization.degree",
                &["found 2"],
            ),
            (
                "9:75",
                "lights[0].emission.polarization.ellipticity_deg",
                &["found 90"],
            ),
            (
                "9:86",
                "lights[0].emission.polarization.axis",
                &["no direction"],
            ),
        ],
    );
}

#[test]
fn an_axis_along_light_from_a_single_direction_is_reported() {
    let light = |diameter: &str| {
        with_camera(&format!(
            "[[lights]]\ntype = 'distant'\ndirection = [0, 2, 0]\ndiameter_deg = {diameter}\n\
             emission = {{ constant = 1, polarization = {{ stokes = [1, 0, 0], axis = [0, -1, 0] }} }}\n"
        ))
    };
    assert_problem(
        &light("0"),
        "10:72",
        "lights[0].emission.polarization.axis",
        &["parallel to the light's direction [0, 1, 0]"],
    );
    super::super::read(&light("20"), "").unwrap_or_else(|problems| panic!("{problems:#}"));
}

#[test]
fn ambient_light_has_no_polarization() {
    let ambient = "{ constant = 1, polarization = { degree = 1, axis = [0, 1, 0] } }";
    let surface = format!(
        "[materials.x]\ntype = 'conductor'\nindex = 'gold'\nroughness = 0.2\nmodel = {{ cook1981 = {{ ambient = {ambient} }} }}\n"
    );
    assert_problem(
        &with_camera(&surface),
        "10:65",
        "materials.x.model.cook1981.ambient.polarization",
        &["ambient light has no `polarization`"],
    );
}

#[test]
fn a_sky_has_a_degree_of_polarization_of_at_most_1() {
    let sky = "[environment]\ntype = 'sky'\nsun_elevation_deg = 30\npolarization_degree = 1.2\n";
    assert_problem(
        &with_camera(sky),
        "9:23",
        "environment.polarization_degree",
        &["found 1.2", "0 to 1"],
    );
}

/// Line 6 is the polarizer, which starts in column 13.
fn polarizer(says: &str, place: usize, field: &str, phrases: &[&str]) {
    assert_problem(
        &with_camera(&format!("polarizer = {says}\n{TRACED}")),
        &format!("6:{place}"),
        &format!("camera.polarizer{field}"),
        phrases,
    );
}

cases! { polarizer:
    a_polarizer_without_an_angle("{ }", 13, ".angle_deg", &["is missing"]);
    a_polarizer_at_no_angle("{ angle_deg = nan }", 27, ".angle_deg", &["-360 to 360°"]);
    a_retarder_without_a_retardance(
        "{ angle_deg = 0, retarder = { fast_axis_deg = 45 } }", 41, ".retarder",
        &["neither `retardance_deg` nor `retardance_nm`", "exactly one", "retardance_nm = 137.5"],
    );
    a_retarder_with_two_retardances(
        "{ angle_deg = 0, retarder = { fast_axis_deg = 45, retardance_deg = 90, retardance_nm = 1 } }",
        41, ".retarder",
        &["both `retardance_deg` and `retardance_nm`", "exactly one"],
    );
    a_phase_of_many_turns(
        "{ angle_deg = 0, retarder = { fast_axis_deg = 45, retardance_deg = 3601 } }",
        80, ".retarder.retardance_deg",
        &["found 3601", "-3600 to 3600°"],
    );
    a_negative_path_difference(
        "{ angle_deg = 0, retarder = { fast_axis_deg = 45, retardance_nm = -1 } }",
        79, ".retarder.retardance_nm",
        &["found -1", "0 to 100000 nm"],
    );
    a_fast_axis_beyond_a_turn(
        "{ angle_deg = 0, retarder = { fast_axis_deg = 400, retardance_nm = 1 } }",
        59, ".retarder.fast_axis_deg",
        &["found 400", "-360 to 360°"],
    );
}

#[test]
fn a_polarizer_needs_polarized_light() {
    let camera = "polarizer = { angle_deg = 0 }\n";
    let phrases: &[&str] = &[
        "light is traced without its polarization",
        "`polarization = true` below [render]",
        "leave out `polarizer`",
    ];
    for render in ["", "[render]\npolarization = false\n"] {
        assert_problem(
            &with_camera(&format!("{camera}{render}")),
            "6:13",
            "camera.polarizer",
            phrases,
        );
    }
    // The value itself is wrong: nothing follows from it.
    assert_problem(
        &with_camera(&format!("{camera}[render]\npolarization = 1\n")),
        "8:16",
        "render.polarization",
        &["true or false"],
    );
}
