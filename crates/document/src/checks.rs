//! Checks that all documents share, and the list of problems that they find.

use crate::suggestion::nearest;
use crate::{FieldPath, Folder, Problem, ProblemKind, Range, Shown};
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Collects the problems of a document, and the assumptions about it. A check returns the value if it is valid.
#[derive(Debug)]
pub struct Checks {
    folder: Folder,
    problems: Vec<Problem>,
    notes: Vec<String>,
}

impl Checks {
    /// Starts without problems; paths of files are relative to `folder`.
    pub fn new(folder: &Folder) -> Self {
        Self {
            folder: folder.clone(),
            problems: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Returns `value`, and the assumptions, one line each, without duplicates.
    ///
    /// # Errors
    /// All problems, if there are any. A check that returns nothing reports why; if none did, a general problem says so.
    pub fn finish<T>(self, value: Option<T>) -> Result<(T, Vec<String>), Vec<Problem>> {
        match value {
            Some(value) if self.problems.is_empty() => Ok((value, self.notes)),
            None if self.problems.is_empty() => {
                let message = "cannot be used, and no check says why: please report this file";
                let root = FieldPath::root();
                Err(vec![Problem::new(
                    ProblemKind::Inconsistent,
                    &root,
                    message,
                )])
            }
            _ => Err(self.problems),
        }
    }

    /// The folder that paths of files are relative to.
    pub fn folder(&self) -> &Folder {
        &self.folder
    }

    /// Reports a problem.
    pub fn report(&mut self, problem: Problem) {
        self.problems.push(problem);
    }

    /// Notes an assumption about the value of `field`.
    pub fn note(&mut self, field: &FieldPath, assumed: impl Display) {
        let note = if field.is_root() {
            assumed.to_string()
        } else {
            format!("{field}: {assumed}")
        };
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// The path to the file that `field` names as `written`. Every file that a document names is opened by this path.
    pub fn path(&mut self, field: &FieldPath, written: &Path) -> Option<PathBuf> {
        let path = self.folder.path_to(written);
        path.map_err(|error| {
            self.report(Problem::new(ProblemKind::File, field, error.to_string()));
        })
        .ok()
    }

    /// Checks that a number is in `range`.
    pub fn number(&mut self, field: &FieldPath, value: f64, range: &Range) -> Option<f64> {
        if range.contains(value) {
            // −0 and 0 are the same number, but would be two entries in a list without duplicates.
            return Some(value + 0.0);
        }
        let message = format!("found {}; it must be from {range}", Shown(value));
        self.report(Problem::new(ProblemKind::OutOfRange, field, message));
        None
    }

    /// Reports a name that none of `known` is; `what` says what it should name.
    pub fn unknown_name(&mut self, field: &FieldPath, (what, name): (&str, &str), known: &[&str]) {
        let short: String = name.chars().take(64).collect();
        let suggestion = nearest(name, known.iter().copied())
            .map(|known| format!("; did you mean {known:?}?"))
            .unwrap_or_default();
        let message = format!("there is no {what} {short:?}{suggestion}");
        let problem = Problem::new(ProblemKind::UnknownName, field, message);
        self.report(problem.help(list_of_names(what, known)));
    }
}

fn list_of_names(what: &str, known: &[&str]) -> String {
    const MAX: usize = 30;
    let names: Vec<_> = known
        .iter()
        .take(MAX)
        .map(|name| format!("{name:?}"))
        .collect();
    match known.len() {
        0 => format!("no {what} is known"),
        count if count > MAX => {
            format!("known names: {} and {} more", names.join(", "), count - MAX)
        }
        _ => format!("known names: {}", names.join(", ")),
    }
}
