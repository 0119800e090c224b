//! Lamps as options name them: `D65`, `D5700K`, `lamp.csv`, `F11*0.3`.

use crate::print;
use pellicle::colorimetry::tristimulus::Rule;
use pellicle::document::text_file::STANDARD_INPUT;
use pellicle::document::wording::visible;
use pellicle::spectra::table_file::{self, Options, Quantity};
use pellicle::spectra::{Spectrum, find_illuminant};
use std::path::Path;

/// The file formats of tables over wavelength.
pub(crate) const FORMATS: &str =
    "columns of numbers in .csv, .txt, .tsv, .dat or .spd, CGATS, or IES TM-27 (.spdx)";

/// The spectrum of a light source and its strength.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lamp {
    /// The name of the illuminant, or that of the file without its folder and ending.
    pub(crate) name: String,
    /// Relative power. A named illuminant is as bright as the constant 1; the values of a file are used unchanged.
    pub(crate) spectrum: Spectrum,
    /// Step of sums over it: 5 nm for the CIE's lamps with lines, which are defined that way, else 1 nm.
    pub(crate) rule: Rule,
    /// The factor by which the power is multiplied.
    pub(crate) factor: f64,
}

/// The allowed factors of a lamp.
const FACTORS: std::ops::RangeInclusive<f64> = 0.0..=1e9;

impl Lamp {
    /// Reads `NAME` or `FILE`, with or without `*FACTOR` after it.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        match text.rsplit_once('*') {
            Some((lamp, factor)) if !Path::new(text).exists() => Ok(Self {
                factor: parse_factor(factor)?,
                ..Self::unscaled(lamp.trim_end())?
            }),
            _ => Self::unscaled(text),
        }
    }

    /// Reads `NAME` or `FILE`, for a lamp whose strength does not matter.
    pub(crate) fn unscaled(text: &str) -> Result<Self, String> {
        let (name, spectrum) = spectrum(text)?;
        let is_known = find_illuminant(text).is_ok();
        let rule = if is_known {
            Rule::for_illuminant(&name)
        } else {
            Rule::OneNm
        };
        Ok(Self {
            name,
            spectrum,
            rule,
            factor: 1.0,
        })
    }
}

/// Reads `NAME` or `FILE` and returns the lamp's name and spectrum. Prints what was assumed about a file.
pub(crate) fn spectrum(text: &str) -> Result<(String, Spectrum), String> {
    match find_illuminant(text) {
        Ok(set) => return Ok((set.name.into_owned(), set.data)),
        Err(error) if !is_file(text) => {
            return Err(format!("{error}; or a file: {FORMATS}"));
        }
        Err(_) => {}
    }
    let path = Path::new(text);
    let table = table_file::read(path, [Quantity::POWER], &Options::default());
    let shown = print::name(path);
    let table = table.map_err(|error| {
        if path.exists() || text == STANDARD_INPUT {
            format!("{shown}: {error}")
        } else {
            format!("{text}: {error}; a lamp is the name of an illuminant, or a file: {FORMATS}")
        }
    })?;
    let [power] = table.columns;
    if power.points().all(|(_, value)| value == 0.0) {
        return Err(format!(
            "{shown}: a lamp must have power at some wavelength, but all values are 0"
        ));
    }
    print::notes(table.note.map(|note| format!("{shown}: {note}")));
    let name = match text {
        STANDARD_INPUT => "standard input".into(),
        _ => path.file_stem().unwrap_or_default().to_string_lossy(),
    };
    Ok((visible(&name).into_owned(), Spectrum::Table(power)))
}

/// Whether a text that does not name an illuminant names a file: the file exists, or the text looks like a path.
fn is_file(text: &str) -> bool {
    let path = Path::new(text);
    let is_ending = |ending: &str| {
        (1..=6).contains(&ending.len()) && ending.starts_with(|c: char| c.is_ascii_alphabetic())
    };
    let ending = path.extension().and_then(|ending| ending.to_str());
    text == STANDARD_INPUT
        || text.contains(std::path::is_separator)
        || ending.is_some_and(is_ending)
        || path.exists() && !text.is_empty()
}

/// Parses the factor after `*`.
pub(crate) fn parse_factor(text: &str) -> Result<f64, String> {
    let factor: Result<f64, _> = text.trim().parse();
    factor
        .ok()
        .filter(|factor| FACTORS.contains(factor))
        .ok_or_else(|| {
            format!("{text:?} is not a factor; write a number from 0 to 1e9 after *, as in D65*0.3")
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
    fn what_is_no_lamp_is_reported() {
        for (text, said) in [
            ("d65", "did you mean \"D65\"?"),
            ("", "known names:"),
            ("D65*", "is not a factor"),
            ("D65*x", "is not a factor"),
            ("D65*-1", "is not a factor"),
            ("D65*inf", "is not a factor"),
            ("D65*NaN", "is not a factor"),
            ("*2", "no illuminant \"\""),
            ("no/such.csv", "cannot be opened"),
            ("none.spdx", "or a file: columns of numbers in .csv"),
            ("no/such", "IES TM-27"),
            ("X65", "or a file: columns of numbers in .csv"),
            ("D100K", "4000 to 25000 K"),
        ] {
            let error = Lamp::parse(text).unwrap_err();
            assert!(error.contains(said), "{text:?}: {error}");
        }
    }

    #[test]
    fn files_of_any_ending_are_lamps() {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in [
            ("a.spd", "380 0.5\n780 1\n"),
            ("a.txt", "nm;power\n380;0,5\n780;1,0\n"),
            ("a.anything", "380,0.5\n780,1\n"),
            ("none", "780\t1\n380\t0.5\n"),
            (
                "a.spdx",
                "<IESTM2714><SpectralData wavelength='380'>0.5</SpectralData><SpectralData wavelength='780'>1</SpectralData></IESTM2714>",
            ),
        ] {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            let lamp = Lamp::parse(&format!("{}*0.5", path.display())).unwrap();
            // Halfway between the two points.
            assert_eq!(lamp.spectrum.at(580.0), Ok(0.75), "{name}");
            assert_eq!((lamp.factor, lamp.rule), (0.5, Rule::OneNm));
        }
    }
}
