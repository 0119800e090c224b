//! Light groups: which emitters are kept apart, and under which names.

use crate::{CAMERA, read, said};
use pellicle_scene_file::Problems;
use scene::{Environment, Material, Scene};

/// A scene with an emitter for each of `emitters`: the name of the material and its fields.
fn checked(render: &str, emitters: &[(&str, &str)], environment: &str) -> Result<Scene, Problems> {
    let mut text = format!("{CAMERA}render = {{ {render} }}\n");
    if !environment.is_empty() {
        text += &format!("environment = {environment}\n");
    }
    for (name, says) in emitters {
        text += &format!("[materials.{name}]\ntype = 'emitter'\n{says}\n");
    }
    for (name, _) in emitters {
        text += &format!(
            "[[objects]]\ntype = 'sphere'\nmaterial = '{name}'\ncenter = [0, 0, 0]\nradius = 1\n"
        );
    }
    read(&text, "")
}

fn scene(emitters: &[(&str, &str)], environment: &str) -> Scene {
    checked("", emitters, environment).unwrap_or_else(|problems| panic!("{problems:#}"))
}

fn names(scene: &Scene) -> Vec<&str> {
    let groups = scene.light_groups().iter();
    groups.map(|group| group.name.as_str()).collect()
}

fn has_lamps(scene: &Scene) -> Vec<bool> {
    let groups = scene.light_groups().iter();
    groups.map(|group| group.lamp.is_some()).collect()
}

/// The names of the light groups of the emitters, in the order of their materials.
fn groups_of(scene: &Scene) -> Vec<&str> {
    let materials = scene.materials().iter();
    materials
        .map(|material| match material {
            Material::Emitter { emission, .. } => names(scene)[emission.light_group.index()],
            other => panic!("{other:?}"),
        })
        .collect()
}

#[test]
fn lights_without_a_name_are_grouped_by_their_spectrum() {
    let scene = scene(
        &[
            ("a", "emission = { illuminant = 'A', scale = 3 }"),
            ("b", "emission = { illuminant = 'D65', scale = 2 }"),
            ("c", "emission = { constant = 0.2 }"),
            ("d", "emission = { constant = 7 }"),
            ("e", "emission = { nm = [380, 780], values = [1, 2] }"),
        ],
        "{ type = 'gradient', zenith = { illuminant = 'D65' }, horizon = { illuminant = 'A' }, ground = { constant = 0 } }",
    );
    assert_eq!(names(&scene), ["A", "D65", "constant", "table"]);
    assert_eq!(
        groups_of(&scene),
        ["A", "D65", "constant", "constant", "table"]
    );
    assert_eq!(has_lamps(&scene), [true; 4]);
    // A constant is a lamp of 1 with its value as a factor.
    let lamp = scene.light_groups()[2].lamp.clone().unwrap();
    assert_eq!(lamp.at(555.0), Ok(1.0));
    let Environment::Gradient {
        zenith, horizon, ..
    } = scene.environment()
    else {
        panic!("{:?}", scene.environment());
    };
    assert_eq!(
        [zenith, horizon].map(|part| names(&scene)[part.light_group.index()]),
        ["D65", "A"]
    );
}

#[test]
fn names_that_are_written_make_groups_of_their_own() {
    let scene = scene(
        &[
            ("a", "emission = { illuminant = 'D65' }"),
            (
                "b",
                "emission = { illuminant = 'D65' }\nlight_group = 'D65'",
            ),
            (
                "c",
                "emission = { illuminant = 'A' }\nlight_group = 'mixed'",
            ),
            (
                "d",
                "emission = { illuminant = 'E' }\nlight_group = 'mixed'",
            ),
            (
                "e",
                "emission = { illuminant = 'A' }\nlight_group = 'mixed'",
            ),
            ("f", "emission = { constant = 1 }\nlight_group = 'same'"),
            ("g", "emission = { constant = 2 }\nlight_group = 'same'"),
        ],
        "{ type = 'constant', emission = { illuminant = 'D65' }, light_group = 'sky' }",
    );
    assert_eq!(names(&scene), ["D65", "mixed", "same", "sky", "D65_2"]);
    assert_eq!(has_lamps(&scene), [true, false, true, true, true]);
    assert_eq!(groups_of(&scene)[..2], ["D65_2", "D65"]);
}

#[test]
fn what_gives_no_light_makes_no_group() {
    let dark = [
        ("a", "emission = { constant = 1, scale = 0 }"),
        ("b", "emission = { constant = 0 }\nlight_group = 'off'"),
    ];
    let scene = scene(&dark, "");
    assert_eq!(
        (names(&scene), has_lamps(&scene)),
        (vec!["all"], vec![false])
    );
    // A material that no object has.
    let text = format!(
        "{CAMERA}[materials.spare]\ntype = 'emitter'\nemission = {{ constant = 1 }}\n\
         [environment]\ntype = 'constant'\nemission = {{ illuminant = 'C' }}\n"
    );
    assert_eq!(names(&read(&text, "").unwrap()), ["C"]);
}

#[test]
fn a_single_group_can_be_asked_for() {
    let emitters = [
        ("a", "emission = { illuminant = 'A' }\nlight_group = 'key'"),
        ("b", "emission = { constant = 0.2 }"),
    ];
    let of = |emitters, environment| {
        checked("light_groups = 'single'", emitters, environment).expect("sound")
    };
    let mixed = of(&emitters, "");
    assert_eq!(
        (names(&mixed), has_lamps(&mixed)),
        (vec!["all"], vec![false])
    );
    let sky = "{ type = 'constant', emission = { illuminant = 'A', scale = 0.1 } }";
    let alike = of(&emitters[..1], sky);
    assert_eq!(
        (names(&alike), has_lamps(&alike)),
        (vec!["all"], vec![true])
    );
}

fn complaints(render: &str, emitters: &[(&str, &str)], environment: &str) -> Vec<String> {
    let problems = checked(render, emitters, environment).expect_err("it must be refused");
    problems
        .iter()
        .map(|problem| format!("{}: {}", problem.field, said(problem)))
        .collect()
}

#[test]
fn bad_names_are_reported() {
    let emission = "emission = { constant = 1 }";
    let long = format!("{emission}\nlight_group = '{}'", "x".repeat(33));
    let odd = format!("{emission}\nlight_group = 'a.b'");
    let reserved = format!("{emission}\nlight_group = 'S0'");
    let emitters = [
        ("a", long.as_str()),
        ("b", odd.as_str()),
        ("c", reserved.as_str()),
    ];
    let sky = "{ type = 'constant', emission = { constant = 1 }, light_group = '' }";
    let reported = complaints("", &emitters, sky);
    assert_eq!(reported.len(), 4, "{reported:#?}");
    for (reported, phrases) in reported.iter().zip([
        ["environment.light_group", "\"\" cannot be the name"],
        ["materials.a.light_group", "1 to 32 ASCII letters"],
        ["materials.b.light_group", "\"a.b\" cannot be the name"],
        ["materials.c.light_group", "have other meanings"],
    ]) {
        for phrase in phrases {
            assert!(reported.contains(phrase), "{reported:?} lacks {phrase:?}");
        }
    }
}

/// A scene that does not mention light groups is valid with any number of spectra.
#[test]
fn many_spectra_without_names_are_a_single_group() {
    let lit = |count| {
        let says: Vec<_> = (0..count)
            .map(|i| format!("emission = {{ nm = [380, 780], values = [1, {i}] }}"))
            .collect();
        let materials: Vec<_> = (0..count).map(|i| format!("m{i}")).collect();
        let names = materials.iter().map(String::as_str);
        let emitters: Vec<_> = names.zip(says.iter().map(String::as_str)).collect();
        scene(&emitters, "")
    };
    let most = lit(32);
    assert_eq!(names(&most).len(), 32);
    assert_eq!(names(&most)[..3], ["table", "table_2", "table_3"]);
    let more = lit(33);
    assert_eq!((names(&more), has_lamps(&more)), (vec!["all"], vec![false]));
    assert_eq!(groups_of(&more), ["all"; 33]);
}

#[test]
fn too_many_groups_and_too_much_memory_are_reported() {
    let says: Vec<_> = (0..33)
        .map(|i| format!("emission = {{ constant = 1 }}\nlight_group = 'g{i}'"))
        .collect();
    let materials: Vec<_> = (0..33).map(|i| format!("m{i}")).collect();
    let names = materials.iter().map(String::as_str);
    let emitters: Vec<_> = names.zip(says.iter().map(String::as_str)).collect();
    let reported = complaints("", &emitters, "");
    assert!(
        reported.len() == 1 && reported[0].contains("found more than 32 light groups"),
        "{reported:#?}"
    );

    // With names for all but one emitter, that one is also too many.
    let mut emitters = emitters;
    emitters[32].1 = "emission = { constant = 1 }";
    assert_eq!(complaints("", &emitters, "").len(), 1);

    // The size is known in advance, and exact.
    let scene = checked("size = [100, 10], bands = 8", &emitters[..2], "").unwrap();
    assert_eq!(scene.image_bytes(), 1000 * (3 * (8 * 4 + 12) + 8 * 4 + 4));
}
