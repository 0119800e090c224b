//! Degrees and angles of polarization.

use pellicle::color::Probe;
use pellicle::spectra::stokes::{
    angle_of_linear_polarization_deg, degree_of_circular_polarization,
    degree_of_linear_polarization, degree_of_polarization,
};
use serde_json::{Value, json};

/// The polarization of the luminance.
pub(super) fn line(stokes: [f64; 4]) -> String {
    format!(
        "polarization {:.2} %: {:.2} % linear at {:.2}°, {}",
        100.0 * degree_of_polarization(stokes),
        100.0 * degree_of_linear_polarization(stokes),
        angle_of_linear_polarization_deg(stokes),
        circular(degree_of_circular_polarization(stokes))
    )
}

fn circular(degree: f64) -> String {
    let hand = if degree < 0.0 { "left" } else { "right" };
    format!("{:.2} % {hand} circular", 100.0 * degree.abs())
}

/// The headings of [`columns`].
pub(super) fn heading() -> String {
    format!(" {:>7} {:>7} {:>8}", "DoP", "AoLP/°", "DoCP")
}

/// The degree of polarization of a band, its angle, and its circular degree with its sign.
pub(super) fn columns(stokes: [f64; 4]) -> String {
    format!(
        " {:>7.4} {:>7.2} {:>8.4}",
        degree_of_polarization(stokes),
        angle_of_linear_polarization_deg(stokes),
        degree_of_circular_polarization(stokes)
    )
}

/// Components, degrees and angles of each band and of the luminance; null if the image is not polarized.
pub(super) fn json(probe: &Probe) -> Value {
    let (Some(components), Some(luminance)) = (&probe.polarized, probe.stokes_of_luminance())
    else {
        return Value::Null;
    };
    let bands = || (0..probe.radiance.len()).filter_map(|band| probe.stokes(band));
    let each = |of: fn([f64; 4]) -> f64| bands().map(of).collect::<Vec<_>>();
    let [s1, s2, s3] = components;
    json!({
        "s1": s1.radiance, "s2": s2.radiance, "s3": s3.radiance,
        "degree": each(degree_of_polarization),
        "linear_degree": each(degree_of_linear_polarization),
        "circular_degree": each(degree_of_circular_polarization),
        "angle_deg": each(angle_of_linear_polarization_deg),
        "of_luminance": {
            "stokes": luminance,
            "degree": degree_of_polarization(luminance),
            "linear_degree": degree_of_linear_polarization(luminance),
            "circular_degree": degree_of_circular_polarization(luminance),
            "angle_deg": angle_of_linear_polarization_deg(luminance),
        },
    })
}
