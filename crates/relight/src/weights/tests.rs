use super::*;
use crate::xyz::exposure_scale;

const OBSERVER: Observer = Observer::Cie1931Deg2;

fn lamp(grid: &BandGrid, name: &str) -> Tabulated {
    grid.lamp(&spectra::illuminant(name).unwrap().data).unwrap()
}

/// The bands of a lamp's light after a transfer, each the mean over 200 points.
fn bands(grid: &BandGrid, lamp: &Tabulated, transfer: impl Fn(f64) -> f64) -> Vec<f32> {
    let mean = |band| {
        let points = (0..200).map(|i| grid.wavelength_nm(band, (f64::from(i) + 0.5) / 200.0));
        let sum: f64 = points.map(|nm| lamp.clamped_at(nm) * transfer(nm)).sum();
        (sum / 200.0) as f32
    };
    (0..grid.count()).map(mean).collect()
}

fn assert_near(found: [f64; 3], expected: [f64; 3], tolerance: f64, what: &str) {
    for (found, expected) in found.iter().zip(expected) {
        let error = found / expected - 1.0;
        assert!(error.abs() < tolerance, "{what}: {error:e}");
    }
}

/// Reflectance of a free film of index 4/3 in air at normal incidence, by Airy's sum over all beams.
fn film(thickness_nm: f64, nm: f64) -> f64 {
    let n = 4.0_f64 / 3.0;
    let r2 = ((1.0 - n) / (1.0 + n)).powi(2);
    let half_phase = 2.0 * std::f64::consts::PI * n * thickness_nm / nm;
    let f = 4.0 * r2 / (1.0 - r2).powi(2) * half_phase.sin().powi(2);
    f / (1.0 + f)
}

#[test]
fn equal_energy_of_one_is_one_to_every_observer() {
    for bands in [1, 2, 7, 40, 400] {
        let grid = BandGrid::visible(bands).unwrap();
        for observer in Observer::ALL {
            let xyz = BandWeights::observed(&grid, observer).xyz(&vec![1.0; bands as usize]);
            // The 1 nm sum counts both ends fully, the integral by half: 2.5e-7 in Y. The tables of 2015 start at 390 nm.
            let error = xyz[1] * exposure_scale(0.0) - 1.0;
            assert!(error.abs() < 2e-6, "{bands}, {observer:?}: {error:e}");
        }
    }
}

/// XYZ of free films of index 4/3 in D65, from sums at 1 nm, computed independently of this code (numpy).
const FILMS: [(f64, [f64; 3]); 3] = [
    (100.0, [7.162_974_235, 7.723_408_026, 7.901_314_441]),
    (250.0, [2.467_596_401, 3.044_270_922, 8.058_016_66]),
    (320.0, [5.732_695_308, 6.910_545_627, 1.753_966_797]),
];

/// From the bands of the film under D65 itself, and from its bands under another lamp.
#[test]
fn films_have_the_color_of_an_independent_computation() {
    for (thickness_nm, expected) in FILMS {
        for (count, tolerance) in [(400, 2e-4), (80, 2e-4), (40, 1e-3)] {
            let grid = BandGrid::visible(count).unwrap();
            let d65 = lamp(&grid, "D65");
            for before in ["D65", "A", "E", "FL2"] {
                let before_lamp = lamp(&grid, before);
                let weights = BandWeights::new(&grid, &before_lamp, &d65, OBSERVER).unwrap();
                let seen = bands(&grid, &before_lamp, |nm| film(thickness_nm, nm));
                let xyz = weights.xyz(&seen).map(|v| 100.0 * exposure_scale(0.0) * v);
                let what = format!("{thickness_nm} nm, {count} bands, from {before}");
                assert_near(xyz, expected, tolerance, &what);
            }
        }
    }
}

/// A transfer that is a parabola is recovered exactly, whatever the lamps and the width of the bands.
#[test]
fn a_parabola_is_relit_exactly() {
    let transfer = |nm: f64| 0.3 + ((nm - 560.0) / 300.0).powi(2) + (nm - 560.0) / 900.0;
    for (count, before, after) in [(8, "D65", "FL11"), (40, "A", "LED-B3"), (16, "D65", "HP1")] {
        let grid = BandGrid::visible(count).unwrap();
        let (before, after) = (lamp(&grid, before), lamp(&grid, after));
        let weights = BandWeights::new(&grid, &before, &after, OBSERVER).unwrap();
        let seen = bands(&grid, &before, transfer);
        let fine = BandGrid::visible(400).unwrap();
        let expected = BandWeights::observed(&fine, OBSERVER).xyz(&bands(&fine, &after, transfer));
        // The expected bands are means over 1 nm, whose product with the observer has an error of 1e-4.
        assert_near(
            weights.xyz(&seen),
            expected,
            2e-4,
            &format!("{count} bands"),
        );
        let expected = bands(&grid, &after, transfer);
        for (found, expected) in weights.relit(&seen).zip(expected) {
            assert!((found - f64::from(expected)).abs() < 2e-4 * f64::from(expected).max(0.1));
        }
    }
}

#[test]
fn the_same_lamp_leaves_the_bands_as_they_are() {
    for name in ["D65", "FL11", "HP1", "LED-RGB1"] {
        for count in [1, 2, 3, 16, 40, 80] {
            let grid = BandGrid::visible(count).unwrap();
            let lamp = lamp(&grid, name);
            let weights = BandWeights::new(&grid, &lamp, &lamp, OBSERVER).unwrap();
            let seen = bands(&grid, &lamp, |nm| film(700.0, nm));
            for (found, &before) in weights.relit(&seen).zip(&seen) {
                let error = found - f64::from(before);
                assert!(
                    error.abs() <= 1e-6 * f64::from(before),
                    "{name}, {count}: {error:e}"
                );
            }
        }
    }
}

/// The noise of the bands grows by a bounded factor, whatever the lamp of the render.
#[test]
fn line_lamps_do_not_magnify_noise() {
    for name in ["FL11", "HP1", "HP5", "LED-RGB1"] {
        for count in [16, 40, 80] {
            let grid = BandGrid::visible(count).unwrap();
            let (before, after) = (lamp(&grid, name), lamp(&grid, "D65"));
            let Ok(weights) = BandWeights::new(&grid, &before, &after, OBSERVER) else {
                continue;
            };
            let knots = Knots::new(&grid, &[&before, &after]);
            let powers = Lamp::new(&grid, &|nm| before.clamped_at(nm), &knots).means;
            let targets = Lamp::new(&grid, &|nm| after.clamped_at(nm), &knots).means;
            for (band, (first, own)) in weights.bands.iter().enumerate() {
                let gain: f64 = own
                    .iter()
                    .zip(&powers[*first..])
                    .map(|(w, power)| (w * power / targets[band]).powi(2))
                    .sum();
                assert!(gain.sqrt() < 2.5, "{name}, {count}: {}", gain.sqrt());
            }
        }
    }
}

#[test]
fn light_from_nothing_is_refused() {
    let grid = BandGrid::visible(40).unwrap();
    let points = vec![(380.0, 0.0), (420.0, 0.0), (430.0, 1.0), (780.0, 1.0)];
    let yellow = Tabulated::new(points).unwrap();
    let d65 = lamp(&grid, "D65");
    let refused = BandWeights::new(&grid, &yellow, &d65, OBSERVER);
    // Four dark bands have 4e-4 of the Y of D65; the last of them has the most.
    let (from_nm, to_nm) = (410.0, 420.0);
    assert_eq!(refused, Err(DarkBand { from_nm, to_nm }));
    assert!(BandWeights::new(&grid, &d65, &yellow, OBSERVER).is_ok());
    assert!(BandWeights::new(&grid, &yellow, &yellow, OBSERVER).is_ok());
}

/// LED-B2 is 0 from 380 to 390 nm, where D65 has 3e-6 of its Y.
#[test]
fn dark_bands_that_nobody_sees_stay_dark() {
    let grid = BandGrid::visible(40).unwrap();
    let (led, d65) = (lamp(&grid, "LED-B2"), lamp(&grid, "D65"));
    let seen = bands(&grid, &led, |_| 0.5);
    assert_eq!(seen[0], 0.0);
    let weights = BandWeights::new(&grid, &led, &d65, OBSERVER).unwrap();
    let expected = BandWeights::observed(&grid, OBSERVER).xyz(&bands(&grid, &d65, |_| 0.5));
    let found = weights.xyz(&seen);
    let y = found[1] / expected[1] - 1.0;
    assert!(y.abs() < BandWeights::DARK_SHARE, "{y:e}");
    let relit: Vec<f64> = weights.relit(&seen).collect();
    assert_eq!(relit[0], 0.0);
    assert!(relit.iter().skip(1).all(|&value| value > 0.1));
}

/// A lamp with a spectral line between two knots: the image holds the light of the knots, and a transfer that is a parabola is
/// recovered up to the `f32` rounding of the image. The lamp's own points give another result.
#[test]
fn a_line_between_knots_is_the_one_that_was_rendered() {
    let grid = BandGrid::visible(16).unwrap();
    let points = vec![
        (380.0, 1.0),
        (549.3, 1.0),
        (550.4, 90.0),
        (551.1, 1.0),
        (780.0, 1.5),
    ];
    let points = Tabulated::new(points).unwrap();
    let spectrum = spectra::Spectrum::Table(points.clone());
    let table = spectra::BandTable::new(&grid, &spectrum).unwrap();
    let transfer = |nm: f64| 0.3 + ((nm - 560.0) / 300.0).powi(2);
    // The mean over a band of the table times the parabola: Simpson's rule is exact between two knots.
    let steps = table.steps();
    let seen: Vec<f32> = (0..grid.count())
        .map(|band| {
            let light = |at: f64| {
                let offset = at / f64::from(steps);
                table.at(band, offset) * transfer(grid.wavelength_nm(band, offset))
            };
            let step = |i: u32| {
                let at = f64::from(i);
                (light(at) + 4.0 * light(at + 0.5) + light(at + 1.0)) / 6.0
            };
            ((0..steps).map(step).sum::<f64>() / f64::from(steps)) as f32
        })
        .collect();
    let off = |before: &Tabulated| {
        let ideal = Tabulated::new(vec![(380.0, 1.0), (780.0, 1.0)]).unwrap();
        let relit = BandWeights::new(&grid, before, &ideal, OBSERVER).unwrap();
        let mean = |band| {
            // ∫ of the parabola over a band, by Simpson's rule.
            let at = |offset| transfer(grid.wavelength_nm(band, offset));
            (at(0.0) + 4.0 * at(0.5) + at(1.0)) / 6.0
        };
        let errors = (0..)
            .zip(relit.relit(&seen))
            .map(|(band, value)| value / mean(band) - 1.0);
        errors.fold(0.0, |most: f64, error| most.max(error.abs()))
    };
    let rendered = grid.lamp(&spectrum).unwrap();
    assert!(off(&rendered) < 1e-6, "{:e}", off(&rendered));
    assert!(off(&points) > 1e-2, "{:e}", off(&points));
}
