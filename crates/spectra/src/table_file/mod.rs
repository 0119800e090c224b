//! Reads users' tables, as written by instruments and programs.
//!
//! The format is recognized from the content:
//!
//! * rows of numbers, separated by commas, semicolons, tabs or blanks, below headers of any kind; between
//!   `>>>>>Begin …` and `>>>>>End …`, or below `[Data]`, if the file of a spectrometer has such lines;
//! * two tables, `wl,n` and `wl,k` in µm, one below the other, as in files from refractiveindex.info;
//! * CGATS.17 with spectra of samples;
//! * IES TM-27 (`.spdx`).
//!
//! [`Table::note`] reports in one line what was assumed. Ambiguous files are refused.

mod axis;
mod block;
mod cgats;
mod choice;
mod error;
mod finish;
mod head;
mod line;
mod options;
mod tm27;

#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::path::Path;

pub use error::{TableFileError, cell_text};
pub use options::{ColumnChoice, Options, Unit};

use crate::Tabulated;
use document::text_file::read_text;

/// A row of a table: a wavelength and the `N` values there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<const N: usize> {
    /// The line of the file, from 1.
    pub line: usize,
    /// The first column: a wavelength, nm, or the independent variable of another table.
    pub nm: f64,
    /// The other columns.
    pub values: [f64; N],
}

/// What a column of values holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// The name of the quantity in messages.
    pub noun: &'static str,
    /// The smallest and largest possible value.
    pub range: (f64, f64),
    /// How files write it.
    pub kind: QuantityKind,
}

/// How files write a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum QuantityKind {
    /// A fraction: it may be written in percent, and instrument noise may make it slightly negative.
    Part,
    /// An amount in any unit; noise may make it slightly negative.
    Amount,
    /// A number that is used unchanged.
    Plain,
}

impl Quantity {
    /// The fraction of light that is reflected, 0 to 1.
    pub const REFLECTANCE: Self = Self::part("reflectance", (0.0, 1.0));
    /// A radiant power, in any unit.
    pub const POWER: Self = Self::amount("power", (0.0, 1e9));

    /// Creates a quantity that is a fraction.
    pub const fn part(noun: &'static str, range: (f64, f64)) -> Self {
        Self {
            noun,
            range,
            kind: QuantityKind::Part,
        }
    }

    /// Creates a quantity that is an amount in any unit.
    pub const fn amount(noun: &'static str, range: (f64, f64)) -> Self {
        Self {
            noun,
            range,
            kind: QuantityKind::Amount,
        }
    }

    /// Creates a quantity whose numbers are used unchanged.
    pub const fn plain(noun: &'static str, range: (f64, f64)) -> Self {
        Self {
            noun,
            range,
            kind: QuantityKind::Plain,
        }
    }
}

/// The tables over wavelength of a file, and what was assumed.
#[derive(Clone, Debug, PartialEq)]
pub struct Table<const N: usize> {
    /// One table per quantity.
    pub columns: [Tabulated; N],
    /// What was assumed, in one line; `None` for a plain file.
    pub note: Option<String>,
}

/// The largest number of rows of a table.
pub const MAX_ROWS: usize = 100_000;
/// The largest number of columns of a table.
const MAX_COLUMNS: usize = 10_000;

/// A position and a value of a column, as written.
#[derive(Clone, Debug)]
struct Point<'a> {
    line: usize,
    place: f64,
    place_text: Cow<'a, str>,
    value: f64,
    text: Cow<'a, str>,
}

/// A chosen column of values.
#[derive(Clone, Debug, Default)]
struct Series<'a> {
    points: Vec<Point<'a>>,
    /// The unit of wavelength that the file states, and where.
    unit: Option<(Unit, &'static str)>,
    /// The divisor of the values that the file states: 100 for percent.
    scale: Option<f64>,
}

/// What is reported about a file.
#[derive(Debug, Default)]
struct Notes(Vec<String>);

impl Notes {
    fn add(&mut self, note: impl Into<String>) {
        let note = note.into();
        if !self.0.contains(&note) {
            self.0.push(note);
        }
    }

    fn line(self) -> Option<String> {
        (!self.0.is_empty()).then(|| format!("read with {}", self.0.join("; ")))
    }
}

/// Reads the tables of a file and parses its text as [`parse`] does.
///
/// # Errors
/// When the file is not text, or [`parse`] fails.
pub fn read<const N: usize>(
    path: &Path,
    quantities: [Quantity; N],
    options: &Options,
) -> Result<Table<N>, TableFileError> {
    parse(&read_text(path)?, quantities, options)
}

/// Parses the tables over wavelength in a text, one per quantity, with every value in its range. For n and k, the second is 0
/// throughout if the text has one column of values.
///
/// # Errors
/// When the text does not contain such tables or is ambiguous; the first fault is reported with its line.
pub fn parse<const N: usize>(
    text: &str,
    quantities: [Quantity; N],
    options: &Options,
) -> Result<Table<N>, TableFileError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut notes = Notes::default();
    let mut series = if tm27::is_tm27(text) {
        vec![tm27::series(text, &mut notes)?]
    } else if cgats::is_cgats(text) {
        vec![cgats::series(text, options, &mut notes)?]
    } else {
        let is_index = N == 2;
        choice::series(text, N, is_index, options, &mut notes)?
    };
    if series.len() == 1 && N == 2 {
        series.push(Series::zeros_beside(&series[0]));
    }
    if series.len() != N {
        return Err(TableFileError::OneQuantity);
    }
    let mut columns = Vec::with_capacity(N);
    for (series, quantity) in series.into_iter().zip(quantities) {
        columns.push(finish::table(&series, quantity, options, &mut notes)?);
    }
    let columns = columns.try_into().map_err(|_| TableFileError::Empty)?;
    Ok(Table {
        columns,
        note: notes.line(),
    })
}

/// Parses the rows of a table over something other than wavelength, with values unchanged.
///
/// # Errors
/// When a row does not consist of numbers, or has the wrong number of them.
pub fn parse_rows<const N: usize>(text: &str) -> Result<Vec<Row<N>>, TableFileError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut notes = Notes::default();
    let series = choice::series(text, N, false, &Options::default(), &mut notes)?;
    let Some(first) = series.first() else {
        return Ok(Vec::new());
    };
    let row = |(index, point): (usize, &Point)| {
        let mut values = [0.0; N];
        for (value, series) in values.iter_mut().zip(&series) {
            *value = series.points.get(index).map_or(0.0, |point| point.value);
        }
        Row {
            line: point.line,
            nm: point.place,
            values,
        }
    };
    Ok(first.points.iter().enumerate().map(row).collect())
}

impl<'a> Series<'a> {
    /// The k of a medium that does not absorb, at the wavelengths of its n.
    fn zeros_beside(other: &Series<'a>) -> Self {
        let zero = |point: &Point<'a>| Point {
            value: 0.0,
            text: Cow::Borrowed("0"),
            ..point.clone()
        };
        Self {
            points: other.points.iter().map(zero).collect(),
            unit: other.unit,
            scale: None,
        }
    }
}
