//! Compares the materials with an independent reading of the same publications, and with values from other sources.

use spectra::{material_info, material_names, optical_constants};
use std::collections::HashSet;

const INDICES: &str = include_str!("data/indices.csv");

/// The rows of `indices.csv`: material, wavelength in nm, n and k.
fn rows() -> Vec<(&'static str, [f64; 3])> {
    let lines = INDICES.lines().filter(|line| !line.starts_with('#'));
    let row = |line: &'static str| {
        let (name, rest) = line.split_once(',').unwrap();
        let numbers: Vec<f64> = rest.split(',').map(|cell| cell.parse().unwrap()).collect();
        (name, numbers.try_into().unwrap())
    };
    lines.skip(1).map(row).collect()
}

fn agrees((name, [nm, n, k]): (&str, [f64; 3])) -> bool {
    let index = optical_constants(name).unwrap().data.at(nm).unwrap();
    (index.re - n).abs() < 1e-12 && (index.im - k).abs() < 1e-12
}

#[test]
fn every_material_is_what_an_independent_program_reads() {
    let rows = rows();
    let named: HashSet<_> = rows.iter().map(|row| row.0).collect();
    assert_eq!(named, material_names().into_iter().collect());
    assert_eq!(rows.len(), 11 * 41 + 58 * 3);
    for row in rows {
        assert!(agrees(row), "{row:?}");
    }
}

#[test]
fn an_index_that_differs_in_the_eleventh_digit_is_noticed() {
    for (name, [nm, n, k]) in rows() {
        assert!(!agrees((name, [nm, n + 1e-11, k])), "{name}");
        assert!(!agrees((name, [nm, n, k - 1e-11])), "{name}");
    }
}

#[test]
fn indices_at_spectral_lines_are_the_published_ones() {
    // Lines: d 587.5618 nm, F 486.1327 nm, D 589.3 nm.
    let published = [
        // SCHOTT data sheet N-SF11 (785257.322).
        ("sf11", 587.5618, 1.78472, 1e-5),
        ("sf11", 486.1327, 1.80651, 1e-5),
        // Indices at these lines from data sheets of crystals, to the digits that they give.
        ("calcium_fluoride", 587.5618, 1.43384, 2e-5),
        ("magnesium_fluoride", 589.3, 1.3777, 5e-5),
        ("alumina", 589.3, 1.768, 5e-4),
        ("rutile", 589.3, 2.613, 5e-4),
        ("diamond", 589.3, 2.417, 1e-3),
        // Air at 15 °C: 1 + 2.77e-4.
        ("air", 589.3, 1.000_277, 5e-7),
        // Sultanova, Kasarova and Nikolov (2009), table 1: 1.592 at the d line.
        ("polystyrene_sultanova", 587.6, 1.592, 5e-4),
    ];
    for (name, nm, expected, tolerance) in published {
        let n = optical_constants(name).unwrap().data.at(nm).unwrap().re;
        assert!((n - expected).abs() <= tolerance, "{name} at {nm} nm: {n}");
    }
}

#[test]
fn the_notice_names_every_publication() {
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let notice = words(include_str!("../../../NOTICE"));
    for name in material_names() {
        let citation = words(material_info(name).unwrap().citation);
        assert!(notice.contains(&citation), "{name}: {citation}");
    }
}
