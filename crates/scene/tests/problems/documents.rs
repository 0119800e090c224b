//! Problems of whole files: their fields, form and length.

use crate::{assert_problems, problems_of, with_camera, with_material};
use pellicle_scene::Problems;

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
    assert_problems(
        "[render]\nsamples = 3\n",
        &[("1:1", "camera", &["is missing"])],
    );
}

#[test]
fn a_field_of_another_variant_says_where_it_belongs() {
    assert_problems(
        &with_camera("height = 3\n"),
        &[(
            "6:1",
            "camera.height",
            &["`height` belongs to type \"orthographic\""],
        )],
    );
    assert_problems(
        &with_material(
            "type = 'film'\nindex = 1.3\nthickness_nm = { pole = 3, equator = 4, from = [0, 0, 0] }",
        ),
        &[(
            "9:41",
            "materials.x.thickness_nm.from",
            &[
                "`from` belongs to another form, a table with `end` and `from` and `start` and `to`",
                "either `equator`, `pole` (and `axis`); or `end`, `from`, `start`, `to`; or",
            ],
        )],
    );
    assert_problems(
        &with_material("type = 'emitter'\nemission = { illuminant = 'D65', skale = 2 }"),
        &[(
            "8:34",
            "materials.x.emission.skale",
            &[
                "did you mean `scale`?",
                "either `constant`; or `illuminant` (and `extrapolate`); or `nm`, `values` (and `extrapolate`); or `csv` (and `column`, \
                 `extrapolate`, `unit`); and with each `illuminance_lux`",
            ],
        )],
    );
}

#[test]
fn words_of_other_programs_are_advised_on() {
    for word in ["sphere", "area"] {
        assert_problems(
            &with_camera(&format!(
                "[[lights]]\ntype = '{word}'\nemission = {{ constant = 1 }}\n"
            )),
            &[(
                "7:8",
                "lights[0].type",
                &[
                    "\"distant\", \"point\" or \"spot\"",
                    "an object whose material is `type = \"emitter\"`",
                ],
            )],
        );
    }
    assert_problems(
        &with_camera("lens = { f_number = 2.8, radius = 0.1 }\n"),
        &[(
            "6:10",
            "camera.lens.f_number",
            &["unknown field", "the focal length divided by 2 N"],
        )],
    );
    assert_problems(
        &with_camera("lens = { radius = 0 }\n"),
        &[(
            "6:19",
            "camera.lens.radius",
            &["found 0", "1e-6 to 1e6", "leave out `lens`"],
        )],
    );
}

#[test]
fn a_value_that_fits_no_form_is_reported_all_of_them() {
    assert_problems(
        &with_material("type = 'diffuse'\nreflectance = true"),
        &[(
            "8:15",
            "materials.x.reflectance",
            &[
                "the boolean true",
                "a number, a string, a table with `srgb`, a table with `linear_srgb`, a table with `name`",
                "`checker` and `size`",
            ],
        )],
    );
    assert_problems(
        &with_material("type = 'emitter'\nemission = { scale = 3 }"),
        &[(
            "8:12",
            "materials.x.emission",
            &["found a table", "`constant`", "`illuminant`"],
        )],
    );
    assert_problems(
        &with_material("type = 'emitter'\nemission = { iluminant = 'D65' }"),
        &[(
            "8:14",
            "materials.x.emission.iluminant",
            &["did you mean `illuminant`?"],
        )],
    );
    assert_problems(
        &with_camera("[objects]\ntype = 'sphere'"),
        &[(
            "6:1",
            "objects",
            &["found a table", "expected an array of tables"],
        )],
    );
}

#[test]
fn what_is_not_toml_gives_the_parsers_message_and_place() {
    assert_problems(
        "[camera\ntype = 3",
        &[("1:8", "", &["unclosed table", "`]`"])],
    );
    assert_problems("", &[("1:1", "", &["empty"])]);
    assert_problems("# only a comment\n", &[("1:1", "camera", &["is missing"])]);
    assert_problems("a = 1\na = 2\n", &[("2:1", "", &["duplicate key"])]);
}

#[test]
fn nesting_bombs_are_refused() {
    for text in [
        "[".repeat(1 << 20),
        "a=".to_owned() + &"[".repeat(1 << 20),
        "a=".to_owned() + &"{a=".repeat(1 << 20),
    ] {
        assert!(format!("{:#}", problems_of(&text)).starts_with("bad.toml:"));
    }
    let keys = vec!["a"; 79].join(".");
    let deep = format!(
        "x = {}1{}",
        format!("{{{keys} = ").repeat(70),
        "}".repeat(70)
    );
    assert_problems(&deep, &[("1:1", "", &["nested more than 32 deep"])]);
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

#[test]
fn long_files_full_of_mistakes_are_judged_in_seconds() {
    let start = std::time::Instant::now();
    for (opening, mistake, closing) in [
        (
            "[materials.x]\ntype = 'conductor'\nindex = { n = [1], nm = [",
            "'', ",
            "] }",
        ),
        ("", "[[objects]]\n", ""),
        ("[materials]\n", "a.b=", "1"),
    ] {
        let text = format!(
            "{opening}{}{closing}",
            mistake.repeat((1 << 20) / mistake.len())
        );
        let problems = problems_of(&with_camera(&text));
        assert!(problems.iter().len() <= Problems::MAX_SHOWN);
    }
    assert!(start.elapsed().as_secs() < 60, "{:?}", start.elapsed());
}
