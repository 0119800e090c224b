//! Errors in files of the database.

use crate::limits::MAX_FORMULA_TERMS;
use document::text_file::TextFileError;
use spectra::FormulaError;
use thiserror::Error;

/// The maximum number of coefficients. The database's formulas have at most 17.
pub(super) const MAX_COEFFICIENTS: usize = 1 + 4 * MAX_FORMULA_TERMS;

/// The reason why a file is not a file of the database. Lines are counted from 1.
#[derive(Debug, Error)]
pub(crate) enum DatabaseFileError {
    #[error(transparent)]
    File(#[from] TextFileError),
    #[error("line {line}: this is not YAML: {message}")]
    Yaml { line: usize, message: String },
    #[error("line {line}: found an alias; write the numbers themselves")]
    Alias { line: usize },
    #[error("line {line}: found a second document; the file must contain only one")]
    Documents { line: usize },
    #[error("line {line}: the key {key:?} is already in line {first}; each key may occur once")]
    Twice {
        line: usize,
        first: usize,
        key: String,
    },
    #[error("the file has no `DATA` with a list of blocks, as files of refractiveindex.info have")]
    NoData,
    #[error("line {line}: the block has no `{field}`")]
    Missing { line: usize, field: &'static str },
    #[error(
        "line {line}: found the type {found:?}; it must be \"tabulated nk\", \"tabulated n\", \"tabulated k\" or \
         \"formula 1\" to \"formula 9\""
    )]
    Type { line: usize, found: String },
    #[error("line {line}: found {found} numbers, expected {expected}")]
    Count {
        line: usize,
        found: usize,
        expected: usize,
    },
    #[error("line {line}: found {found} coefficients; at most {MAX_COEFFICIENTS} are possible")]
    Coefficients { line: usize, found: usize },
    #[error("line {line}: {text:?} is not a number")]
    Number { line: usize, text: String },
    #[error("line {line}: {source}")]
    Formula { line: usize, source: FormulaError },
}
