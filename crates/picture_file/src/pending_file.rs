//! A file that appears under its name only when it is complete.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

use list::Listed;
pub use list::{Abandoned, abandon_all};

mod list;

/// The path that stands for standard output. A file of this name is `./-`.
pub const STANDARD_OUTPUT: &str = "-";

/// Where a path leads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Destination {
    /// Standard output, named by [`STANDARD_OUTPUT`].
    StandardOutput,
    /// A file that exists or can be created, with symbolic links resolved. The file is replaced as a whole.
    File(PathBuf),
    /// A pipe or a device, which is written to in place.
    Stream(PathBuf),
}

/// The most links to follow, as in operating systems.
const MAX_LINKS: usize = 40;

impl Destination {
    /// Follows the links of a path; the file at the end need not exist.
    ///
    /// # Errors
    /// When the path is a folder or does not end in a file name, or when its links form a loop.
    pub fn of(path: &Path) -> io::Result<Self> {
        if path.as_os_str() == STANDARD_OUTPUT {
            return Ok(Self::StandardOutput);
        }
        let ends_in_separator = path.to_string_lossy().ends_with(std::path::is_separator);
        if ends_in_separator || path.file_name().is_none() {
            let message = "the path does not end in a file name";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
        let mut path = path.to_owned();
        for _ in 0..MAX_LINKS {
            let metadata = fs::metadata(&path);
            let kind = metadata.as_ref().ok().map(fs::Metadata::file_type);
            if kind.is_some_and(|kind| kind.is_dir()) {
                let message = "is a directory";
                return Err(io::Error::new(io::ErrorKind::IsADirectory, message));
            }
            // These are names of open files, which may be regular ones. (Other folders in /dev may hold files, such as /dev/shm.)
            let streams = [
                "/proc",
                "/dev/fd",
                "/dev/stdin",
                "/dev/stdout",
                "/dev/stderr",
            ];
            let is_of_system = streams.iter().any(|stream| path.starts_with(stream));
            let is_special = kind.is_some_and(|kind| !kind.is_file());
            if is_special || (is_of_system && kind.is_some()) {
                return Ok(Self::Stream(path));
            }
            match fs::read_link(&path) {
                // A relative link starts in its own folder.
                Ok(link) => path = path.with_file_name("").join(link),
                Err(_) => return Ok(Self::File(path)),
            }
        }
        Err(io::Error::other("its symbolic links form a loop"))
    }
}

/// Checks that a file can be created in a folder: permissions alone do not reveal read-only and virtual file systems. The file that
/// is created has no name where the system allows that, and is gone afterward.
///
/// # Errors
/// The error of the operating system when no file can be created.
pub fn can_create_in(folder: &Path) -> io::Result<()> {
    tempfile::tempfile_in(folder).map(drop)
}

/// A file being written under another name in the folder of its target, so that a failure leaves no partial file. Output for a pipe,
/// a device or standard output is collected in a file without a name in the folder for temporary files. A file dropped without
/// [`PendingFile::commit`] is removed.
///
/// Bytes of any kind can be written with it: through [`PendingFile::handle`], then [`PendingFile::commit`].
#[derive(Debug)]
pub struct PendingFile(Output);

#[derive(Debug)]
enum Output {
    /// A file that will be renamed. It is removed before it leaves the list.
    File {
        target: PathBuf,
        file: NamedTempFile,
        listed: Listed,
    },
    /// A file without a name, whose bytes will be copied to the pipe or device, or to standard output if there is no path.
    Copied { target: Option<PathBuf>, file: File },
}

impl PendingFile {
    /// Opens a new file in the directory that `target` leads to.
    ///
    /// # Errors
    /// As [`Destination::of`], and when the folder cannot be written to.
    pub fn create(target: &Path) -> io::Result<Self> {
        let target = match Destination::of(target)? {
            Destination::File(target) => {
                let create = || temporary(&target, folder_of(&target));
                let (file, listed) = Listed::create(create)?;
                return Ok(Self(Output::File {
                    target,
                    file,
                    listed,
                }));
            }
            Destination::Stream(target) => Some(target),
            Destination::StandardOutput => None,
        };
        let file = tempfile::tempfile()?;
        Ok(Self(Output::Copied { target, file }))
    }

    /// Returns a handle to write with. Dropping the handle does not close the file.
    ///
    /// # Errors
    /// When the system provides no second handle.
    pub fn handle(&self) -> io::Result<File> {
        match &self.0 {
            Output::File { file, .. } => file.as_file().try_clone(),
            Output::Copied { file, .. } => file.try_clone(),
        }
    }

    /// Renames the file to its target, replacing any file there, or writes it to the pipe, the device or standard output.
    ///
    /// # Errors
    /// When the file cannot be flushed to disk, renamed or written; it is then removed. When only its new name cannot be flushed to
    /// disk, the file stays.
    pub fn commit(self) -> io::Result<()> {
        match self.0 {
            Output::File {
                target,
                file,
                listed,
            } => {
                file.as_file().sync_all()?;
                listed.rename(file, &target)?;
                sync_folder(folder_of(&target))
            }
            Output::Copied { target, file } => copy(file, target.as_deref()),
        }
    }
}

/// Writes a file from its start to the pipe or device, or to standard output.
fn copy(mut file: File, target: Option<&Path>) -> io::Result<()> {
    file.rewind()?;
    if let Some(target) = target {
        let mut stream = OpenOptions::new().append(true).open(target)?;
        io::copy(&mut file, &mut stream)?;
        return Ok(());
    }
    let mut output = io::stdout().lock();
    io::copy(&mut file, &mut output)?;
    output.flush()
}

fn folder_of(path: &Path) -> &Path {
    let folder = path.parent();
    let folder = folder.filter(|folder| !folder.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}

/// Flushes the names in a folder to disk, where the folder may be read and its file system can do so.
#[cfg(unix)]
fn sync_folder(folder: &Path) -> io::Result<()> {
    let opened = match File::open(folder) {
        Err(error) if error.kind() == io::ErrorKind::PermissionDenied => return Ok(()),
        opened => opened?,
    };
    match opened.sync_all() {
        // EINVAL: the file system does not flush folders.
        Err(error) if error.kind() == io::ErrorKind::InvalidInput => Ok(()),
        flushed => flushed,
    }
}

#[cfg(not(unix))]
fn sync_folder(_: &Path) -> io::Result<()> {
    Ok(())
}

/// A temporary file for a target, whose name starts with a dot, with the permissions of any new file.
fn temporary(target: &Path, folder: &Path) -> io::Result<NamedTempFile> {
    let mut prefix = OsString::from(".");
    prefix.push(target.file_name().unwrap_or_default());
    let mut builder = Builder::new();
    builder.prefix(&prefix).suffix(".tmp");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
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

    #[test]
    fn a_name_with_a_separator_behind_it_is_no_file() {
        let directory = tempfile::tempdir().unwrap();
        let path = format!("{}/picture/", directory.path().display());
        assert!(PendingFile::create(Path::new(&path)).is_err());
        assert!(names(directory.path()).is_empty());
    }

    #[cfg(unix)]
    fn put(path: &Path, bytes: &[u8]) {
        let pending = PendingFile::create(path).unwrap();
        pending.handle().unwrap().write_all(bytes).unwrap();
        pending.commit().unwrap();
    }

    /// Relative and absolute links, links to links, and a link to a file that does not exist yet.
    #[cfg(unix)]
    #[test]
    fn links_stay_and_what_they_lead_to_is_replaced() {
        use std::os::unix::fs::symlink;
        let directory = tempfile::tempdir().unwrap();
        let at = |name: &str| directory.path().join(name);
        fs::create_dir(at("inner")).unwrap();
        fs::write(at("inner/old"), "old").unwrap();
        symlink("inner/old", at("relative")).unwrap();
        symlink(at("relative"), at("absolute")).unwrap();
        symlink("inner/missing", at("dangling")).unwrap();
        for (link, file) in [
            ("relative", "inner/old"),
            ("absolute", "inner/old"),
            ("dangling", "inner/missing"),
        ] {
            put(&at(link), link.as_bytes());
            assert_eq!(fs::read(at(file)).unwrap(), link.as_bytes());
            assert!(fs::symlink_metadata(at(link)).unwrap().is_symlink());
            assert!(!fs::symlink_metadata(at(file)).unwrap().is_symlink());
        }
        symlink("round", at("round")).unwrap();
        assert!(PendingFile::create(&at("round")).is_err());
        symlink("inner", at("folder")).unwrap();
        assert!(PendingFile::create(&at("folder")).is_err());
        assert_eq!(names(&at("inner")).len(), 2);
    }

    #[cfg(unix)]
    #[test]
    fn a_pipe_gets_the_bytes_and_stays_a_pipe() {
        use std::os::unix::fs::FileTypeExt;
        let directory = tempfile::tempdir().unwrap();
        let pipe = directory.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.unwrap().success());
        let end = pipe.clone();
        let reader = std::thread::spawn(move || fs::read(end).unwrap());
        put(&pipe, b"picture");
        assert_eq!(reader.join().unwrap(), b"picture");
        assert!(fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo());
        assert_eq!(names(directory.path()), ["pipe"]);
    }

    /// A folder in memory that is below the devices.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_file_in_shared_memory_is_replaced() {
        let directory = tempfile::tempdir_in("/dev/shm").unwrap();
        let path = directory.path().join("picture");
        for bytes in [&b"a long picture"[..], b"short"] {
            put(&path, bytes);
            assert_eq!(fs::read(&path).unwrap(), bytes);
        }
    }

    /// The destination is checked first, since a wrong one would replace the device by a file.
    #[cfg(unix)]
    #[test]
    fn the_null_device_is_written_to_and_stays() {
        use std::os::unix::fs::MetadataExt;
        let null = Path::new("/dev/null");
        let before = fs::symlink_metadata(null).unwrap();
        assert_eq!(
            Destination::of(null).unwrap(),
            Destination::Stream(null.to_owned())
        );
        put(null, b"picture");
        let after = fs::symlink_metadata(null).unwrap();
        assert_eq!((before.ino(), before.rdev()), (after.ino(), after.rdev()));
    }

    #[test]
    fn a_dash_alone_is_standard_output() {
        let of = |path: &str| Destination::of(Path::new(path)).unwrap();
        assert_eq!(of(STANDARD_OUTPUT), Destination::StandardOutput);
        assert!(matches!(of("./-"), Destination::File(_)));
        assert!(matches!(of("--"), Destination::File(_)));
        let pending = PendingFile::create(Path::new("-")).unwrap();
        assert!(matches!(pending.0, Output::Copied { target: None, .. }));
    }

    #[test]
    fn a_folder_is_tried_without_leaving_anything() {
        let directory = tempfile::tempdir().unwrap();
        can_create_in(directory.path()).unwrap();
        assert!(names(directory.path()).is_empty());
        assert!(can_create_in(&directory.path().join("missing")).is_err());
    }

    /// Into a folder that may be written to but not listed.
    #[cfg(unix)]
    #[test]
    fn a_folder_that_cannot_be_read_can_hold_files() {
        use std::os::unix::fs::PermissionsExt;
        let directory = tempfile::tempdir().unwrap();
        let mode = |mode| fs::set_permissions(directory.path(), fs::Permissions::from_mode(mode));
        mode(0o300).unwrap();
        put(&directory.path().join("picture"), b"picture");
        mode(0o700).unwrap();
        assert_eq!(names(directory.path()), ["picture"]);
    }
}
