//! A file that has been read as a document, and the problems found in it.

use crate::reader::{Findings, read};
use crate::text_file::{STANDARD_INPUT, read_text};
use crate::tree::{Tree, TreeError};
use crate::{Document, FieldPath, Folder, Location, Problem, ProblemKind, Problems};
use std::path::Path;
use std::sync::Arc;

/// A TOML file that has been read as a [`Document`], and the problems found in it.
///
/// Reading compares the text with the schema of the description's type and replaces missing and unusable values by stand-ins, so that the
/// rest can still be checked; [`Self::finish`] then reports all problems at once, each with its location.
#[derive(Clone, Debug)]
pub struct SourceFile {
    findings: Findings,
    name: String,
    text: Arc<str>,
    folder: Folder,
}

impl SourceFile {
    /// Reads a file, or standard input for `-`, whose paths are relative to the working folder.
    ///
    /// # Errors
    /// When there is no such file, or it is not TOML. [`Self::finish`] reports other mistakes.
    pub fn read<T: Document>(path: &Path) -> Result<(T, Self), Problems> {
        let name = if path.as_os_str() == STANDARD_INPUT {
            "<standard input>".to_owned()
        } else {
            path.display().to_string()
        };
        let text = read_text(path).map_err(|error| {
            let problem = Problem::new(ProblemKind::File, &FieldPath::root(), error.to_string());
            Problems::of_unread_file(name.clone(), problem)
        })?;
        let directory = path.parent().unwrap_or(Path::new(""));
        Self::parse(&name, &text, &Folder::from(directory))
    }

    /// Parses the text of a file. `name` is its name in errors, and its paths are relative to `folder`.
    ///
    /// # Errors
    /// When the text is not TOML.
    pub fn parse<T: Document>(
        name: &str,
        text: &str,
        folder: &Folder,
    ) -> Result<(T, Self), Problems> {
        let text: Arc<str> = Arc::from(text);
        let refuse = |problem| Problems::of_file(name, &text, vec![problem], 0);
        if text.trim().is_empty() {
            let message = format!("the file is empty; {}", T::NEEDS);
            let problem = Problem::new(ProblemKind::MissingField, &FieldPath::root(), message);
            return Err(refuse(problem.located(Location::new(&text, 0..0))));
        }
        let tree = Tree::parse(&text).map_err(|TreeError { message, bytes }| {
            let problem = Problem::new(ProblemKind::Syntax, &FieldPath::root(), message);
            refuse(problem.located(Location::new(&text, bytes)))
        })?;
        let (description, findings) = read(&text, &tree);
        drop(tree);
        let Some(description) = description else {
            let Findings {
                problems, omitted, ..
            } = findings;
            return Err(Problems::of_file(name, &text, problems, omitted));
        };
        let file = Self {
            findings,
            name: name.to_owned(),
            text,
            folder: folder.clone(),
        };
        Ok((description, file))
    }

    /// The folder that the file's paths are relative to.
    pub fn folder(&self) -> &Folder {
        &self.folder
    }

    /// Sets whether the file's paths may lead out of its folder; by default they may not.
    pub fn allow_outside(&mut self, allows_outside: bool) {
        self.folder = self.folder.clone().allow_outside(allows_outside);
    }

    /// Returns the result of checking the description, if reading found no problems either.
    ///
    /// # Errors
    /// All problems that reading and checking found, except those that only a stand-in caused. Problems of the checks get the location of
    /// their field.
    pub fn finish<T>(&self, checked: Result<T, Vec<Problem>>) -> Result<T, Problems> {
        self.finish_changed(checked, |_| false)
    }

    /// Like [`Self::finish`], but fields that `is_changed` do not have their value from the file.
    ///
    /// # Errors
    /// As for [`Self::finish`].
    pub fn finish_changed<T>(
        &self,
        checked: Result<T, Vec<Problem>>,
        is_changed: impl Fn(&FieldPath) -> bool,
    ) -> Result<T, Problems> {
        let (value, mistakes) = match checked {
            Ok(value) => (Some(value), Vec::new()),
            Err(mistakes) => (None, mistakes),
        };
        let mut mistakes = self.not_caused_by_stand_ins(mistakes);
        let omitted = mistakes.len().saturating_sub(Problems::MAX_SHOWN);
        mistakes.truncate(Problems::MAX_SHOWN);
        let mut problems = self.findings.problems.clone();
        problems.extend(self.placed(mistakes, is_changed));
        match value {
            Some(value) if problems.is_empty() => Ok(value),
            _ => Err(Problems::of_file(
                &self.name,
                &self.text,
                problems,
                self.findings.omitted + omitted,
            )),
        }
    }

    fn not_caused_by_stand_ins(&self, mistakes: Vec<Problem>) -> Vec<Problem> {
        let rests_on_file = |problem: &Problem| {
            let mut grounds = std::iter::once(&problem.field).chain(&problem.involves);
            !grounds.any(|field| self.findings.is_broken(field))
        };
        mistakes.into_iter().filter(rests_on_file).collect()
    }

    /// Adds to each problem its location in the file, or a note that its value does not come from there.
    fn placed(
        &self,
        problems: Vec<Problem>,
        is_changed: impl Fn(&FieldPath) -> bool,
    ) -> Vec<Problem> {
        if problems.is_empty() {
            return problems;
        }
        // The tree borrows the text, so it is parsed again here, the only place that needs it.
        let Ok(tree) = Tree::parse(&self.text) else {
            return problems;
        };
        let place = |problem: Problem| {
            if is_changed(&problem.field) {
                let note = "this value was set outside the file";
                let help = match &problem.help {
                    Some(help) => format!("{help}; {note}"),
                    None => note.to_owned(),
                };
                return problem.help(help);
            }
            let location = Location::new(&self.text, tree.bytes_of(&problem.field));
            let written = self.text.get(location.bytes.clone());
            problem
                .with_written(written.unwrap_or_default())
                .located(location)
        };
        problems.into_iter().map(place).collect()
    }
}
