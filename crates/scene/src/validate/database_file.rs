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
//! ```
//!
//! Wavelengths are in µm. What else a file says (references, conditions, properties) is passed over.

use crate::limits::TABLE_NM;
use saphyr_parser::{Event, Parser, ScalarStyle, ScanError, Span};
use spectra::table_file::Row;
use spectra::text_file::{TextFileError, read_text};
use spectra::{DispersionFormula, FormulaError, FormulaKind};
use std::path::Path;
use thiserror::Error;

/// One of the `DATA` of a file, with the line that it begins in.
pub(crate) struct Block {
    pub(crate) line: usize,
    pub(crate) data: Data,
}

/// What a block gives.
pub(crate) enum Data {
    N(Vec<Row<1>>),
    K(Vec<Row<1>>),
    Nk(Vec<Row<2>>),
    Formula(DispersionFormula),
}

/// Why a file is not one of the database. Lines are counted from 1.
#[derive(Debug, Error)]
pub(crate) enum DatabaseFileError {
    #[error(transparent)]
    File(#[from] TextFileError),
    #[error("line {line}: this is not YAML: {message}")]
    Yaml { line: usize, message: String },
    #[error("line {line}: an alias; the figures must be written where they belong")]
    Alias { line: usize },
    #[error("the file has no `DATA` with a list of blocks, as files of refractiveindex.info have")]
    NoData,
    #[error("line {line}: the block has no `{field}`")]
    Missing { line: usize, field: &'static str },
    #[error(
        "line {line}: found the type {found:?}; it must be \"tabulated nk\", \"tabulated n\", \"tabulated k\" or \
         \"formula 1\" to \"formula 6\""
    )]
    Type { line: usize, found: String },
    #[error("line {line}: found {found} numbers, expected {expected}")]
    Count {
        line: usize,
        found: usize,
        expected: usize,
    },
    #[error("line {line}: {text:?} is not a number")]
    Number { line: usize, text: String },
    #[error("line {line}: {source}")]
    Formula { line: usize, source: FormulaError },
}

/// The blocks of a file.
pub(crate) fn read(path: &Path) -> Result<Vec<Block>, DatabaseFileError> {
    let text = read_text(path)?;
    let written = written(text.strip_prefix('\u{feff}').unwrap_or(&text))?;
    if written.is_empty() {
        return Err(DatabaseFileError::NoData);
    }
    written.iter().map(block).collect()
}

/// A block as it is written.
struct Written {
    line: usize,
    fields: Vec<(String, Text)>,
}

/// A value and the place of its first line.
struct Text {
    content: String,
    line: usize,
    /// Whether a line of the value is a line of the file.
    is_literal: bool,
}

/// A collection that is being read.
enum Open {
    List,
    /// A mapping, with the key whose value comes next.
    Mapping(Option<String>),
}

/// The mappings in the list under the key `DATA` of the file's mapping.
fn written(text: &str) -> Result<Vec<Written>, DatabaseFileError> {
    let mut parser = Parser::new_from_str(text);
    let mut open: Vec<Open> = Vec::new();
    let mut blocks: Vec<Written> = Vec::new();
    while let Some(event) = parser.next_event() {
        let (event, span) = event.map_err(|error| not_yaml(&error))?;
        match event {
            Event::Alias(_) => {
                return Err(DatabaseFileError::Alias {
                    line: span.start.line(),
                });
            }
            Event::Scalar(text, style, ..) => {
                scalar(&mut open, &mut blocks, text.into_owned(), style, span);
            }
            Event::SequenceStart(..) => open.push(Open::List),
            Event::MappingStart(..) => {
                if is_list_of_data(&open) {
                    let line = span.start.line();
                    let fields = Vec::new();
                    blocks.push(Written { line, fields });
                }
                open.push(Open::Mapping(None));
            }
            Event::SequenceEnd | Event::MappingEnd => {
                open.pop();
                value_is_over(&mut open);
            }
            Event::Nothing
            | Event::StreamStart
            | Event::StreamEnd
            | Event::DocumentStart(_)
            | Event::DocumentEnd => {}
        }
    }
    Ok(blocks)
}

fn not_yaml(error: &ScanError) -> DatabaseFileError {
    DatabaseFileError::Yaml {
        line: error.marker().line(),
        message: error.info().to_owned(),
    }
}

fn is_list_of_data(open: &[Open]) -> bool {
    matches!(open, [Open::Mapping(Some(key)), Open::List] if key == "DATA")
}

/// A key, or a value, which is kept if it is one of a block's.
fn scalar(open: &mut [Open], blocks: &mut [Written], text: String, style: ScalarStyle, span: Span) {
    if let Some(Open::Mapping(key @ None)) = open.last_mut() {
        *key = Some(text);
        return;
    }
    if let [around @ .., Open::Mapping(Some(key))] = &*open
        && is_list_of_data(around)
        && let Some(block) = blocks.last_mut()
    {
        let is_literal = style == ScalarStyle::Literal;
        // The place of a literal is that of its first line that is not empty.
        let empty = text.lines().take_while(|line| line.is_empty()).count();
        let value = Text {
            line: span
                .start
                .line()
                .saturating_sub(if is_literal { empty } else { 0 }),
            content: text,
            is_literal,
        };
        block.fields.push((key.clone(), value));
    }
    value_is_over(open);
}

/// After a value its mapping expects a key again. A collection may itself be a key; its mapping then expects a value.
fn value_is_over(open: &mut [Open]) {
    if let Some(Open::Mapping(key)) = open.last_mut() {
        *key = match key {
            Some(_) => None,
            None => Some(String::new()),
        };
    }
}

impl Written {
    fn field(&self, field: &'static str) -> Result<&Text, DatabaseFileError> {
        let named = self.fields.iter().find(|(name, _)| name == field);
        let missing = DatabaseFileError::Missing {
            line: self.line,
            field,
        };
        named.map(|(_, value)| value).ok_or(missing)
    }
}

fn block(written: &Written) -> Result<Block, DatabaseFileError> {
    let kind = written.field("type")?;
    let words: Vec<&str> = kind.content.split_whitespace().collect();
    let data = match words[..] {
        ["tabulated", "n"] => Data::N(rows(written.field("data")?)?),
        ["tabulated", "k"] => Data::K(rows(written.field("data")?)?),
        ["tabulated", "nk"] => Data::Nk(rows(written.field("data")?)?),
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
    // Older files say `range`.
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
    DispersionFormula::new(kind, figures, (low_um * 1e3, high_um * 1e3))
        .map_err(|source| DatabaseFileError::Formula { line, source })
}

/// The rows of a table, by wavelength: the database has tables that step back for a row.
///
/// Wavelengths beyond those of any scene are left out, and so is a row at the wavelength of the one before: the database has
/// tables from X-rays to radio waves, and some that say a thing twice.
fn rows<const N: usize>(data: &Text) -> Result<Vec<Row<N>>, DatabaseFileError> {
    let mut rows: Vec<Row<N>> = Vec::new();
    for (index, content) in data.content.lines().enumerate() {
        let line = if data.is_literal {
            data.line + index
        } else {
            data.line
        };
        let numbers = numbers(content, line)?;
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
        let row = Row {
            line,
            nm: numbers[0] * 1e3,
            values: std::array::from_fn(|column| numbers[1 + column]),
        };
        let repeats = rows.last().is_some_and(|before| before.nm == row.nm);
        let is_elsewhere = row.nm > 0.0 && row.nm.is_finite() && !TABLE_NM.contains(row.nm);
        if !repeats && !is_elsewhere {
            rows.push(row);
        }
    }
    // Rows of the same wavelength stay in the order of the file, and the later one is told of.
    rows.sort_by(|a, b| a.nm.total_cmp(&b.nm));
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
