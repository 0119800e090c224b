//! Tests of `pellicle check` and `pellicle schema`, and of bad scene files.

use crate::place::Place;
use crate::{assert_says, scene};

#[test]
fn check_summarizes_a_scene() {
    let place = Place::default();
    let ran = place.run(&format!("check {}", scene("film_wedge.toml")));
    let said = ran.succeeded();
    assert_says(
        &said.stdout,
        &["film_wedge.toml: valid", "bands", "lit by its environment;"],
    );
    assert!(said.stderr.is_empty(), "{}", said.stderr);
    let dark = place.path("dark.toml");
    let camera =
        "camera = { type = 'orthographic', position = [0, 0, 5], look_at = [0, 0, 0], height = 2 }";
    std::fs::write(&dark, camera).unwrap();
    let said = place.run(&format!("check {}", dark.display())).succeeded();
    assert_says(&said.stdout, &["0 objects, no light;"]);
    assert_says(&said.stderr, &["note: nothing emits light"]);
    std::fs::remove_file(&dark).unwrap();
    assert!(place.names().is_empty());
}

#[test]
fn the_printed_schema_is_the_shipped_one() {
    let printed = Place::default().run("schema").succeeded().stdout;
    let shipped = std::fs::read_to_string(scene("scene.schema.json")).unwrap();
    let parse = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap();
    assert_eq!(parse(&printed), parse(&shipped));
}

/// `render` and `check` refuse a file with these words.
fn refused(name: &str, words: &str) {
    let place = Place::default();
    std::fs::write(place.path("empty.toml"), "").unwrap();
    std::fs::write(place.path("binary.toml"), [0x89, b'P', 0, 0xff, 0xfe]).unwrap();
    std::fs::create_dir(place.path("folder")).unwrap();
    let before = place.names();
    for subcommand in ["render", "check"] {
        let stderr = place.run(&format!("{subcommand} {name}")).failed();
        assert_says(&stderr, &[name, words]);
    }
    assert_eq!(place.names(), before);
}

cases! { refused:
    a_missing_file("missing.toml", "cannot be opened");
    a_folder("folder", "is a directory");
    an_empty_file("empty.toml", "the file is empty");
    a_binary_file("binary.toml", "is not text");
}

#[test]
fn all_mistakes_of_a_scene_are_reported_with_their_lines() {
    let place = Place::default();
    let text = "[camera]\ntype = \"perspective\"\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov_deg = 200\n\n\
        [render]\nsampels = 4\n\n[[objects]]\ntype = \"sphere\"\nmaterial = \"gold\"\ncenter = [0, 0, 0]\nradius = -1\n";
    std::fs::write(place.path("bad.toml"), text).unwrap();
    let stderr = place.run("render bad.toml").failed();
    let mistakes = [
        ("bad.toml:5:11", "fov_deg = 200"),
        ("bad.toml:8:1", "sampels = 4"),
        ("bad.toml:12:12", "material = \"gold\""),
        ("bad.toml:14:10", "radius = -1"),
    ];
    for (at, line) in mistakes {
        assert_says(&stderr, &[at, line]);
    }
    assert_says(&stderr, &["4 problems", "samples"]);
    assert_eq!(place.names(), ["bad.toml"]);
}
