//! The format of the built-in data files.
//!
//! ```text
//! # name: Au-Johnson
//! # citation: who measured it, where it was published
//! # license: the terms of use
//! nm,n,k
//! 300.9,1.53,1.889
//! ```
//!
//! A dispersion formula has its number and range in the header, and its coefficients as a block of one column:
//!
//! ```text
//! # formula: 1
//! # range_nm: 210 to 6700
//! coefficient
//! 0
//! 0.6961663
//! ```
//!
//! A header of `# key: value` lines is followed by blocks of comma-separated numbers. A line that
//! starts with a letter names the columns and begins a block; an empty cell means that the source
//! has no value; empty lines separate blocks.

use std::collections::BTreeMap;

use thiserror::Error;

use crate::{FormulaError, Tabulated, TabulatedError};

/// A parsed data file.
#[derive(Debug)]
pub(super) struct Table {
    head: BTreeMap<&'static str, &'static str>,
    blocks: Vec<Block>,
}

/// One block of columns.
#[derive(Debug)]
struct Block {
    columns: Vec<&'static str>,
    rows: Vec<Vec<Option<f64>>>,
}

/// What is wrong with a data file. Lines are counted from 1.
#[derive(Debug, Error, PartialEq)]
pub(super) enum TableError {
    #[error("line {0}: a line of the header must be `# key: value`")]
    Head(usize),
    #[error("line {0}: numbers before the names of the columns")]
    NoColumns(usize),
    #[error("line {line}: {found} cells, but {expected} columns")]
    Cells {
        line: usize,
        found: usize,
        expected: usize,
    },
    #[error("line {line}: {cell:?} is not a number")]
    NotANumber { line: usize, cell: &'static str },
    #[error("the header has no {0:?}")]
    MissingKey(&'static str),
    #[error("no block has the columns {0:?}")]
    MissingColumns(Vec<&'static str>),
    #[error("the header has an invalid {key:?}: {value:?}")]
    Value {
        key: &'static str,
        value: &'static str,
    },
    #[error(transparent)]
    Formula(#[from] FormulaError),
    #[error("column {column:?}: {source}")]
    Points {
        column: &'static str,
        source: TabulatedError,
    },
}

impl Table {
    /// Parses the text of a data file.
    pub(super) fn parse(text: &'static str) -> Result<Self, TableError> {
        let mut head = BTreeMap::new();
        let mut blocks: Vec<Block> = Vec::new();
        for (line, content) in (1..).zip(text.lines()) {
            if let Some(comment) = content.strip_prefix('#') {
                let (key, value) = comment.split_once(':').ok_or(TableError::Head(line))?;
                head.insert(key.trim(), value.trim());
            } else if content.starts_with(|c: char| c.is_ascii_alphabetic()) {
                let columns = content.split(',').map(str::trim).collect();
                blocks.push(Block {
                    columns,
                    rows: Vec::new(),
                });
            } else if !content.trim().is_empty() {
                let block = blocks.last_mut().ok_or(TableError::NoColumns(line))?;
                block.rows.push(cells(line, content, block.columns.len())?);
            }
        }
        Ok(Self { head, blocks })
    }

    /// Returns a value of the header.
    pub(super) fn head(&self, key: &'static str) -> Result<&'static str, TableError> {
        self.head
            .get(key)
            .copied()
            .ok_or(TableError::MissingKey(key))
    }

    /// Returns the name of the set, its source and its license as one text.
    pub(super) fn citation(&self) -> Result<String, TableError> {
        Ok(format!(
            "{}: {}. License: {}.",
            self.head("name")?,
            self.head("citation")?,
            self.head("license")?
        ))
    }

    /// The names of the first block's columns after the first one, `nm`.
    pub(super) fn series_names(&self) -> Vec<&'static str> {
        self.blocks
            .first()
            .map_or_else(Vec::new, |block| block.columns[1..].to_vec())
    }

    /// Returns the numbers of a block that consists of this column only, or nothing if there is no such block.
    pub(super) fn column(&self, name: &str) -> Vec<f64> {
        let own = self.blocks.iter().find(|block| block.columns == [name]);
        let rows = own.into_iter().flat_map(|block| &block.rows);
        rows.filter_map(|row| row[0]).collect()
    }

    /// Returns the rows with a value in both `x` and `y`, from the first block with these columns.
    pub(super) fn pairs(
        &self,
        x: &'static str,
        y: &'static str,
    ) -> Result<Vec<(f64, f64)>, TableError> {
        for block in &self.blocks {
            let place = |name| block.columns.iter().position(|&column| column == name);
            if let (Some(x), Some(y)) = (place(x), place(y)) {
                return Ok(block
                    .rows
                    .iter()
                    .filter_map(|row| Some((row[x]?, row[y]?)))
                    .collect());
            }
        }
        Err(TableError::MissingColumns(vec![x, y]))
    }

    /// Returns the column `column` over wavelength.
    pub(super) fn series(&self, column: &'static str) -> Result<Tabulated, TableError> {
        Tabulated::new(self.pairs("nm", column)?)
            .map_err(|source| TableError::Points { column, source })
    }
}

/// Parses the numbers of one row.
fn cells(
    line: usize,
    content: &'static str,
    expected: usize,
) -> Result<Vec<Option<f64>>, TableError> {
    let row = content
        .split(',')
        .map(|cell| match cell.trim() {
            "" => Ok(None),
            cell => cell
                .parse()
                .map(Some)
                .map_err(|_| TableError::NotANumber { line, cell }),
        })
        .collect::<Result<Vec<_>, _>>()?;
    if row.len() == expected {
        Ok(row)
    } else {
        Err(TableError::Cells {
            line,
            found: row.len(),
            expected,
        })
    }
}

/// Loads a built-in file with `load`.
///
/// # Panics
/// When the file is invalid, which no user can cause and the test that loads every set rules out.
pub(super) fn embedded<T>(
    file: &str,
    text: &'static str,
    load: impl Fn(&Table) -> Result<T, TableError>,
) -> T {
    Table::parse(text)
        .and_then(|table| load(&table))
        .unwrap_or_else(|error| panic!("the built-in data file {file}: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn head_blocks_and_gaps_are_read() {
        let table =
            Table::parse("# name: a set\n# citation: x: y\n# license: z\nb,c\n1,2\n\nnm,p,q\n400,1,\n410,2,5e-1\n")
                .unwrap();
        assert_eq!(table.citation().unwrap(), "a set: x: y. License: z.");
        assert_eq!(table.series_names(), ["c"]);
        assert!(table.column("c").is_empty() && table.column("r").is_empty());
        let formula = Table::parse("coefficient\n1\n2e-3\n\nnm,k\n400,0\n").unwrap();
        assert_eq!(formula.column("coefficient"), [1.0, 2e-3]);
        assert_eq!(table.pairs("b", "c").unwrap(), [(1.0, 2.0)]);
        assert_eq!(table.series("p").unwrap().range_nm(), (400.0, 410.0));
        assert_eq!(table.series("q").unwrap().range_nm(), (410.0, 410.0));
        assert_eq!(table.head("notes"), Err(TableError::MissingKey("notes")));
        assert!(table.series("r").is_err());
    }

    #[test]
    fn faults_name_their_line() {
        let fault = |text| Table::parse(text).unwrap_err();
        assert_eq!(fault("# no colon\n"), TableError::Head(1));
        assert_eq!(fault("400,1\n"), TableError::NoColumns(1));
        assert_eq!(
            fault("nm,n\n400,x\n"),
            TableError::NotANumber { line: 2, cell: "x" }
        );
        assert!(matches!(
            fault("nm,n\n400\n"),
            TableError::Cells {
                line: 2,
                found: 1,
                expected: 2
            }
        ));
    }

    #[test]
    fn falling_wavelengths_are_refused() {
        let table = Table::parse("nm,n\n410,1\n400,1\n").unwrap();
        assert!(matches!(table.series("n"), Err(TableError::Points { .. })));
    }
}
