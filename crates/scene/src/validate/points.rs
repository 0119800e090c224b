//! Tables over wavelength, written in the scene or in a file of their own.

use super::checks::Checks;
use crate::FieldPath;
use crate::description::Extrapolate;
use crate::limits::{MAX_TABLE_POINTS, Range, TABLE_NM};
use crate::problem::{Problem, ProblemKind};
use spectra::table_file::{self, Row};
use spectra::{Spectrum, Tabulated};
use std::path::Path;

/// One of the quantities that a table gives over wavelength.
#[derive(Clone, Copy)]
pub(crate) struct Column {
    /// What it is, for messages.
    noun: &'static str,
    /// Its field in a table within the scene.
    field: &'static str,
    range: &'static Range,
}

impl Column {
    pub(crate) const fn new(
        noun: &'static str,
        field: &'static str,
        range: &'static Range,
    ) -> Self {
        Self { noun, field, range }
    }
}

/// Problems of one table that are told; the rest are likely to be the same mistake again.
const MOST_PROBLEMS: usize = 3;

/// The spectra of a table in the scene.
pub(crate) fn inline<const N: usize>(
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
        for (index, &value) in faults.take(MOST_PROBLEMS) {
            checks.number(&own.index(index), value, column.range);
            is_sound = false;
        }
    }
    for (index, complaint) in faults_of_wavelengths(nm).take(MOST_PROBLEMS) {
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
pub(crate) fn file<const N: usize>(
    checks: &mut Checks,
    field: &FieldPath,
    path: &Path,
    columns: [Column; N],
    extrapolate: Extrapolate,
) -> Option<[Spectrum; N]> {
    let own = field.key("csv");
    match table_file::rows::<N>(path) {
        Ok(found) => rows(checks, &own, path, &found, columns, extrapolate),
        Err(complaint) => {
            let message = format!("{}: {complaint}", path.display());
            checks.report(Problem::new(ProblemKind::File, &own, message));
            None
        }
    }
}

/// The spectra of rows that were read from a file.
pub(crate) fn rows<const N: usize>(
    checks: &mut Checks,
    field: &FieldPath,
    path: &Path,
    rows: &[Row<N>],
    columns: [Column; N],
    extrapolate: Extrapolate,
) -> Option<[Spectrum; N]> {
    let mut is_sound = check_count(checks, field, rows.len(), &format!("{}: ", path.display()));
    for (line, complaint) in faults_of_rows(rows, &columns)
        .into_iter()
        .take(MOST_PROBLEMS)
    {
        let message = format!("{}: line {line}: {complaint}", path.display());
        checks.report(Problem::new(ProblemKind::OutOfRange, field, message));
        is_sound = false;
    }
    if !is_sound {
        return None;
    }
    let spectra = std::array::from_fn(|column| {
        let points = rows.iter().map(|row| (row.nm, row.values[column]));
        spectrum(checks, field, points.collect(), extrapolate)
    });
    all(spectra)
}

/// `prefix` names the table where it is not the scene's own.
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

/// Wavelengths out of range or not above the one before, by position.
fn faults_of_wavelengths(nm: &[f64]) -> impl Iterator<Item = (usize, String)> {
    nm.iter().enumerate().filter_map(|(index, &value)| {
        let before = index.checked_sub(1).map(|before| nm[before]);
        if !TABLE_NM.contains(value) {
            Some((index, format!("found {value}; it must be from {TABLE_NM}")))
        } else if let Some(before) = before.filter(|&before| value <= before) {
            let complaint = format!("found {value} nm after {before} nm; wavelengths must rise");
            Some((index, complaint))
        } else {
            None
        }
    })
}

/// Everything out of range in the rows of a file, by line.
fn faults_of_rows<const N: usize>(rows: &[Row<N>], columns: &[Column; N]) -> Vec<(usize, String)> {
    let nm: Vec<f64> = rows.iter().map(|row| row.nm).collect();
    let mut faults: Vec<_> = faults_of_wavelengths(&nm)
        .take(MOST_PROBLEMS)
        .map(|(index, complaint)| (rows[index].line, complaint))
        .collect();
    for (position, column) in columns.iter().enumerate() {
        let values = rows.iter().map(|row| (row.line, row.values[position]));
        let wrong = values.filter(|&(_, value)| !column.range.contains(value));
        faults.extend(wrong.take(MOST_PROBLEMS).map(|(line, value)| {
            let complaint = format!(
                "found {} {value}; it must be from {}",
                column.noun, column.range
            );
            (line, complaint)
        }));
    }
    faults.sort_by_key(|&(line, _)| line);
    faults
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
