//! The camera: from `[camera]` to its axes.

use super::checks::Checks;
use super::polarization;
use crate::description;
use crate::limits;
use document::{FieldPath, Problem, ProblemKind};
use scene::{Camera, Lens, PixelFilter, Projection};

/// Checks `[camera]`.
pub(crate) fn check(checks: &mut Checks, camera: &description::Camera) -> Option<Camera> {
    let top = FieldPath::root().key("camera");
    let (position, look_at, up) = match camera {
        description::Camera::Perspective {
            position,
            look_at,
            up,
            ..
        }
        | description::Camera::Orthographic {
            position,
            look_at,
            up,
            ..
        } => (*position, *look_at, *up),
        description::Camera::Panorama {
            position: [x, y, z],
            look_at,
            up,
            ..
        } => ([*x, *y, *z], look_at.unwrap_or([*x, *y, *z - 1.0]), *up),
    };
    let projection = projection(checks, &top, camera);
    let polarizer = camera.polarizer().map(|polarizer| {
        let field = top.key("polarizer");
        polarization::check_polarizer(checks, &field, polarizer)
    });
    let (position_field, look_at_field) = (top.key("position"), top.key("look_at"));
    let origin = checks.point(&position_field, position);
    let target = checks.point(&look_at_field, look_at);
    let up = checks.direction(&top.key("up"), up);
    let (origin, target) = (origin?, target?);
    let forward = checks.distance((&look_at_field, target), (&position_field, origin))?;
    let back = -forward.normalize();
    let up = checks.across(
        (&top.key("up"), up?),
        (-back, "the view direction"),
        &[position_field, look_at_field],
    )?;
    let (lens, filter) = match *camera {
        description::Camera::Perspective { lens, filter, .. } => {
            let target_distance = forward.length();
            let lens = match lens {
                Some(lens) => Some(check_lens(checks, &top, lens, target_distance)?),
                None => None,
            };
            (lens, filter)
        }
        description::Camera::Orthographic { filter, .. }
        | description::Camera::Panorama { filter, .. } => (None, filter),
    };
    Some(Camera {
        origin,
        right: up.cross(back),
        up,
        back,
        projection: projection?,
        lens,
        filter: PixelFilter::new(filter),
        polarizer: match polarizer {
            Some(checked) => Some(checked?),
            None => None,
        },
    })
}

/// Checks a lens. It focuses at `target_distance` unless it has a focus distance.
fn check_lens(
    checks: &mut Checks,
    top: &FieldPath,
    lens: description::Lens,
    target_distance: f64,
) -> Option<Lens> {
    let field = top.key("lens");
    let radius = check_radius(checks, &field.key("radius"), lens.radius);
    let focus_distance = match lens.focus_distance {
        Some(distance) => checks.number(&field.key("focus_distance"), distance, &limits::LENGTH),
        None => Some(target_distance),
    };
    Some(Lens {
        radius: radius?,
        focus_distance: focus_distance?,
    })
}

fn check_radius(checks: &mut Checks, field: &FieldPath, radius: f64) -> Option<f64> {
    if radius != 0.0 {
        return checks.number(field, radius, &limits::LENGTH);
    }
    let message = format!("found 0; it must be from {}", limits::LENGTH);
    let problem = Problem::new(ProblemKind::OutOfRange, field, message);
    checks.report(problem.help("leave out `lens` to have everything in focus"));
    None
}

fn projection(
    checks: &mut Checks,
    top: &FieldPath,
    camera: &description::Camera,
) -> Option<Projection> {
    match *camera {
        description::Camera::Perspective { fov_deg, .. } => {
            let fov = checks.number(&top.key("fov_deg"), fov_deg, &limits::FOV_DEG)?;
            Some(Projection::Perspective {
                half_height: (fov.to_radians() / 2.0).tan(),
            })
        }
        description::Camera::Panorama { .. } => Some(Projection::Panorama),
        description::Camera::Orthographic { height, .. } => {
            let height = checks.number(&top.key("height"), height, &limits::LENGTH)?;
            Some(Projection::Orthographic {
                half_height: height / 2.0,
            })
        }
    }
}
