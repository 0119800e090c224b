//! Compares the white points of the illuminants with an independent computation and with the values published by the CIE.

use colorimetry::chromaticity::xy_of_xyz;
use colorimetry::tristimulus::{Rule, Weights, xyz_of_emission};
use spectra::{KM_LUMENS_PER_WATT, Observer, Spectrum, Tabulated, find_illuminant};

const COMPUTED: &str = include_str!("data/white_points.csv");
const PUBLISHED: &str = include_str!("data/published_chromaticities.csv");

/// The cells of a table, without comments and header.
fn rows(table: &str) -> impl Iterator<Item = Vec<&str>> {
    let lines = table.lines().filter(|line| !line.starts_with('#')).skip(1);
    lines.map(|line| line.split(',').collect())
}

fn numbers(cells: &[&str]) -> Vec<f64> {
    cells.iter().map(|cell| cell.parse().unwrap()).collect()
}

/// XYZ of an illuminant, with Y = 100.
fn white(light: &Spectrum, observer: &str, rule: &str) -> [f64; 3] {
    let weights = Weights::new(light, observer.parse().unwrap(), rule.parse().unwrap()).unwrap();
    weights.white().map(|v| 100.0 * v)
}

/// The largest difference between expected and computed values in XYZ and in x, y, and the number of rows.
fn worst(change: impl Fn(Spectrum) -> Spectrum) -> (f64, usize) {
    let mut worst: f64 = 0.0;
    let mut count = 0;
    for row in rows(COMPUTED) {
        let light = change(find_illuminant(row[1]).unwrap().data);
        let xyz = white(&light, row[0], row[2]);
        let found = xyz.into_iter().chain(xy_of_xyz(xyz));
        for (found, expected) in found.zip(numbers(&row[3..])) {
            worst = worst.max((found - expected).abs());
        }
        count += 1;
    }
    (worst, count)
}

#[test]
fn white_points_equal_an_independent_computation() {
    let (worst, count) = worst(|light| light);
    // The values have twelve digits and are up to 131.
    assert!(worst < 1e-9, "{worst:e}");
    assert_eq!(count, 92);
}

/// A point of the table that is 1 % off is noticed.
#[test]
fn a_slightly_different_light_is_noticed() {
    let (worst, _) = worst(|light| match light {
        Spectrum::Table(table) => {
            let bent = table
                .points()
                .map(|(nm, v)| (nm, if nm == 550.0 { 1.01 * v } else { v }));
            Spectrum::Table(Tabulated::new(bent.collect()).unwrap())
        }
        other => other,
    });
    assert!(worst > 1e-3, "{worst:e}");
}

#[test]
fn chromaticities_are_those_that_the_cie_publishes() {
    let mut count = 0;
    for row in rows(PUBLISHED) {
        let light = find_illuminant(row[1]).unwrap().data;
        let found = xy_of_xyz(white(&light, row[0], "5nm"));
        for (found, cell) in found.into_iter().zip(&row[2..]) {
            let digits = cell.split_once('.').unwrap().1.len() as i32;
            let expected: f64 = cell.parse().unwrap();
            // The published values come from sums from 360 to 830 nm, some at 1 nm, and from a rounded table of B: they differ by 1.6
            // units of the last digit at most.
            let tolerance = 1.6 * 10.0_f64.powi(-digits);
            assert!((found - expected).abs() <= tolerance, "{row:?}: {found}");
        }
        count += 1;
    }
    assert_eq!(count, 35);
}

/// A radiance of 1 has the luminance K_m Σ ȳ Δλ, nearly the same by both rules; XYZ is proportional to a constant reflectance.
#[test]
fn emissions_are_absolute() {
    let one = Spectrum::Constant(1.0);
    for observer in Observer::ALL {
        let [coarse, fine] =
            Rule::ALL.map(|rule| xyz_of_emission(&one, observer, rule).unwrap()[1]);
        assert!(
            (coarse / fine - 1.0).abs() < 1e-3,
            "{observer}: {coarse} {fine}"
        );
    }
    let found = xyz_of_emission(&one, Observer::Cie1931Deg2, Rule::OneNm).unwrap();
    // Σ ȳ at 1 nm from 380 to 780 nm of the CIE's table: 106.856.
    assert!(
        (found[1] / KM_LUMENS_PER_WATT - 106.856).abs() < 1e-3,
        "{found:?}"
    );
    let half = Spectrum::Constant(0.5);
    let weights = Weights::new(&one, Observer::Cie1931Deg2, Rule::OneNm).unwrap();
    assert!((weights.xyz_of(&half).unwrap()[1] - 0.5).abs() < 1e-14);
    let short = Spectrum::Table(Tabulated::new(vec![(400.0, 1.0), (780.0, 1.0)]).unwrap());
    assert!(weights.xyz_of(&short).is_err());
    assert!(Weights::new(&Spectrum::Constant(0.0), Observer::Cie1931Deg2, Rule::OneNm).is_err());
}
