//! n and k from files of the refractiveindex.info database.
//!
//! The database covers X-rays to radio waves, and its faults are mostly far from the wavelengths of a scene. An unusable value is therefore
//! not an error of the whole file: the interval around it, from the previous valid value to the next, becomes a [`spectra::Fault`], and
//! only a scene that needs these wavelengths is rejected, with the line.

mod error;
mod file;
mod table;
mod yaml;

use self::file::{Block, Data, DatabaseFile, OfAir};
use self::table::{Quantity, Table};
use crate::formula;
use crate::limits::{self, INDEX_N, MAX_TABLE_POINTS};
use document::{Checks, FieldPath, Problem, ProblemKind};
use spectra::table_file::Row;
use spectra::{DispersionFormula, Spectrum};
use std::path::Path;

const N: Quantity = Quantity {
    name: "n",
    range: &limits::INDEX_N,
    noise: 0.0,
};
const K: Quantity = Quantity {
    name: "k",
    range: &limits::INDEX_K,
    noise: NOISE,
};
/// How far below 0 a k may be to still count as a transparent medium's 0 with noise.
const NOISE: f64 = 1e-6;

/// A file that is being converted to spectra.
struct Reading<'a> {
    checks: &'a mut Checks,
    field: &'a FieldPath,
    path: &'a Path,
}

/// Reads n and k from a file.
pub(super) fn read(checks: &mut Checks, field: &FieldPath, path: &Path) -> Option<[Spectrum; 2]> {
    let mut reading = Reading {
        checks,
        field,
        path,
    };
    match file::read(path) {
        Ok(file) => reading.spectra(&file),
        Err(error) => reading.refuse(ProblemKind::File, &error.to_string()),
    }
}

impl Reading<'_> {
    fn refuse<T>(&mut self, kind: ProblemKind, complaint: &str) -> Option<T> {
        let message = format!("{}: {complaint}", self.path.display());
        self.checks.report(Problem::new(kind, self.field, message));
        None
    }

    fn note(&mut self, text: &str) {
        let note = format!("{}: {text}", self.path.display());
        self.checks.note(self.field, note);
    }

    fn spectra(&mut self, file: &DatabaseFile) -> Option<[Spectrum; 2]> {
        let (mut n, mut k) = (Vec::new(), Vec::new());
        for block in &file.blocks {
            let [real, imaginary] = self.block(block)?;
            n.extend(real);
            k.extend(imaginary);
        }
        for (what, count) in [("n", n.len()), ("k", k.len())] {
            let complaint = match count {
                0 if what == "n" => "no block gives n".to_owned(),
                0 | 1 => continue,
                _ => format!("{count} blocks give {what}; only one can"),
            };
            return self.refuse(ProblemKind::Inconsistent, &complaint);
        }
        for block in &file.blocks {
            if matches!(block.data, Data::N2) {
                self.note(&format!(
                    "line {}: \"tabulated n2\", the nonlinear index, is ignored",
                    block.line
                ));
            }
        }
        for of_air in &file.of_air {
            self.note(&match of_air {
                OfAir::Index(line) => format!(
                    "line {line}: n is relative to air (`n_is_absolute: false`) and is used unchanged"
                ),
                OfAir::Wavelengths(line) => format!(
                    "line {line}: wavelengths are in air (`wavelength_is_vacuum: false`) and are used unchanged"
                ),
            });
        }
        Some([n.pop()?, k.pop().unwrap_or(Spectrum::Constant(0.0))])
    }

    /// The n and the k of a block.
    fn block(&mut self, block: &Block) -> Option<[Option<Spectrum>; 2]> {
        Some(match &block.data {
            Data::N(rows) => {
                let [n] = self.table(rows, &[N])?;
                [Some(n), None]
            }
            Data::K(rows) => {
                let [k] = self.table(rows, &[K])?;
                [None, Some(k)]
            }
            Data::Nk(rows) => self.table(rows, &[N, K])?.map(Some),
            Data::Formula(formula) => [Some(self.formula(block.line, formula)?), None],
            Data::N2 => [None, None],
        })
    }

    fn table<const C: usize>(
        &mut self,
        rows: &[Row<C>],
        columns: &[Quantity; C],
    ) -> Option<[Spectrum; C]> {
        if rows.len() > MAX_TABLE_POINTS {
            let count = rows.len();
            let complaint =
                format!("the table has {count} points; at most {MAX_TABLE_POINTS} are possible");
            return self.refuse(ProblemKind::TooLarge, &complaint);
        }
        let table = match Table::new(rows) {
            Ok(table) => table,
            Err(complaint) => return self.refuse(ProblemKind::OutOfRange, &complaint),
        };
        for note in table.notes() {
            self.note(&note);
        }
        let mut spectra = Vec::with_capacity(C);
        for (column, quantity) in columns.iter().enumerate() {
            match table.spectrum(column, quantity) {
                Ok((spectrum, note)) => {
                    spectra.push(spectrum);
                    if let Some(note) = note {
                        self.note(&note);
                    }
                }
                Err(complaint) => return self.refuse(ProblemKind::OutOfRange, &complaint),
            }
        }
        spectra.try_into().ok()
    }

    fn formula(&mut self, line: usize, written: &DispersionFormula) -> Option<Spectrum> {
        if let Some(formula) = formula::without_gaps(written, line) {
            Some(Spectrum::Formula(formula))
        } else {
            let (low, high) = written.range_nm();
            let complaint = format!(
                "line {line}: the formula gives no index from {INDEX_N} at any wavelength from {low} to {high} nm"
            );
            self.refuse(ProblemKind::OutOfRange, &complaint)
        }
    }
}
