//! Polarization: of emitted light, and of polarizers.

use super::checks::Checks;
use super::strength::Radiator;
use crate::description::{self, Description, Polarization};
use crate::limits;
use document::{FieldPath, Problem, ProblemKind, Shown};
use glam::DVec3;
use scene::{EmittedPolarization, LightShape};
use spectra::stokes::{Polarizer, Retardance, Retarder};

/// Checks the polarization of an emission at `field`; the inner `None` is unpolarized light.
#[expect(clippy::option_option, reason = "the outer one is the check's result")]
pub(crate) fn check(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Emission,
    radiator: Radiator,
) -> Option<Option<EmittedPolarization>> {
    let Some(written) = &written.polarization else {
        return Some(None);
    };
    let field = field.key("polarization");
    if radiator == Radiator::Ambient {
        let message = "ambient light has no `polarization`; leave it out";
        checks.report(Problem::new(ProblemKind::Inconsistent, &field, message));
        return None;
    }
    let stokes = stokes(checks, &field, written);
    let axis = checks.direction(&field.key("axis"), written.axis);
    let (stokes, axis) = (stokes?, axis?);
    let is_polarized = stokes != [0.0; 3];
    Some(is_polarized.then_some(EmittedPolarization::Stokes { stokes, axis }))
}

/// S1, S2 and S3 over S0 from the form that is written.
fn stokes(checks: &mut Checks, field: &FieldPath, written: &Polarization) -> Option<[f64; 3]> {
    let Polarization {
        stokes,
        degree,
        angle_deg,
        ellipticity_deg,
        ..
    } = *written;
    let angles = [
        ("degree", degree),
        ("angle_deg", angle_deg),
        ("ellipticity_deg", ellipticity_deg),
    ];
    let first = angles.iter().find(|(_, value)| value.is_some());
    match (stokes, first, degree) {
        (Some(stokes), None, _) => of_components(checks, &field.key("stokes"), stokes),
        (None, _, Some(degree)) => of_angles(checks, field, (degree, angle_deg, ellipticity_deg)),
        (None, _, None) => {
            let message = match first {
                Some((name, _)) => format!("found `{name}` without `degree`; both are needed"),
                None => "found neither `stokes` nor `degree`; one of them is needed".to_owned(),
            };
            let help = "degree = 1 is fully polarized light";
            checks.report(Problem::new(ProblemKind::MissingField, field, message).help(help));
            None
        }
        (Some(_), Some((name, _)), _) => {
            let message = format!(
                "found `stokes` and `{name}`; give either `stokes`, or `degree` with `angle_deg` and `ellipticity_deg`"
            );
            checks.report(Problem::new(ProblemKind::Inconsistent, field, message));
            None
        }
    }
}

/// Checks S1, S2 and S3 over S0.
fn of_components(checks: &mut Checks, field: &FieldPath, stokes: [f64; 3]) -> Option<[f64; 3]> {
    let mut checked = [0.0; 3];
    let mut is_sound = true;
    for (index, value) in stokes.into_iter().enumerate() {
        let component = checks.number(&field.index(index), value, &limits::STOKES);
        is_sound &= component.is_some();
        checked[index] = component.unwrap_or_default();
    }
    if !is_sound {
        return None;
    }
    let length = DVec3::from_array(checked).length();
    if length <= 1.0 + limits::STOKES_ROUNDING {
        return Some(checked.map(|component| component / length.max(1.0)));
    }
    let [s1, s2, s3] = stokes.map(Shown);
    let message = format!(
        "found [{s1}, {s2}, {s3}], which has the length {length:.6}; √(S1² + S2² + S3²) relative to S0 is at most 1"
    );
    checks.report(Problem::new(ProblemKind::OutOfRange, field, message));
    None
}

/// S1 = p cos 2χ cos 2ψ, S2 = p cos 2χ sin 2ψ, S3 = p sin 2χ for the degree p, the angle ψ and the ellipticity χ (Born and Wolf, Principles
/// of Optics, 7th ed., section 1.4.2, equation 45).
fn of_angles(
    checks: &mut Checks,
    field: &FieldPath,
    (degree, angle_deg, ellipticity_deg): (f64, Option<f64>, Option<f64>),
) -> Option<[f64; 3]> {
    let mut number = |name: &str, value, range| checks.number(&field.key(name), value, range);
    let degree = number("degree", degree, &limits::FRACTION);
    let angle = number(
        "angle_deg",
        angle_deg.unwrap_or_default(),
        &limits::POLARIZATION_DEG,
    );
    let ellipticity = number(
        "ellipticity_deg",
        ellipticity_deg.unwrap_or_default(),
        &limits::ELLIPTICITY_DEG,
    );
    let (degree, angle, ellipticity) = (degree?, angle?, ellipticity?);
    let (sin_angle, cos_angle) = (2.0 * angle).to_radians().sin_cos();
    let (sin_ellipticity, cos_ellipticity) = (2.0 * ellipticity).to_radians().sin_cos();
    let linear = degree * cos_ellipticity;
    Some([
        linear * cos_angle,
        linear * sin_angle,
        degree * sin_ellipticity,
    ])
}

/// Checks that the reference axis of light from a single direction at `field` is not that direction.
pub(crate) fn check_across(
    checks: &mut Checks,
    field: &FieldPath,
    shape: &LightShape,
    polarization: Option<EmittedPolarization>,
) -> Option<()> {
    if let (LightShape::Direction { toward }, Some(EmittedPolarization::Stokes { axis, .. })) =
        (shape, polarization)
    {
        let at = field.key("emission").key("polarization").key("axis");
        let direction = (*toward, "the light's direction");
        checks.across((&at, axis), direction, &[field.key("direction")])?;
    }
    Some(())
}

/// Checks the polarizer of a camera.
pub(crate) fn check_polarizer(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Polarizer,
) -> Option<Polarizer> {
    let angle = field.key("angle_deg");
    let angle_deg = checks.number(&angle, written.angle_deg, &limits::POLARIZATION_DEG);
    let retarder = match &written.retarder {
        Some(retarder) => Some(check_retarder(checks, &field.key("retarder"), retarder)?),
        None => None,
    };
    Some(Polarizer {
        angle_deg: angle_deg?,
        retarder,
    })
}

fn check_retarder(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Retarder,
) -> Option<Retarder> {
    let axis = field.key("fast_axis_deg");
    let fast_axis_deg = checks.number(&axis, written.fast_axis_deg, &limits::POLARIZATION_DEG);
    let retardance = match (written.retardance_deg, written.retardance_nm) {
        (Some(deg), None) => checks
            .number(&field.key("retardance_deg"), deg, &limits::RETARDANCE_DEG)
            .map(|deg| Retardance::Phase { deg }),
        (None, Some(nm)) => checks
            .number(&field.key("retardance_nm"), nm, &limits::RETARDANCE_NM)
            .map(|nm| Retardance::Path { nm }),
        (deg, _) => {
            let (kind, found) = match deg {
                Some(_) => (ProblemKind::Inconsistent, "both"),
                None => (ProblemKind::MissingField, "neither"),
            };
            let and = if deg.is_some() { "and" } else { "nor" };
            let message = format!(
                "found {found} `retardance_deg` {and} `retardance_nm`; exactly one of them is needed"
            );
            let help = "retardance_deg = 90 is a quarter-wave plate at every wavelength, retardance_nm = 137.5 one at 550 nm";
            checks.report(Problem::new(kind, field, message).help(help));
            None
        }
    };
    Some(Retarder {
        fast_axis_deg: fast_axis_deg?,
        retardance: retardance?,
    })
}

/// Reports a polarizer if light is traced without its polarization.
pub(crate) fn check_is_traced(checks: &mut Checks, description: &Description) {
    if description.render.polarization || description.camera.polarizer().is_none() {
        return;
    }
    let field = FieldPath::root().key("camera").key("polarizer");
    let message = "found a polarizer, but light is traced without its polarization";
    let problem = Problem::new(ProblemKind::Inconsistent, &field, message)
        .involving(FieldPath::root().key("render").key("polarization"));
    let help = "write `polarization = true` below [render], or leave out `polarizer`";
    checks.report(problem.help(help));
}
