//! End-to-end tests of the command: what it writes, what it prints, and what it refuses.

/// Makes a test of each row: the check is called with the arguments in its parentheses.
macro_rules! cases {
    ($check:ident: $($name:ident($($argument:expr),* $(,)?);)+) => {
        $(
            #[test]
            fn $name() {
                $check($($argument),*);
            }
        )+
    };
}

mod adapters;
mod booth;
mod check;
mod checkpoints;
mod color;
mod color_refusals;
mod compare;
mod develop;
mod display;
mod ends;
mod faults;
mod film;
mod film_models;
mod film_phase;
mod film_refusals;
mod film_reports;
#[cfg(target_os = "linux")]
mod full_disks;
mod images;
mod inspect;
#[cfg(unix)]
mod kills;
mod large_files;
mod large_pictures;
mod materials;
mod merge;
mod pages;
mod pipeline_cache;
mod place;
mod polarized;
mod render;
mod render_refusals;
#[cfg(unix)]
mod running;
mod sequences;
#[cfg(unix)]
mod signals;
mod standard_input;
mod terminal;

use place::Ran;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The root of the workspace.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The path of a scene that is shipped.
fn scene(name: &str) -> String {
    let path = root().join("scenes").join(name);
    path.to_str().unwrap().to_owned()
}

/// All of `words` are in the text.
fn assert_says(text: &str, words: &[&str]) {
    for words in words {
        assert!(text.contains(words), "{words:?} is not in\n{text}");
    }
}

/// The JSON that the command printed.
fn json(ran: Ran) -> Value {
    serde_json::from_str(&ran.succeeded().stdout).unwrap()
}

/// The cells of a table with comments and a line of headings before them.
fn rows(table: &str) -> impl Iterator<Item = Vec<&str>> {
    let lines = table.lines().filter(|line| !line.starts_with('#'));
    lines.skip(1).map(|line| line.split(',').collect())
}

/// The number in a cell.
fn number(cell: &str) -> f64 {
    let parsed = cell.parse();
    parsed.unwrap_or_else(|_| panic!("{cell} is not a number"))
}

/// The numbers of a JSON array.
fn floats(value: &Value) -> Vec<f64> {
    let values = value.as_array().unwrap().iter();
    values.map(|value| value.as_f64().unwrap()).collect()
}
