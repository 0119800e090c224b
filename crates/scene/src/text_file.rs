//! Reading a whole file that someone else wrote.

use crate::limits::MAX_FILE_BYTES;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;
use thiserror::Error;

/// Why a file cannot be read.
#[derive(Debug, Error)]
pub(crate) enum TextFileError {
    #[error("cannot be opened: {0}")]
    Io(#[from] io::Error),
    #[error("is a directory, not a file")]
    Directory,
    #[error("is not a regular file")]
    NotRegular,
    #[error("is larger than {} MiB", MAX_FILE_BYTES >> 20)]
    TooLarge,
    #[error("is not text: line {line} is not UTF-8")]
    NotText { line: usize },
}

/// The text of a regular file of at most [`MAX_FILE_BYTES`].
pub(crate) fn read_text(path: &Path) -> Result<String, TextFileError> {
    String::from_utf8(read_bytes(path)?).map_err(|error| {
        let sound = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        TextFileError::NotText {
            line: sound.split(|&b| b == b'\n').count(),
        }
    })
}

/// The bytes of a regular file of at most [`MAX_FILE_BYTES`].
///
/// What the path leads to is looked at before it is opened: to open a pipe would wait for its writer.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, TextFileError> {
    let metadata = fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(TextFileError::Directory);
    }
    if !metadata.is_file() {
        return Err(TextFileError::NotRegular);
    }
    let mut bytes = Vec::new();
    File::open(path)?
        .take(MAX_FILE_BYTES + 1)
        .read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(TextFileError::TooLarge);
    }
    Ok(bytes)
}
