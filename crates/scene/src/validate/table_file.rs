//! Tables in files of their own: columns of numbers, separated by commas, semicolons or tabs.

use crate::text_file::{TextFileError, read_text};
use std::path::Path;
use thiserror::Error;

/// A row of a table: a wavelength and the `N` values there.
pub(crate) struct Row<const N: usize> {
    /// Line of the file, counted from 1.
    pub(crate) line: usize,
    pub(crate) nm: f64,
    pub(crate) values: [f64; N],
}

/// Why a file is not a table.
#[derive(Debug, Error)]
pub(crate) enum TableFileError {
    #[error(transparent)]
    File(#[from] TextFileError),
    #[error("line {line}: found {found} columns, expected {expected}")]
    Columns {
        line: usize,
        found: usize,
        expected: &'static str,
    },
    #[error("line {line}: {text:?} is not a number")]
    Number { line: usize, text: String },
}

/// The rows of a file.
///
/// Empty lines and lines that start with `#` are passed over, and so is a first line without any number, which is
/// taken for a heading. Where two values are asked for (n and k), files with the first alone have 0 for the other.
pub(crate) fn read<const N: usize>(path: &Path) -> Result<Vec<Row<N>>, TableFileError> {
    let text = read_text(path)?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let mut lines = text
        .lines()
        .zip(1..)
        .map(|(content, line)| (line, content.trim()))
        .filter(|(_, content)| !content.is_empty() && !content.starts_with('#'))
        .peekable();
    lines.next_if(|(_, content)| cells(content).all(|cell| cell.parse::<f64>().is_err()));
    lines.map(|(line, content)| row(line, content)).collect()
}

fn cells(content: &str) -> impl Iterator<Item = &str> {
    content.split([',', ';', '\t']).map(str::trim)
}

fn row<const N: usize>(line: usize, content: &str) -> Result<Row<N>, TableFileError> {
    let found = cells(content).count();
    if found != 1 + N && !(found == 2 && N == 2) {
        return Err(TableFileError::Columns {
            line,
            found,
            expected: if N == 1 { "2" } else { "3 (or 2, for k = 0)" },
        });
    }
    let mut numbers = [0.0; 3];
    for (number, cell) in numbers.iter_mut().zip(cells(content)) {
        *number = cell.parse().map_err(|_| TableFileError::Number {
            line,
            text: cell.chars().take(40).collect(),
        })?;
    }
    Ok(Row {
        line,
        nm: numbers[0],
        values: std::array::from_fn(|column| numbers[1 + column]),
    })
}
