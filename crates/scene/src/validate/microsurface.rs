//! Roughness: either smooth or rough enough, and a grain where directions differ.

use super::checks::Checks;
use crate::description::{Brushed, Distribution, Roughness};
use crate::limits;
use crate::problem::{Problem, ProblemKind};
use crate::{FieldPath, Grain, Microsurface};

/// What a material says of its roughness.
#[derive(Clone, Copy, Debug)]
pub(super) struct Written {
    pub(super) roughness: Roughness,
    pub(super) distribution: Option<Distribution>,
    pub(super) brushed: Option<Brushed>,
}

impl Written {
    /// The facets of the surface; `Some(None)` where it is smooth.
    pub(super) fn check(
        self,
        checks: &mut Checks,
        field: &FieldPath,
    ) -> Option<Option<Microsurface>> {
        let brushed = self.check_brushed(checks, &field.key("brushed"));
        let roughness = self.check_roughness(checks, &field.key("roughness"))?;
        let Some(roughness) = roughness else {
            return self.nothing_is_lost(checks, field).then_some(None);
        };
        let grain = self.check_grain(checks, field, brushed?)?;
        Some(Some(Microsurface {
            distribution: self.distribution.unwrap_or_default(),
            roughness,
            grain,
        }))
    }

    /// Along and across the grain; `Some(None)` of a smooth surface.
    fn check_roughness(self, checks: &mut Checks, field: &FieldPath) -> Option<Option<[f64; 2]>> {
        match self.roughness {
            Roughness::Even(0.0) => Some(None),
            Roughness::Even(even) => {
                let even = check_number(checks, field, even, "0 (a smooth mirror) or ")?;
                Some(Some([even; 2]))
            }
            Roughness::Brushed(both) => {
                let along = check_number(checks, &field.index(0), both[0], "");
                let across = check_number(checks, &field.index(1), both[1], "");
                Some(Some([along?, across?]))
            }
        }
    }

    /// `Some(None)` where nothing is said.
    fn check_brushed(self, checks: &mut Checks, field: &FieldPath) -> Option<Option<Grain>> {
        Some(match self.brushed {
            None => None,
            Some(Brushed::Along { along }) => {
                Some(Grain::Along(checks.direction(&field.key("along"), along)?))
            }
            Some(Brushed::Around { around }) => Some(Grain::Around(
                checks.direction(&field.key("around"), around)?,
            )),
        })
    }

    /// Two numbers and a direction belong together.
    fn check_grain(
        self,
        checks: &mut Checks,
        field: &FieldPath,
        brushed: Option<Grain>,
    ) -> Option<Grain> {
        let is_even = matches!(self.roughness, Roughness::Even(_));
        let (place, other, message, help) = match brushed {
            None if is_even => return Some(Grain::None),
            Some(grain) if !is_even => return Some(grain),
            None => (
                "roughness",
                "brushed",
                "two numbers are for a brushed surface, and nothing says which way its grain runs",
                "add brushed = { along = [1, 0, 0] } or brushed = { around = [0, 0, 1] }, or write one number",
            ),
            Some(_) => (
                "brushed",
                "roughness",
                "a surface of the same roughness in all directions has no grain",
                "write the roughness along and across the grain: roughness = [0.05, 0.3]",
            ),
        };
        let problem = Problem::new(ProblemKind::Inconsistent, &field.key(place), message);
        checks.report(problem.help(help).involving(field.key(other)));
        None
    }

    /// A smooth surface has neither a distribution nor a grain.
    fn nothing_is_lost(self, checks: &mut Checks, field: &FieldPath) -> bool {
        let given = [
            ("distribution", self.distribution.is_some()),
            ("brushed", self.brushed.is_some()),
        ];
        let mut is_sound = true;
        for (name, _) in given.iter().filter(|(_, is_given)| *is_given) {
            let message = format!("`{name}` is for a rough surface; this one has no roughness");
            let problem = Problem::new(ProblemKind::Inconsistent, &field.key(name), message);
            checks.report(problem.help("add a roughness from 0.02 to 1, or leave it out"));
            is_sound = false;
        }
        is_sound
    }
}

/// See [`limits::ROUGHNESS`].
fn check_number(checks: &mut Checks, field: &FieldPath, number: f64, or: &str) -> Option<f64> {
    if limits::ROUGHNESS.contains(number) {
        return Some(number);
    }
    let message = format!("found {number}; it must be {or}from {}", limits::ROUGHNESS);
    checks.report(Problem::new(ProblemKind::OutOfRange, field, message));
    None
}
