//! Tables of the refractiveindex.info database: from rows to spectra that keep the faults of the rows.

use crate::limits::TABLE_NM;
use document::Range;
use spectra::table_file::Row;
use spectra::{Fault, Spectrum, Tabulated};
use std::sync::Arc;

/// A quantity over wavelength.
pub(super) struct Quantity {
    pub(super) name: &'static str,
    pub(super) range: &'static Range,
    /// How far below the range a value still counts as its lower end.
    pub(super) noise: f64,
}

/// The rows of a table sorted by wavelength; rows of equal wavelength are in the order of the file.
pub(super) struct Table<const N: usize> {
    rows: Vec<Row<N>>,
    repeats: Repeats,
    beyond: usize,
}

/// Rows that repeat another: their number, and the line numbers of the first and of the row that it repeats.
#[derive(Default)]
struct Repeats {
    count: usize,
    first: Option<(usize, usize)>,
}

/// The value of a table at a wavelength.
enum Entry {
    Sound(f64),
    Faulty(String),
}

impl<const N: usize> Table<N> {
    /// Creates the table without rows outside the range of tables, and without exact repeats.
    ///
    /// # Errors
    /// When a wavelength is not a positive finite number.
    pub(super) fn new(rows: &[Row<N>]) -> Result<Self, String> {
        if let Some(row) = rows
            .iter()
            .find(|row| !(row.nm > 0.0 && row.nm.is_finite()))
        {
            let (line, nm) = (row.line, row.nm);
            return Err(format!("line {line}: found {nm} nm; it must be above 0"));
        }
        let within = rows.iter().filter(|row| TABLE_NM.contains(row.nm));
        let mut sorted: Vec<&Row<N>> = within.collect();
        // A stable sort: the database has tables with a row that steps back.
        sorted.sort_by(|a, b| a.nm.total_cmp(&b.nm));
        let beyond = rows.len() - sorted.len();
        let mut repeats = Repeats::default();
        let mut kept: Vec<Row<N>> = Vec::with_capacity(sorted.len());
        for row in sorted {
            let of_one_nm = kept.iter().rev().take_while(|other| other.nm == row.nm);
            // Only the last few rows of one wavelength are compared: at worst, others are reported as a contradiction.
            let same = of_one_nm.take(4).find(|other| is_repeat(other, row));
            match same {
                Some(other) => repeats.add(row.line, other.line),
                None => kept.push(Row {
                    line: row.line,
                    nm: row.nm,
                    values: row.values,
                }),
            }
        }
        if kept.is_empty() {
            return Err("the table has no points; it needs at least one".to_owned());
        }
        Ok(Self {
            rows: kept,
            repeats,
            beyond,
        })
    }

    /// Notes on rows that were left out.
    pub(super) fn notes(&self) -> impl Iterator<Item = String> {
        let repeats = self.repeats.first.map(|(line, other)| {
            let more = match self.repeats.count {
                1 => String::new(),
                count => format!(", and {} more such rows", count - 1),
            };
            format!("line {line} repeats line {other}{more}; each counts once")
        });
        let beyond = (self.beyond > 0).then(|| {
            let count = self.beyond;
            format!("{count} of the rows are left out: they are outside {TABLE_NM}")
        });
        repeats.into_iter().chain(beyond)
    }

    /// A column as a spectrum with its faults, and a note on what was assumed.
    ///
    /// # Errors
    /// When the column has no valid value; the error is its first fault.
    pub(super) fn spectrum(
        &self,
        column: usize,
        quantity: &Quantity,
    ) -> Result<(Spectrum, Option<String>), String> {
        let mut noisy: Vec<&Row<N>> = Vec::new();
        let mut points: Vec<(f64, f64)> = Vec::new();
        let mut faults: Vec<Fault> = Vec::new();
        // The reason of a fault that begins after the last valid value.
        let mut pending: Option<Arc<str>> = None;
        for same in self.rows.chunk_by(|a, b| a.nm == b.nm) {
            let (first, nm) = (&same[0], same[0].nm);
            match entry(same, column, quantity) {
                Entry::Faulty(reason) => {
                    pending.get_or_insert(reason.into());
                }
                Entry::Sound(value) => {
                    faults.extend(pending.take().map(|reason| Fault {
                        from_nm: points.last().map_or(0.0, |&(nm, _)| nm),
                        to_nm: nm,
                        reason,
                    }));
                    if first.values[column] < quantity.range.low {
                        noisy.push(first);
                    }
                    points.push((nm, value));
                }
            }
        }
        if let Some(reason) = pending {
            let Some(&(from_nm, _)) = points.last() else {
                return Err(reason.to_string());
            };
            let to_nm = f64::INFINITY;
            faults.push(Fault {
                from_nm,
                to_nm,
                reason,
            });
        }
        let table = Tabulated::new(points).map_err(|error| error.to_string())?;
        let note = noise(&noisy, column, quantity);
        Ok((Spectrum::Table(table.with_faults(faults)), note))
    }
}

impl Repeats {
    fn add(&mut self, line: usize, other: usize) {
        self.count += 1;
        self.first.get_or_insert((line, other));
    }
}

fn is_repeat<const N: usize>(a: &Row<N>, b: &Row<N>) -> bool {
    a.values == b.values
}

/// The value of a column in the rows of one wavelength.
fn entry<const N: usize>(same: &[Row<N>], column: usize, quantity: &Quantity) -> Entry {
    let Quantity { name, range, noise } = quantity;
    let (first, nm) = (&same[0], same[0].nm);
    let value = first.values[column];
    if let Some(other) = same.iter().find(|row| row.values[column] != value) {
        let (line, again, found) = (first.line, other.line, other.values[column]);
        if value.is_finite() {
            return Entry::Faulty(format!(
                "lines {line} and {again} both give {name} at {nm} nm, as {value} and as {found}; remove one of them"
            ));
        }
    }
    if range.contains(value) {
        return Entry::Sound(value + 0.0);
    }
    if value < range.low && value >= range.low - noise {
        return Entry::Sound(range.low);
    }
    Entry::Faulty(format!(
        "line {}: found {name} {value} at {nm} nm; it must be from {range}",
        first.line
    ))
}

fn noise<const N: usize>(noisy: &[&Row<N>], column: usize, quantity: &Quantity) -> Option<String> {
    let first = noisy.first()?;
    let more = match noisy.len() {
        1 => String::new(),
        count => format!(
            ", and {} more that are above -{}",
            count - 1,
            quantity.noise
        ),
    };
    Some(format!(
        "line {}: {} {} at {} nm{more}: taken as {}",
        first.line, quantity.name, first.values[column], first.nm, quantity.range.low
    ))
}
