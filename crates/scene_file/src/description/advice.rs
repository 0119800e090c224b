//! Advice on words from other renderers' scenes, and on names that changed.

use document::{FieldPath, Step};

/// What to write instead of an unknown `type`.
pub(super) fn of_type(field: &FieldPath, word: &str) -> Option<&'static str> {
    match (section(field)?, word) {
        ("lights", "sphere" | "rectangle" | "disk" | "quad" | "plane" | "area" | "emitter") => {
            Some("a light with a shape is an object whose material is `type = \"emitter\"`")
        }
        ("lights", "environment" | "constant" | "image" | "sky") => {
            Some("light from all directions is written as [environment]")
        }
        _ => None,
    }
}

/// What to write instead of an unknown field.
pub(super) fn of_field(field: &FieldPath, name: &str) -> Option<&'static str> {
    match (section(field)?, name) {
        ("camera", "f_number" | "f_stop" | "aperture") => Some(
            "write lens = { radius = ... } with the aperture radius in scene units: the focal length divided by 2 N for the f-number N",
        ),
        _ => None,
    }
}

/// Fields and words that were renamed: the old and the new name.
pub(super) const RENAMED: &[(&str, &str)] = &[
    ("anodising", "anodizing"),
    ("centre", "center"),
    ("lights", "emitters"),
    ("normalisation", "normalization"),
    ("normalised", "normalized"),
    ("surfaces", "bsdf"),
];

/// The section of the file that a field belongs to.
fn section(field: &FieldPath) -> Option<&str> {
    match field.steps().first()? {
        Step::Key(section) => Some(section),
        Step::Index(_) => None,
    }
}
