//! Advice on words of other programs' scenes, and on names that changed.

use crate::FieldPath;
use crate::field_path::Step;

/// What to write for a `type` that is not there.
pub(super) fn of_type(field: &FieldPath, word: &str) -> Option<&'static str> {
    match (section(field)?, word) {
        ("lights", "sphere" | "rectangle" | "disk" | "quad" | "plane" | "area" | "emitter") => {
            Some("a light with a shape is an object whose material is `type = \"emitter\"`")
        }
        ("lights", "environment" | "constant" | "image" | "sky") => {
            Some("light from all around is written as [environment]")
        }
        _ => None,
    }
}

/// What to write for a field that is not there.
pub(super) fn of_field(field: &FieldPath, name: &str) -> Option<&'static str> {
    match (section(field)?, name) {
        ("camera", "f_number" | "f_stop" | "aperture") => Some(
            "lens = { radius = ... } has the radius of the opening in scene units: the focal length over 2 N for an f-number of N",
        ),
        _ => None,
    }
}

/// Fields and words that are called otherwise now.
const RENAMED: &[(&str, &str)] = &[
    ("anodising", "anodizing"),
    ("centre", "center"),
    ("lights", "emitters"),
    ("normalisation", "normalization"),
    ("normalised", "normalized"),
    ("surfaces", "bsdf"),
];

/// What an old name is called now, if that is one of those that are possible here.
pub(super) fn renamed<'a>(
    name: &str,
    mut possible: impl Iterator<Item = &'a str>,
) -> Option<&'a str> {
    let (_, now) = RENAMED.iter().find(|(old, _)| *old == name)?;
    possible.find(|known| known == now)
}

/// The part of the file that a field lies in.
fn section(field: &FieldPath) -> Option<&str> {
    match field.steps().first()? {
        Step::Key(section) => Some(section),
        Step::Index(_) => None,
    }
}
