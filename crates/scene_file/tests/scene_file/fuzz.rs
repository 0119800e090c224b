//! No scene file causes a panic, and accepted scenes have only valid numbers.

use pellicle_scene_file::SceneFile;
use pellicle_scene_file::description::{Extrapolate, Index};
use proptest::prelude::*;
use scene::{Scene, Shape};
use std::path::Path;

const SCENES: [&str; 5] = [
    include_str!("../../../../scenes/soap_bubble.toml"),
    include_str!("../../../../scenes/film_wedge.toml"),
    include_str!("../../../../scenes/metal_spheres.toml"),
    include_str!("../../../../scenes/furnace.toml"),
    include_str!("../../../../scenes/draining_bubble.toml"),
];

/// Words that have a meaning in a scene or in TOML, or that have broken parsers.
const WORDS: [&str; 37] = [
    "0",
    "-1",
    "1",
    "0.5",
    "1e300",
    "-1e-300",
    "1e9",
    "1e6",
    "1e-6",
    "nan",
    "inf",
    "-inf",
    "1e999",
    "99999999999999999999",
    "0xff",
    "true",
    "1979-05-27",
    "\"gold\"",
    "\"\"",
    "[]",
    "{}",
    "[0, 0, 0]",
    "[1e-6, 0, 0]",
    "[[objects]]",
    "[camera]",
    "=",
    "\"",
    "'''",
    ".",
    ",",
    "\n",
    "#",
    "{ constant = 1 }",
    "{ pole = 1, equator = 2 }",
    "{ cauchy = [1.5, 0.004] }",
    "{ sellmeier = { b = [1], c_um2 = [0.3] } }",
    "{ mixture = 'bruggeman', of = [1, 'gold'], fraction = 0.5 }",
];

/// A file of the refractiveindex.info database with everything that is read from one.
const DATABASE_FILE: &str = "REFERENCES: |\n    A. Author\nDATA:\n  - type: formula 4\n    wavelength_range: 0.3 0.9\n    \
    coefficients: 5.9 0.24 0 0.08 1 0.1 0 0.01 1 0.001 -2\n  - type: tabulated k\n    data: |\n        0.3 2e-3\n        0.9 0\n\
    CONDITIONS: {temperature: [293, \"K\"]}\n";

/// Pieces that have a meaning in YAML or in a number.
const PIECES: [&str; 24] = [
    "",
    " ",
    "\n",
    "\t",
    ":",
    ": ",
    "- ",
    "[",
    "]",
    "{",
    "}",
    "|",
    ">-",
    "&a ",
    "*a",
    "!t ",
    "\"",
    "'",
    "#",
    "---\n",
    "nan",
    "-1",
    "1e400",
    "formula 3",
];

/// Every number of the scene is finite, before and after rounding, and no length is 0.
fn assert_sound(scene: &Scene) {
    for scene in [scene, &scene.rounded_to_f32()] {
        let text = format!("{scene:?}");
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        for object in scene.objects() {
            assert!(object.material.index() < scene.materials().len());
            let lengths = match object.shape {
                Shape::Sphere { radius, .. } => [radius, 1.0, 1.0],
                Shape::Plane {
                    normal, tangent, ..
                } => [normal.length(), tangent.length(), 1.0],
                Shape::Rectangle {
                    half_width,
                    half_height,
                    normal,
                    ..
                } => [half_width, half_height, normal.length()],
                Shape::Disk { radius, normal, .. } => [radius, normal.length(), 1.0],
            };
            assert!(lengths.iter().all(|&length| length > 1e-7), "{object:?}");
        }
    }
}

fn try_text(text: &str) -> bool {
    let Ok(file) = SceneFile::parse("fuzz.toml", text, Path::new("")) else {
        return false;
    };
    match file.validate() {
        Ok(scene) => {
            assert_sound(&scene);
            true
        }
        Err(problems) => {
            assert!(problems.iter().len() > 0);
            assert!(!format!("{problems:#}").is_empty());
            false
        }
    }
}

/// Returns whether `text` is accepted as a file of the database. If so, it gives a valid index or a reported fault throughout
/// its range.
fn try_database_file(text: &str) -> bool {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.yml"), text).unwrap();
    let yaml = "a.yml".into();
    let extrapolate = Extrapolate::Error;
    match media::optical_constants(&Index::Database { yaml, extrapolate }, folder.path()) {
        Ok((constants, _)) => {
            let range = constants.range_nm().expect("a file covers a range");
            for nm in [range.0, f64::midpoint(range.0, range.1), range.1] {
                let index = constants.at(nm);
                let sound = match &index {
                    Ok(index) => index.re > 0.0 && index.im >= 0.0,
                    Err(gap) => gap.fault.is_some(),
                };
                assert!(
                    sound || range.0 > range.1,
                    "{index:?} at {nm} nm of\n{text}"
                );
            }
            true
        }
        Err(problems) => {
            assert!(problems.iter().len() > 0);
            false
        }
    }
}

/// Returns `text` with one of its values, one of its numbers, or a piece of `kind` characters replaced by `word`.
fn mutated(text: &str, position: usize, kind: usize, word: &str) -> String {
    let values: Vec<_> = text.match_indices("= ").map(|(at, _)| at + 2).collect();
    let numbers: Vec<_> = text
        .match_indices(|c: char| c.is_ascii_digit())
        .map(|(at, _)| at)
        .collect();
    let (start, end) = match kind {
        0 => {
            let start = values[position % values.len()];
            (
                start,
                text[start..]
                    .find('\n')
                    .map_or(text.len(), |length| start + length),
            )
        }
        1 => {
            let start = numbers[position % numbers.len()];
            let is_number = |c: char| c.is_ascii_digit() || c == '.';
            let length = text[start..].find(|c| !is_number(c)).unwrap_or(1);
            (start, start + length)
        }
        _ => {
            let starts: Vec<_> = text.char_indices().map(|(at, _)| at).collect();
            let from = position % starts.len();
            (starts[from], starts[(from + kind).min(starts.len() - 1)])
        }
    };
    format!("{}{word}{}", &text[..start], &text[end.max(start)..])
}

/// Reduces the number of bands, so that each case is fast.
fn quickened(text: &str) -> String {
    text.replace("[render]\n", "[render]\nbands = 2\n")
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_read_without_a_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        try_text(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn a_changed_scene_is_refused_or_sound(
        scene in 0..SCENES.len(),
        changes in prop::collection::vec((any::<usize>(), 0..6usize, 0..WORDS.len()), 1..4),
    ) {
        let mut text = quickened(SCENES[scene]);
        for (position, kind, word) in changes {
            text = mutated(&text, position, kind, WORDS[word]);
        }
        try_text(&text);
    }

    #[test]
    fn a_changed_database_file_is_refused_or_sound(
        changes in prop::collection::vec((0..DATABASE_FILE.len(), 0..4usize, 0..PIECES.len()), 1..4),
    ) {
        let mut text = DATABASE_FILE.to_owned();
        for (position, length, piece) in changes {
            let start = position.min(text.len());
            let end = (start + length).min(text.len());
            text.replace_range(start..end, PIECES[piece]);
        }
        try_database_file(&text);
    }

    #[test]
    fn numbers_of_any_size_are_refused_or_sound(
        center in prop::array::uniform3(any::<f64>()),
        normal in prop::array::uniform3(-1e-5..1e-5f64),
        exponent in -320..320i32,
        thickness in prop::array::uniform2(-10.0..2e5f64),
    ) {
        let text = format!(
            "[camera]\ntype = 'perspective'\nposition = {center:?}\nlook_at = {normal:?}\nfov_deg = 1e{exponent}\n\
             [render]\nbands = 2\n\
             [materials.a]\ntype = 'film'\nindex = 1e{exponent}\nthickness_nm = {{ pole = {:?}, equator = {:?} }}\n\
             [[objects]]\ntype = 'rectangle'\nmaterial = 'a'\ncenter = {normal:?}\nnormal = {normal:?}\nsize = [1e{exponent}, 1]\n",
            thickness[0], thickness[1]
        );
        try_text(&text);
    }
}

#[test]
fn the_database_file_is_accepted_as_it_stands() {
    assert!(try_database_file(DATABASE_FILE));
    assert!(!try_database_file(
        &DATABASE_FILE[1..DATABASE_FILE.len() - 4]
    ));
}

#[test]
fn the_mutations_reach_both_verdicts() {
    let counts = (0..400).fold((0, 0), |(accepted, refused), position| {
        let text = mutated(
            &quickened(SCENES[position % SCENES.len()]),
            position * 7919,
            1,
            WORDS[position % 9],
        );
        if try_text(&text) {
            (accepted + 1, refused)
        } else {
            (accepted, refused + 1)
        }
    });
    assert!(counts.0 > 20 && counts.1 > 20, "{counts:?}");
}
