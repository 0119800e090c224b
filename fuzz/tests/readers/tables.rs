//! Campaigns for tables over wavelength, and for files of the refractiveindex.info database.

use crate::bombs;
use crate::support::text;
use pellicle_fuzz::{Campaign, Outcome};
use scene_file::description::{Extrapolate, Index};
use spectra::table_file::{Options, Quantity, Table, Unit, parse, parse_rows};
use std::fs;

const WORDS: [&str; 40] = [
    ",",
    ";",
    "\t",
    " ",
    "\n",
    "\r\n",
    "\"",
    "#",
    "%",
    "nm",
    "um",
    "µm",
    "eV",
    "wl",
    "wl,n\n",
    "wl,k\n",
    "n",
    "k",
    "R",
    "T",
    "Reflectance (%)",
    "Wavelength",
    "[Data]",
    ">>>>>Begin Spectral Data<<<<<",
    ">>>>>End Spectral Data<<<<<",
    "CGATS.17",
    "BEGIN_DATA_FORMAT",
    "END_DATA_FORMAT",
    "BEGIN_DATA",
    "END_DATA",
    "NUMBER_OF_SETS",
    "SPECTRAL_NM400",
    "SAMPLE_ID",
    "<IESTM2714>",
    "<SpectralData wavelength=\"500\">",
    "</SpectralData>",
    "<SpectralQuantity>reflectance</SpectralQuantity>",
    "\u{feff}",
    "&amp;",
    "1e",
];

/// Finds a fault in a table: wavelengths must rise, and values must be finite and in the range of their quantity.
fn fault<const N: usize>(table: &Table<N>, quantities: [Quantity; N]) -> Option<String> {
    for (column, quantity) in table.columns.iter().zip(quantities) {
        let mut before = 0.0;
        for (nm, value) in column.points() {
            let (low, high) = quantity.range;
            if !(nm.is_finite() && nm > before && (low..=high).contains(&value)) {
                return Some(format!(
                    "{}: {value} at {nm} nm after {before}",
                    quantity.noun
                ));
            }
            before = nm;
        }
    }
    None
}

fn read<const N: usize>(text: &str, quantities: [Quantity; N], options: &Options) -> Outcome {
    match parse(text, quantities, options) {
        Ok(table) => fault(&table, quantities).map_or(Outcome::ACCEPTED, Outcome::Unsound),
        Err(error) => Outcome::Refused(error.to_string()),
    }
}

/// Reads the text as each kind of table that it may be; the outcome is the worst, or else all outcomes together.
fn read_all(bytes: &[u8]) -> Outcome {
    let text = text(bytes);
    let plain = Options::default();
    let micrometers = Options {
        unit: Some(Unit::Um),
        is_percent: true,
        columns: Vec::new(),
    };
    let index = [
        Quantity::plain("n", (1e-3, 100.0)),
        Quantity::plain("k", (0.0, 1000.0)),
    ];
    let outcomes = [
        read(&text, [Quantity::REFLECTANCE], &plain),
        read(&text, [Quantity::REFLECTANCE], &micrometers),
        read(&text, [Quantity::POWER], &plain),
        read(&text, index, &plain),
        read(&text, [Quantity::plain("a", (-1e9, 1e9)); 3], &plain),
        rows(&text),
    ];
    if let Some(unsound) = outcomes.iter().find(|o| matches!(o, Outcome::Unsound(_))) {
        return unsound.clone();
    }
    let refusals = outcomes.iter().filter_map(|outcome| match outcome {
        Outcome::Refused(error) => Some(error.as_str()),
        _ => None,
    });
    let refusals: Vec<_> = refusals.collect();
    if refusals.len() < outcomes.len() {
        return Outcome::ACCEPTED;
    }
    Outcome::Refused(refusals.concat())
}

fn rows(text: &str) -> Outcome {
    match parse_rows::<2>(text) {
        Ok(rows) => {
            let is_finite = rows
                .iter()
                .all(|row| row.nm.is_finite() && row.values.iter().all(|value| value.is_finite()));
            crate::support::expect(is_finite, || "a row is not finite".to_owned())
        }
        Err(error) => Outcome::Refused(error.to_string()),
    }
}

#[test]
fn tables_over_wavelength() {
    Campaign {
        seeds: [bombs::tables(), bombs::xml()].concat(),
        words: &WORDS,
        ..Campaign::new("tables", 1000)
    }
    .run(read_all);
}

const YAML_WORDS: [&str; 34] = [
    " ",
    "\n",
    "\t",
    ":",
    ": ",
    "- ",
    "[",
    "]",
    "{",
    "}",
    "|",
    ">-",
    "&a ",
    "*a",
    "!t ",
    "\"",
    "'",
    "#",
    "---\n",
    "...\n",
    "<<: *a",
    "nan",
    "DATA:",
    "type: formula 4",
    "type: formula 9",
    "type: tabulated nk",
    "type: tabulated k",
    "wavelength_range: 0.3 0.9",
    "coefficients: 1 2 3 4",
    "data: |",
    "CONDITIONS:",
    "temperature: [293, K]",
    "tabulated n2",
    "REFERENCES: |",
];

/// A file of the database gives a valid index at every wavelength of its range, or reports a fault.
#[test]
fn database_files() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.yml");
    let index = Index::Database {
        yaml: "a.yml".into(),
        extrapolate: Extrapolate::Error,
    };
    let read = |bytes: &[u8]| {
        fs::write(&file, bytes).unwrap();
        let constants = match media::optical_constants(&index, folder.path()) {
            Ok((constants, _)) => constants,
            Err(problems) => return Outcome::Refused(format!("{problems:#}")),
        };
        let Some((low, high)) = constants.range_nm() else {
            return Outcome::Unsound("it covers no range".to_owned());
        };
        for nm in [low, low + 1.0, f64::midpoint(low, high), high] {
            let is_sound = match constants.at(nm) {
                Ok(index) => index.re > 0.0 && index.im >= 0.0 && index.is_finite(),
                Err(gap) => gap.fault.is_some() || nm > high,
            };
            if !is_sound && low <= high {
                return Outcome::Unsound(format!("{:?} at {nm} nm", constants.at(nm)));
            }
        }
        Outcome::ACCEPTED
    };
    Campaign {
        seeds: bombs::yaml(),
        words: &YAML_WORDS,
        ..Campaign::new("database_files", 1000)
    }
    .run(read);
}
