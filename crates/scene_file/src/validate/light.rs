//! Lights that are not objects: from `[[lights]]` to [`Light`].

use super::checks::Checks;
use super::polarization;
use super::spectrum_list::SpectrumList;
use super::strength::Radiator;
use crate::description;
use crate::description::Description;
use crate::limits;
use document::{FieldPath, Problem, ProblemKind};
use scene::{DirectLight, Light, LightShape};
use std::f64::consts::{PI, TAU};

/// A light and the written name of its light group, if any.
pub(crate) type Named<'a> = (Light, Option<&'a str>);

/// Checks `[[lights]]`.
pub(crate) fn check_all<'a>(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    lights: &'a [description::Light],
) -> Option<Vec<Named<'a>>> {
    let top = FieldPath::root().key("lights");
    let checked: Vec<_> = lights
        .iter()
        .enumerate()
        .map(|(index, light)| {
            let checked = check(checks, spectra, &top.index(index), light)?;
            Some((checked, light.light_group()))
        })
        .collect();
    checked.into_iter().collect()
}

/// Reports lights that no ray hits if `direct_light` is `bsdf`: only emitter sampling finds them.
pub(crate) fn check_direct_light(checks: &mut Checks, description: &Description) {
    if description.render.direct_light != DirectLight::Bsdf {
        return;
    }
    for (index, light) in description.lights.iter().enumerate() {
        let what = match light {
            description::Light::Point { .. } => "a point",
            description::Light::Spot { .. } => "a spot",
            description::Light::Distant {
                diameter_deg: 0.0, ..
            } => "light from a single direction",
            description::Light::Distant { .. } => continue,
        };
        let message = format!(
            "found {what} with render.direct_light = \"bsdf\"; BSDF sampling never finds it, so it would be dark"
        );
        let field = FieldPath::root().key("lights").index(index);
        let way = FieldPath::root().key("render").key("direct_light");
        let problem = Problem::new(ProblemKind::Inconsistent, &field, message).involving(way);
        checks.report(
            problem.help("leave out `render.direct_light`, or write \"both\" or \"emitters\""),
        );
    }
}

/// Adds the sun of a sky, sorts disks first, and checks the number of disks.
pub(crate) fn with_sun<'a>(
    checks: &mut Checks,
    mut lights: Vec<Named<'a>>,
    sun: Option<Named<'a>>,
) -> Option<Vec<Named<'a>>> {
    lights.extend(sun);
    lights.sort_by_key(|(light, _)| !is_distant_disk(light));
    let disks = lights
        .iter()
        .filter(|(light, _)| is_distant_disk(light))
        .count();
    if disks > limits::MAX_DISTANT_DISKS {
        let message = format!(
            "found {disks} distant lights with a diameter, including the sun of a sky; at most {} are possible",
            limits::MAX_DISTANT_DISKS
        );
        let top = FieldPath::root().key("lights");
        checks.report(Problem::new(ProblemKind::TooLarge, &top, message));
        return None;
    }
    Some(lights)
}

fn is_distant_disk(light: &Light) -> bool {
    matches!(light.shape, LightShape::DistantDisk { .. })
}

fn check(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    field: &FieldPath,
    light: &description::Light,
) -> Option<Light> {
    let shape = match light {
        description::Light::Distant {
            direction,
            diameter_deg,
            ..
        } => distant(checks, field, *direction, *diameter_deg),
        description::Light::Point { position, .. } => checks
            .point(&field.key("position"), *position)
            .map(|position| LightShape::Point { position }),
        description::Light::Spot {
            position,
            direction,
            angle_deg,
            full_angle_deg,
            ..
        } => spot(
            checks,
            field,
            (*position, *direction),
            (*angle_deg, *full_angle_deg),
        ),
    };
    let radiator = shape.map_or(any_radiator(light), radiator);
    let emission = spectra.emission(checks, &field.key("emission"), light.emission(), radiator);
    let (shape, emission) = (shape?, emission?);
    polarization::check_across(checks, field, &shape, emission.polarization)?;
    Some(Light { shape, emission })
}

/// The radiator that stands in for a light with an invalid shape.
fn any_radiator(light: &description::Light) -> Radiator {
    match light {
        description::Light::Distant { .. } => Radiator::Distant(1.0),
        _ => Radiator::Point(1.0),
    }
}

fn radiator(shape: LightShape) -> Radiator {
    match shape {
        // ∫ cos dω = π sin²θ, with θ the angle at the edge.
        LightShape::DistantDisk { height, .. } => Radiator::Distant(PI * height * (2.0 - height)),
        LightShape::Direction { .. } => Radiator::Distant(0.0),
        LightShape::Point { .. } => Radiator::Point(2.0 * TAU),
        // The smooth edge is point-symmetric about its middle, so half of it counts.
        LightShape::Spot {
            full_height,
            edge_height,
            ..
        } => Radiator::Point(0.5 * TAU * (full_height + edge_height)),
    }
}

fn distant(
    checks: &mut Checks,
    field: &FieldPath,
    direction: [f64; 3],
    diameter_deg: f64,
) -> Option<LightShape> {
    let toward = checks.direction(&field.key("direction"), direction);
    let at = field.key("diameter_deg");
    let diameter = checks.number(&at, diameter_deg, &limits::ANGULAR_DIAMETER_DEG)?;
    if diameter == 0.0 {
        return Some(LightShape::Direction { toward: toward? });
    }
    if diameter < limits::MIN_ANGULAR_DIAMETER_DEG {
        let message = format!(
            "found {diameter_deg}; it must be 0 or at least {}°",
            limits::MIN_ANGULAR_DIAMETER_DEG
        );
        checks.report(Problem::new(ProblemKind::OutOfRange, &at, message));
        return None;
    }
    Some(LightShape::DistantDisk {
        toward: toward?,
        height: 2.0 * (0.25 * diameter.to_radians()).sin().powi(2),
    })
}

fn spot(
    checks: &mut Checks,
    field: &FieldPath,
    (position, direction): ([f64; 3], [f64; 3]),
    (angle_deg, full_angle_deg): (f64, Option<f64>),
) -> Option<LightShape> {
    let position = checks.point(&field.key("position"), position);
    let axis = checks.direction(&field.key("direction"), direction);
    let angle = checks.number(&field.key("angle_deg"), angle_deg, &limits::SPOT_DEG)?;
    let full_angle = full_angle_deg.unwrap_or(0.8 * angle);
    let most = limits::SPOT_SHARPEST * angle;
    if !(0.0..=most).contains(&full_angle) {
        let at = field.key("full_angle_deg");
        let message = format!(
            "found {full_angle}; it must be from 0 to {most}°, {} of `angle_deg`",
            limits::SPOT_SHARPEST
        );
        let problem = Problem::new(ProblemKind::OutOfRange, &at, message);
        checks.report(problem.involving(field.key("angle_deg")));
        return None;
    }
    let height = |degrees: f64| 2.0 * (0.25 * degrees).to_radians().sin().powi(2);
    Some(LightShape::Spot {
        position: position?,
        axis: axis?,
        full_height: height(full_angle),
        edge_height: height(angle),
    })
}
