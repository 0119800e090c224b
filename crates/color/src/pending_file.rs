//! A file that appears under its name only when it is complete.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// A file being written beside its place, under another name, so that a failure leaves no half file. Dropped without [`PendingFile::commit`], it is removed.
#[derive(Debug)]
pub struct PendingFile {
    target: PathBuf,
    temporary: PathBuf,
    file: Option<File>,
}

impl PendingFile {
    /// Opens a new file in the directory of `target`.
    ///
    /// # Errors
    /// When `target` is a folder or names none, or its folder cannot be written to.
    pub fn create(target: &Path) -> io::Result<Self> {
        static COUNTER: AtomicU32 = AtomicU32::new(0);
        let Some(name) = target.file_name() else {
            let message = "the path does not end in a file name";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        };
        if target.is_dir() {
            return Err(io::Error::new(
                io::ErrorKind::IsADirectory,
                "is a directory",
            ));
        }
        let mut hidden = OsString::from(".");
        hidden.push(name);
        let turn = COUNTER.fetch_add(1, Ordering::Relaxed);
        hidden.push(format!(".{}-{turn}.tmp", std::process::id()));
        let temporary = target.with_file_name(hidden);
        let file = OpenOptions::new()
            .read(true)
            .write(true)
            .create_new(true)
            .open(&temporary)?;
        Ok(Self {
            target: target.to_owned(),
            temporary,
            file: Some(file),
        })
    }

    /// The file to write to. Dropping what is returned does not close the file.
    ///
    /// # Errors
    /// When the system gives no second handle.
    pub fn handle(&self) -> io::Result<File> {
        match &self.file {
            Some(file) => file.try_clone(),
            None => Err(io::ErrorKind::NotFound.into()),
        }
    }

    /// Puts the file in its place, over any file that stood there.
    ///
    /// # Errors
    /// When the file cannot be brought to the disk or renamed; it is then removed.
    pub fn commit(mut self) -> io::Result<()> {
        if let Some(file) = &self.file {
            file.sync_all()?;
        }
        fs::rename(&self.temporary, &self.target)?;
        self.file = None;
        Ok(())
    }
}

impl Drop for PendingFile {
    fn drop(&mut self) {
        if self.file.take().is_some() {
            // An error is already on its way to the caller; there is no better place for this one.
            let _ = fs::remove_file(&self.temporary);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    fn names(directory: &Path) -> Vec<OsString> {
        let entries = fs::read_dir(directory).unwrap();
        entries.map(|entry| entry.unwrap().file_name()).collect()
    }

    #[test]
    fn the_file_appears_whole_or_not_at_all() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("picture");
        fs::write(&path, "old").unwrap();

        let pending = PendingFile::create(&path).unwrap();
        pending.handle().unwrap().write_all(b"half").unwrap();
        drop(pending);
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(directory.path()), ["picture"]);

        let pending = PendingFile::create(&path).unwrap();
        pending.handle().unwrap().write_all(b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"old");
        pending.commit().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(directory.path()), ["picture"]);
    }

    #[test]
    fn impossible_places_are_refused() {
        let directory = tempfile::tempdir().unwrap();
        assert!(PendingFile::create(directory.path()).is_err());
        assert!(PendingFile::create(Path::new("/")).is_err());
        assert!(PendingFile::create(&directory.path().join("missing/picture")).is_err());
    }
}
