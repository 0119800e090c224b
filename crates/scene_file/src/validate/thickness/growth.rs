//! Oxides described by the process that grows them.

use super::{KNOTS, Ramp, linear, ramp};
use crate::description;
use crate::growth::heat_tint_nm2;
use crate::limits;
use crate::validate::checks::Checks;
use document::{FieldPath, Range};
use scene::{Coordinate, Profile, Thickness};

/// An anodic oxide: its thickness is linear in the voltage, so it is linear along a line if the voltage is.
pub(super) fn anodized(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Anodizing,
) -> Option<Thickness> {
    let description::AnodizedMetal::Titanium = written.metal;
    let growth = field.key("nm_per_volt");
    let nm_per_volt = checks.number(&growth, written.nm_per_volt, &limits::NM_PER_VOLT);
    let native_nm = checks.number(&field.key("native"), written.native, &limits::THICKNESS_NM);
    let volts = quantity(checks, &field.key("volts"), &written.volts, &limits::VOLTS);
    let (nm_per_volt, native_nm) = (nm_per_volt?, native_nm?);
    let oxide = |volts: f64| native_nm + nm_per_volt * volts;
    Some(match volts? {
        Quantity::Constant(volts) => Thickness::Constant { nm: oxide(volts) },
        Quantity::Linear(Ramp { line, ends }) => linear(&Ramp {
            line,
            ends: (oxide(ends.0), oxide(ends.1)),
        }),
    })
}

/// A heat tint: its growth is parabolic, so the table holds squares of the thickness.
pub(super) fn tinted(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::HeatTint,
) -> Option<Thickness> {
    let description::Steel::Carbon = written.steel;
    let minutes = checks.number(&field.key("minutes"), written.minutes, &limits::MINUTES);
    let temperature = field.key("temperature_c");
    let temperature = quantity(
        checks,
        &temperature,
        &written.temperature_c,
        &limits::HEAT_TINT_C,
    );
    let minutes = minutes?;
    Some(match temperature? {
        Quantity::Constant(celsius) => Thickness::Constant {
            nm: heat_tint_nm2(celsius, minutes).sqrt(),
        },
        Quantity::Linear(Ramp {
            line: (start, end),
            ends: (cool, hot),
        }) => {
            let square = |knot| {
                let along = f64::from(knot) / f64::from(KNOTS - 1);
                heat_tint_nm2(cool + (hot - cool) * along, minutes)
            };
            Thickness::Profile(Profile {
                coordinate: Coordinate::Line { start, end },
                squares_nm2: (0..KNOTS).map(square).collect(),
                most_nm: limits::THICKNESS_NM.high,
                black: None,
            })
        }
    })
}

/// The setting of a process, in its unit.
enum Quantity {
    Constant(f64),
    Linear(Ramp),
}

fn quantity(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Quantity,
    range: &Range,
) -> Option<Quantity> {
    match *written {
        description::Quantity::Constant(value) => {
            checks.number(field, value, range).map(Quantity::Constant)
        }
        description::Quantity::Linear {
            start,
            end,
            from,
            to,
        } => ramp(checks, field, (start, end), (from, to), range).map(Quantity::Linear),
    }
}
