//! Functions of spectrum.wgsl and lifting.wgsl: spectra at the wavelengths of a sample.

use crate::world::{BANDS, GROUPS, bands_of, everything, rows, value_of, within};
use crate::{Check, lazy};
use pellicle_tests::tolerances::{ARITHMETIC, KNOT, SMOOTH, SPECTRUM};

fn steps() -> u32 {
    everything().packed.frame.steps
}

/// A spectrum, or one of the observer's, which come after them and are 0 beyond the last band.
fn spectrum_twin(a: &[f64]) -> Vec<f64> {
    let (scene, spectrum) = (&everything().scene, a[0] as usize);
    let value = |band| match spectrum.checked_sub(scene.spectra().len()) {
        None => value_of(spectrum, band, a[2]),
        Some(_) if band >= BANDS => 0.0,
        Some(of_three) => scene.observer()[of_three].at(band, a[2]),
    };
    bands_of(a[1]).map(value).to_vec()
}

fn world_bands() -> &'static spectra::BandGrid {
    &everything().scene.settings().bands
}

/// Offsets away from knots of the spectra.
fn offsets() -> Vec<f32> {
    let mut offsets = rows(1, |u| {
        let position = u[0] * f64::from(steps());
        ((position - position.round()).abs() > 1e-5).then(|| u.to_vec())
    });
    offsets.extend([0.0, 0.5, 0.999_999_94]);
    offsets
}

pub(crate) fn checks() -> Vec<Check> {
    vec![
        Check {
            probe: within(
                everything,
                (1, 3),
                "let w = wavelengths_at(a(0u)); put(0u, w.offset); put(1u, f32(w.knot)); put(2u, w.fraction);",
            ),
            proves: &["wavelengths_at"],
            inputs: lazy(offsets),
            twin: |a| {
                let position = a[0] * f64::from(steps());
                vec![a[0], position.floor(), position - position.floor()]
            },
            tolerance: KNOT,
        },
        Check {
            probe: within(
                everything,
                (3, 4),
                "put4(0u, spectrum_at(u32(a(0u)), u32(a(1u)), wavelengths_at(a(2u))));",
            ),
            proves: &["spectra_row", "spectrum_at"],
            inputs: lazy(|| {
                let count = (everything().scene.spectra().len() + 3) as f64;
                rows(3, |u| {
                    let group = (u[1] * f64::from(GROUPS)).floor();
                    Some(vec![(u[0] * count).floor(), group, u[2]])
                })
            }),
            twin: spectrum_twin,
            tolerance: SPECTRUM,
        },
        Check {
            probe: within(
                everything,
                (5, 4),
                "put4(0u, smooth_value(a3(0u), u32(a(3u)), wavelengths_at(a(4u))));",
            ),
            proves: &["smooth_value"],
            inputs: lazy(move || {
                rows(5, |u| {
                    let spread = |u: f64| 20.0 * (2.0 * u - 1.0).powi(3);
                    let group = (u[3] * f64::from(GROUPS)).floor();
                    Some(vec![spread(u[0]), spread(u[1]), spread(u[2]), group, u[4]])
                })
            }),
            twin: |a| {
                let bands = world_bands();
                let value = |lane: u32| {
                    let nm = bands.wavelength_nm(4 * a[3] as u32 + lane, a[4]);
                    reference::smooth_value([a[0], a[1], a[2]], nm)
                };
                (0..4).map(value).collect()
            },
            tolerance: SMOOTH,
        },
        Check {
            // In 1/µm, so that the numbers are of order one.
            probe: within(
                everything,
                (2, 4),
                "put4(0u, 1000.0 * inverse_wavelengths(u32(a(0u)), wavelengths_at(a(1u))));",
            ),
            proves: &["inverse_wavelengths"],
            inputs: lazy(move || rows(2, |u| Some(vec![(u[0] * f64::from(GROUPS)).floor(), u[1]]))),
            twin: |a| {
                let grid = &everything().scene.settings().bands;
                bands_of(a[0])
                    .map(|band| 1000.0 / grid.wavelength_nm(band, a[1]))
                    .to_vec()
            },
            tolerance: ARITHMETIC,
        },
    ]
}
