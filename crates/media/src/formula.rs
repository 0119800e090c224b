//! Dispersion formulas: their coefficients in a scene, and the wavelengths at which they yield an index.

use crate::description::SellmeierTerms;
use crate::limits::{COEFFICIENT, INDEX_N, MAX_FORMULA_TERMS};
use document::{Checks, FieldPath, Problem, ProblemKind};
use spectra::{DispersionFormula, Fault, FormulaKind};

/// n = A + B/λ² + C/λ⁴.
pub(crate) fn cauchy(
    checks: &mut Checks,
    field: &FieldPath,
    coefficients: &[f64],
) -> Option<DispersionFormula> {
    if !(1..=3).contains(&coefficients.len()) {
        let message = format!(
            "found {} coefficients; there must be 1 to 3: A, B, C",
            coefficients.len()
        );
        checks.report(Problem::new(ProblemKind::Inconsistent, field, message));
        return None;
    }
    are_in_range(checks, field, coefficients)?;
    let powers = [0.0, -2.0, -4.0];
    let mut terms = vec![coefficients[0]];
    terms.extend(
        coefficients
            .iter()
            .zip(powers)
            .skip(1)
            .flat_map(|(&c, power)| [c, power]),
    );
    over_valid_range(checks, field, FormulaKind::Cauchy, &terms)
}

/// n² = 1 + Σ b λ²/(λ² − c).
pub(crate) fn sellmeier(
    checks: &mut Checks,
    field: &FieldPath,
    terms: &SellmeierTerms,
) -> Option<DispersionFormula> {
    let (strengths, squares) = (field.key("b"), field.key("c_um2"));
    let (b, c) = (terms.b.len(), terms.c_um2.len());
    if b != c || b == 0 || b > MAX_FORMULA_TERMS {
        let message = format!(
            "found {b} strengths `b` for {c} resonances `c_um2`; there must be one for each, and 1 to {MAX_FORMULA_TERMS} in all"
        );
        let problem = Problem::new(ProblemKind::Inconsistent, field, message);
        checks.report(problem.involving(strengths).involving(squares));
        return None;
    }
    let b = are_in_range(checks, &strengths, &terms.b);
    let c = are_in_range(checks, &squares, &terms.c_um2);
    b.and(c)?;
    let pairs = terms.b.iter().zip(&terms.c_um2);
    let coefficients: Vec<f64> = std::iter::once(0.0)
        .chain(pairs.flat_map(|(&b, &c)| [b, c]))
        .collect();
    over_valid_range(checks, field, FormulaKind::Sellmeier2, &coefficients)
}

fn are_in_range(checks: &mut Checks, field: &FieldPath, coefficients: &[f64]) -> Option<()> {
    let found = coefficients.iter().enumerate().map(|(index, &value)| {
        checks
            .number(&field.index(index), value, &COEFFICIENT)
            .map(|_| ())
    });
    // All are checked, so that all problems are reported.
    found.fold(Some(()), Option::and)
}

/// Wavelengths from 100 nm to 30 µm: every nanometer up to 2.5 µm, then every ten nanometers.
fn wavelengths_nm() -> impl Iterator<Item = f64> {
    let fine = (100..2500).map(f64::from);
    fine.chain((250..=3000).map(|tens| 10.0 * f64::from(tens)))
}

fn gives_an_index(formula: &DispersionFormula, nm: f64) -> bool {
    formula.at(nm).is_ok_and(|n| INDEX_N.contains(n))
}

/// A formula without a stated range. It counts as valid where it yields an index: around 550 nm, or else in the nearest range above.
fn over_valid_range(
    checks: &mut Checks,
    field: &FieldPath,
    kind: FormulaKind,
    coefficients: &[f64],
) -> Option<DispersionFormula> {
    const MIDDLE_NM: f64 = 550.0;
    let over = |range| DispersionFormula::new(kind, coefficients.to_vec(), range).ok();
    let unbounded = over((1.0, 1e6))?;
    let mut range: Option<(f64, f64)> = None;
    for nm in wavelengths_nm() {
        match (&mut range, gives_an_index(&unbounded, nm)) {
            (Some(range), true) => range.1 = nm,
            (None, true) => range = Some((nm, nm)),
            (Some(range), false) if range.1 >= MIDDLE_NM => break,
            (_, false) => range = None,
        }
    }
    let formula = range.and_then(over);
    if formula.is_none() {
        let message = format!(
            "the formula gives no index from {INDEX_N} at any wavelength from {MIDDLE_NM} nm up"
        );
        checks.report(Problem::new(ProblemKind::OutOfRange, field, message));
    }
    formula
}

/// A formula with faults, which name `line`, at the wavelengths of its range where it has a pole or yields no index that a scene may have.
/// `None` if it yields no index at all.
pub(crate) fn without_gaps(formula: &DispersionFormula, line: usize) -> Option<DispersionFormula> {
    let (low, high) = formula.range_nm();
    let poles = formula.poles_nm();
    let inside = wavelengths_nm().chain(far_wavelengths_nm());
    let mut samples: Vec<f64> = inside.filter(|nm| (low..=high).contains(nm)).collect();
    samples.extend([low, high].iter().chain(&poles));
    samples.sort_by(f64::total_cmp);
    samples.dedup();
    let mut faults = Vec::new();
    let (mut last_sound, mut first_faulty) = (None, None);
    let fault = |from_nm: Option<f64>, at: f64, to_nm| Fault {
        from_nm: from_nm.unwrap_or(0.0),
        to_nm,
        reason: format!("line {line}: the formula gives no index from {INDEX_N} at {at} nm").into(),
    };
    for nm in samples {
        if poles.contains(&nm) || !gives_an_index(formula, nm) {
            first_faulty.get_or_insert(nm);
            continue;
        }
        faults.extend(first_faulty.take().map(|at| fault(last_sound, at, nm)));
        last_sound = Some(nm);
    }
    last_sound?;
    faults.extend(first_faulty.map(|at| fault(last_sound, at, f64::INFINITY)));
    Some(formula.clone().with_faults(faults))
}

/// Wavelengths from 31 µm to 1 mm, where tables end, every micrometer.
fn far_wavelengths_nm() -> impl Iterator<Item = f64> {
    (31..=1000).map(|um| 1e3 * f64::from(um))
}
