//! Reading a user's file or standard input as a whole.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use thiserror::Error;

/// The path that means standard input.
pub const STANDARD_INPUT: &str = "-";

/// Whether standard input has been requested; it can be read only once.
static STANDARD_INPUT_IS_USED: AtomicBool = AtomicBool::new(false);

/// The size of the largest text file that is read, in bytes.
pub const MAX_BYTES: u64 = 16 << 20;

/// Why a file cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TextFileError {
    /// The operating system reports an error.
    #[error("cannot be opened: {0}")]
    Io(#[from] io::Error),
    /// The path is a directory.
    #[error("is a directory, not a file")]
    Directory,
    /// The path is a pipe, a device or similar.
    #[error("is not a regular file but a pipe or a device; standard input is read as -")]
    NotRegular,
    /// The file is larger than the limit.
    #[error("is larger than {} MiB", most >> 20)]
    TooLarge {
        /// The limit in bytes.
        most: u64,
    },
    /// The file is not UTF-8.
    #[error("is not text: line {line} is not UTF-8; save the file as UTF-8")]
    NotText {
        /// The first line that is not UTF-8, from 1.
        line: usize,
    },
    /// The file contains a zero byte, which no text has.
    #[error(
        "is not text: line {line} has a zero byte; UTF-16 needs a byte order mark at the start"
    )]
    Nul {
        /// The line, from 1.
        line: usize,
    },
    /// The file starts with a UTF-16 byte order mark but is not UTF-16.
    #[error("is not text: line {line} is not UTF-16, but the file starts with its byte order mark")]
    NotUtf16 {
        /// The first line that is not UTF-16, from 1.
        line: usize,
    },
    /// `-` is given twice.
    #[error(
        "is standard input, which can be read once only, but is requested twice; write one of the two to a file"
    )]
    StandardInputTwice,
}

/// Reads the text of a regular file of at most [`MAX_BYTES`], or of standard input for `-`: UTF-8, or UTF-16 with a byte order mark.
///
/// # Errors
/// When the file cannot be read, or is not such text.
pub fn read_text(path: &Path) -> Result<String, TextFileError> {
    let bytes = read_bytes(path, MAX_BYTES)?;
    match bytes.as_slice() {
        [0xff, 0xfe, rest @ ..] => utf_16(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => utf_16(rest, u16::from_be_bytes),
        _ if bytes.contains(&0) => Err(TextFileError::Nul {
            line: line_of(&bytes, bytes.iter().position(|&byte| byte == 0)),
        }),
        _ => String::from_utf8(bytes).map_err(|error| {
            let sound = error.utf8_error().valid_up_to();
            TextFileError::NotText {
                line: line_of(error.as_bytes(), Some(sound)),
            }
        }),
    }
}

/// Returns the line, from 1, that contains a byte position.
fn line_of(bytes: &[u8], place: Option<usize>) -> usize {
    let before = place.and_then(|place| bytes.get(..place));
    before
        .unwrap_or_default()
        .split(|&byte| byte == b'\n')
        .count()
}

fn utf_16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<String, TextFileError> {
    let (pairs, rest) = bytes.as_chunks::<2>();
    let mut text = String::new();
    let mut characters = char::decode_utf16(pairs.iter().copied().map(unit));
    let is_sound = characters.all(|character| character.map(|c| text.push(c)).is_ok());
    if is_sound && rest.is_empty() {
        return Ok(text);
    }
    let line = text.split('\n').count();
    Err(TextFileError::NotUtf16 { line })
}

/// Reads the bytes of a regular file of at most `most` bytes, or of standard input for `-`.
///
/// # Errors
/// When the file cannot be read.
pub fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>, TextFileError> {
    let bytes = read_start(path, most.saturating_add(1))?;
    if bytes.len() as u64 > most {
        return Err(TextFileError::TooLarge { most });
    }
    Ok(bytes)
}

/// Reads the first `most` bytes of a regular file, or all if it is shorter; for `-`, those of standard input, once in a process.
///
/// The type of the file is checked before it is opened, because opening a pipe would wait for its writer.
///
/// # Errors
/// When the file cannot be read.
pub fn read_start(path: &Path, most: u64) -> Result<Vec<u8>, TextFileError> {
    if path.as_os_str() == STANDARD_INPUT {
        if STANDARD_INPUT_IS_USED.swap(true, Ordering::Relaxed) {
            return Err(TextFileError::StandardInputTwice);
        }
        let mut bytes = Vec::new();
        io::stdin().lock().take(most).read_to_end(&mut bytes)?;
        return Ok(bytes);
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn text_of(bytes: &[u8]) -> Result<String, TextFileError> {
        let file = tempfile::NamedTempFile::new().unwrap();
        fs::write(file.path(), bytes).unwrap();
        read_text(file.path())
    }

    #[test]
    fn utf_16_with_a_mark_is_text() {
        // "µ\n": U+00B5 U+000A.
        assert_eq!(text_of(b"\xff\xfe\xb5\x00\x0a\x00").unwrap(), "µ\n");
        assert_eq!(text_of(b"\xfe\xff\x00\xb5\x00\x0a").unwrap(), "µ\n");
        assert_eq!(text_of(b"\xff\xfe").unwrap(), "");
    }

    #[test]
    fn what_is_no_text_names_the_line() {
        for (bytes, said) in [
            (&b"a\nb\n\xc3("[..], "line 3 is not UTF-8"),
            (b"a\n1,0.1\x00\n", "line 2 has a zero byte"),
            (b"\xff\xfea\x00\n\x00b", "line 2 is not UTF-16"),
            (b"\xfe\xff\x00a\xd8\x00", "line 1 is not UTF-16"),
        ] {
            let error = text_of(bytes).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
        }
    }
}
