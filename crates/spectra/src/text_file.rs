//! Reading a whole file that someone else wrote.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;
use thiserror::Error;

/// The largest file of text that is read, in bytes.
pub const MAX_BYTES: u64 = 16 << 20;

/// Why a file cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TextFileError {
    /// The system refuses.
    #[error("cannot be opened: {0}")]
    Io(#[from] io::Error),
    /// It is a folder.
    #[error("is a directory, not a file")]
    Directory,
    /// It is a pipe, a device or the like.
    #[error("is not a regular file")]
    NotRegular,
    /// It has more bytes than are read.
    #[error("is larger than {} MiB", most >> 20)]
    TooLarge {
        /// The most bytes that are read.
        most: u64,
    },
    /// It is not UTF-8.
    #[error("is not text: line {line} is not UTF-8")]
    NotText {
        /// The first line that is not, from 1.
        line: usize,
    },
}

/// The text of a regular file of at most [`MAX_BYTES`].
///
/// # Errors
/// When it cannot be read, or is not UTF-8.
pub fn read_text(path: &Path) -> Result<String, TextFileError> {
    String::from_utf8(read_bytes(path, MAX_BYTES)?).map_err(|error| {
        let sound = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        TextFileError::NotText {
            line: sound.split(|&b| b == b'\n').count(),
        }
    })
}

/// The bytes of a regular file of at most `most`.
///
/// # Errors
/// When it cannot be read.
pub fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>, TextFileError> {
    let bytes = read_start(path, most.saturating_add(1))?;
    if bytes.len() as u64 > most {
        return Err(TextFileError::TooLarge { most });
    }
    Ok(bytes)
}

/// The first bytes of a regular file, all of them where it has no more.
///
/// What the path leads to is looked at before it is opened: to open a pipe would wait for its writer.
///
/// # Errors
/// When it cannot be read.
pub fn read_start(path: &Path, most: u64) -> Result<Vec<u8>, TextFileError> {
    let metadata = fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(TextFileError::Directory);
    }
    if !metadata.is_file() {
        return Err(TextFileError::NotRegular);
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}
