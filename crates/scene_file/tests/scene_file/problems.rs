//! Bad scene files: every mistake is reported, with its position, its field, what was found and what would be right.

mod documents;
mod materials;
mod polarization;
mod values;

use crate::said;
use pellicle_scene_file::{Problems, SceneFile};
use std::path::Path;

/// Expected content of a problem: line:column, field, and phrases of the message or the help.
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
        let said = said(problem);
        for phrase in *phrases {
            assert!(said.contains(phrase), "{said:?} lacks {phrase:?}");
        }
    }
}

/// The only problem of `text` is at this place, of this field, with these phrases.
fn assert_problem(text: &str, place: &str, field: &str, phrases: &[&str]) {
    assert_problems(text, &[(place, field, phrases)]);
}

/// A valid camera on five lines, then `rest` from line 6.
fn with_camera(rest: &str) -> String {
    let camera =
        "[camera]\ntype = 'perspective'\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov_deg = 40";
    format!("{camera}\n{rest}")
}

/// Line 6 is `[materials.x]`, `body` starts on line 7.
fn with_material(body: &str) -> String {
    with_camera(&format!("[materials.x]\n{body}\n"))
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
