//! Tables in files of users: columns of numbers, separated by commas, semicolons or tabs.

use std::path::Path;

use thiserror::Error;

use crate::text_file::{TextFileError, read_text};
use crate::{Tabulated, TabulatedError};

/// A row of a table: a wavelength and the `N` values there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<const N: usize> {
    /// Line of the file, counted from 1.
    pub line: usize,
    /// The first column: a wavelength, nm; in a table over something else, that.
    pub nm: f64,
    /// The others.
    pub values: [f64; N],
}

/// Why a file is not a table that can be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TableFileError {
    /// It cannot be read as text.
    #[error(transparent)]
    File(#[from] TextFileError),
    /// A row has more or fewer cells than it needs.
    #[error("line {line}: found {found} columns, expected {expected}")]
    Columns {
        /// Line, from 1.
        line: usize,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: String,
    },
    /// A cell is not a number.
    #[error("line {line}: {text:?} is not a number")]
    Number {
        /// Line, from 1.
        line: usize,
        /// The cell.
        text: String,
    },
    /// A value is not in its range.
    #[error("line {line}: found {noun} {value}; it must be from {} to {}", range.0, range.1)]
    Value {
        /// Line, from 1.
        line: usize,
        /// What it is.
        noun: &'static str,
        /// The value.
        value: f64,
        /// Smallest and largest possible.
        range: (f64, f64),
    },
    /// A wavelength is not above the one before it.
    #[error("line {line}: wavelengths must rise, but {nm} nm does not")]
    NotRising {
        /// Line, from 1.
        line: usize,
        /// The wavelength.
        nm: f64,
    },
    /// No rows.
    #[error("the table has no points; it needs at least one")]
    Empty,
}

/// What a column of values holds, for [`columns`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Its name in messages.
    pub noun: &'static str,
    /// Smallest and largest value possible.
    pub range: (f64, f64),
}

impl Quantity {
    /// The part of the light that comes back, 0 to 1.
    pub const REFLECTANCE: Self = Self {
        noun: "reflectance",
        range: (0.0, 1.0),
    };
    /// A power of light, in any unit.
    pub const POWER: Self = Self {
        noun: "power",
        range: (0.0, 1e9),
    };
}

/// Wavelengths that a table may have, nm.
const POSSIBLE_NM: Quantity = Quantity {
    noun: "wavelength",
    range: (1.0, 1e6),
};

/// The rows of a file: [`parse_rows`] of its text.
///
/// # Errors
/// When the file is not text, or a row is not of numbers.
pub fn rows<const N: usize>(path: &Path) -> Result<Vec<Row<N>>, TableFileError> {
    parse_rows(&read_text(path)?)
}

/// The rows of a text.
///
/// Empty lines and lines that start with `#` are passed over, and so is a first line without any number, which is
/// taken for a heading. Where two values are asked for (n and k), texts with the first alone have 0 for the other.
///
/// # Errors
/// When a row is not of numbers.
pub fn parse_rows<const N: usize>(text: &str) -> Result<Vec<Row<N>>, TableFileError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = text
        .lines()
        .zip(1..)
        .map(|(content, line)| (line, content.trim()))
        .filter(|(_, content)| !content.is_empty() && !content.starts_with('#'))
        .peekable();
    lines.next_if(|(_, content)| cells(content).all(|cell| cell.parse::<f64>().is_err()));
    lines.map(|(line, content)| row(line, content)).collect()
}

/// The columns of a file: [`parse_columns`] of its text.
///
/// # Errors
/// When the file is not text, or not of such tables; the first fault is told with its line.
pub fn columns<const N: usize>(
    path: &Path,
    quantities: [Quantity; N],
) -> Result<[Tabulated; N], TableFileError> {
    parse_columns(&read_text(path)?, quantities)
}

/// The tables over wavelength that a text's columns are, each value in the range of its quantity.
///
/// # Errors
/// When [`parse_rows`] fails, or the rows are not such tables; the first fault is told with its line.
pub fn parse_columns<const N: usize>(
    text: &str,
    quantities: [Quantity; N],
) -> Result<[Tabulated; N], TableFileError> {
    let rows = parse_rows::<N>(text)?;
    for row in &rows {
        check(row.line, row.nm, POSSIBLE_NM)?;
        for (&value, quantity) in row.values.iter().zip(quantities) {
            check(row.line, value, quantity)?;
        }
    }
    let mut tables = Vec::with_capacity(N);
    for column in 0..N {
        let points = rows.iter().map(|row| (row.nm, row.values[column]));
        let table = Tabulated::new(points.collect()).map_err(|error| match error {
            TabulatedError::NotRising { index, nm } => TableFileError::NotRising {
                line: rows[index].line,
                nm,
            },
            // What is not finite is in no range.
            TabulatedError::Empty | TabulatedError::NotFinite { .. } => TableFileError::Empty,
        })?;
        tables.push(table);
    }
    tables.try_into().map_err(|_| TableFileError::Empty)
}

fn check(
    line: usize,
    value: f64,
    Quantity { noun, range }: Quantity,
) -> Result<(), TableFileError> {
    if (range.0..=range.1).contains(&value) {
        return Ok(());
    }
    Err(TableFileError::Value {
        line,
        noun,
        value,
        range,
    })
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
            expected: match N {
                2 => "3 (or 2, for k = 0)".to_owned(),
                _ => (1 + N).to_string(),
            },
        });
    }
    let number = |cell: &str| {
        cell.parse().map_err(|_| TableFileError::Number {
            line,
            text: cell.chars().take(40).collect(),
        })
    };
    let mut cells = cells(content);
    let nm = number(cells.next().unwrap_or_default())?;
    let mut values = [0.0; N];
    for (value, cell) in values.iter_mut().zip(cells) {
        *value = number(cell)?;
    }
    Ok(Row { line, nm, values })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(text: &str) -> tempfile::NamedTempFile {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        file
    }

    #[test]
    fn columns_are_tables_over_wavelength() {
        let file = file(
            "\u{feff}# measured\n\nwavelength_nm;red;green;blue\n400; 0;0.5;1\n410\t1\t2\t3\n",
        );
        let [red, _, blue] = columns(file.path(), [Quantity::POWER; 3]).unwrap();
        assert_eq!(red.at(405.0), Ok(0.5));
        assert_eq!(blue.range_nm(), (400.0, 410.0));
    }

    #[test]
    fn faults_name_their_line() {
        for (text, said) in [
            (
                "nm,r\n400,1\n400,1\n",
                "line 3: wavelengths must rise, but 400 nm does not",
            ),
            (
                "nm,r\n400,1.1\n",
                "line 2: found reflectance 1.1; it must be from 0 to 1",
            ),
            ("400,-0.1\n", "line 1: found reflectance -0.1"),
            ("400,nan\n", "line 1: found reflectance NaN"),
            ("0,0.5\n", "line 1: found wavelength 0"),
            ("400,0.5\n410,x\n", "line 2: \"x\" is not a number"),
            ("400,0.5,0.5\n", "line 1: found 3 columns, expected 2"),
            ("nm,r\n", "has no points"),
            ("", "has no points"),
        ] {
            let error = columns(file(text).path(), [Quantity::REFLECTANCE]).unwrap_err();
            assert!(error.to_string().contains(said), "{text:?}: {error}");
        }
        let folder = tempfile::tempdir().unwrap();
        let error = columns(folder.path(), [Quantity::POWER]).unwrap_err();
        assert!(error.to_string().contains("directory"), "{error}");
    }
}
