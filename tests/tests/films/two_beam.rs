//! Two beams and Newton's colors against independent computations; no device is needed.

use optics::{PathDifference, film, two_beam};
use pellicle_tests::agreement::compare;
use pellicle_tests::colorimetry::xyz;
use pellicle_tests::tables::{number, rows};
use pellicle_tests::tolerances::{ORACLE, ORACLE_RGB, ORACLE_TWO_BEAM, ORACLE_XYZ};

const TWO_BEAM: &str = include_str!("../../data/two_beam.csv");
const NEWTON: &str = include_str!("../../data/newton_series.csv");
const WATER: f64 = 4.0 / 3.0;

fn path(name: &str) -> PathDifference {
    match name {
        "optical" => PathDifference::Optical,
        "as_printed" => PathDifference::AsPrinted,
        other => panic!("{other} is not a path difference"),
    }
}

/// Rs and Rp of every row of `two_beam.csv`, as found and expected; then the same of the exact film.
fn reflectances(index: f64) -> [(Vec<f64>, Vec<f64>); 2] {
    let [mut beams, mut exact] = [(vec![], vec![]), (vec![], vec![])];
    for row in rows(TWO_BEAM) {
        let (d, nm) = (number(row[0]), number(row[2]));
        let cosine = number(row[1]).to_radians().cos();
        let r = two_beam(index, d, nm, cosine, path(row[3])).reflectance;
        beams.0.extend([r.s, r.p]);
        beams.1.extend([number(row[4]), number(row[5])]);
        let r = film(index.into(), d, nm, cosine).reflectance;
        exact.0.extend([r.s, r.p]);
        exact.1.extend([number(row[6]), number(row[7])]);
    }
    [beams, exact]
}

#[test]
fn two_beams_agree_with_independent_figures() {
    let [beams, exact] = reflectances(WATER);
    assert_eq!(beams.0.len(), 320 * 2);
    for ((found, expected), tolerance) in [(beams, ORACLE_TWO_BEAM), (exact, ORACLE)] {
        match compare(&found, &expected, tolerance) {
            Ok(report) => println!("{report}"),
            Err(report) => panic!("{report}"),
        }
    }
}

#[test]
fn a_wrong_index_or_the_other_path_is_noticed() {
    let [beams, exact] = reflectances(1.01 * WATER);
    assert!(compare(&beams.0, &beams.1, ORACLE_TWO_BEAM).is_err());
    assert!(compare(&exact.0, &exact.1, ORACLE).is_err());
    let [(mut found, expected), _] = reflectances(WATER);
    // The rows alternate between the two paths, two numbers each.
    found.rotate_left(2);
    assert!(compare(&found, &expected, ORACLE_TWO_BEAM).is_err());
}

/// XYZ and linear sRGB of every row of `newton_series.csv`, by the chain reflectance, XYZ, display.
fn newton(index: f64) -> Vec<(String, [f64; 6], Vec<f64>)> {
    let of_row = |row: Vec<&str>| {
        let d = number(row[2]);
        let reflectance = |nm: f64| match row[0] {
            "airy" => film(index.into(), d, nm, 1.0).reflectance.unpolarized(),
            beams => two_beam(index, d, nm, 1.0, path(beams))
                .reflectance
                .unpolarized(),
        };
        let [x, y, z] = xyz(row[1], reflectance);
        let [r, g, b] = colorimetry::srgb::linear_from_xyz([x, y, z].map(|v| v / 100.0));
        let expected = row[3..9].iter().map(|cell| number(cell)).collect();
        (row[..3].join(" "), [x, y, z, r, g, b], expected)
    };
    rows(NEWTON).map(of_row).collect()
}

#[test]
fn newtons_series_has_the_colors_of_independent_computations() {
    let colors = newton(WATER);
    assert_eq!(colors.len(), 3 * 2 * 41);
    for (name, found, expected) in colors {
        if name.starts_with("airy") && name.ends_with(" 0") {
            assert!(found.iter().all(|x| x.abs() < 1e-12), "{name}: {found:?}");
            assert!(expected.iter().all(|x| *x == 0.0));
            continue;
        }
        for (range, tolerance) in [(0..3, ORACLE_XYZ), (3..6, ORACLE_RGB)] {
            if let Err(report) = compare(&found[range.clone()], &expected[range], tolerance) {
                panic!("{name}: {report}");
            }
        }
    }
}

#[test]
fn a_series_with_a_wrong_index_is_noticed() {
    for (name, found, expected) in newton(1.01 * WATER) {
        if !(name.starts_with("airy") && name.ends_with(" 0")) {
            assert!(
                compare(&found[..3], &expected[..3], ORACLE_XYZ).is_err(),
                "{name}"
            );
            assert!(
                compare(&found[3..], &expected[3..], ORACLE_RGB).is_err(),
                "{name}"
            );
        }
    }
}
