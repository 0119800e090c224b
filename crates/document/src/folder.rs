//! The folder of the files that a document names.

use std::path::{Component, Path, PathBuf};
use thiserror::Error;

/// The folder that the paths of a description's files are relative to.
///
/// A description may come from someone else, so the files that it names must be in the folder or its subfolders after links are resolved.
/// [`Self::allow_outside`] lifts this restriction.
///
/// ```
/// use pellicle_document::Folder;
/// assert!(Folder::from("scenes").path_to("../Cargo.toml".as_ref()).is_err());
/// assert!(Folder::from("scenes").allow_outside(true).path_to("../Cargo.toml".as_ref()).is_ok());
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Folder {
    path: PathBuf,
    allows_outside: bool,
}

/// The error for a file outside the folder.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error(
    "found \"{}\", which leads out of the folder \"{}\"; it must be in this folder unless --allow-outside is given",
    file.display(),
    shown(folder).display()
)]
pub struct OutsideError {
    /// The file as written.
    pub file: PathBuf,
    /// The folder.
    pub folder: PathBuf,
}

impl<T: AsRef<Path> + ?Sized> From<&T> for Folder {
    fn from(path: &T) -> Self {
        Self {
            path: path.as_ref().to_owned(),
            allows_outside: false,
        }
    }
}

impl From<Folder> for PathBuf {
    fn from(folder: Folder) -> Self {
        folder.path
    }
}

impl Folder {
    /// Sets whether files outside may be read too: only for descriptions that can be trusted.
    #[must_use]
    pub fn allow_outside(mut self, allows_outside: bool) -> Self {
        self.allows_outside = allows_outside;
        self
    }

    /// The folder itself; the empty path is the working folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The path to a file that a description names. It does not check whether the file exists.
    ///
    /// # Errors
    /// When it leads out of the folder and this is not allowed.
    pub fn path_to(&self, file: &Path) -> Result<PathBuf, OutsideError> {
        let path = self.path.join(file);
        if self.allows_outside || self.holds(file, &path) {
            return Ok(path);
        }
        Err(OutsideError {
            file: file.to_owned(),
            folder: self.path.clone(),
        })
    }

    fn holds(&self, file: &Path, path: &Path) -> bool {
        let Ok(folder) = shown(&self.path).canonicalize() else {
            return stays_within(file);
        };
        match path.canonicalize() {
            Ok(path) => path.starts_with(folder),
            // It cannot be opened either, which is reported when someone tries.
            Err(_) => stays_within(file),
        }
    }
}

/// The folder as a nonempty path.
fn shown(folder: &Path) -> &Path {
    if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    }
}

/// Whether a path, as written, never leads above its start.
fn stays_within(file: &Path) -> bool {
    let mut depth = 0_usize;
    file.components().all(|component| match component {
        Component::Prefix(_) | Component::RootDir => false,
        Component::CurDir => true,
        Component::ParentDir => match depth.checked_sub(1) {
            Some(less) => {
                depth = less;
                true
            }
            None => false,
        },
        Component::Normal(_) => {
            depth += 1;
            true
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// `inside/a.csv`, `inside/deep/b.csv` and `outside.csv`.
    fn tree() -> tempfile::TempDir {
        let tree = tempfile::tempdir().unwrap();
        fs::create_dir_all(tree.path().join("inside/deep")).unwrap();
        for file in ["inside/a.csv", "inside/deep/b.csv", "outside.csv"] {
            fs::write(tree.path().join(file), "x").unwrap();
        }
        tree
    }

    #[test]
    fn files_within_are_found() {
        let tree = tree();
        let folder = Folder::from(&tree.path().join("inside"));
        let absolute = tree.path().join("inside/a.csv");
        let absolute = absolute.to_str().unwrap();
        for file in [
            "a.csv",
            "./a.csv",
            "deep/b.csv",
            "deep/../a.csv",
            "../inside/a.csv",
            absolute,
        ] {
            let path = folder.path_to(Path::new(file)).unwrap();
            assert_eq!(fs::read(path).unwrap(), b"x", "{file}");
        }
        // A missing file is reported when it is opened.
        assert!(folder.path_to(Path::new("missing.csv")).is_ok());
        assert!(folder.path_to(Path::new("missing/../a.csv")).is_ok());
    }

    #[test]
    fn files_outside_are_refused_unless_allowed() {
        let tree = tree();
        let folder = Folder::from(&tree.path().join("inside"));
        let absolute = tree.path().join("outside.csv");
        let absolute = absolute.to_str().unwrap();
        for file in [
            "../outside.csv",
            "deep/../../outside.csv",
            "../missing.csv",
            "/missing.csv",
            "..",
            absolute,
        ] {
            let error = folder.path_to(Path::new(file)).unwrap_err().to_string();
            assert!(
                error.contains(file) && error.contains("--allow-outside"),
                "{error}"
            );
            let open = folder.clone().allow_outside(true);
            assert!(open.path_to(Path::new(file)).is_ok(), "{file}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed() {
        let tree = tree();
        let inside = tree.path().join("inside");
        let link =
            |to: &str, name: &str| std::os::unix::fs::symlink(to, inside.join(name)).unwrap();
        link("../outside.csv", "out.csv");
        link("..", "up");
        link("deep/b.csv", "in.csv");
        let folder = Folder::from(&inside);
        assert!(folder.path_to(Path::new("in.csv")).is_ok());
        for file in ["out.csv", "up/outside.csv"] {
            assert!(folder.path_to(Path::new(file)).is_err(), "{file}");
        }
        // The folder itself may be reached through a link.
        let other = tree.path().join("other");
        std::os::unix::fs::symlink(&inside, &other).unwrap();
        assert!(Folder::from(&other).path_to(Path::new("a.csv")).is_ok());
    }
}
