//! Helpers of several campaigns.

use pellicle_fuzz::Outcome;
use std::fs;
use std::path::{Path, PathBuf};

/// The root of the workspace.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The files in a folder of the workspace with this extension.
pub(crate) fn files(folder: &str, extension: &str) -> Vec<Vec<u8>> {
    let entries = fs::read_dir(root().join(folder)).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let is_wanted = |path: &PathBuf| path.extension().is_some_and(|e| e == extension);
    paths.retain(is_wanted);
    paths.iter().map(|path| fs::read(path).unwrap()).collect()
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// `Unsound` with `what` unless `is_sound`.
pub(crate) fn expect(is_sound: bool, what: impl FnOnce() -> String) -> Outcome {
    if is_sound {
        Outcome::ACCEPTED
    } else {
        Outcome::Unsound(what())
    }
}

/// A refusal with the whole chain of causes of the error.
pub(crate) fn refused(error: &dyn std::error::Error) -> Outcome {
    let mut text = error.to_string();
    let mut inner = error.source();
    while let Some(error) = inner {
        text.push_str(&error.to_string());
        inner = error.source();
    }
    Outcome::Refused(text)
}
