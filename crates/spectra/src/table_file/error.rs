//! Why a file is not a table that can be used.

use thiserror::Error;

use crate::text_file::TextFileError;

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
    /// More rows or columns than are read.
    #[error("the table has more than {most} {what}; at most as many are possible")]
    TooMany {
        /// Rows or columns.
        what: &'static str,
        /// How many are possible.
        most: usize,
    },
    /// A cell is not a number.
    #[error("line {line}: {} is not a number", cell_text(text))]
    Number {
        /// Line, from 1.
        line: usize,
        /// The cell.
        text: String,
    },
    /// A cell is empty.
    #[error("line {line}: column {column} is empty, but every row needs a number there")]
    EmptyCell {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
    },
    /// A line can be read in two ways.
    #[error(
        "line {line}: {} is ambiguous: {one}, or {other}; {way_out}",
        cell_text(text)
    )]
    Ambiguous {
        /// Line, from 1.
        line: usize,
        /// What stands there.
        text: String,
        /// One reading.
        one: String,
        /// The other.
        other: String,
        /// How to say which.
        way_out: String,
    },
    /// A number has a decimal point and another a decimal comma.
    #[error(
        "line {}: {} has a decimal comma, but {} in line {} a decimal point; one of them must be meant otherwise", comma.0, cell_text(&comma.1),
        cell_text(&point.1), point.0
    )]
    TwoDecimalSigns {
        /// Line and cell with a comma.
        comma: (usize, String),
        /// Line and cell with a point.
        point: (usize, String),
    },
    /// A value is not in its range.
    #[error("line {line}: found {noun} {text}; it must be from {} to {}{hint}", short(range.0), short(range.1))]
    Value {
        /// Line, from 1.
        line: usize,
        /// What it is.
        noun: &'static str,
        /// The value as written.
        text: String,
        /// Smallest and largest possible.
        range: (f64, f64),
        /// What may be meant, or nothing.
        hint: &'static str,
    },
    /// Two rows have the same wavelength.
    #[error("lines {} and {} are both at {text}; each wavelength needs one row", lines.0, lines.1)]
    Repeated {
        /// The lines, from 1.
        lines: (usize, usize),
        /// The wavelength as written.
        text: String,
    },
    /// Wavelengths go up and down.
    #[error(
        "line {line}: found {text} after {before}; wavelengths must rise or fall throughout, and {direction} before"
    )]
    NotInOrder {
        /// Line, from 1.
        line: usize,
        /// The wavelength as written.
        text: String,
        /// The one before.
        before: String,
        /// What they did.
        direction: &'static str,
    },
    /// A column was asked for that is not there.
    #[error("there is no column {asked}; the columns are {known}")]
    NoColumn {
        /// What was asked for.
        asked: String,
        /// Those there are.
        known: String,
    },
    /// There are more columns than needed and none is chosen.
    #[error(
        "{wrong}; the columns are {known}: choose by `column = …` (`--column …`) with a name or number"
    )]
    WhichColumn {
        /// What is not clear.
        wrong: String,
        /// Those there are.
        known: String,
    },
    /// The unit of the head is not one that is read.
    #[error(
        "line {line}: the head {} names no wavelength in nm, µm or Å nor an energy in eV; such tables are not read",
        cell_text(text)
    )]
    Unit {
        /// Line, from 1.
        line: usize,
        /// The cell of the head.
        text: String,
    },
    /// A column holds logarithms of what is needed.
    #[error(
        "line {line}: the column {} is the logarithm of a transmittance or reflectance, which is not read; 10^-A is needed",
        cell_text(text)
    )]
    Logarithm {
        /// Line, from 1.
        line: usize,
        /// The cell of the head.
        text: String,
    },
    /// A format of one quantity was given for several.
    #[error("such a file has one column of values, but several are needed")]
    OneQuantity,
    /// A file of a known format is not as that format is.
    #[error("line {line}: not as {format} has it: {wrong}")]
    Format {
        /// Line, from 1.
        line: usize,
        /// The format.
        format: &'static str,
        /// What is wrong.
        wrong: String,
    },
    /// No rows.
    #[error("the table has no points; it needs at least one line that starts with two numbers")]
    Empty,
}

/// What a file says, for a message: at most 40 characters, in quotes, control characters escaped.
pub fn cell_text(text: &str) -> String {
    let mut short: String = text.chars().take(40).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    format!("{short:?}")
}

/// A bound as messages show it: large ones as a power of ten.
fn short(bound: f64) -> String {
    if bound.abs() >= 1e6 {
        format!("{bound:e}")
    } else {
        bound.to_string()
    }
}
