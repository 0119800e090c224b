//! Tables in files of users, as instruments and programs write them.
//!
//! What a file is, is seen from its content:
//!
//! * rows of numbers, separated by commas, semicolons, tabs or blanks, below heads of any kind; between
//!   `>>>>>Begin …` and `>>>>>End …`, or below `[Data]`, where a spectrometer writes such lines;
//! * two tables, `wl,n` and `wl,k` in µm, one below the other, as refractiveindex.info writes them;
//! * CGATS.17 with spectra of samples;
//! * IES TM-27 (`.spdx`).
//!
//! What is assumed of a file is said in one line: [`Table::note`]. What can be read in two ways is refused.

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
use crate::text_file::read_text;

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

/// What a column of values holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Its name in messages.
    pub noun: &'static str,
    /// Smallest and largest value possible.
    pub range: (f64, f64),
    /// What files do with it.
    pub kind: QuantityKind,
}

/// What files do with a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum QuantityKind {
    /// A part of a whole: it may stand in percent, and noise of an instrument may take it below zero.
    Part,
    /// An amount in any unit; noise may take it below zero.
    Amount,
    /// A number that stands as it is.
    Plain,
}

impl Quantity {
    /// The part of the light that comes back, 0 to 1.
    pub const REFLECTANCE: Self = Self::part("reflectance", (0.0, 1.0));
    /// A power of light, in any unit.
    pub const POWER: Self = Self::amount("power", (0.0, 1e9));

    /// A part of a whole.
    pub const fn part(noun: &'static str, range: (f64, f64)) -> Self {
        Self {
            noun,
            range,
            kind: QuantityKind::Part,
        }
    }

    /// An amount in any unit.
    pub const fn amount(noun: &'static str, range: (f64, f64)) -> Self {
        Self {
            noun,
            range,
            kind: QuantityKind::Amount,
        }
    }

    /// A number that stands as it is.
    pub const fn plain(noun: &'static str, range: (f64, f64)) -> Self {
        Self {
            noun,
            range,
            kind: QuantityKind::Plain,
        }
    }
}

/// Tables over wavelength from a file, and what was assumed of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Table<const N: usize> {
    /// A table for each quantity.
    pub columns: [Tabulated; N],
    /// What was assumed, in one line; `None` of a plain file.
    pub note: Option<String>,
}

/// The most rows of a table.
pub const MAX_ROWS: usize = 100_000;
/// The most columns of a table.
const MAX_COLUMNS: usize = 10_000;

/// A place and a value of a column, as they stand.
#[derive(Clone, Debug)]
struct Point<'a> {
    line: usize,
    place: f64,
    place_text: Cow<'a, str>,
    value: f64,
    text: Cow<'a, str>,
}

/// A column of values that was chosen.
#[derive(Clone, Debug, Default)]
struct Series<'a> {
    points: Vec<Point<'a>>,
    /// The unit of wavelength that the file names, and how it does.
    unit: Option<(Unit, &'static str)>,
    /// What the values are divided by as the file says: 100 in percent.
    scale: Option<f64>,
}

/// What is said of a file.
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

/// The tables of a file: [`parse`] of its text.
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

/// The tables over wavelength in a text, one for each quantity and each value in its range. Of n and k the second is 0
/// throughout where the text has one column of values.
///
/// # Errors
/// When the text is of no such tables or can be read in two ways; the first fault is told with its line.
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

/// The rows of a text that is a table over something else than wavelength, as they stand.
///
/// # Errors
/// When a row is not of numbers, or not of as many as it needs.
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
    /// The k of a medium that does not absorb.
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
