//! Tests of what reaches a terminal: no control characters, short messages, numbers as they were written.

use crate::assert_says;
use crate::place::{Place, Ran};

/// Runs the command with exactly these arguments.
fn run(place: &Place, arguments: &[&str]) -> Ran {
    Ran::of(&place.command("").args(arguments).output().unwrap())
}

fn is_safe(ran: &Ran) {
    let bad = |c: char| (c.is_control() && c != '\n') || ('\u{202a}'..='\u{202e}').contains(&c);
    for text in [&ran.stdout, &ran.stderr] {
        assert!(!text.contains(bad), "{text:?}");
    }
}

const BAD: &str = "a\x1b[2J\x07\r\u{202e}";

/// A folder with a scene, a stack and a lamp that have control characters in their names or their contents.
fn place() -> Place {
    let place = Place::default();
    for (name, text) in [
        (
            &format!("{BAD}.toml")[..],
            "[cam\\u001bera]\n\"k\\u001b[31m\" = 1\n",
        ),
        (&format!("{BAD}.csv"), "nm,x\n380,1\n780,1\n"),
        ("s.toml", "\"k\\u001b[31m\" = 1\nsubstrate = \"\\u001bx\"\n"),
    ] {
        std::fs::write(place.path(name), text).unwrap();
    }
    place
}

/// The command fails, with the control characters escaped. `BAD` in an argument stands for them.
fn escaped(arguments: &[&str]) {
    let arguments: Vec<_> = arguments
        .iter()
        .map(|argument| argument.replace("BAD", BAD))
        .collect();
    let arguments: Vec<_> = arguments.iter().map(String::as_str).collect();
    let ran = run(&place(), &arguments);
    is_safe(&ran);
    let said = ran.failed();
    let is_escaped = said.contains("\\u001b") || said.contains("\\u{1b}");
    assert!(is_escaped, "{said}");
}

cases! { escaped:
    a_bad_subcommand_is_escaped(&["BAD"]);
    a_bad_scene_is_escaped(&["check", "BAD.toml"]);
    a_missing_scene_is_escaped(&["check", "BAD"]);
    a_bad_scene_to_render_is_escaped(&["render", "BAD.toml", "--backend", "cpu"]);
    a_missing_stack_is_escaped(&["film", "BAD"]);
    a_bad_medium_is_escaped(&["film", "1 | BAD 30nm | 1"]);
    a_bad_stack_is_escaped(&["film", "s.toml"]);
    a_bad_illuminant_is_escaped(&["film", "1 | 1.5", "--illuminant", "BAD"]);
    a_bad_table_is_escaped(&["color", "BAD"]);
    a_bad_display_is_escaped(&["display", "BAD"]);
    a_bad_material_is_escaped(&["materials", "BAD"]);
}

#[test]
fn names_of_good_files_are_escaped() {
    let lamp = format!("{BAD}.csv");
    for arguments in [
        &["film", "1 | 1.5", "--illuminant", &lamp][..],
        &["color", &lamp],
    ] {
        let ran = run(&place(), arguments).succeeded();
        is_safe(&ran);
        assert_says(&ran.stdout, &["a\\u001b[2J"]);
    }
}

/// Only the part around the fault of a line of a megabyte is shown.
fn shortened(text: &str, words: &str) {
    let place = Place::default();
    std::fs::write(place.path("s.toml"), text).unwrap();
    let failed = place.run("film s.toml").failed();
    assert_says(&failed, &[words, "…"]);
    assert!(failed.chars().count() < 9000, "{}", failed.len());
}

#[test]
fn a_message_about_a_long_line_is_short() {
    let long = "1.5, ".repeat(200_000);
    let text = format!("substrate = {{ nm = [{long}], n = [{long}], k = FAULT }}\n");
    // 35 characters and twice 1 000 000 before the fault.
    shortened(&text, "s.toml:1:2000036");
}

#[test]
fn a_message_about_a_long_key_is_short() {
    let text = format!("{} = 1\n", "k".repeat(1 << 20));
    shortened(&text, "unknown field");
}

#[test]
fn a_message_about_a_long_name_is_short() {
    let text = format!("substrate = \"{}\"\n", "k".repeat(1 << 20));
    shortened(&text, "there is no material");
}

#[test]
fn a_message_about_a_long_argument_is_short() {
    let line = format!("1 | {}FAULT | 1", "1.5 1nm | ".repeat(900));
    let failed = run(&Place::default(), &["film", &line]).failed();
    assert!(failed.chars().count() < 1000, "{failed}");
    assert_says(&failed, &["FAULT", &format!("stack:1:{}", 4 + 9000 + 1)]);
}

/// A number appears in a message as it was written.
fn unchanged(arguments: &[&str], words: &str) {
    let place = Place::default();
    let text = "substrate = 1.5\n[[layer]]\nindex = 1.5\nthickness_nm = 1e9\n";
    std::fs::write(place.path("s.toml"), text).unwrap();
    assert_says(&run(&place, arguments).failed(), &[words]);
}

cases! { unchanged:
    a_number_of_a_file(&["film", "s.toml"], "found 1e9; it must be from 0 to 100000 nm");
    a_thickness(&["film", "1 | 1.5 1e9nm | 1"], "a thickness of 1e9 nm");
    a_thickness_in_micrometers(&["film", "1 | 1.5 2e3um | 1"], "a thickness of 2e3 um, 2000000 nm");
    an_exposure(&["film", "1 | 1.5", "--exposure", "1e9"], "--exposure 1e9:");
    a_wavelength(&["film", "1 | 1.5", "--wavelengths", "1e10"], "1e10 nm");
    a_range_of_a_chart(
        &["film", "1 | 1.5 1nm | 1", "--chart", "a.png", "--vary", "1:0:1e9"],
        "from 0 to 1e9 nm",
    );
}
