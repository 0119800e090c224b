//! Dispersion formulas: the index of a transparent medium from a few coefficients.

use crate::fault::Faults;
use crate::{Fault, OutOfRange};
use std::sync::Arc;
use thiserror::Error;

/// The dispersion formulas 1 to 9 of the refractiveindex.info database.
///
/// λ is the vacuum wavelength in µm; C₁, C₂ … are the coefficients in order.
///
/// Source: M. N. Polyanskiy, Refractiveindex.info database of optical constants, Sci. Data 11, 94 (2024),
/// DOI 10.1038/s41597-023-02898-2, and the database's own sheet of dispersion formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FormulaKind {
    /// 1: n² − 1 = C₁ + C₂λ²/(λ² − C₃²) + C₄λ²/(λ² − C₅²) + …
    Sellmeier,
    /// 2: n² − 1 = C₁ + C₂λ²/(λ² − C₃) + C₄λ²/(λ² − C₅) + …
    Sellmeier2,
    /// 3: n² = C₁ + C₂λ^C₃ + C₄λ^C₅ + …
    Polynomial,
    /// 4: n² = C₁ + C₂λ^C₃/(λ² − C₄^C₅) + C₆λ^C₇/(λ² − C₈^C₉) + C₁₀λ^C₁₁ + C₁₂λ^C₁₃ + …
    RefractiveIndexInfo,
    /// 5: n = C₁ + C₂λ^C₃ + C₄λ^C₅ + …
    Cauchy,
    /// 6: n − 1 = C₁ + C₂/(C₃ − λ⁻²) + C₄/(C₅ − λ⁻²) + …
    Gases,
    /// 7: n = C₁ + C₂L + C₃L² + C₄λ² + C₅λ⁴ + C₆λ⁶ with L = 1/(λ² − 0.028). M. Herzberger, Opt. Acta 6, 197 (1959),
    /// DOI 10.1080/713826291.
    Herzberger,
    /// 8: (n² − 1)/(n² + 2) = C₁ + C₂λ²/(λ² − C₃) + C₄λ².
    Retro,
    /// 9: n² = C₁ + C₂/(λ² − C₃) + C₄(λ − C₅)/((λ − C₅)² + C₆).
    Exotic,
}

/// The square of the resonance wavelength that Herzberger uses for all glasses, µm².
const HERZBERGER_UM2: f64 = 0.028;

impl FormulaKind {
    /// Returns the formula with this number in the database, from 1 to 9.
    pub fn from_number(number: u32) -> Option<Self> {
        Some(match number {
            1 => Self::Sellmeier,
            2 => Self::Sellmeier2,
            3 => Self::Polynomial,
            4 => Self::RefractiveIndexInfo,
            5 => Self::Cauchy,
            6 => Self::Gases,
            7 => Self::Herzberger,
            8 => Self::Retro,
            9 => Self::Exotic,
            _ => return None,
        })
    }

    /// Whether `count` coefficients make complete terms: C₁ alone, or followed by whole terms.
    fn accepts(self, count: usize) -> bool {
        match self {
            Self::RefractiveIndexInfo => matches!(count, 1 | 5) || (count >= 9 && count % 2 == 1),
            Self::Herzberger => matches!(count, 1..=6),
            Self::Retro => matches!(count, 1 | 3 | 4),
            Self::Exotic => matches!(count, 1 | 3 | 6),
            _ => count % 2 == 1,
        }
    }

    /// Returns n at `um`; NaN or infinite if the formula gives no real number.
    fn index(self, coefficients: &[f64], um: f64) -> f64 {
        let um2 = um * um;
        let first = coefficients[0];
        // A term with weight 0 is skipped, even where its denominator is 0.
        let pairs = |from: usize, term: &dyn Fn(f64, f64) -> f64| -> f64 {
            let pairs = coefficients.get(from..).unwrap_or_default();
            let weighted = pairs.chunks_exact(2).filter(|pair| pair[0] != 0.0);
            weighted.map(|pair| term(pair[0], pair[1])).sum()
        };
        let one_pair = |term: &dyn Fn(f64, f64) -> f64| match coefficients.get(1..3) {
            Some(&[b, c]) if b != 0.0 => term(b, c),
            _ => 0.0,
        };
        let power = |b: f64, c: f64| b * um.powf(c);
        match self {
            Self::Sellmeier => (1.0 + (first + pairs(1, &|b, c| b * um2 / (um2 - c * c)))).sqrt(),
            Self::Sellmeier2 => (1.0 + (first + pairs(1, &|b, c| b * um2 / (um2 - c)))).sqrt(),
            Self::Polynomial => (first + pairs(1, &power)).sqrt(),
            Self::RefractiveIndexInfo => {
                let resonances = &coefficients[1..coefficients.len().min(9)];
                let weighted = resonances.chunks_exact(4).filter(|term| term[0] != 0.0);
                let resonant: f64 = weighted
                    .map(|c| c[0] * um.powf(c[1]) / (um2 - c[2].powf(c[3])))
                    .sum();
                (first + resonant + pairs(9, &power)).sqrt()
            }
            Self::Cauchy => first + pairs(1, &power),
            Self::Gases => 1.0 + (first + pairs(1, &|b, c| b / (c - 1.0 / um2))),
            Self::Herzberger => herzberger(coefficients, um2),
            Self::Retro => {
                let resonant = one_pair(&|b, c| b * um2 / (um2 - c));
                let x = first + resonant + coefficients.get(3).map_or(0.0, |c| c * um2);
                ((1.0 + 2.0 * x) / (1.0 - x)).sqrt()
            }
            Self::Exotic => {
                let resonant = one_pair(&|b, c| b / (um2 - c));
                let damped = match coefficients.get(3..6) {
                    Some(&[b, at, width]) if b != 0.0 => {
                        b * (um - at) / ((um - at) * (um - at) + width)
                    }
                    _ => 0.0,
                };
                (first + resonant + damped).sqrt()
            }
        }
    }

    /// Returns the squares, µm², of the wavelengths at which a term diverges; negative ones are not real wavelengths.
    fn poles_um2(self, coefficients: &[f64]) -> Vec<f64> {
        let pairs = |most: usize, square: &dyn Fn(f64) -> f64| -> Vec<f64> {
            let pairs = coefficients.get(1..).unwrap_or_default().chunks_exact(2);
            let weighted = pairs.take(most).filter(|pair| pair[0] != 0.0);
            weighted.map(|pair| square(pair[1])).collect()
        };
        match self {
            Self::Sellmeier => pairs(usize::MAX, &|c| c * c),
            Self::Sellmeier2 => pairs(usize::MAX, &|c| c),
            Self::Gases => pairs(usize::MAX, &|c| 1.0 / c),
            Self::Retro | Self::Exotic => pairs(1, &|c| c),
            Self::RefractiveIndexInfo => {
                let resonances = &coefficients[1..coefficients.len().min(9)];
                let weighted = resonances.chunks_exact(4).filter(|term| term[0] != 0.0);
                weighted.map(|c| c[2].powf(c[3])).collect()
            }
            Self::Herzberger if coefficients.iter().skip(1).take(2).any(|&c| c != 0.0) => {
                vec![HERZBERGER_UM2]
            }
            Self::Polynomial | Self::Cauchy | Self::Herzberger => Vec::new(),
        }
    }
}

fn herzberger(coefficients: &[f64], um2: f64) -> f64 {
    let near = 1.0 / (um2 - HERZBERGER_UM2);
    let terms = [1.0, near, near * near, um2, um2 * um2, um2 * um2 * um2];
    let weighted = coefficients.iter().zip(terms).filter(|(c, _)| **c != 0.0);
    weighted.map(|(c, term)| c * term).sum()
}

/// A dispersion formula with its coefficients and range of validity.
#[derive(Clone, Debug, PartialEq)]
pub struct DispersionFormula {
    kind: FormulaKind,
    coefficients: Vec<f64>,
    range_nm: (f64, f64),
    faults: Faults,
}

/// Why numbers do not define a [`DispersionFormula`].
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum FormulaError {
    /// A term is incomplete.
    #[error("found {found} coefficients; {}", whole_terms(*kind))]
    Count {
        /// The formula.
        kind: FormulaKind,
        /// The number of coefficients found.
        found: usize,
    },
    /// A coefficient is NaN or infinite.
    #[error("coefficient {index} is not finite")]
    NotFinite {
        /// Which coefficient, counted from 1.
        index: usize,
    },
    /// The range of wavelengths has no extent, or reaches 0.
    #[error("{min_nm} to {max_nm} nm is not a range of wavelengths")]
    Range {
        /// First wavelength.
        min_nm: f64,
        /// Last wavelength.
        max_nm: f64,
    },
}

fn whole_terms(kind: FormulaKind) -> &'static str {
    match kind {
        FormulaKind::RefractiveIndexInfo => {
            "expected one, then none, four or eight for the resonances, and after eight any number of pairs"
        }
        FormulaKind::Herzberger => "expected one to six",
        FormulaKind::Retro => "expected one, three or four",
        FormulaKind::Exotic => "expected one, three or six",
        _ => "expected one, then two for each term",
    }
}

impl DispersionFormula {
    /// Creates a formula that is valid from `range_nm.0` to `range_nm.1`.
    ///
    /// # Errors
    /// When a term is incomplete, a number is not finite, or the range is invalid.
    pub fn new(
        kind: FormulaKind,
        coefficients: Vec<f64>,
        range_nm: (f64, f64),
    ) -> Result<Self, FormulaError> {
        if !kind.accepts(coefficients.len()) {
            let found = coefficients.len();
            return Err(FormulaError::Count { kind, found });
        }
        if let Some(at) = coefficients.iter().position(|c| !c.is_finite()) {
            return Err(FormulaError::NotFinite { index: at + 1 });
        }
        let (min_nm, max_nm) = range_nm;
        if !(min_nm > 0.0 && min_nm < max_nm && max_nm.is_finite()) {
            return Err(FormulaError::Range { min_nm, max_nm });
        }
        Ok(Self {
            kind,
            coefficients,
            range_nm,
            faults: Faults::default(),
        })
    }

    /// Returns the same formula with no values within `faults`.
    #[must_use]
    pub fn with_faults(mut self, faults: Vec<Fault>) -> Self {
        self.faults = Faults::new(faults);
        self
    }

    pub(crate) fn faults(&self) -> &Faults {
        &self.faults
    }

    /// The wavelengths within the range at which a term diverges, nm.
    pub fn poles_nm(&self) -> Vec<f64> {
        let (min_nm, max_nm) = self.range_nm;
        let squares = self.kind.poles_um2(&self.coefficients).into_iter();
        let poles = squares.map(|um2| um2.sqrt() * 1e3);
        poles.filter(|&nm| min_nm <= nm && nm <= max_nm).collect()
    }

    /// First and last wavelength, nm.
    pub fn range_nm(&self) -> (f64, f64) {
        self.range_nm
    }

    /// Returns the index at `nm`.
    ///
    /// # Errors
    /// When `nm` lies outside the range by more than 1e-9 nm or in a fault, or the formula gives no positive real number there.
    pub fn at(&self, nm: f64) -> Result<f64, OutOfRange> {
        let (min_nm, max_nm) = self.range_nm;
        let inside = nm >= min_nm - 1e-9 && nm <= max_nm + 1e-9;
        let n = self.kind.index(&self.coefficients, nm * 1e-3);
        let fault = self.faults.at(nm).map(|fault| Arc::clone(&fault.reason));
        if inside && n > 0.0 && n.is_finite() && fault.is_none() {
            return Ok(n);
        }
        let no_index = || inside.then(|| "the formula gives no index there".into());
        Err(OutOfRange {
            nm,
            min_nm,
            max_nm,
            fault: fault.or_else(no_index),
        })
    }

    /// Returns the index at `nm`, or beyond the range the index at its nearer end.
    ///
    /// # Errors
    /// When `nm` lies in a fault, or the formula gives no positive real number there.
    pub fn clamped_at(&self, nm: f64) -> Result<f64, OutOfRange> {
        let (min_nm, max_nm) = self.range_nm;
        if self.faults.at(nm).is_some() {
            return self.at(nm);
        }
        self.at(nm.clamp(min_nm, max_nm))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn formula(number: u32, coefficients: &[f64]) -> DispersionFormula {
        let kind = FormulaKind::from_number(number).unwrap();
        DispersionFormula::new(kind, coefficients.to_vec(), (200.0, 2000.0)).unwrap()
    }

    #[test]
    fn every_formula_is_its_equation_worked_by_hand() {
        // λ = 0.5 µm: λ² = 1/4 and λ⁻² = 4, so that the terms are whole numbers and fractions.
        let cases: [(u32, &[f64], f64); 13] = [
            // 1 + 2 + 3·¼/(¼ − 0.3²) = 3 + 0.75/0.16
            (1, &[2.0, 3.0, 0.3], (3.0_f64 + 0.75 / 0.16).sqrt()),
            // 1 + 2 + 3·¼/(¼ − 0.1) = 3 + 5
            (2, &[2.0, 3.0, 0.1], 8.0_f64.sqrt()),
            // 2 + 3·(½)² + 4·(½)⁻¹ = 2 + 0.75 + 8
            (3, &[2.0, 3.0, 2.0, 4.0, -1.0], 10.75_f64.sqrt()),
            // 2 + 3·½/(¼ − 0.2²) + 4·1/(¼ − 0.125¹) + 5·(½)² = 2 + 1.5/0.21 + 32 + 1.25
            (
                4,
                &[2.0, 3.0, 1.0, 0.2, 2.0, 4.0, 0.0, 0.125, 1.0, 5.0, 2.0],
                (2.0_f64 + 1.5 / 0.21 + 32.0 + 1.25).sqrt(),
            ),
            (4, &[4.0], 2.0),
            // A term with weight 0 whose denominator is 0: ¼ − ½².
            (4, &[4.0, 0.0, 0.0, 0.5, 2.0], 2.0),
            // 1.25 + 0.01·(½)⁻² + 0.001·(½)⁻⁴ = 1.25 + 0.04 + 0.016
            (5, &[1.25, 0.01, -2.0, 0.001, -4.0], 1.306),
            // 1 + 0.5 + 3/(10 − 4)
            (6, &[0.5, 3.0, 10.0], 2.0),
            // L = 1/(0.25 − 0.028) = 1/0.222: 1.5 + 0.0222/0.222 + 0.002/0.222² + 0.4/4 + 0.16/16 + 0.64/64
            (
                7,
                &[1.5, 0.0222, 0.002, 0.4, 0.16, 0.64],
                1.5 + 0.1 + 0.002 / 0.049_284 + 0.1 + 0.01 + 0.01,
            ),
            (7, &[1.5, 0.0222], 1.6),
            // x = 0.1 + 0.2·¼/(¼ − 0.05) + 0.4·¼ = 0.1 + 0.25 + 0.1: n² = 1.9/0.55
            (8, &[0.1, 0.2, 0.05, 0.4], (1.9_f64 / 0.55).sqrt()),
            // x = 0.35: n² = 1.7/0.65
            (8, &[0.1, 0.2, 0.05], (1.7_f64 / 0.65).sqrt()),
            // 2 + 0.3/(¼ − 0.05) + 0.4·0.2/(0.2² + 0.06) = 2 + 1.5 + 0.8
            (9, &[2.0, 0.3, 0.05, 0.4, 0.3, 0.06], 4.3_f64.sqrt()),
        ];
        for (number, coefficients, expected) in cases {
            let found = formula(number, coefficients).at(500.0).unwrap();
            assert!((found - expected).abs() < 1e-14, "{number}: {found}");
        }
        assert_eq!(FormulaKind::from_number(0), None);
        assert_eq!(FormulaKind::from_number(10), None);
    }

    #[test]
    fn published_indices_of_the_last_three_formulas() {
        let at = |number, coefficients: &[f64], range, nm| {
            let kind = FormulaKind::from_number(number).unwrap();
            let formula = DispersionFormula::new(kind, coefficients.to_vec(), range).unwrap();
            formula.at(nm).unwrap()
        };
        // Edwards and Ochoa, Appl. Opt. 19, 4130 (1980): silicon has 3.4434 at 2.4373 µm and 3.4201 at 25 µm.
        let silicon = [3.41983, 0.159_906, -0.123_109, 1.26878e-6, -1.95104e-9];
        let silicon = |nm| at(7, &silicon, (2437.3, 25e3), nm);
        assert!((silicon(2437.3) - 3.4434).abs() < 5e-5 && (silicon(25e3) - 3.4201).abs() < 5e-5);
        // Schröter, Z. Phys. 67, 24 (1931); handbooks give silver bromide 2.253 at the D line.
        let bromide = [0.452_505, 0.09939, 0.070_537, -0.000_150];
        assert!((at(8, &bromide, (495.0, 670.0), 589.3) - 2.253).abs() < 5e-3);
        // Rosker et al., IEEE J. Quantum Electron. 21, 1600 (1985); mineralogists give urea's ε as 1.602 at the D line.
        let urea = [2.51527, 0.0240, 0.0300, 0.020, 1.52, 0.8771];
        assert!((at(9, &urea, (300.0, 1060.0), 589.3) - 1.602).abs() < 6e-3);
    }

    #[test]
    fn poles_are_where_a_denominator_is_zero() {
        let near = |number, coefficients: &[f64], expected: &[f64]| {
            let found = formula(number, coefficients).poles_nm();
            let same = found.len() == expected.len()
                && found
                    .iter()
                    .zip(expected)
                    .all(|(a, b)| (a - b).abs() < 1e-9);
            assert!(same, "{number}: {found:?}");
        };
        near(1, &[0.0, 1.0, 0.5, 0.0, 0.6, 1.0, 9.0], &[500.0]);
        near(2, &[0.0, 1.0, 0.25, 1.0, -0.25], &[500.0]);
        near(3, &[1.0, 1.0, -2.0], &[]);
        near(4, &[1.0, 1.0, 0.0, 0.5, 2.0], &[500.0]);
        near(6, &[0.0, 1.0, 4.0], &[500.0]);
        near(7, &[1.5], &[]);
        near(8, &[0.1, 0.1, 0.25, 0.25], &[500.0]);
        near(9, &[2.0, 0.1, 0.25, 1.0, 0.36, 0.1], &[500.0]);
    }

    #[test]
    fn outside_its_range_or_without_a_real_index_a_formula_is_an_error() {
        let cauchy = formula(5, &[1.5, 0.004, -2.0]);
        for nm in [199.0, 2001.0, f64::NAN, f64::INFINITY] {
            assert!(cauchy.at(nm).is_err(), "{nm}");
        }
        assert_eq!(cauchy.clamped_at(100.0), cauchy.at(200.0));
        assert_eq!(cauchy.clamped_at(1e5), cauchy.at(2000.0));
        // n² = 1 + 1·λ²/(λ² − ¼): infinite at 500 nm, −0.78 at 400 nm.
        let pole = formula(2, &[0.0, 1.0, 0.25]);
        assert!(pole.at(500.0).is_err() && pole.at(400.0).is_err() && pole.at(600.0).is_ok());
    }

    #[test]
    fn incomplete_terms_and_ranges_that_are_none_are_refused() {
        let new = |number, count, range| {
            let kind = FormulaKind::from_number(number).unwrap();
            DispersionFormula::new(kind, vec![1.0; count], range)
        };
        let range = (300.0, 800.0);
        for number in [7, 8, 9] {
            assert!(new(number, 0, range).is_err() && new(number, 7, range).is_err());
            assert!(new(number, 1, range).is_ok() && new(number, 3, range).is_ok());
            assert_eq!(new(number, 4, range).is_ok(), number != 9, "{number}");
            assert_eq!(new(number, 5, range).is_ok(), number == 7, "{number}");
            assert_eq!(new(number, 6, range).is_ok(), number != 8, "{number}");
        }
        for number in 1..=6 {
            assert!(new(number, 0, range).is_err() && new(number, 2, range).is_err());
            assert!(new(number, 1, range).is_ok());
            assert_eq!(new(number, 3, range).is_ok(), number != 4, "{number}");
        }
        assert!(new(4, 5, range).is_ok() && new(4, 7, range).is_err() && new(4, 13, range).is_ok());
        for range in [
            (0.0, 1.0),
            (2.0, 1.0),
            (1.0, 1.0),
            (f64::NAN, 1.0),
            (1.0, f64::INFINITY),
        ] {
            assert!(matches!(new(5, 3, range), Err(FormulaError::Range { .. })));
        }
        let kind = FormulaKind::Cauchy;
        let infinite = DispersionFormula::new(kind, vec![f64::INFINITY], range);
        assert_eq!(infinite, Err(FormulaError::NotFinite { index: 1 }));
    }
}
