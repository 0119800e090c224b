//! Tests of what reaches a terminal (no control characters, short messages) and of input from standard input.

use pellicle_tests::command::{Place, Ran};

/// Runs the command with exactly these arguments.
fn run(place: &Place, arguments: &[&str]) -> Ran {
    Ran::of(&place.command("").args(arguments).output().unwrap())
}

fn is_safe(ran: &Ran, case: &str) {
    let bad = |c: char| (c.is_control() && c != '\n') || ('\u{202a}'..='\u{202e}').contains(&c);
    for text in [&ran.stdout, &ran.stderr] {
        assert!(!text.contains(bad), "{case}: {text:?}");
    }
}

const BAD: &str = "a\x1b[2J\x07\r\u{202e}";

#[test]
fn control_characters_in_names_are_escaped() {
    let place = Place::default();
    let scene = format!("{BAD}.toml");
    std::fs::write(
        place.path(&scene),
        "[cam\\u001bera]\n\"k\\u001b[31m\" = 1\n",
    )
    .unwrap();
    let lamp = format!("{BAD}.csv");
    std::fs::write(place.path(&lamp), "nm,x\n380,1\n780,1\n").unwrap();
    std::fs::write(
        place.path("s.toml"),
        "\"k\\u001b[31m\" = 1\nsubstrate = \"\\u001bx\"\n",
    )
    .unwrap();
    let line = format!("1 | {BAD} 30nm | 1");
    for arguments in [
        &[BAD][..],
        &["check", &scene],
        &["check", BAD],
        &["render", &scene, "--backend", "cpu"],
        &["film", BAD],
        &["film", &line],
        &["film", "s.toml"],
        &["film", "1 | 1.5", "--illuminant", BAD],
        &["color", BAD],
        &["display", BAD],
        &["materials", BAD],
    ] {
        let ran = run(&place, arguments);
        is_safe(&ran, &format!("{arguments:?}"));
        let said = ran.failed();
        assert!(
            said.contains("\\u001b") || said.contains("\\u{1b}"),
            "{arguments:?}: {said}"
        );
    }
    for arguments in [
        &["film", "1 | 1.5", "--illuminant", &lamp][..],
        &["color", &lamp],
    ] {
        let ran = run(&place, arguments).succeeded();
        is_safe(&ran, &format!("{arguments:?}"));
        assert!(ran.stdout.contains("a\\u001b[2J"), "{}", ran.stdout);
    }
}

/// Only the part around the fault of a line of a megabyte is shown.
#[test]
fn messages_about_long_lines_are_short() {
    let place = Place::default();
    let long = "1.5, ".repeat(200_000);
    std::fs::write(
        place.path("s.toml"),
        format!("substrate = {{ nm = [{long}], n = [{long}], k = FAULT }}\n"),
    )
    .unwrap();
    std::fs::write(
        place.path("key.toml"),
        format!("{} = 1\n", "k".repeat(1 << 20)),
    )
    .unwrap();
    std::fs::write(
        place.path("name.toml"),
        format!("substrate = \"{}\"\n", "k".repeat(1 << 20)),
    )
    .unwrap();
    for (file, said) in [
        // 35 characters and twice 1 000 000 before the fault.
        ("s.toml", "s.toml:1:2000036"),
        ("key.toml", "unknown field"),
        ("name.toml", "there is no material"),
    ] {
        let failed = place.run(&format!("film {file}")).failed();
        assert!(failed.contains(said), "{file}: {failed}");
        assert!(failed.contains('…'), "{file}: {failed}");
        assert!(failed.chars().count() < 9000, "{file}: {}", failed.len());
    }
    let line = format!("1 | {}FAULT | 1", "1.5 1nm | ".repeat(900));
    let failed = run(&place, &["film", &line]).failed();
    assert!(
        failed.contains("FAULT") && failed.chars().count() < 1000,
        "{failed}"
    );
    assert!(
        failed.contains(&format!("stack:1:{}", 4 + 9000 + 1)),
        "{failed}"
    );
}

#[test]
fn numbers_are_reported_as_they_were_written() {
    let place = Place::default();
    std::fs::write(
        place.path("s.toml"),
        "substrate = 1.5\n[[layer]]\nindex = 1.5\nthickness_nm = 1e9\n",
    )
    .unwrap();
    for (arguments, said) in [
        (
            &["film", "s.toml"][..],
            "found 1e9; it must be from 0 to 100000 nm",
        ),
        (&["film", "1 | 1.5 1e9nm | 1"], "a thickness of 1e9 nm"),
        (
            &["film", "1 | 1.5 2e3um | 1"],
            "a thickness of 2e3 um, 2000000 nm",
        ),
        (&["film", "1 | 1.5", "--exposure", "1e9"], "--exposure 1e9:"),
        (&["film", "1 | 1.5", "--wavelengths", "1e10"], "1e10 nm"),
        (
            &[
                "film",
                "1 | 1.5 1nm | 1",
                "--chart",
                "a.png",
                "--vary",
                "1:0:1e9",
            ],
            "from 0 to 1e9 nm",
        ),
    ] {
        let failed = run(&place, arguments).failed();
        assert!(failed.contains(said), "{arguments:?}: {failed}");
    }
}

const SCENE: &str = "camera = { type = \"orthographic\", position = [0, 0, 2], look_at = [0, 0, 0], height = 1 }\n\
    environment = { type = \"constant\", emission = { csv = \"lamp.csv\" } }\n\
    render = { size = [4, 4], samples = 1, bands = 4 }\n";
const LAMP: &str = "wavelength_nm,power\n300,1\n900,1\n";

#[test]
fn a_file_may_come_from_standard_input() {
    let place = Place::default();
    std::fs::write(place.path("lamp.csv"), LAMP).unwrap();
    let display = "white = [0.3127, 0.3290]\n[primaries]\nred = [0.64, 0.33]\ngreen = [0.30, 0.60]\nblue = [0.15, 0.06]\n\
        [response]\ncurve = \"linear\"\n";
    for (arguments, input, said) in [
        ("check -", SCENE, "<standard input>: valid; 4×4 pixels"),
        (
            "film - --wavelengths 500",
            "incident = 1\nsubstrate = 1.5\n",
            "0.040000",
        ),
        ("color - --emission", LAMP, "<standard input>: an emission"),
        ("film 1|1.5 --illuminant -", LAMP, "under standard input"),
        ("display -", display, "0.640000"),
    ] {
        let ran = place
            .run_with_input(arguments, input.as_bytes())
            .succeeded();
        assert!(ran.stdout.contains(said), "{arguments}: {}", ran.stdout);
    }
    let _ = place
        .run_with_input("render - --backend cpu", SCENE.as_bytes())
        .succeeded();
    assert_eq!(place.names(), ["lamp.csv", "render.exr", "render.png"]);
}

#[test]
fn errors_in_standard_input_are_reported() {
    let place = Place::default();
    for (arguments, input, said) in [
        ("check -", "x = 1\n", "<standard input>:1:1"),
        ("check -", "", "the file is empty"),
        ("film -", "substrat = 1\n", "<standard input>:1:1"),
        ("color -", "x\n", "<standard input>:"),
        (
            "film 1|1.5 --illuminant -",
            "380,0\n780,0\n",
            "<standard input>: a lamp must have power",
        ),
        (
            "film - --illuminant -",
            "380,1\n780,1\n",
            "can be read once",
        ),
    ] {
        let failed = place.run_with_input(arguments, input.as_bytes()).failed();
        assert!(failed.contains(said), "{arguments}: {failed}");
    }
    for arguments in ["check .", "film .", "color ."] {
        let failed = place.run(arguments).failed();
        assert!(failed.contains("is a directory"), "{arguments}: {failed}");
    }
    let failed = place.run_with_input("check /dev/stdin", b"x").failed();
    assert!(failed.contains("standard input is read as -"), "{failed}");
}
