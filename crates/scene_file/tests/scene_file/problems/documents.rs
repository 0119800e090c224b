//! Problems of whole files: their fields, form and length.

use super::{assert_problem, assert_problems, problems_of, with_camera, with_material};
use pellicle_scene_file::Problems;

#[test]
fn all_mistakes_of_a_file_are_reported_at_once_in_its_order() {
    let text = "\
[camera]
type = 'perspective'
position = [0, 0, 5]
look_at = [0, 0, 5]
fov_deg = 'wide'

[render]
size = [0, 480]
sampels = 4
seed = -1

[materials.soap]
type = 'film'
index = 'watr'
thickness_nm = -3

[materials.iron]
type = 'condutor'
index = 2

[[objects]]
type = 'sphere'
material = 'sope'
center = [0, 0]
radus = 1

[[objects]]
type = 'sphere'
material = 'soap'
center = [0, nan, 0]
radius = -1

[enviroment]
type = 'constant'
";
    assert_problems(
        text,
        &[
            (
                "4:11",
                "camera.look_at",
                &["[0, 0, 5]", "`camera.position`", "apart"],
            ),
            (
                "5:11",
                "camera.fov_deg",
                &["the string 'wide'", "expected a number"],
            ),
            ("8:9", "render.size[0]", &["found 0", "from 1 to 32768"]),
            (
                "9:1",
                "render.sampels",
                &["unknown field", "did you mean `samples`?"],
            ),
            ("10:8", "render.seed", &["found -1", "from 0 to 4294967295"]),
            (
                "14:9",
                "materials.soap.index",
                &[
                    "no material with a known index \"watr\"",
                    "did you mean \"water\"?",
                    "known names:",
                ],
            ),
            (
                "15:16",
                "materials.soap.thickness_nm",
                &["found -3", "from 0 to 100000 nm"],
            ),
            (
                "18:8",
                "materials.iron.type",
                &["\"condutor\"", "did you mean \"conductor\"?", "\"emitter\""],
            ),
            (
                "23:12",
                "objects[0].material",
                &["no material \"sope\"", "did you mean \"soap\"?"],
            ),
            (
                "24:10",
                "objects[0].center",
                &["an array of 2", "expected an array of 3 numbers"],
            ),
            (
                "25:1",
                "objects[0].radus",
                &["did you mean `radius`?", "the fields here are"],
            ),
            (
                "30:14",
                "objects[1].center[1]",
                &["found nan", "-1e6 to 1e6"],
            ),
            (
                "31:10",
                "objects[1].radius",
                &["found -1", "from 1e-6 to 1e6"],
            ),
            ("33:2", "enviroment", &["did you mean `environment`?"]),
        ],
    );
}

#[test]
fn missing_fields_are_reported_at_their_table() {
    assert_problems(
        "[camera]\ntype = 'orthographic'\nposition = [0, 0, 5]\n[[objects]]\nmaterial = 'x'\n",
        &[
            (
                "1:1",
                "camera.height",
                &["is missing; expected a number", "Height of the picture"],
            ),
            (
                "1:1",
                "camera.look_at",
                &["is missing; expected an array of 3 numbers"],
            ),
            (
                "4:1",
                "objects[0].type",
                &[
                    "is missing",
                    "\"disk\", \"plane\", \"rectangle\" or \"sphere\"",
                ],
            ),
        ],
    );
}

#[test]
fn a_missing_camera_is_reported_at_the_beginning() {
    assert_problem("[render]\nsamples = 3\n", "1:1", "camera", &["is missing"]);
}

cases! { assert_problem:
    a_field_of_another_type_of_camera(
        &with_camera("height = 3\n"),
        "6:1",
        "camera.height",
        &["`height` belongs to type \"orthographic\""],
    );
    a_field_of_another_form_of_thickness(
        &with_material("type = 'film'\nindex = 1.3\nthickness_nm = { pole = 3, equator = 4, from = [0, 0, 0] }"),
        "9:41",
        "materials.x.thickness_nm.from",
        &[
            "`from` belongs to another form, a table with `end` and `from` and `start` and `to`",
            "either `equator`, `pole` (and `axis`); or `end`, `from`, `start`, `to`; or",
        ],
    );
    a_misspelled_field_of_an_emission(
        &with_material("type = 'emitter'\nemission = { illuminant = 'D65', skale = 2 }"),
        "8:34",
        "materials.x.emission.skale",
        &[
            "did you mean `scale`?",
            "either `constant`; or `illuminant` (and `extrapolate`); or `nm`, `values` (and `extrapolate`); or `csv` (and `column`, `extrapolate`, `unit`); and with each `illuminance_lux`",
        ],
    );
}

fn a_light_is_an_object(word: &str) {
    assert_problem(
        &with_camera(&format!(
            "[[lights]]\ntype = '{word}'\nemission = {{ constant = 1 }}\n"
        )),
        "7:8",
        "lights[0].type",
        &[
            "\"distant\", \"point\" or \"spot\"",
            "an object whose material is `type = \"emitter\"`",
        ],
    );
}

// Words of other programs are advised on.
cases! { a_light_is_an_object:
    a_sphere_as_light("sphere");
    an_area_light("area");
}

cases! { assert_problem:
    an_f_number(
        &with_camera("lens = { f_number = 2.8, radius = 0.1 }\n"),
        "6:10",
        "camera.lens.f_number",
        &["unknown field", "the focal length divided by 2 N"],
    );
    a_lens_without_a_radius(
        &with_camera("lens = { radius = 0 }\n"),
        "6:19",
        "camera.lens.radius",
        &["found 0", "1e-6 to 1e6", "leave out `lens`"],
    );
}

// A value that fits no form is reported with all of them.
cases! { assert_problem:
    a_boolean_as_reflectance(
        &with_material("type = 'diffuse'\nreflectance = true"),
        "8:15",
        "materials.x.reflectance",
        &[
            "the boolean true",
            "a number, a string, a table with `srgb`, a table with `linear_srgb`, a table with `name`",
            "`checker` and `size`",
        ],
    );
    an_emission_without_a_spectrum(
        &with_material("type = 'emitter'\nemission = { scale = 3 }"),
        "8:12",
        "materials.x.emission",
        &["found a table", "`constant`", "`illuminant`"],
    );
    a_misspelled_spectrum_of_an_emission(
        &with_material("type = 'emitter'\nemission = { iluminant = 'D65' }"),
        "8:14",
        "materials.x.emission.iluminant",
        &["did you mean `illuminant`?"],
    );
    a_table_as_objects(
        &with_camera("[objects]\ntype = 'sphere'"),
        "6:1",
        "objects",
        &["found a table", "expected an array of tables"],
    );
}

cases! { assert_problem:
    an_unclosed_table("[camera\ntype = 3", "1:8", "", &["unclosed table", "`]`"]);
    an_empty_file("", "1:1", "", &["empty"]);
    a_file_of_comments("# only a comment\n", "1:1", "camera", &["is missing"]);
    a_key_that_is_there_twice("a = 1\na = 2\n", "2:1", "", &["duplicate key"]);
}

/// Text that is nested very deep is refused.
fn bomb_refused(text: &str) {
    assert!(format!("{:#}", problems_of(text)).starts_with("bad.toml:"));
}

cases! { bomb_refused:
    a_million_brackets(&"[".repeat(1 << 20));
    a_million_arrays(&("a=".to_owned() + &"[".repeat(1 << 20)));
    a_million_tables(&("a=".to_owned() + &"{a=".repeat(1 << 20)));
}

#[test]
fn dotted_keys_in_tables_are_bounded() {
    let keys = vec!["a"; 79].join(".");
    let deep = format!(
        "x = {}1{}",
        format!("{{{keys} = ").repeat(70),
        "}".repeat(70)
    );
    assert_problem(&deep, "1:1", "", &["nested more than 32 deep"]);
}

#[test]
fn of_very_many_problems_the_first_are_shown_and_the_rest_counted() {
    let problems = problems_of(&with_camera(&"[[objects]]\n".repeat(70_000)));
    assert_eq!(problems.iter().len(), Problems::MAX_SHOWN);
    assert_eq!(problems.omitted(), 70_000 - Problems::MAX_SHOWN);
    assert!(
        problems.to_string().contains("70000 problems"),
        "{problems}"
    );
}

/// A file of a megabyte with the same mistake again and again is judged in seconds.
fn judged_in_seconds(opening: &str, mistake: &str, closing: &str) {
    let start = std::time::Instant::now();
    let mistakes = mistake.repeat((1 << 20) / mistake.len());
    let text = format!("{opening}{mistakes}{closing}");
    let problems = problems_of(&with_camera(&text));
    assert!(problems.iter().len() <= Problems::MAX_SHOWN);
    assert!(start.elapsed().as_secs() < 30, "{:?}", start.elapsed());
}

cases! { judged_in_seconds:
    many_words_as_wavelengths("[materials.x]\ntype = 'conductor'\nindex = { n = [1], nm = [", "'', ", "] }");
    many_empty_objects("", "[[objects]]\n", "");
    many_dotted_keys("[materials]\n", "a.b=", "1");
}
