//! Scene files: read, changed where the command line says so, then validated.

use crate::description::Description;
use crate::document::{self, Findings, Tree, TreeError};
use crate::field_path::Step;
use crate::problem::{Location, Problem, ProblemKind, Problems};
use crate::text_file::read_text;
use crate::{FieldPath, Scene, validate};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::Value;

/// Reads and validates a scene file.
///
/// # Errors
/// Everything that is wrong with it.
pub fn load(path: impl AsRef<Path>) -> Result<Scene, Problems> {
    SceneFile::read(path)?.validate()
}

/// A scene file that has been read and can still be changed before it is validated.
///
/// ```no_run
/// # fn main() -> Result<(), pellicle_scene::Problems> {
/// let mut file = pellicle_scene::SceneFile::read("scenes/soap_bubble.toml")?;
/// file.description.render.samples = 4;
/// let scene = file.validate()?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// What the file says. Where it is broken there are stand-ins, so that the rest can be changed and checked;
    /// [`Self::validate`] then fails whatever is written over them.
    pub description: Description,
    as_read: Description,
    findings: Findings,
    name: String,
    text: Arc<str>,
    directory: PathBuf,
}

impl SceneFile {
    /// Reads a scene file.
    ///
    /// # Errors
    /// When there is no such file, or it is not TOML. Other mistakes wait for [`Self::validate`], so that all of
    /// them can be told at once.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Problems> {
        let path = path.as_ref();
        let name = path.display().to_string();
        let text = read_text(path).map_err(|error| {
            let problem = Problem::new(ProblemKind::File, &FieldPath::root(), error.to_string());
            Problems::of_unread_file(name.clone(), problem)
        })?;
        let directory = path.parent().unwrap_or(Path::new(""));
        Self::parse(&name, &text, directory)
    }

    /// Reads the text of a scene file: `name` is what errors call it, and tables are looked for from `directory`.
    ///
    /// # Errors
    /// When the text is not TOML.
    pub fn parse(name: &str, text: &str, directory: &Path) -> Result<Self, Problems> {
        let text: Arc<str> = Arc::from(text);
        let refuse = |problem| Problems::of_file(name, &text, vec![problem], 0);
        if text.trim().is_empty() {
            let message = "the file is empty; a scene needs at least a [camera]";
            let problem = Problem::new(ProblemKind::MissingField, &FieldPath::root(), message);
            return Err(refuse(problem.located(Location::new(&text, 0..0))));
        }
        let tree = Tree::parse(&text).map_err(|TreeError { message, bytes }| {
            let problem = Problem::new(ProblemKind::Syntax, &FieldPath::root(), message);
            refuse(problem.located(Location::new(&text, bytes)))
        })?;
        let (description, findings) = document::read(&text, &tree);
        drop(tree);
        let Some(description) = description else {
            let Findings {
                problems, omitted, ..
            } = findings;
            return Err(Problems::of_file(name, &text, problems, omitted));
        };
        Ok(Self {
            as_read: description.clone(),
            description,
            findings,
            name: name.to_owned(),
            text,
            directory: directory.to_owned(),
        })
    }

    /// The scene that the file, as changed, describes.
    ///
    /// # Errors
    /// Everything that is wrong with the file and with [`Self::description`].
    pub fn validate(&self) -> Result<Scene, Problems> {
        let (scene, mistakes) = match validate::scene(&self.description, &self.directory) {
            Ok(scene) => (Some(scene), Vec::new()),
            Err(mistakes) => (None, mistakes),
        };
        let mut mistakes = self.not_caused_by_stand_ins(mistakes);
        let omitted = mistakes.len().saturating_sub(Problems::MAX_SHOWN);
        mistakes.truncate(Problems::MAX_SHOWN);
        let mut problems = self.findings.problems.clone();
        problems.extend(self.placed(mistakes));
        match scene {
            Some(scene) if problems.is_empty() => Ok(scene),
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

    /// Says of each problem where in the file it lies, or that its value does not come from there.
    fn placed(&self, problems: Vec<Problem>) -> Vec<Problem> {
        if problems.is_empty() {
            return problems;
        }
        // The tree borrows the text, so it is made again where it is needed, which is here alone.
        let Ok(tree) = Tree::parse(&self.text) else {
            return problems;
        };
        let changes = Changes::between(&self.as_read, &self.description);
        let place = |problem: Problem| {
            if changes.touch(&problem.field) {
                let note = "this value was set outside the file";
                let help = match &problem.help {
                    Some(help) => format!("{help}; {note}"),
                    None => note.to_owned(),
                };
                return problem.help(help);
            }
            let location = Location::new(&self.text, tree.bytes_of(&problem.field));
            problem.located(location)
        };
        problems.into_iter().map(place).collect()
    }
}

/// Where two descriptions differ.
struct Changes(Option<(Value, Value)>);

impl Changes {
    fn between(before: &Description, after: &Description) -> Self {
        // Compared as text: a NaN is unequal to itself.
        if format!("{before:?}") == format!("{after:?}") {
            return Self(None);
        }
        Self(
            Value::try_from(before)
                .ok()
                .zip(Value::try_from(after).ok()),
        )
    }

    fn touch(&self, field: &FieldPath) -> bool {
        let Some((before, after)) = &self.0 else {
            return false;
        };
        let (before, after) = (value_at(before, field), value_at(after, field));
        format!("{before:?}") != format!("{after:?}")
    }
}

fn value_at<'a>(root: &'a Value, field: &FieldPath) -> Option<&'a Value> {
    field
        .steps()
        .iter()
        .try_fold(root, |value, step| match step {
            Step::Key(key) => value.get(key),
            Step::Index(index) => value.get(index),
        })
}
