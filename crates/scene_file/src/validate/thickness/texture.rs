//! Textured thicknesses: swirls and pictures.

use crate::description;
use crate::limits;
use crate::validate::checks::{Checks, placed_size};
use crate::validate::picture_file;
use document::{FieldPath, Problem, ProblemKind};
use scene::{Picture, Swirls, Thickness};
use std::path::Path;
use std::sync::Arc;

/// Checks swirls and advances them to the scene's time.
pub(super) fn swirls(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Swirls,
) -> Option<Thickness> {
    let nm = &limits::THICKNESS_NM;
    let mean = checks.number(&field.key("mean"), written.mean, nm);
    let amplitude = checks.number(&field.key("amplitude"), written.amplitude, nm);
    let scale = checks.number(&field.key("scale"), written.scale, &limits::SWIRL_SCALE);
    let warp = checks.number(&field.key("warp"), written.warp, &limits::WARP);
    let rate = checks.number(&field.key("rate"), written.rate, &limits::SWIRL_RATE);
    let octaves = checks.number(
        &field.key("octaves"),
        f64::from(written.octaves),
        &limits::OCTAVES,
    );
    let lives = rate? * checks.time_s;
    octaves?;
    Some(Thickness::Swirls(Swirls {
        mean: mean?,
        amplitude: amplitude?,
        cells_per_unit: 1.0 / scale?,
        seed: written.seed,
        octaves: written.octaves,
        warp: warp?,
        cells: (lives.floor() % 2.0_f64.powi(32)) as u32,
        phase: lives.fract(),
    }))
}

/// Checks a picture and reads its file.
pub(super) fn picture(
    checks: &mut Checks,
    field: &FieldPath,
    (image, channel): (&Path, Option<description::PictureChannel>),
    (min, max): (f64, f64),
    size: Option<[f64; 2]>,
) -> Option<Thickness> {
    let black_nm = checks.number(&field.key("min"), min, &limits::THICKNESS_NM);
    let white_nm = checks.number(&field.key("max"), max, &limits::THICKNESS_NM);
    let size = placed_size(checks, &field.key("size"), size);
    let path = checks.path(&field.key("image"), image)?;
    let mut notes = Vec::new();
    let file = match picture_file::read(&path, channel, &mut notes) {
        Ok(file) => Some(Arc::new(file)),
        Err(error) => {
            let message = format!("{}: {error}", path.display());
            checks.report(Problem::new(
                ProblemKind::File,
                &field.key("image"),
                message,
            ));
            None
        }
    };
    for note in notes {
        let note = format_args!("{}: {note}", image.display());
        checks.note(&field.key("image"), note);
    }
    Some(Thickness::Picture(Picture {
        file: file?,
        black_nm: black_nm?,
        white_nm: white_nm?,
        size: size?,
    }))
}
