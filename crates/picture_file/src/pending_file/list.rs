//! The temporary files of the whole process, so that a signal can remove them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

/// The paths of all temporary files that have a name.
static FILES: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Locks the list. It is sound even if another thread panicked.
fn files() -> MutexGuard<'static, Vec<PathBuf>> {
    FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// While this exists, other threads wait instead of creating or renaming a [`PendingFile`](super::PendingFile).
#[derive(Debug)]
#[must_use = "once it is dropped, other threads create and rename files again"]
pub struct Abandoned {
    _files: MutexGuard<'static, Vec<PathBuf>>,
}

/// Removes the temporary files of every [`PendingFile`](super::PendingFile) of this process. This is for a thread that handles a
/// signal: it keeps the result until the process exits, so that no file is left behind and none is replaced after that. The thread
/// must not use a `PendingFile` meanwhile.
pub fn abandon_all() -> Abandoned {
    let mut files = files();
    for path in files.drain(..) {
        // Nothing more can be done about a file that stays.
        let _ = fs::remove_file(path);
    }
    Abandoned { _files: files }
}

/// An entry of the list, which ends with it.
#[derive(Debug)]
pub(super) struct Listed(PathBuf);

impl Listed {
    /// Creates a file and enters it into the list, in one step for other threads.
    pub(super) fn create(
        create: impl FnOnce() -> io::Result<NamedTempFile>,
    ) -> io::Result<(NamedTempFile, Self)> {
        let mut files = files();
        let file = create()?;
        let path = file.path().to_owned();
        files.push(path.clone());
        Ok((file, Self(path)))
    }

    /// Renames the file and takes it out of the list, in one step for other threads. The file is removed if that fails.
    pub(super) fn rename(self, file: NamedTempFile, target: &Path) -> io::Result<()> {
        let mut files = files();
        let renamed = file.persist(target).map(drop).map_err(io::Error::from);
        files.retain(|path| *path != self.0);
        // Dropping the entry takes the lock again.
        drop(files);
        renamed
    }
}

impl Drop for Listed {
    fn drop(&mut self) {
        files().retain(|path| *path != self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_listed_until_it_is_renamed_or_dropped() {
        let folder = tempfile::tempdir().unwrap();
        let own = || {
            let files = files();
            let own = files.iter().filter(|path| path.starts_with(folder.path()));
            own.count()
        };
        let create = || Listed::create(|| NamedTempFile::new_in(folder.path())).unwrap();
        let ((kept, kept_entry), (dropped, dropped_entry)) = (create(), create());
        assert_eq!(own(), 2);
        drop((dropped, dropped_entry));
        assert_eq!(own(), 1);
        let target = folder.path().join("target");
        kept_entry.rename(kept, &target).unwrap();
        assert_eq!(own(), 0);
        let (refused, entry) = create();
        assert!(entry.rename(refused, &target.join("file")).is_err());
        assert_eq!(own(), 0);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
