//! Words that name the axis of a table.

use super::options::Unit;

/// Words that name the axis of a table over wavelength.
const AXIS_WORDS: [&str; 9] = [
    "wl",
    "wlen",
    "wave",
    "λ",
    "energy",
    "photon",
    "wavenumber",
    "wavenumbers",
    "frequency",
];
/// Prefixes of words for wavelength, in the languages of instruments.
const AXIS_STARTS: [&str; 7] = [
    "wavel",
    "lambda",
    "wellenl",
    "longueur",
    "longitud",
    "lunghezza",
    "golflengte",
];

/// The words of a cell, in lower case.
pub(super) fn words(cell: &str) -> impl Iterator<Item = String> + '_ {
    let words = cell.split(|c: char| !c.is_alphanumeric() && c != '\u{30a}');
    words.filter(|word| !word.is_empty()).map(str::to_lowercase)
}

/// Whether a cell contains a word for an axis.
pub(super) fn axis_word(cell: &str) -> bool {
    words(cell).any(|word| {
        AXIS_WORDS.contains(&word.as_str())
            || AXIS_STARTS.iter().any(|start| word.starts_with(start))
    })
}

/// Whether a cell consists only of a unit of wavelength.
pub(super) fn is_axis(cell: &str) -> bool {
    words(cell).next().is_some() && words(cell).all(|word| Unit::from_word(&word).is_some())
}
