//! Files of the refractiveindex.info database: YAML with tables and dispersion formulas.
//!
//! ```yaml
//! DATA:
//!   - type: formula 2
//!     wavelength_range: 0.3 2.5
//!     coefficients: 0 1.03961212 0.00600069867
//!   - type: tabulated k
//!     data: |
//!       0.300 2.8607E-06
//!       0.310 1.3679E-06
//! SPECS:
//!   n_is_absolute: true
//! ```
//!
//! Wavelengths are in µm. Everything else in a file (references, conditions, properties) is ignored.

use super::error::{DatabaseFileError, MAX_COEFFICIENTS};
use super::yaml::{self, Document, Text, Written};
use document::text_file::read_text;
use spectra::table_file::Row;
use spectra::{DispersionFormula, FormulaKind};
use std::path::Path;

/// The contents of a file.
pub(crate) struct DatabaseFile {
    /// Its `DATA`.
    pub(crate) blocks: Vec<Block>,
    /// Entries of its `SPECS` which say that data do not refer to vacuum.
    pub(crate) of_air: Vec<OfAir>,
}

/// Data that do not refer to vacuum, with the line that says so.
pub(crate) enum OfAir {
    Index(usize),
    Wavelengths(usize),
}

/// One entry of a file's `DATA`, with its first line.
pub(crate) struct Block {
    pub(crate) line: usize,
    pub(crate) data: Data,
}

/// The data of a block.
pub(crate) enum Data {
    N(Vec<Row<1>>),
    K(Vec<Row<1>>),
    Nk(Vec<Row<2>>),
    Formula(DispersionFormula),
    /// The nonlinear index.
    N2,
}

/// Reads a file.
pub(crate) fn read(path: &Path) -> Result<DatabaseFile, DatabaseFileError> {
    let text = read_text(path)?;
    let document = yaml::document(text.strip_prefix('\u{feff}').unwrap_or(&text))?;
    if document.blocks.is_empty() {
        return Err(DatabaseFileError::NoData);
    }
    let of_air = of_air(&document);
    let blocks = document.blocks.iter().map(block);
    Ok(DatabaseFile {
        blocks: blocks.collect::<Result<_, _>>()?,
        of_air,
    })
}

fn of_air(document: &Document) -> Vec<OfAir> {
    let denied = document.specs.iter().filter(|(_, value)| {
        let value = value.content.trim().to_lowercase();
        matches!(value.as_str(), "false" | "no")
    });
    let of = |(key, value): &(String, Text)| match key.as_str() {
        "n_is_absolute" => Some(OfAir::Index(value.line)),
        "wavelength_is_vacuum" => Some(OfAir::Wavelengths(value.line)),
        _ => None,
    };
    denied.filter_map(of).collect()
}

fn block(written: &Written) -> Result<Block, DatabaseFileError> {
    let kind = written.field("type")?;
    let words: Vec<&str> = kind.content.split_whitespace().take(3).collect();
    let data = match words[..] {
        ["tabulated", "n"] => Data::N(rows(written.field("data")?)?),
        ["tabulated", "k"] => Data::K(rows(written.field("data")?)?),
        ["tabulated", "nk"] => Data::Nk(rows(written.field("data")?)?),
        ["tabulated", "n2"] => Data::N2,
        ["formula", number] => Data::Formula(formula(written, kind, number)?),
        _ => return Err(unknown_type(kind)),
    };
    Ok(Block {
        line: written.line,
        data,
    })
}

fn unknown_type(kind: &Text) -> DatabaseFileError {
    DatabaseFileError::Type {
        line: kind.line,
        found: kind.content.chars().take(40).collect(),
    }
}

fn formula(
    written: &Written,
    kind: &Text,
    number: &str,
) -> Result<DispersionFormula, DatabaseFileError> {
    let kind = number
        .parse()
        .ok()
        .and_then(FormulaKind::from_number)
        .ok_or_else(|| unknown_type(kind))?;
    // Older files have `range`.
    let range = written
        .field("wavelength_range")
        .or_else(|missing| written.field("range").map_err(|_| missing))?;
    let ends = numbers(&range.content, range.line)?;
    let &[low_um, high_um] = ends.as_slice() else {
        return Err(DatabaseFileError::Count {
            line: range.line,
            found: ends.len(),
            expected: 2,
        });
    };
    let coefficients = written.field("coefficients")?;
    let line = coefficients.line;
    let figures = numbers(&coefficients.content, line)?;
    if figures.len() > MAX_COEFFICIENTS {
        let found = figures.len();
        return Err(DatabaseFileError::Coefficients { line, found });
    }
    DispersionFormula::new(kind, figures, (low_um * 1e3, high_um * 1e3))
        .map_err(|source| DatabaseFileError::Formula { line, source })
}

/// The rows of a table in the order of the file.
fn rows<const N: usize>(data: &Text) -> Result<Vec<Row<N>>, DatabaseFileError> {
    let mut rows: Vec<Row<N>> = Vec::new();
    for (index, content) in data.content.lines().enumerate() {
        let line = if data.is_literal {
            data.line + index
        } else {
            data.line
        };
        let figures = content.split('#').next().unwrap_or_default();
        let numbers = numbers(figures, line)?;
        if numbers.is_empty() {
            continue;
        }
        if numbers.len() != 1 + N {
            return Err(DatabaseFileError::Count {
                line,
                found: numbers.len(),
                expected: 1 + N,
            });
        }
        rows.push(Row {
            line,
            nm: numbers[0] * 1e3,
            values: std::array::from_fn(|column| numbers[1 + column]),
        });
    }
    Ok(rows)
}

fn numbers(text: &str, line: usize) -> Result<Vec<f64>, DatabaseFileError> {
    let number = |word: &str| {
        let not_a_number = || DatabaseFileError::Number {
            line,
            text: word.chars().take(40).collect(),
        };
        word.parse().map_err(|_| not_a_number())
    };
    text.split_whitespace().map(number).collect()
}
