//! Tests of the reflectances and transmittances that `pellicle film` prints.

use crate::place::{Place, Ran};
use crate::{assert_says, number, rows};
use pellicle::coating::{Angle, Stack};
use serde_json::Value;
use std::collections::BTreeMap;

/// Silica on silicon.
pub(crate) const STEP: &str = "1 | silica 300nm | silicon";

/// Runs `film` in a folder of its own.
pub(crate) fn film(stack: &str, arguments: &str) -> Ran {
    Place::default().film(stack, arguments)
}

/// The numbers of the rows of a CSV.
pub(crate) fn figures(csv: &str) -> Vec<Vec<f64>> {
    let row = |line: &str| line.split(',').map(number).collect();
    csv.lines().skip(1).map(row).collect()
}

#[test]
fn csv_is_ordered_by_angle_then_wavelength_and_keeps_every_digit() {
    let ran = film(STEP, "--angles 0,60 --wavelengths 400:600:100 --format csv").succeeded();
    let head = ran.stdout.lines().next().unwrap();
    assert_eq!(head, "wavelength_nm,angle_deg,Rs,Rp,Ts,Tp");
    let found = figures(&ran.stdout);
    let order: Vec<_> = found.iter().map(|row| (row[0], row[1])).collect();
    assert_eq!(
        order,
        [
            (400.0, 0.0),
            (500.0, 0.0),
            (600.0, 0.0),
            (400.0, 60.0),
            (500.0, 60.0),
            (600.0, 60.0)
        ]
    );
    // Seventeen digits restore the exact number.
    let stack = Stack::parse(STEP).unwrap();
    let sampled = stack.sampled(&[400.0, 500.0, 600.0]).unwrap();
    let angles = [0.0, 60.0].map(|deg| Angle::from_degrees(deg).unwrap());
    let expected = sampled.powers_of_all(&[stack.thicknesses_nm().to_vec()], &angles);
    for (row, expected) in found.iter().zip(expected) {
        let (r, t) = (expected.reflectance, expected.transmittance);
        assert_eq!(row[2..], [r.s, r.p, t.s, t.p]);
    }
    assert!(ran.stdout.contains('e'), "{}", ran.stdout);
}

/// A case of independently computed figures: its media from the incident one on, each with its thickness, and rows of wavelength,
/// angle, Rs, Rp, Ts and Tp.
#[derive(Default)]
struct Case {
    media: BTreeMap<usize, (f64, [Vec<f64>; 3])>,
    rows: Vec<[f64; 6]>,
}

fn computed() -> BTreeMap<&'static str, Case> {
    let mut cases: BTreeMap<&str, Case> = BTreeMap::new();
    for cells in rows(include_str!("../../../../tests/data/films_media.csv")) {
        let case = cases.entry(cells[0]).or_default();
        let (thickness_nm, columns) = case.media.entry(cells[1].parse().unwrap()).or_default();
        *thickness_nm = number(cells[2]);
        for (column, cell) in columns.iter_mut().zip(&cells[3..]) {
            column.push(number(cell));
        }
    }
    for cells in rows(include_str!("../../../../tests/data/films.csv")) {
        let row: Vec<f64> = cells[1..].iter().map(|cell| number(cell)).collect();
        cases
            .entry(cells[0])
            .or_default()
            .rows
            .push(row.try_into().unwrap());
    }
    cases
}

/// A stack file with its tables inside.
fn stack_file(case: &Case) -> String {
    let table =
        |(_, [nm, n, k]): &(f64, [Vec<f64>; 3])| format!("{{ nm = {nm:?}, n = {n:?}, k = {k:?} }}");
    let last = case.media.len() - 1;
    let mut text = format!("incident = {}\n", case.media[&0].1[1][0]);
    text += &format!("substrate = {}\n", table(&case.media[&last]));
    for medium in 1..last {
        let (thickness_nm, _) = case.media[&medium];
        let index = table(&case.media[&medium]);
        text += &format!("[[layer]]\nindex = {index}\nthickness_nm = {thickness_nm}\n");
    }
    text
}

/// Bare metals, soap films, oxides and a mirror of seven layers (tmm 0.2.0), from a stack file to CSV.
#[test]
fn stack_files_give_the_figures_of_an_independent_computation() {
    let cases = computed();
    assert_eq!(cases.len(), 14);
    for (name, case) in &cases {
        let place = Place::default();
        std::fs::write(place.path("stack.toml"), stack_file(case)).unwrap();
        let asked = "--angles 0,30,60,80 --wavelengths 380:780:10 --format csv";
        let ran = place.film("stack.toml", asked).succeeded();
        let found: BTreeMap<_, _> = figures(&ran.stdout)
            .into_iter()
            .map(|row| ((row[0] as u32, row[1] as u32), row))
            .collect();
        assert_eq!(found.len(), 164);
        for expected in &case.rows {
            let row = &found[&(expected[0] as u32, expected[1] as u32)];
            for (a, b) in row.iter().zip(expected) {
                assert!((a - b).abs() < 1e-10, "{name}: {row:?} {expected:?}");
            }
        }
    }
}

#[test]
fn json_describes_its_content() {
    let place = Place::default();
    let text =
        "incident = 1\nsubstrate = \"silicon\"\n[[layer]]\nindex = [1.5, 0.1]\nthickness_nm = 80\n";
    std::fs::write(place.path("stack.toml"), text).unwrap();
    let asked = "--angles 0,30 --wavelengths 400,500 --format json --absorptance";
    let ran = place.film("stack.toml", asked).succeeded();
    let json: Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!(
        json["stack"]["layer"][0]["index"],
        serde_json::json!([1.5, 0.1])
    );
    assert_eq!(json["stack"]["substrate"], "silicon");
    assert!(json["backend"].as_str().unwrap().starts_with("CPU"));
    assert_eq!(json["wavelengths_nm"], serde_json::json!([400.0, 500.0]));
    let figure = |value: &Value| value.as_f64().unwrap();
    assert_eq!(figure(&json["indices"]["substrate"]["n"][0]), 5.613);
    for (angle, deg) in [0.0, 30.0].into_iter().enumerate() {
        let at = &json["angles"][angle];
        assert_eq!(figure(&at["angle_deg"]), deg);
        for w in 0..2 {
            let absorbed = figure(&at["layers"][0]["Ap"][w]);
            let sum = figure(&at["Rp"][w]) + figure(&at["Tp"][w]) + absorbed;
            assert!((sum - 1.0).abs() < 1e-12 && absorbed > 0.01);
        }
        assert!(at["color"]["srgb"].as_str().unwrap().starts_with('#'));
    }
}

#[test]
fn without_a_file_a_table_with_the_colors_is_printed() {
    let ran = film(STEP, "--angles 0,60").succeeded();
    assert_says(
        &ran.stdout,
        &[
            "1 | silica 300 nm | silicon",
            "0°: #4d6caf",
            "60°: #a68879",
            "Rs",
        ],
    );
    assert_eq!(
        ran.stdout
            .lines()
            .filter(|line| line.trim_start().starts_with("780 "))
            .count(),
        2
    );
    assert!(
        !ran.stdout.contains('\x1b'),
        "no colors where there is no terminal"
    );
    let short = film(
        STEP,
        "--wavelengths 550 --illuminant A --exposure 1 --transmitted",
    )
    .succeeded();
    assert_says(&short.stdout, &["transmitted under A, shown at +1 EV"]);
    assert_says(&short.stderr, &["not adapted to A"]);
    assert!(!ran.stderr.contains("adapted"), "{}", ran.stderr);
    assert_eq!(
        film(STEP, "--format table --angles 0,60")
            .succeeded()
            .stdout,
        ran.stdout
    );
}

/// The CPU computes in `f64` and the GPU in `f32`, so the numbers differ a little.
#[test]
fn the_gpu_agrees_with_the_cpu() {
    let stack = "1.5 | titania 60nm | silica 90nm | gold 20nm | bk7";
    let asked = "--angles 0,30,60,80 --format csv";
    let cpu = figures(&film(stack, asked).succeeded().stdout);
    let gpu = figures(
        &film(stack, &format!("{asked} --backend gpu"))
            .succeeded()
            .stdout,
    );
    assert_eq!(cpu.len(), gpu.len());
    let pairs = || cpu.iter().flatten().zip(gpu.iter().flatten());
    for (a, b) in pairs() {
        assert!((a - b).abs() < 5e-5, "{a} {b}");
    }
    assert!(
        pairs().any(|(a, b)| a != b),
        "all numbers are equal: both runs used the CPU"
    );
}

/// Data that end within the visible range give spectra, but no color.
#[test]
fn without_data_for_the_visible_range_there_is_no_color() {
    let place = Place::default();
    let text = "substrate = { nm = [400, 700], n = [1.5, 1.4] }\n";
    std::fs::write(place.path("stack.toml"), text).unwrap();
    let ran = place
        .film("stack.toml", "--wavelengths 400:700:100")
        .succeeded();
    assert_says(&ran.stdout, &["no color", "0.039946"]);
    let said = place.film("stack.toml", "").failed();
    assert_says(&said, &["380 nm", "the substrate", "400 to 700 nm"]);
}
