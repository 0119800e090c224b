//! Scene files: read, changed by command-line options, then validated.

use crate::description::Description;
use crate::validate::checked;
use document::{FieldPath, Folder, Problems, SourceFile, Step};
use scene::Scene;
use std::cell::OnceCell;
use std::path::Path;
use toml::Value;

/// Reads and validates a scene file.
///
/// # Errors
/// All problems of the scene.
pub fn load(path: impl AsRef<Path>) -> Result<Scene, Problems> {
    SceneFile::read(path)?.validate()
}

/// Validates `description` and returns its scene. Paths of files are relative to `folder`, and the files must be in it.
///
/// # Errors
/// All problems of the description. For a description from a file, [`SceneFile::validate`] also knows the lines.
pub fn validate(description: &Description, folder: impl Into<Folder>) -> Result<Scene, Problems> {
    checked(description, &folder.into()).map_err(|list| Problems::of_program("the scene", list))
}

/// A scene file that has been read and can still be changed before it is validated.
///
/// ```no_run
/// # fn main() -> Result<(), pellicle_scene_file::Problems> {
/// let mut file = pellicle_scene_file::SceneFile::read("scenes/soap_bubble.toml")?;
/// file.description.render.samples = 4;
/// let scene = file.validate()?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// The description from the file. Broken values have stand-ins, so that the rest can be changed and checked; [`Self::validate`] then
    /// fails even if they are overwritten.
    pub description: Description,
    as_read: Description,
    source: SourceFile,
}

impl SceneFile {
    /// Reads a scene file.
    ///
    /// # Errors
    /// When there is no such file, or it is not TOML. [`Self::validate`] reports other mistakes, all at once.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Problems> {
        Ok(Self::new(SourceFile::read(path.as_ref())?))
    }

    /// Parses the text of a scene file. `name` is its name in errors; paths of files are relative to `folder`, and the files must be in it.
    /// The empty path is the working folder.
    ///
    /// # Errors
    /// When the text is not TOML.
    pub fn parse(name: &str, text: &str, folder: impl Into<Folder>) -> Result<Self, Problems> {
        Ok(Self::new(SourceFile::parse(name, text, &folder.into())?))
    }

    fn new((description, source): (Description, SourceFile)) -> Self {
        Self {
            as_read: description.clone(),
            description,
            source,
        }
    }

    /// Sets whether the files that the scene names may be outside its folder; by default they may not. Only for scenes that can be trusted.
    #[must_use]
    pub fn allow_outside(mut self, allows_outside: bool) -> Self {
        self.source.allow_outside(allows_outside);
        self
    }

    /// The folder that paths of the scene's files are relative to.
    pub fn folder(&self) -> &Folder {
        self.source.folder()
    }

    /// Validates the description, with its changes, and returns the scene.
    ///
    /// # Errors
    /// All problems of the file and of [`Self::description`].
    pub fn validate(&self) -> Result<Scene, Problems> {
        let checked = checked(&self.description, self.source.folder());
        let changes = OnceCell::new();
        self.source.finish_changed(checked, |field| {
            let between = || Changes::between(&self.as_read, &self.description);
            changes.get_or_init(between).touch(field)
        })
    }
}

/// The difference between two descriptions.
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
