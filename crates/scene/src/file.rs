//! Scene files: read, changed where the command line says so, then validated.

use crate::description::Description;
use crate::document::SourceFile;
use crate::field_path::Step;
use crate::problem::Problems;
use crate::{FieldPath, Folder, Scene, validate};
use std::cell::OnceCell;
use std::path::Path;
use toml::Value;

/// The least that a scene file holds.
const NEEDS: &str = "a scene needs at least a [camera]";

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
    source: SourceFile,
}

impl SceneFile {
    /// Reads a scene file.
    ///
    /// # Errors
    /// When there is no such file, or it is not TOML. Other mistakes wait for [`Self::validate`], so that all of
    /// them can be told at once.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Problems> {
        Ok(Self::new(SourceFile::read(path.as_ref(), NEEDS)?))
    }

    /// Reads the text of a scene file: `name` is what errors call it, and files are looked for from `folder` and must lie in
    /// it; the empty path is the working folder.
    ///
    /// # Errors
    /// When the text is not TOML.
    pub fn parse(name: &str, text: &str, folder: impl Into<Folder>) -> Result<Self, Problems> {
        Ok(Self::new(SourceFile::parse(
            name,
            text,
            &folder.into(),
            NEEDS,
        )?))
    }

    fn new((description, source): (Description, SourceFile)) -> Self {
        Self {
            as_read: description.clone(),
            description,
            source,
        }
    }

    /// Whether the files that the scene names may lie outside of its folder, which they may not by default: only for scenes that
    /// can be trusted.
    #[must_use]
    pub fn allow_outside(mut self, allows_outside: bool) -> Self {
        self.source.allow_outside(allows_outside);
        self
    }

    /// Where the files are looked for that the scene names.
    pub fn folder(&self) -> &Folder {
        self.source.folder()
    }

    /// The scene that the file, as changed, describes.
    ///
    /// # Errors
    /// Everything that is wrong with the file and with [`Self::description`].
    pub fn validate(&self) -> Result<Scene, Problems> {
        let checked = validate::scene(&self.description, self.source.folder());
        let changes = OnceCell::new();
        self.source.finish_changed(checked, |field| {
            let between = || Changes::between(&self.as_read, &self.description);
            changes.get_or_init(between).touch(field)
        })
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
