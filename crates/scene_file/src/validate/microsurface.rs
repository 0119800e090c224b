//! Roughness: a surface is smooth or rough enough, and has a grain if directions differ.

use super::checks::Checks;
use crate::description::{Brushed, Finish, Roughness};
use crate::limits;
use document::{FieldPath, Problem, ProblemKind};
use scene::{Grain, Microsurface};

/// A problem has been reported.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reported;

impl Finish {
    /// Checks the facets of the surface; `None` if it is smooth.
    pub(super) fn check(
        self,
        checks: &mut Checks,
        field: &FieldPath,
    ) -> Result<Option<Microsurface>, Reported> {
        let brushed = self.check_brushed(checks, &field.key("brushed"));
        let roughness = self.check_roughness(checks, &field.key("roughness"))?;
        let Some(roughness) = roughness else {
            return self.check_smooth(checks, field).map(|()| None);
        };
        let grain = self.check_grain(checks, field, brushed?)?;
        let distribution = self.distribution.unwrap_or_default();
        Ok(Some(Microsurface {
            distribution,
            roughness,
            grain,
            energy: checks.energy(distribution, roughness),
        }))
    }

    /// Checks the roughness along and across the grain; `None` for a smooth surface.
    fn check_roughness(
        self,
        checks: &mut Checks,
        field: &FieldPath,
    ) -> Result<Option<[f64; 2]>, Reported> {
        match self.roughness {
            Roughness::Even(0.0) => Ok(None),
            Roughness::Even(even) => {
                let even = check_number(checks, field, even, "0 (a smooth mirror) or ")?;
                Ok(Some([even; 2]))
            }
            Roughness::Brushed(both) => {
                let along = check_number(checks, &field.index(0), both[0], "");
                let across = check_number(checks, &field.index(1), both[1], "");
                Ok(Some([along?, across?]))
            }
        }
    }

    /// Checks the grain's direction; `None` if it is absent.
    fn check_brushed(
        self,
        checks: &mut Checks,
        field: &FieldPath,
    ) -> Result<Option<Grain>, Reported> {
        let grain = match self.brushed {
            None => return Ok(None),
            Some(Brushed::Along { along }) => {
                let direction = checks.direction(&field.key("along"), along);
                direction.map(Grain::Along)
            }
            Some(Brushed::Around { around }) => {
                let axis = checks.direction(&field.key("around"), around);
                axis.map(Grain::Around)
            }
        };
        grain.map(Some).ok_or(Reported)
    }

    /// Checks that either both two numbers and a direction are given, or neither.
    fn check_grain(
        self,
        checks: &mut Checks,
        field: &FieldPath,
        brushed: Option<Grain>,
    ) -> Result<Grain, Reported> {
        let is_even = matches!(self.roughness, Roughness::Even(_));
        let (place, other, message, help) = match brushed {
            None if is_even => return Ok(Grain::None),
            Some(grain) if !is_even => return Ok(grain),
            None => (
                "roughness",
                "brushed",
                "found two numbers, which are for a brushed surface, but no direction of its grain",
                "add brushed = { along = [1, 0, 0] } or brushed = { around = [0, 0, 1] }, or write one number",
            ),
            Some(_) => (
                "brushed",
                "roughness",
                "found a grain, but the roughness is the same in all directions",
                "write the roughness along and across the grain: roughness = [0.05, 0.3]",
            ),
        };
        let problem = Problem::new(ProblemKind::Inconsistent, &field.key(place), message);
        checks.report(problem.help(help).involving(field.key(other)));
        Err(Reported)
    }

    /// Checks that a smooth surface has neither a distribution nor a grain.
    fn check_smooth(self, checks: &mut Checks, field: &FieldPath) -> Result<(), Reported> {
        let given = [
            ("distribution", self.distribution.is_some()),
            ("brushed", self.brushed.is_some()),
        ];
        let mut result = Ok(());
        for (name, _) in given.iter().filter(|(_, is_given)| *is_given) {
            let message = format!("`{name}` is for a rough surface; this one has no roughness");
            let problem = Problem::new(ProblemKind::Inconsistent, &field.key(name), message);
            checks.report(problem.help("add a roughness from 0.02 to 1, or leave out this field"));
            result = Err(Reported);
        }
        result
    }
}

/// Checks that a number is in [`limits::ROUGHNESS`].
fn check_number(
    checks: &mut Checks,
    field: &FieldPath,
    number: f64,
    or: &str,
) -> Result<f64, Reported> {
    if limits::ROUGHNESS.contains(number) {
        return Ok(number);
    }
    let message = format!("found {number}; it must be {or}from {}", limits::ROUGHNESS);
    checks.report(Problem::new(ProblemKind::OutOfRange, field, message));
    Err(Reported)
}
