//! Campaign for display files and the tables that they name.

use crate::bombs;
use crate::support::refused;
use colorimetry::Display;
use pellicle_fuzz::{Campaign, Outcome};
use std::fs;

const WORDS: [&str; 30] = [
    "title",
    "white",
    "white_luminance",
    "black_luminance",
    "[primaries]",
    "red",
    "green",
    "blue",
    "spectra = \"table.csv\"",
    "[response]",
    "curve",
    "\"gamma\"",
    "\"linear\"",
    "\"srgb\"",
    "\"bt1886\"",
    "\"pq\"",
    "\"table\"",
    "gamma",
    "alpha",
    "csv = \"table.csv\"",
    "[ambient]",
    "illuminance_lux",
    "reflectance",
    "illuminant = \"D50\"",
    "\"A\"",
    "[0.3, 0.3]",
    "[0, 0]",
    "=",
    "\n",
    "code,red,green,blue\n",
];

/// The text of a file below this line is its table.
const TABLE: &str = "--- table.csv\n";

/// Finds a fault in a display: matrices must be finite, luminances positive, and curves must rise within 0 to 1 or the display's peak.
fn fault(display: &Display) -> Option<String> {
    let matrices = [display.xyz_from_rgb(), display.rgb_from_xyz()];
    let is_finite = |numbers: &[f64; 3]| numbers.iter().all(|number| number.is_finite());
    if !matrices.iter().all(|matrix| matrix.iter().all(is_finite)) {
        return Some(format!("a matrix: {matrices:?}"));
    }
    let positive = [
        display.peak(),
        display.white_luminance(),
        display.white_xyz()[1],
    ];
    if !positive
        .iter()
        .all(|&value| value.is_finite() && value > 0.0)
        || !is_finite(&display.black_xyz())
    {
        return Some(format!(
            "a luminance: {positive:?}, {:?}",
            display.black_xyz()
        ));
    }
    for response in display.responses() {
        let mut before = -1e-9;
        for step in 0..=32 {
            let light = response.light(f64::from(step) / 32.0);
            if !light.is_finite() || light < before - 1e-9 || !response.code(light).is_finite() {
                return Some(format!("a response: {light} after {before} at {step}/32"));
            }
            before = light;
        }
    }
    None
}

#[test]
fn display_files() {
    let folder = tempfile::tempdir().unwrap();
    let (file, table) = (
        folder.path().join("a.toml"),
        folder.path().join("table.csv"),
    );
    let read = |bytes: &[u8]| {
        let at = bytes
            .windows(TABLE.len())
            .position(|piece| piece == TABLE.as_bytes());
        let at = at.unwrap_or(bytes.len());
        fs::write(&file, &bytes[..at]).unwrap();
        fs::write(&table, bytes.get(at + TABLE.len()..).unwrap_or_default()).unwrap();
        match Display::read(&file) {
            Ok(display) => fault(&display).map_or(Outcome::ACCEPTED, Outcome::Unsound),
            Err(error) => refused(&error),
        }
    };
    Campaign {
        unchanged: bombs::toml(),
        words: &WORDS,
        ..Campaign::new("display_files", 1000)
    }
    .run(read);
}
