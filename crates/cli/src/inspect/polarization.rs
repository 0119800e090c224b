//! Degrees and angles of polarization.

use pellicle::color::Probe;
use pellicle::spectra::stokes::{
    angle_of_linear_polarization_deg, degree_of_circular_polarization,
    degree_of_linear_polarization, degree_of_polarization,
};
use serde_json::{Value, json};

/// The polarization of the luminance.
pub(super) fn line(stokes: [f64; 4]) -> String {
    let Some(degree) = degree(degree_of_polarization, stokes) else {
        return "polarization: none, as there is no light".to_owned();
    };
    let at = angle(stokes).map_or(String::new(), |angle| format!(" at {angle:.2}°"));
    format!(
        "polarization {:.2} %: {:.2} % linear{at}, {}",
        100.0 * degree,
        100.0 * degree_of_linear_polarization(stokes),
        circular(degree_of_circular_polarization(stokes))
    )
}

fn circular(degree: f64) -> String {
    let hand = match degree {
        _ if degree.abs() < ROUNDING => "",
        _ if degree < 0.0 => "left ",
        _ => "right ",
    };
    format!("{:.2} % {hand}circular", 100.0 * degree.abs())
}

/// A degree of polarization below this is a rounding error of 0: it has neither an angle nor a hand.
const ROUNDING: f64 = 1e-6;

/// A degree of polarization; `None` where there is no light.
fn degree(of: fn([f64; 4]) -> f64, stokes: [f64; 4]) -> Option<f64> {
    (stokes[0] > 0.0).then(|| of(stokes))
}

/// The angle of linear polarization, degrees; `None` where there is none.
fn angle(stokes: [f64; 4]) -> Option<f64> {
    let degree = degree(degree_of_linear_polarization, stokes)?;
    (degree >= ROUNDING).then(|| angle_of_linear_polarization_deg(stokes))
}

/// A number with some decimals, or a dash.
fn shown(number: Option<f64>, decimals: usize) -> String {
    number.map_or_else(|| "-".to_owned(), |number| format!("{number:.decimals$}"))
}

/// The headings of [`columns`].
pub(super) fn heading() -> String {
    format!(" {:>7} {:>7} {:>8}", "DoP", "AoLP/°", "DoCP")
}

/// The degree of polarization of a band, its angle, and its circular degree with its sign.
pub(super) fn columns(stokes: [f64; 4]) -> String {
    format!(
        " {:>7} {:>7} {:>8}",
        shown(degree(degree_of_polarization, stokes), 4),
        shown(angle(stokes), 2),
        shown(degree(degree_of_circular_polarization, stokes), 4)
    )
}

/// Components, degrees and angles of each band and of the luminance; null if the image is not polarized.
pub(super) fn json(probe: &Probe) -> Value {
    let (Some(components), Some(luminance)) = (&probe.polarized, probe.stokes_of_luminance())
    else {
        return Value::Null;
    };
    let bands = || (0..probe.radiance.len()).filter_map(|band| probe.stokes(band));
    let each = |of| bands().map(|stokes| degree(of, stokes)).collect::<Vec<_>>();
    let [s1, s2, s3] = components;
    json!({
        "s1": s1.radiance, "s2": s2.radiance, "s3": s3.radiance,
        "degree": each(degree_of_polarization),
        "linear_degree": each(degree_of_linear_polarization),
        "circular_degree": each(degree_of_circular_polarization),
        "angle_deg": bands().map(angle).collect::<Vec<_>>(),
        "of_luminance": {
            "stokes": luminance,
            "degree": degree(degree_of_polarization, luminance),
            "linear_degree": degree(degree_of_linear_polarization, luminance),
            "circular_degree": degree(degree_of_circular_polarization, luminance),
            "angle_deg": angle(luminance),
        },
    })
}
