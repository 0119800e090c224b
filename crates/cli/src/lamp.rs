//! Lamps as options name them: `D65`, `D5700K`, `lamp.csv`, `F11*0.3`.

use pellicle::colorimetry::tristimulus::Rule;
use pellicle::spectra::table_file::{Quantity, columns};
use pellicle::spectra::{Spectrum, find_illuminant};
use std::ffi::OsStr;
use std::path::Path;

/// A spectrum that a light burns with, and how strongly.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lamp {
    /// The illuminant's name, or the file's without its folder and ending.
    pub(crate) name: String,
    /// Relative power. An illuminant by name is as bright as the constant 1; the values of a file are as they stand there.
    pub(crate) spectrum: Spectrum,
    /// How sums over it are taken: at 5 nm for the CIE's lamps with lines, which that defines, else at 1 nm.
    pub(crate) rule: Rule,
    /// What the power is multiplied by.
    pub(crate) factor: f64,
}

/// Factors that a lamp may have.
const FACTORS: std::ops::RangeInclusive<f64> = 0.0..=1e9;

impl Lamp {
    /// Reads `NAME` or `FILE.csv`, either with `*FACTOR` behind it.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        match text.rsplit_once('*') {
            Some((lamp, factor)) if !is_file(text) => Ok(Self {
                factor: parse_factor(factor)?,
                ..Self::unscaled(lamp.trim_end())?
            }),
            _ => Self::unscaled(text),
        }
    }

    /// Reads `NAME` or `FILE.csv`: a light whose strength does not matter.
    pub(crate) fn unscaled(text: &str) -> Result<Self, String> {
        let (name, spectrum) = spectrum(text)?;
        let rule = if is_file(text) {
            Rule::OneNm
        } else {
            Rule::for_illuminant(&name)
        };
        Ok(Self {
            name,
            spectrum,
            rule,
            factor: 1.0,
        })
    }
}

/// A light's spectrum with its name: `NAME` or `FILE.csv`.
pub(crate) fn spectrum(text: &str) -> Result<(String, Spectrum), String> {
    if !is_file(text) {
        let set = find_illuminant(text).map_err(|error| format!("{error}; or a file .csv"))?;
        return Ok((set.name.into_owned(), set.data));
    }
    let path = Path::new(text);
    let [table] = columns(path, [Quantity::POWER]).map_err(|error| format!("{text}: {error}"))?;
    if table.points().all(|(_, value)| value == 0.0) {
        return Err(format!(
            "{text}: a lamp must shine somewhere, but all values are 0"
        ));
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    Ok((stem.into_owned(), Spectrum::Table(table)))
}

/// Whether a lamp is a file: its name ends in `.csv`.
fn is_file(text: &str) -> bool {
    let extension = Path::new(text).extension().and_then(OsStr::to_str);
    extension.is_some_and(|extension| extension.eq_ignore_ascii_case("csv"))
}

/// What stands behind `*`.
pub(crate) fn parse_factor(text: &str) -> Result<f64, String> {
    let factor: Result<f64, _> = text.trim().parse();
    factor
        .ok()
        .filter(|factor| FACTORS.contains(factor))
        .ok_or_else(|| {
            format!(
                "{text:?} is not a factor; behind * stands a number from 0 to 1e9, as in D65*0.3"
            )
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_factors() {
        let lamp = Lamp::parse("D65*0.3").unwrap();
        assert_eq!((lamp.name.as_str(), lamp.factor), ("D65", 0.3));
        let lamp = Lamp::parse("F11").unwrap();
        assert_eq!((lamp.name.as_str(), lamp.rule), ("FL11", Rule::FiveNm));
        assert_eq!(Lamp::parse("D5700K * 2e-1").unwrap().factor, 0.2);
        assert_eq!(Lamp::parse("E").unwrap().spectrum, Spectrum::Constant(1.0));
    }

    #[test]
    fn what_is_no_lamp_is_told() {
        for (text, said) in [
            ("d65", "did you mean \"D65\"?"),
            ("", "known are"),
            ("D65*", "is not a factor"),
            ("D65*x", "is not a factor"),
            ("D65*-1", "is not a factor"),
            ("D65*inf", "is not a factor"),
            ("D65*NaN", "is not a factor"),
            ("*2", "no illuminant \"\""),
            ("no/such.csv", "cannot be opened"),
            ("D100K", "4000 to 25000 K"),
        ] {
            let error = Lamp::parse(text).unwrap_err();
            assert!(error.contains(said), "{text:?}: {error}");
        }
    }
}
