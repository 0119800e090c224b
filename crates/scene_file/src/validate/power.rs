//! Emitters by power: each object that has one gets a separate material, since the radiance depends on the object's area.

use super::checks::Checks;
use super::light_groups::Unlit;
use crate::description::{self, Description};
use crate::limits;
use document::{FieldPath, Problem, ProblemKind, Shown};
use scene::{Material, MaterialId, Shape, SpectrumId};
use std::collections::HashMap;
use std::f64::consts::PI;

/// Replaces power by radiance, Φ / (π A); `peak` returns the largest value of a spectrum.
pub(crate) fn spread(
    checks: &mut Checks,
    description: &Description,
    parts: &mut Unlit,
    peak: impl Fn(SpectrumId) -> f64,
) {
    let by_power: Vec<_> = description.materials.values().map(unit_of_power).collect();
    let mut made: HashMap<(MaterialId, u64), MaterialId> = HashMap::new();
    for (index, object) in parts.objects.iter_mut().enumerate() {
        let written = object.material;
        let Some(unit) = by_power[written.index()] else {
            continue;
        };
        let field = FieldPath::root().key("objects").index(index);
        let Some(area) = area(&object.shape) else {
            let message = format!(
                "found an infinite plane, to which the `{unit}` of its material cannot apply; it must have a bounded shape"
            );
            let field = field.key("material");
            let problem = Problem::new(ProblemKind::Inconsistent, &field, message)
                .help("give the material a `radiance` or `luminance_cd_m2`, or make the plane a rectangle");
            checks.report(problem);
            continue;
        };
        let own = *made.entry((written, area.to_bits())).or_insert_with(|| {
            let mut material = parts.materials[written.index()].clone();
            if let Material::Emitter { emission, .. } = &mut material {
                emission.scale /= PI * area;
                let radiance = peak(emission.spectrum) * emission.scale;
                if !limits::EMISSION.contains(radiance) {
                    let message = format!(
                        "the `{unit}` of its material gives a radiance of {radiance:.3e} W m⁻² sr⁻¹ nm⁻¹ at the spectrum's peak; at most {} is possible",
                        Shown(limits::EMISSION.high)
                    );
                    checks.report(Problem::new(ProblemKind::OutOfRange, &field, message));
                }
            }
            let id = MaterialId::new(parts.materials.len());
            parts.materials.push(material);
            id
        });
        object.material = own;
    }
}

/// The unit of an emitter by power.
fn unit_of_power(material: &description::Material) -> Option<&'static str> {
    let description::Material::Emitter { emission, .. } = material else {
        return None;
    };
    let strength = &emission.strength;
    let watts = strength.power_w.map(|_| "power_w");
    watts.or(strength.power_lm.map(|_| "power_lm"))
}

/// The area that emits, both sides of flat shapes together.
fn area(shape: &Shape) -> Option<f64> {
    match *shape {
        Shape::Sphere { radius, .. } => Some(4.0 * PI * radius * radius),
        Shape::Rectangle {
            half_width,
            half_height,
            ..
        } => Some(8.0 * half_width * half_height),
        Shape::Disk { radius, .. } => Some(2.0 * PI * radius * radius),
        Shape::Plane { .. } => None,
    }
}
