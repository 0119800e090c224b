//! The errors of reading a table file.

use thiserror::Error;

use document::text_file::TextFileError;

/// Why a file is not a usable table.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TableFileError {
    /// The file cannot be read as text.
    #[error(transparent)]
    File(#[from] TextFileError),
    /// A row has the wrong number of cells.
    #[error("line {line}: found {found} columns, expected {expected}")]
    Columns {
        /// Line, from 1.
        line: usize,
        /// The number of columns found.
        found: usize,
        /// The number expected.
        expected: String,
    },
    /// The table has too many rows or columns.
    #[error("the table has more than {most} {what}, the most that are possible")]
    TooMany {
        /// Points, samples or columns.
        what: &'static str,
        /// The largest possible number.
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
    /// A line is ambiguous.
    #[error(
        "line {line}: {} is ambiguous: {one}, or {other}; {way_out}",
        cell_text(text)
    )]
    Ambiguous {
        /// Line, from 1.
        line: usize,
        /// The text in question.
        text: String,
        /// One reading.
        one: String,
        /// The other.
        other: String,
        /// How to resolve the ambiguity.
        way_out: String,
    },
    /// One number has a decimal point and another a decimal comma.
    #[error(
        "line {}: {} has a decimal comma, but {} in line {} has a decimal point; use one of the two throughout", comma.0, cell_text(&comma.1),
        cell_text(&point.1), point.0
    )]
    TwoDecimalSigns {
        /// Line and cell with a comma.
        comma: (usize, String),
        /// Line and cell with a point.
        point: (usize, String),
    },
    /// A value is out of range.
    #[error("line {line}: found {noun} {text}; it must be from {} to {}{hint}", short(range.0), short(range.1))]
    Value {
        /// Line, from 1.
        line: usize,
        /// The quantity.
        noun: &'static str,
        /// The value as written.
        text: String,
        /// The smallest and largest possible value.
        range: (f64, f64),
        /// What may be meant, or empty.
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
    /// Wavelengths rise and fall.
    #[error(
        "line {line}: found {text} after {before}; wavelengths must rise or fall throughout, and {direction} up to that line"
    )]
    NotInOrder {
        /// Line, from 1.
        line: usize,
        /// The wavelength as written.
        text: String,
        /// The previous wavelength.
        before: String,
        /// Whether they rose or fell before.
        direction: &'static str,
    },
    /// A requested column does not exist.
    #[error("there is no column {asked}; the columns are {known}")]
    NoColumn {
        /// The requested column.
        asked: String,
        /// The columns of the table.
        known: String,
    },
    /// There are more columns than needed, and none is chosen.
    #[error(
        "{wrong}; the columns are {known}: choose by name or number with `column = …` (`--column …`)"
    )]
    WhichColumn {
        /// What is unclear.
        wrong: String,
        /// The columns of the table.
        known: String,
    },
    /// The unit in the header is not supported.
    #[error(
        "line {line}: the header {} names neither a wavelength in nm, µm or Å nor an energy in eV; other axes are not read",
        cell_text(text)
    )]
    Unit {
        /// Line, from 1.
        line: usize,
        /// The cell of the header.
        text: String,
    },
    /// A column holds logarithms of the quantity.
    #[error(
        "line {line}: the column {} is the logarithm of a transmittance or reflectance, which is not read; write 10^-A instead",
        cell_text(text)
    )]
    Logarithm {
        /// Line, from 1.
        line: usize,
        /// The cell of the header.
        text: String,
    },
    /// The format has one quantity, but several are needed.
    #[error("a file of this format has one column of values, but several are needed")]
    OneQuantity,
    /// The file violates the rules of its format.
    #[error("line {line}: invalid {format}: {wrong}")]
    Format {
        /// Line, from 1.
        line: usize,
        /// The format.
        format: &'static str,
        /// What is wrong.
        wrong: String,
    },
    /// There are no rows.
    #[error("the table has no points; it needs at least one line that starts with two numbers")]
    Empty,
}

/// Quotes text of a file for a message: at most 40 characters, with control characters escaped.
pub fn cell_text(text: &str) -> String {
    let mut short: String = text.chars().take(40).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    format!("{short:?}")
}

/// Formats a bound for a message: large ones as a power of ten.
fn short(bound: f64) -> String {
    if bound.abs() >= 1e6 {
        format!("{bound:e}")
    } else {
        bound.to_string()
    }
}
