//! Thicknesses: from the description to fields at the scene's time, with every value within bounds.

mod drainage;
mod growth;
mod texture;

use super::checks::Checks;
use crate::description;
use crate::limits;
use document::{FieldPath, Problem, ProblemKind, Range, Step};
use glam::DVec3;
use scene::Thickness;

/// Number of knots of a profile that is not linear. On a draining bubble the relative error between them is below 1e-4 up to 160° from the
/// top, and below 1e-3 up to 175°.
const KNOTS: u32 = 513;

/// Checks a thickness.
pub(crate) fn check(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Thickness,
) -> Option<Thickness> {
    check_extent(checks, field, written)?;
    part(checks, field, written)
}

/// Rejects a thickness that is too deep or too long before anything traverses it recursively.
fn check_extent(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Thickness,
) -> Option<()> {
    let (mut parts, mut deepest) = (0, 0);
    let mut open = vec![(written, 0)];
    while let Some((part, depth)) = open.pop() {
        parts += 1;
        deepest = deepest.max(depth);
        if let description::Thickness::Sum { sum: inner }
        | description::Thickness::Product { product: inner } = part
        {
            open.extend(inner.iter().map(|part| (part, depth + 1)));
        }
    }
    let (what, found, most) = if deepest > limits::MAX_FIELD_DEPTH {
        (
            "levels of sums and products",
            deepest,
            limits::MAX_FIELD_DEPTH,
        )
    } else if parts > limits::MAX_FIELD_PARTS {
        ("parts", parts, limits::MAX_FIELD_PARTS)
    } else {
        return Some(());
    };
    let message = format!("found {found} {what}; at most {most} are possible");
    checks.report(Problem::new(ProblemKind::TooLarge, field, message));
    None
}

fn part(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Thickness,
) -> Option<Thickness> {
    use description::Thickness as Written;
    let range = &limits::THICKNESS_NM;
    match written {
        Written::Constant(nm) => {
            let nm = checks.number(field, *nm, range)?;
            Some(Thickness::Constant { nm })
        }
        Written::Polar {
            pole,
            equator,
            axis,
        } => polar(checks, field, (*pole, *equator), *axis),
        Written::Linear {
            start,
            end,
            from,
            to,
        } => {
            let ramp = ramp(checks, field, (*start, *end), (*from, *to), range)?;
            Some(linear(&ramp))
        }
        Written::Steps { steps } => stepped(checks, &field.key("steps"), steps),
        Written::Drainage { drainage } => {
            drainage::check(checks, &field.key("drainage"), drainage).map(Thickness::Profile)
        }
        Written::Swirls { swirls } => texture::swirls(checks, &field.key("swirls"), swirls),
        Written::Image {
            image,
            channel,
            min,
            max,
            size,
        } => texture::picture(checks, field, (image, *channel), (*min, *max), *size),
        Written::Sum { sum } => combined(checks, &field.key("sum"), sum).map(Thickness::Sum),
        Written::Product { product } => {
            combined(checks, &field.key("product"), product).map(Thickness::Product)
        }
        Written::Anodizing { anodizing } => {
            growth::anodized(checks, &field.key("anodizing"), anodizing)
        }
        Written::HeatTint { heat_tint } => {
            growth::tinted(checks, &field.key("heat_tint"), heat_tint)
        }
    }
}

fn polar(
    checks: &mut Checks,
    field: &FieldPath,
    (pole, equator): (f64, f64),
    axis: [f64; 3],
) -> Option<Thickness> {
    let range = &limits::THICKNESS_NM;
    let pole_nm = checks.number(&field.key("pole"), pole, range);
    let equator_nm = checks.number(&field.key("equator"), equator, range);
    let axis = checks.direction(&field.key("axis"), axis);
    let (pole_nm, equator_nm) = (pole_nm?, equator_nm?);
    check_far_pole(checks, field, pole_nm, equator_nm)?;
    Some(Thickness::Polar {
        axis: axis?,
        pole_nm,
        equator_nm,
    })
}

/// Checks the thickness at the far pole, which is 2 equator − pole.
fn check_far_pole(
    checks: &mut Checks,
    field: &FieldPath,
    pole_nm: f64,
    equator_nm: f64,
) -> Option<()> {
    let far_nm = 2.0 * equator_nm - pole_nm;
    let range = &limits::THICKNESS_NM;
    if range.contains(far_nm) {
        return Some(());
    }
    let message = format!(
        "found {pole_nm} nm at the pole and {equator_nm} nm at the equator, which gives {far_nm} nm at the far pole; \
         it must be from {range} everywhere"
    );
    let least_nm = pole_nm / 2.0;
    let most_nm = f64::midpoint(pole_nm, range.high);
    let help = format!("with this pole, `equator` can be from {least_nm} to {most_nm} nm");
    checks.report(Problem::new(ProblemKind::OutOfRange, field, message).help(help));
    None
}

/// Values along a line in space.
struct Ramp {
    /// The start and the end of the line.
    line: (DVec3, DVec3),
    /// The values at the start and the end.
    ends: (f64, f64),
}

fn ramp(
    checks: &mut Checks,
    field: &FieldPath,
    (start, end): (f64, f64),
    points: ([f64; 3], [f64; 3]),
    range: &Range,
) -> Option<Ramp> {
    let start = checks.number(&field.key("start"), start, range);
    let end = checks.number(&field.key("end"), end, range);
    let line = line(checks, field, points)?;
    let ends = (start?, end?);
    Some(Ramp { line, ends })
}

/// A ramp of thicknesses.
fn linear(ramp: &Ramp) -> Thickness {
    Thickness::Linear {
        start: ramp.line.0,
        end: ramp.line.1,
        start_nm: ramp.ends.0,
        end_nm: ramp.ends.1,
    }
}

/// Checks the points `from` and `to`, which must not coincide.
fn line(
    checks: &mut Checks,
    field: &FieldPath,
    (from, to): ([f64; 3], [f64; 3]),
) -> Option<(DVec3, DVec3)> {
    let (from_field, to_field) = (field.key("from"), field.key("to"));
    let from = checks.point(&from_field, from);
    let to = checks.point(&to_field, to);
    let (from, to) = (from?, to?);
    checks.distance((&to_field, to), (&from_field, from))?;
    Some((from, to))
}

fn stepped(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Steps,
) -> Option<Thickness> {
    let values = field.key("values");
    let count = written.values.len();
    if !(1..=limits::MAX_STEPS).contains(&count) {
        let most = limits::MAX_STEPS;
        let message = format!("found {count} steps; there must be from 1 to {most}");
        checks.report(Problem::new(ProblemKind::OutOfRange, &values, message));
        return None;
    }
    let nm: Vec<_> = written
        .values
        .iter()
        .enumerate()
        .map(|(index, &nm)| checks.number(&values.index(index), nm, &limits::THICKNESS_NM))
        .collect();
    let (start, end) = line(checks, field, (written.from, written.to))?;
    let nm = nm.into_iter().collect::<Option<_>>()?;
    Some(Thickness::Steps { start, end, nm })
}

/// Checks the parts of a sum or product, which must stay within the range of `f32`.
fn combined(
    checks: &mut Checks,
    field: &FieldPath,
    written: &[description::Thickness],
) -> Option<Vec<Thickness>> {
    if written.is_empty() {
        let message = "found an empty array; there must be at least one part";
        checks.report(Problem::new(ProblemKind::OutOfRange, field, message));
        return None;
    }
    let parts: Vec<_> = written
        .iter()
        .enumerate()
        .map(|(index, written)| part(checks, &field.index(index), written))
        .collect();
    let parts = parts.into_iter().collect::<Option<Vec<_>>>()?;
    let is_product = field
        .steps()
        .last()
        .is_some_and(|step| *step == Step::Key("product".to_owned()));
    let step = |so_far: f64, bound: f64| {
        if is_product {
            so_far * bound
        } else {
            so_far + bound
        }
    };
    // Part by part, in the order of evaluation: a later factor of 0 does not help if an earlier product left the range of `f32`.
    let mut so_far = f64::from(u8::from(is_product));
    for (index, bound) in parts.iter().map(largest).enumerate() {
        so_far = step(so_far, bound);
        // A bound that is NaN fails this comparison too.
        if so_far <= limits::MAX_FIELD_VALUE {
            continue;
        }
        let message = format!(
            "the first {} parts may reach a value of {so_far:.1e}; at most {:e} is possible",
            index + 1,
            limits::MAX_FIELD_VALUE
        );
        checks.report(Problem::new(ProblemKind::TooLarge, field, message));
        return None;
    }
    Some(parts)
}

/// A bound of the absolute value of a thickness.
fn largest(thickness: &Thickness) -> f64 {
    match thickness {
        Thickness::Constant { nm } => *nm,
        Thickness::Polar {
            pole_nm,
            equator_nm,
            ..
        } => pole_nm.max(2.0 * equator_nm - pole_nm),
        Thickness::Linear {
            start_nm, end_nm, ..
        } => start_nm.max(*end_nm),
        Thickness::Steps { nm, .. } => nm.iter().copied().fold(0.0, f64::max),
        Thickness::Profile(profile) => {
            let black = profile.black.map_or(0.0, |black| black.nm);
            profile.most_nm.max(black)
        }
        Thickness::Swirls(swirls) => swirls.mean + swirls.amplitude,
        Thickness::Picture(picture) => picture.black_nm.max(picture.white_nm),
        Thickness::Sum(parts) => parts.iter().map(largest).sum(),
        Thickness::Product(parts) => parts.iter().map(largest).product(),
    }
}
