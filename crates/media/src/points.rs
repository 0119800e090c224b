//! Tables over wavelength, in the document or in a separate file.

use crate::description::{Extrapolate, IndexColumns, TableColumn};
use crate::extrapolated;
use crate::limits::{MAX_TABLE_POINTS, TABLE_NM};
use document::{Checks, FieldPath, Problem, ProblemKind, Range};
use spectra::table_file::{self, ColumnChoice, Options, Quantity, QuantityKind};
use spectra::{Spectrum, Tabulated};
use std::path::Path;

/// One of the quantities that a table contains.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// Its name, for messages.
    noun: &'static str,
    /// Its field in a table within the document.
    field: &'static str,
    range: &'static Range,
    /// How files represent it.
    kind: QuantityKind,
}

impl Column {
    /// `noun` and `field` are its name in messages and its field in an inline table; values must be in `range`.
    pub const fn new(
        noun: &'static str,
        field: &'static str,
        range: &'static Range,
        kind: QuantityKind,
    ) -> Self {
        Self {
            noun,
            field,
            range,
            kind,
        }
    }

    fn quantity(&self) -> Quantity {
        Quantity {
            noun: self.noun,
            range: (self.range.low, self.range.high),
            kind: self.kind,
        }
    }
}

/// A table in a file, with the options from the document.
#[derive(Clone, Debug)]
pub struct FileTable<'a> {
    /// Its path.
    pub path: &'a Path,
    /// Empty if none is chosen.
    pub columns: Vec<ColumnChoice>,
    /// The units that its header does not name.
    pub unit: Option<&'a str>,
    /// How it extends outside its wavelengths.
    pub extrapolate: Extrapolate,
}

/// The chosen column, if any.
pub fn chosen(column: Option<&TableColumn>) -> Vec<ColumnChoice> {
    column.map(choice).into_iter().collect()
}

/// The chosen columns of n and k, if any.
pub fn chosen_of_index(columns: Option<&IndexColumns>) -> Vec<ColumnChoice> {
    match columns {
        None => Vec::new(),
        Some(IndexColumns::N(column)) => vec![choice(column)],
        Some(IndexColumns::Both(columns)) => columns.iter().map(choice).collect(),
    }
}

fn choice(column: &TableColumn) -> ColumnChoice {
    match column {
        TableColumn::Number(number) => ColumnChoice::Number(*number as usize),
        TableColumn::Name(name) => ColumnChoice::Name(name.clone()),
    }
}

/// The maximum number of problems reported for one table; the rest are likely to be the same mistake.
const MAX_PROBLEMS: usize = 3;

/// The spectra of a table in the document.
pub fn inline<const N: usize>(
    checks: &mut Checks,
    field: &FieldPath,
    nm: &[f64],
    columns: [(Column, &[f64]); N],
    extrapolate: Extrapolate,
) -> Option<[Spectrum; N]> {
    let nm_field = field.key("nm");
    let mut is_sound = check_count(checks, &nm_field, nm.len(), "");
    for (column, values) in columns {
        let own = field.key(column.field);
        if values.len() != nm.len() {
            let message = format!(
                "found {} values for {} wavelengths; each wavelength needs one",
                values.len(),
                nm.len()
            );
            let problem = Problem::new(ProblemKind::Inconsistent, &own, message);
            checks.report(problem.involving(nm_field.clone()));
            is_sound = false;
        }
        let faults = values
            .iter()
            .enumerate()
            .filter(|&(_, &v)| !column.range.contains(v));
        for (index, &value) in faults.take(MAX_PROBLEMS) {
            checks.number(&own.index(index), value, column.range);
            is_sound = false;
        }
    }
    for (index, complaint) in faults_of_wavelengths(nm).take(MAX_PROBLEMS) {
        let at = nm_field.index(index);
        let problem = Problem::new(ProblemKind::OutOfRange, &at, complaint);
        checks.report(problem.involving(nm_field.clone()));
        is_sound = false;
    }
    if !is_sound {
        return None;
    }
    let spectra = columns.map(|(_, values)| {
        let points = nm.iter().copied().zip(values.iter().copied());
        spectrum(checks, field, points.collect(), extrapolate)
    });
    all(spectra)
}

/// The spectra of a table in a file.
pub fn file<const N: usize>(
    checks: &mut Checks,
    field: &FieldPath,
    table: FileTable,
    columns: [Column; N],
) -> Option<[Spectrum; N]> {
    let extrapolate = table.extrapolate;
    let mut options = Options {
        columns: table.columns,
        ..Options::default()
    };
    if let Some(unit) = table.unit {
        set_unit(checks, &field.key("unit"), unit, (&mut options, &columns))?;
    }
    let own = field.key("csv");
    let path = table.path.display();
    match table_file::read(
        table.path,
        columns.map(|column| column.quantity()),
        &options,
    ) {
        Ok(found) => {
            if let Some(note) = found.note {
                checks.note(&own, format_args!("{path}: {note}"));
            }
            let spectrum = |table| extrapolated(Spectrum::Table(table), extrapolate);
            Some(found.columns.map(spectrum))
        }
        Err(complaint) => {
            let message = format!("{path}: {complaint}");
            checks.report(Problem::new(ProblemKind::File, &own, message));
            None
        }
    }
}

/// Applies the units that the document specifies.
fn set_unit(
    checks: &mut Checks,
    field: &FieldPath,
    unit: &str,
    (options, columns): (&mut Options, &[Column]),
) -> Option<()> {
    let can_be_percent = columns
        .iter()
        .any(|column| column.kind == QuantityKind::Part);
    let complaint = match options.set_unit(unit) {
        Err(complaint) => complaint,
        Ok(()) if options.is_percent && !can_be_percent => {
            "found \"percent\", but only reflectances can be in percent".to_owned()
        }
        Ok(()) => return Some(()),
    };
    checks.report(Problem::new(ProblemKind::UnknownName, field, complaint));
    None
}

/// Checks the number of points; `prefix` names the table if it is not in the document.
fn check_count(checks: &mut Checks, field: &FieldPath, count: usize, prefix: &str) -> bool {
    let complaint = match count {
        0 => format!("{prefix}the table has no points; it needs at least one"),
        _ if count > MAX_TABLE_POINTS => {
            format!("{prefix}the table has {count} points; at most {MAX_TABLE_POINTS} are possible")
        }
        _ => return true,
    };
    checks.report(Problem::new(ProblemKind::TooLarge, field, complaint));
    false
}

/// Wavelengths that are out of range or not above their predecessor, by position.
fn faults_of_wavelengths(nm: &[f64]) -> impl Iterator<Item = (usize, String)> {
    nm.iter().enumerate().filter_map(|(index, &value)| {
        let before = index.checked_sub(1).map(|before| nm[before]);
        if !TABLE_NM.contains(value) {
            Some((index, format!("found {value}; it must be from {TABLE_NM}")))
        } else if let Some(before) = before.filter(|&before| value <= before) {
            let complaint =
                format!("found {value} nm after {before} nm; wavelengths must increase");
            Some((index, complaint))
        } else {
            None
        }
    })
}

fn spectrum(
    checks: &mut Checks,
    field: &FieldPath,
    points: Vec<(f64, f64)>,
    extrapolate: Extrapolate,
) -> Option<Spectrum> {
    match Tabulated::new(points) {
        Ok(table) if extrapolate == Extrapolate::Clamp => Some(Spectrum::ClampedTable(table)),
        Ok(table) => Some(Spectrum::Table(table)),
        Err(error) => {
            let message = error.to_string();
            checks.report(Problem::new(ProblemKind::Inconsistent, field, message));
            None
        }
    }
}

fn all<const N: usize>(spectra: [Option<Spectrum>; N]) -> Option<[Spectrum; N]> {
    let list: Option<Vec<_>> = spectra.into_iter().collect();
    list?.try_into().ok()
}
