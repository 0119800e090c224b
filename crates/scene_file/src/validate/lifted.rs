//! Colors: from RGB values to smooth reflectances.

use super::checks::Checks;
use super::picture_file::read_colors;
use colorimetry::lifting::SigmoidReflectance;
use document::{FieldPath, Problem, ProblemKind};
use picture_file::png_colors::CodeColors;
use rayon::prelude::*;
use scene::Texels;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

/// The texels of a picture's colors.
pub(super) fn picture(checks: &mut Checks, field: &FieldPath, file: &Path) -> Option<Arc<Texels>> {
    let path = checks.path(field, file)?;
    let mut notes = Vec::new();
    let (picture, meaning) = match read_colors(&path, &mut notes) {
        Ok(found) => found,
        Err(error) => {
            let message = format!("{}: {error}", path.display());
            checks.report(Problem::new(ProblemKind::File, field, message));
            return None;
        }
    };
    let mut colors: Vec<[u16; 3]> = picture.pixels().map(|pixel| pixel.0).collect();
    colors.sort_unstable();
    colors.dedup();
    let beyond = colors
        .par_iter()
        .filter(|&&codes| is_beyond(&meaning, codes));
    let beyond = beyond.count();
    if beyond > 0 {
        let of = colors.len();
        notes.push(format!(
            "{beyond} of its {of} colors are outside the gamut of sRGB, and are clipped to it"
        ));
    }
    for note in notes {
        checks.note(field, format_args!("{}: {note}", file.display()));
    }
    let texels: HashMap<[u16; 3], [f32; 4]> = colors
        .into_par_iter()
        .map(|codes| (codes, texel(meaning.linear_srgb(codes))))
        .collect();
    Some(Arc::new(Texels {
        width: picture.width(),
        height: picture.height(),
        per_pixel: 1,
        values: picture.pixels().map(|pixel| texels[&pixel.0]).collect(),
    }))
}

/// Whether a color is outside the gamut of sRGB by more than rounding.
fn is_beyond(meaning: &CodeColors, codes: [u16; 3]) -> bool {
    let linear = meaning.linear_srgb(codes);
    linear.iter().any(|value| !(-1e-3..=1.001).contains(value))
}

fn texel(linear: [f64; 3]) -> [f32; 4] {
    let [c0, c1, c2] = SigmoidReflectance::of_linear_srgb(linear).coefficients;
    [c0 as f32, c1 as f32, c2 as f32, 1.0]
}
