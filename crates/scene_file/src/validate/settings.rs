//! Render settings: from `[render]` to [`RenderSettings`].

use super::checks::Checks;
use crate::description::Render;
use crate::limits;
use document::{FieldPath, Problem, ProblemKind, Range};
use scene::RenderSettings;
use spectra::BandGrid;

/// The result of checking `[render]`.
pub(crate) struct Checked {
    /// `None` if there is a problem.
    pub(crate) settings: Option<RenderSettings>,
    /// The bands, if at least they are valid.
    pub(crate) grid: Option<BandGrid>,
}

/// Checks `[render]`.
pub(crate) fn check(checks: &mut Checks, render: &Render) -> Checked {
    let top = FieldPath::root().key("render");
    let grid = grid(checks, &top, render);
    let size = size(checks, &top, render.size);
    let samples = whole(
        checks,
        &top.key("samples"),
        render.samples,
        limits::MAX_SAMPLES,
    );
    let most_segments = RenderSettings::MAX_PATH_SEGMENTS;
    let segments = top.key("max_path_segments");
    let max_path_segments = whole(checks, &segments, render.max_path_segments, most_segments);
    let film_splits = at_most(
        checks,
        &top.key("film_splits"),
        render.film_splits,
        RenderSettings::MAX_FILM_SPLITS,
    );
    let roulette = top.key("roulette_after");
    let roulette_after = whole(checks, &roulette, render.roulette_after, most_segments);
    let clamp = render
        .clamp
        .map(|clamp| checks.number(&top.key("clamp"), clamp, &limits::CLAMP));
    let exposure = top.key("exposure_ev");
    let exposure_ev = checks.number(&exposure, render.exposure_ev, &limits::EXPOSURE_EV);
    let time_s = checks.number(&top.key("time_s"), render.time_s, &limits::TIME_S);
    let step = top.key("time_step_s");
    let time_step_s = checks.number(&step, render.time_step_s, &limits::TIME_S);
    checks.time_s = time_s.unwrap_or(0.0);
    let settings = || {
        time_step_s?;
        let [width, height] = size?;
        Some(RenderSettings {
            width,
            height,
            samples: samples?,
            sampler: render.sampler,
            seed: render.seed,
            bands: grid?,
            sampling: render.sampling,
            polarization: render.polarization,
            max_path_segments: max_path_segments?,
            direct_light: render.direct_light,
            film_splits: film_splits?,
            roulette_after: roulette_after?,
            clamp: match clamp {
                Some(checked) => Some(checked?),
                None => None,
            },
            exposure_ev: exposure_ev?,
            time_s: time_s?,
        })
    };
    Checked {
        settings: settings(),
        grid,
    }
}

/// A whole number from 1 to `most`.
fn whole(checks: &mut Checks, field: &FieldPath, value: u32, most: u32) -> Option<u32> {
    whole_from(checks, field, value, (1, most))
}

/// A whole number from 0 to `most`.
fn at_most(checks: &mut Checks, field: &FieldPath, value: u32, most: u32) -> Option<u32> {
    whole_from(checks, field, value, (0, most))
}

fn whole_from(
    checks: &mut Checks,
    field: &FieldPath,
    value: u32,
    (least, most): (u32, u32),
) -> Option<u32> {
    let range = Range {
        low: f64::from(least),
        high: f64::from(most),
        unit: "",
    };
    checks
        .number(field, f64::from(value), &range)
        .map(|_| value)
}

fn size(checks: &mut Checks, top: &FieldPath, size: [u32; 2]) -> Option<[u32; 2]> {
    let field = top.key("size");
    let width = whole(checks, &field.index(0), size[0], RenderSettings::MAX_SIDE);
    let height = whole(checks, &field.index(1), size[1], RenderSettings::MAX_SIDE);
    Some([width?, height?])
}

/// Checks the bands. The ends are rounded to `f32` here: that both renderers have the same grid to the last bit is worth an error of 2e-5
/// nm.
fn grid(checks: &mut Checks, top: &FieldPath, render: &Render) -> Option<BandGrid> {
    let field = top.key("wavelengths_nm");
    let [first, last] = render.wavelengths_nm;
    let first_nm = checks.number(&field.index(0), first, &limits::BAND_NM);
    let last_nm = checks.number(&field.index(1), last, &limits::BAND_NM);
    let count = whole(checks, &top.key("bands"), render.bands, BandGrid::MAX_COUNT);
    let (first_nm, last_nm) = (f64::from(first_nm? as f32), f64::from(last_nm? as f32));
    if last_nm - first_nm < limits::MIN_BAND_RANGE_NM {
        let message = format!(
            "found {first} to {last} nm; the second must be at least {} nm above the first",
            limits::MIN_BAND_RANGE_NM
        );
        checks.report(Problem::new(ProblemKind::Inconsistent, &field, message));
        return None;
    }
    let grid = BandGrid::new(first_nm, last_nm, count?);
    let refuse = |error| Problem::new(ProblemKind::OutOfRange, top, format!("{error}"));
    grid.map_err(|error| checks.report(refuse(error))).ok()
}
