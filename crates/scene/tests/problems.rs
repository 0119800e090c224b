//! Bad scene files: every mistake is told, with its place, its field, what was found and what would be right.

use pellicle_scene::{Problems, SceneFile};
use std::path::Path;

/// What a problem must say: line:column, field, and phrases of the message or the advice.
type Expected<'a> = (&'a str, &'a str, &'a [&'a str]);

fn problems_of(text: &str) -> Problems {
    match SceneFile::parse("bad.toml", text, Path::new("")).and_then(|file| file.validate()) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(problems) => problems,
    }
}

/// The problems of `text` are exactly `expected`, in this order.
fn assert_problems(text: &str, expected: &[Expected<'_>]) {
    let problems = problems_of(text);
    let listing = format!("{problems:#}");
    assert_eq!(
        problems.iter().len(),
        expected.len(),
        "{listing}\n--- in\n{text}"
    );
    for (problem, (place, field, phrases)) in problems.iter().zip(expected) {
        let location = problem.location.as_ref().expect("a place in the file");
        assert_eq!(
            format!("{}:{}", location.line, location.column),
            *place,
            "{listing}"
        );
        assert_eq!(problem.field.to_string(), *field, "{listing}");
        let said = format!(
            "{} | {}",
            problem.message,
            problem.help.clone().unwrap_or_default()
        );
        for phrase in *phrases {
            assert!(said.contains(phrase), "{said:?} lacks {phrase:?}");
        }
    }
}

/// A sound camera on four lines, then `rest` from line 5.
fn with_camera(rest: &str) -> String {
    let camera =
        "[camera]\ntype = 'perspective'\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov_deg = 40";
    format!("{camera}\n{rest}")
}

/// Line 6 is `[materials.x]`, `body` starts on line 7.
fn with_material(body: &str) -> String {
    with_camera(&format!("[materials.x]\n{body}\n"))
}

/// A material may be on several objects: the one that does not suit it is told.
#[test]
fn thicknesses_for_spheres_are_refused_on_planes() {
    let scene = |thickness: &str, shape: &str| {
        with_camera(&format!(
            "[materials.x]\ntype = 'film'\nlayers = [{{ index = 1.5, thickness_nm = 9 }}, {{ index = 1.3, thickness_nm = {thickness} }}]\n\
             [[objects]]\ntype = 'sphere'\nmaterial = 'x'\ncenter = [0, 0, 0]\nradius = 1\n\
             [[objects]]\nmaterial = 'x'\n{shape}\n"
        ))
    };
    let plane = "type = 'plane'\npoint = [0, 0, 0]\nnormal = [0, 0, 1]";
    let rectangle = "type = 'rectangle'\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nsize = [1, 1]";
    let polar = "{ product = [2, { pole = 3, equator = 4 }] }";
    let bubble = "{ drainage = { initial = 500, radius_m = 0.01 } }";
    for (thickness, shape, said) in [
        (
            polar,
            plane,
            [
                "\"x\"",
                "`pole` and `equator`",
                "this is a plane",
                "`start`, `end`",
            ],
        ),
        (
            bubble,
            rectangle,
            ["\"x\"", "`radius_m`", "this is a rectangle", "`height_m`"],
        ),
    ] {
        assert_problems(
            &scene(thickness, shape),
            &[("15:12", "objects[1].material", &said)],
        );
    }
    let sphere = "type = 'sphere'\ncenter = [0, 3, 0]\nradius = 1";
    let film =
        "{ drainage = { initial = 500, height_m = 0.01, from = [0, 1, 0], to = [0, 0, 0] } }";
    for (thickness, shape) in [(polar, sphere), (bubble, sphere), (film, rectangle)] {
        let file = SceneFile::parse("good.toml", &scene(thickness, shape), Path::new(""));
        if let Err(problems) = file.and_then(|file| file.validate()) {
            panic!("{problems:#}");
        }
    }
}

#[test]
fn all_mistakes_of_a_file_are_told_at_once_in_its_order() {
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
                    "known are",
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
                &["found NaN", "-1000000 to 1000000"],
            ),
            (
                "31:10",
                "objects[1].radius",
                &["found -1", "from 0.000001 to 1000000"],
            ),
            ("33:2", "enviroment", &["did you mean `environment`?"]),
        ],
    );
}

#[test]
fn missing_fields_are_told_at_their_table() {
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
            &["`from` belongs to another form, a table with `end` and `from` and `start` and `to`"],
        )],
    );
}

#[test]
fn a_value_that_fits_no_form_is_told_all_of_them() {
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
fn numbers_out_of_range_are_told_with_the_range() {
    let cases: &[(&str, &str, &[&str])] = &[
        ("samples = 0", "samples", &["found 0", "1 to 16777216"]),
        ("samples = 16777217", "samples", &["found 16777217"]),
        (
            "samples = 4.5",
            "samples",
            &["the number 4.5", "a whole number"],
        ),
        (
            "samples = 99999999999999999999",
            "samples",
            &["1 to 16777216"],
        ),
        ("bands = 0", "bands", &["1 to 1024"]),
        ("bands = 1025", "bands", &["1 to 1024"]),
        ("size = [640, 32769]", "size[1]", &["1 to 32768"]),
        (
            "size = [640]",
            "size",
            &["an array of 1", "2 whole numbers"],
        ),
        ("max_path_segments = 33", "max_path_segments", &["1 to 32"]),
        (
            "exposure_ev = inf",
            "exposure_ev",
            &["found inf", "-32 to 32 stops"],
        ),
        ("exposure_ev = 1e999", "exposure_ev", &["-32 to 32 stops"]),
        (
            "wavelengths_nm = [380, 831]",
            "wavelengths_nm[1]",
            &["360 to 830 nm"],
        ),
        (
            "wavelengths_nm = [700, 400]",
            "wavelengths_nm",
            &["700 to 400 nm", "above the first"],
        ),
        (
            "wavelengths_nm = [500, 500.5]",
            "wavelengths_nm",
            &["at least 1 nm"],
        ),
        (
            "sampling = 'center'",
            "sampling",
            &["\"center\"", "did you mean \"centre\"?"],
        ),
    ];
    for (line, field, phrases) in cases {
        let column = line.find('=').unwrap() + 3;
        let inner = match *field {
            "size[1]" | "wavelengths_nm[1]" => column + 6,
            _ => column,
        };
        assert_problems(
            &with_camera(&format!("[render]\n{line}\n")),
            &[(&format!("7:{inner}"), &format!("render.{field}"), phrases)],
        );
    }
}

#[test]
fn an_image_that_no_memory_holds_is_told_with_its_size() {
    assert_problems(
        &with_camera("[render]\nsize = [32768, 32768]\nbands = 1024\n"),
        &[(
            "7:8",
            "render.size",
            &[
                "32768 × 32768",
                "1024 bands",
                "8208.0 GiB",
                "at most 32 GiB",
                "2 bands at this size",
            ],
        )],
    );
}

/// Each material alone has one problem: body, place, field within the material, phrases.
fn assert_material_problems(cases: &[(String, &str, &str, &[&str])]) {
    for (body, place, field, phrases) in cases {
        assert_problems(
            &with_material(body),
            &[(*place, &format!("materials.x.{field}"), phrases)],
        );
    }
}

#[test]
fn films_out_of_range_are_told() {
    let film = |rest: &str| format!("type = 'film'\nindex = 1.33\nthickness_nm = {rest}");
    let cases: &[(String, &str, &str, &[&str])] = &[
        (film("nan"), "9:16", "thickness_nm", &["found NaN"]),
        (film("100001"), "9:16", "thickness_nm", &["0 to 100000 nm"]),
        (
            film("{ pole = 700, equator = 300 }"),
            "9:16",
            "thickness_nm",
            &[
                "comes to -100 nm at the far pole",
                "`equator` can be from 350 to",
            ],
        ),
        (
            film("{ pole = 0, equator = 60000 }"),
            "9:16",
            "thickness_nm",
            &["comes to 120000 nm", "to 50000 nm"],
        ),
        (
            film("{ pole = 3, equator = 3, axis = [0, 0, 0] }"),
            "9:48",
            "thickness_nm.axis",
            &["has no direction"],
        ),
        (
            film("{ start = 1, end = 2, from = [1, 0, 0], to = [1, 0, 0] }"),
            "9:61",
            "thickness_nm.to",
            &["not far enough from `materials.x.thickness_nm.from`"],
        ),
    ];
    assert_material_problems(cases);
}

#[test]
fn roughness_out_of_range_is_told() {
    let metal = |rest: &str| format!("type = 'conductor'\n{rest}");
    let cases: &[(String, &str, &str, &[&str])] = &[
        (
            metal("index = 'gold'\nroughness = 0.01"),
            "9:13",
            "roughness",
            &["0 (a smooth mirror)", "0.02 to 1"],
        ),
        (
            metal("index = 'gold'\nroughness = [0.1, 2]\nbrushed = { along = [1, 0, 0] }"),
            "9:19",
            "roughness[1]",
            &["found 2; it must be from 0.02 to 1"],
        ),
        (
            metal("index = 'gold'\nroughness = [0.1, 0.2]"),
            "9:13",
            "roughness",
            &["which way its grain runs", "brushed = { along"],
        ),
        (
            metal("index = 'gold'\nroughness = 0.1\nbrushed = { around = [0, 1, 0] }"),
            "10:11",
            "brushed",
            &["no grain", "along and across"],
        ),
        (
            metal("index = 'gold'\nroughness = [0.1, 0.2]\nbrushed = { around = [0, 0, 0] }"),
            "10:22",
            "brushed.around",
            &["no direction"],
        ),
        (
            metal("index = 'gold'\ndistribution = 'ggx'"),
            "9:16",
            "distribution",
            &["for a rough surface"],
        ),
        (
            metal("index = 'gold'\nroughness = 0.1\ndistribution = 'phong'"),
            "10:16",
            "distribution",
            &["\"beckmann\" or \"ggx\""],
        ),
    ];
    assert_material_problems(cases);
}

#[test]
fn other_materials_out_of_range_are_told() {
    let metal = |rest: &str| format!("type = 'conductor'\n{rest}");
    let cases: &[(String, &str, &str, &[&str])] = &[
        (
            metal("index = 0"),
            "8:9",
            "index",
            &["found 0", "0.001 to 1000"],
        ),
        (
            metal("index = [1, -0.5]"),
            "8:13",
            "index[1]",
            &["found -0.5", "0 to 1000"],
        ),
        (
            metal("index = [1, 2, 3]"),
            "8:9",
            "index",
            &["an array of 3", "an array of 2 numbers"],
        ),
        (
            metal("index = [1e4, 2]"),
            "8:10",
            "index[0]",
            &["0.001 to 1000"],
        ),
        (
            metal("index = { name = 'glod' }"),
            "8:18",
            "index.name",
            &["did you mean \"gold\"?"],
        ),
        (
            "type = 'diffuse'\nreflectance = 1.5".into(),
            "8:15",
            "reflectance",
            &["0 to 1"],
        ),
        (
            "type = 'diffuse'\nreflectance = { checker = [0.5, 2], size = 1 }".into(),
            "8:33",
            "reflectance.checker[1]",
            &["0 to 1"],
        ),
        (
            "type = 'diffuse'\nreflectance = { checker = [0.5, 1], size = 0 }".into(),
            "8:44",
            "reflectance.size",
            &["0.000001 to 1000000"],
        ),
        (
            "type = 'emitter'\nemission = { constant = -1 }".into(),
            "8:25",
            "emission.constant",
            &["found -1", "0 to 1000000000"],
        ),
        (
            "type = 'emitter'\nemission = { constant = 1e6, scale = 1e6 }".into(),
            "8:38",
            "emission.scale",
            &["a radiance of 1000000000000", "at most 1000000000"],
        ),
        (
            "type = 'emitter'\nemission = { illuminant = 'd65' }".into(),
            "8:27",
            "emission.illuminant",
            &["no illuminant \"d65\"", "did you mean \"D65\"?"],
        ),
    ];
    assert_material_problems(cases);
}

#[test]
fn tables_are_checked_point_by_point() {
    let cases: &[(&str, &[Expected<'_>])] = &[
        (
            "{ nm = [380, 500, 500, 780], values = [0, 1, 0, 2] }",
            &[
                (
                    "8:33",
                    "reflectance.nm[2]",
                    &["500 nm after 500 nm", "must rise"],
                ),
                ("8:63", "reflectance.values[3]", &["found 2", "0 to 1"]),
            ],
        ),
        (
            "{ nm = [380, 780], values = [0.5] }",
            &[(
                "8:43",
                "reflectance.values",
                &["1 values for 2 wavelengths"],
            )],
        ),
        (
            "{ nm = [], values = [] }",
            &[("8:22", "reflectance.nm", &["no points"])],
        ),
        (
            "{ nm = [400, 700], values = [0, 1] }",
            &[(
                "8:15",
                "reflectance",
                &["400 to 700 nm", "380 to 780 nm", "extrapolate = \"clamp\""],
            )],
        ),
        (
            "{ nm = [0.5, nan, inf], values = [0, 1, 1], extrapolate = 'claamp' }",
            &[
                (
                    "8:23",
                    "reflectance.nm[0]",
                    &["found 0.5", "1 to 1000000 nm"],
                ),
                ("8:28", "reflectance.nm[1]", &["found NaN"]),
                ("8:33", "reflectance.nm[2]", &["found inf"]),
                (
                    "8:73",
                    "reflectance.extrapolate",
                    &["did you mean \"clamp\"?"],
                ),
            ],
        ),
        (
            "{ nm = [400, 700] }",
            &[(
                "8:15",
                "reflectance.values",
                &["is missing", "an array of numbers"],
            )],
        ),
    ];
    for (table, expected) in cases {
        let expected: Vec<_> = expected
            .iter()
            .map(|(place, field, phrases)| (*place, format!("materials.x.{field}"), *phrases))
            .collect();
        let expected: Vec<Expected<'_>> = expected
            .iter()
            .map(|(place, field, phrases)| (*place, field.as_str(), *phrases))
            .collect();
        assert_problems(
            &with_material(&format!("type = 'diffuse'\nreflectance = {table}")),
            &expected,
        );
    }
}

#[test]
fn a_named_spectrum_outside_its_table_says_how_to_go_on() {
    let narrow = "{ nm = [400, 700], n = [1.3, 1.3] }";
    let text = with_material(&format!("type = 'conductor'\nindex = {narrow}"));
    // n and k come from one table, so its range is told once.
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
fn directions_that_span_no_plane_are_told() {
    assert_problems(
        "[camera]\ntype = 'perspective'\nposition = [0, 3, 0]\nlook_at = [0, 0, 0]\nfov_deg = 180\n",
        &[
            ("1:1", "camera.up", &["parallel to the direction of view"]),
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
            ("12:17", "objects[0].center[2]", &["found 2000000"]),
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
fn the_comparison_can_fail() {
    let wrong_place = std::panic::catch_unwind(|| {
        assert_problems(
            "[render]\nsamples = 3\n",
            &[("1:2", "camera", &["is missing"])],
        );
    });
    let wrong_phrase = std::panic::catch_unwind(|| {
        assert_problems(
            "[render]\nsamples = 3\n",
            &[("1:1", "camera", &["is here"])],
        );
    });
    assert!(wrong_place.is_err() && wrong_phrase.is_err());
}

#[test]
fn a_terminal_shows_the_source_line_of_each_problem() {
    let problems = problems_of(&with_camera("[render]\nsamples = 0\nbands = 0\n"));
    let mut shown = String::new();
    let handler =
        miette::GraphicalReportHandler::new_themed(miette::GraphicalTheme::unicode_nocolor());
    handler.render_report(&mut shown, &problems).unwrap();
    for phrase in [
        "bad.toml has 2 problems",
        "[bad.toml:7:11]",
        "samples = 0",
        "[bad.toml:8:9]",
        "bands = 0",
    ] {
        assert!(shown.contains(phrase), "{shown}");
    }
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
