//! Thicknesses in one-line stacks: a length with its unit, or waves at a wavelength.

use document::Range;
use document::wording::number;
use media::limits::TABLE_NM;
use spectra::OpticalConstants;

/// Thickness of a layer: 100 µm is far beyond the last visible fringe.
pub(crate) const THICKNESS_NM: Range = Range::new(0.0, 100_000.0, " nm");

/// Units of a thickness, in nm. The micro sign µ and the Greek letter are different characters, as are the angstrom sign and the
/// letter Å.
const UNITS: [(&str, f64); 8] = [
    ("nm", 1.0),
    ("um", 1e3),
    ("\u{b5}m", 1e3),
    ("\u{3bc}m", 1e3),
    ("mm", 1e6),
    ("\u{c5}", 0.1),
    ("\u{212b}", 0.1),
    ("angstrom", 0.1),
];

/// Help on how to write a thickness.
pub(crate) const FORMS: &str = "300nm, 0.3um, 3000Å or, in waves at a wavelength in nm, 0.25@550";

/// A thickness as it was written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Written<'a> {
    /// A number, and its unit with the value in nm.
    Length(&'a str, (&'static str, f64)),
    /// An optical thickness in waves, and the vacuum wavelength.
    Waves(&'a str, &'a str),
}

/// Splits `silica 300 nm` into medium and thickness; without a thickness at its end, the whole text is the medium.
pub(crate) fn split(text: &str) -> (&str, Option<Written<'_>>) {
    let last_word = |text: &'_ str| text.rfind(char::is_whitespace).map_or(0, |at| at + 1);
    if let Some((before, after)) = text.rsplit_once('@') {
        let at = after.trim();
        let at = at.strip_suffix("nm").unwrap_or(at).trim_end();
        let before = before.trim_end();
        let (medium, waves) = split_at_char(before, last_word(before));
        if is_a_number_at_its_end(at) && !at.contains(char::is_whitespace) {
            return (medium.trim_end(), Some(Written::Waves(waves, at)));
        }
    }
    for unit in UNITS {
        let Some(rest) = text.strip_suffix(unit.0) else {
            continue;
        };
        let rest = rest.trim_end();
        let (medium, digits) = split_at_char(rest, last_word(rest));
        // A name that happens to end in a unit has no digit before it.
        if is_a_number_at_its_end(digits) {
            return (medium.trim_end(), Some(Written::Length(digits, unit)));
        }
    }
    (text, None)
}

/// Splits `text` in two; the second part starts with the character that begins at or before the position.
fn split_at_char(text: &str, at: usize) -> (&str, &str) {
    let at = (0..=at).rev().find(|&at| text.is_char_boundary(at));
    text.split_at(at.unwrap_or(0))
}

fn is_a_number_at_its_end(text: &str) -> bool {
    text.ends_with(|c: char| c.is_ascii_digit() || c == '.')
}

impl Written<'_> {
    /// Returns the thickness in nm of a layer of this medium, or what is wrong and what would be right.
    pub(crate) fn nm(self, constants: &OpticalConstants) -> Result<f64, (String, String)> {
        let parsed = |digits: &str| {
            digits.parse::<f64>().map_err(|_| {
                let message = format!("{digits:?} is not a number");
                (message, format!("a thickness is written like {FORMS}"))
            })
        };
        match self {
            Self::Length(digits, (unit, factor)) => {
                let nm = parsed(digits)? * factor;
                within(nm, |nm| match factor {
                    1.0 => format!("{digits} nm"),
                    _ => format!("{digits} {unit}, {nm} nm"),
                })
            }
            Self::Waves(waves, at) => optical_nm(parsed(waves)?, parsed(at)?, constants),
        }
    }
}

/// Checks that a layer may have this thickness; `written` returns how it was written, given the number in nm.
pub(crate) fn within(nm: f64, written: impl Fn(&str) -> String) -> Result<f64, (String, String)> {
    if THICKNESS_NM.contains(nm) {
        // Adding 0 turns −0 into 0.
        return Ok(nm + 0.0);
    }
    let help = format!("it must be from {THICKNESS_NM}");
    Err((format!("a thickness of {}", written(&number(nm))), help))
}

/// Returns the thickness d in nm of a layer that is `waves` wavelengths thick at normal incidence: n d = waves · λ with the real
/// part n of its index at the vacuum wavelength λ = `at_nm`; a quarter-wave layer has 0.25. The error has what is wrong and what
/// would be right.
pub(crate) fn optical_nm(
    waves: f64,
    at_nm: f64,
    constants: &OpticalConstants,
) -> Result<f64, (String, String)> {
    if !TABLE_NM.contains(at_nm) {
        let help = format!("it must be from {TABLE_NM}");
        return Err((format!("a wavelength of {} nm", number(at_nm)), help));
    }
    let n = constants.n.at(at_nm).map_err(|gap| {
        let help = "a thickness in waves needs the layer's index at the wavelength after the @";
        (gap.to_string(), help.to_owned())
    })?;
    within(waves * at_nm / n, |nm| {
        format!("{} waves at {} nm, {nm} nm", number(waves), number(at_nm))
    })
}
