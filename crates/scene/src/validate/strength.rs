//! How much light: from the units of a file to the factor of a spectrum.

use super::checks::Checks;
use crate::FieldPath;
use crate::description::{self, Strength};
use crate::limits::{self, Range};
use crate::problem::{Problem, ProblemKind};
use spectra::{BandGrid, BandTable, KM_LUMENS_PER_WATT, observer_1931};
use std::f64::consts::PI;

/// What emits, as far as its units go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Radiator {
    /// The material of objects. Its factor by power is that of an object of which πA = 1.
    Emitter,
    /// Surroundings of the same radiance from everywhere.
    Surroundings,
    /// A part of surroundings that are brighter in some directions.
    PartOfSurroundings,
    /// A distant light: ∫ cos dω over it; 0 where it comes from a single direction.
    Distant(f64),
    /// A point or spot: ∫ dω of its intensity relative to the largest.
    Point(f64),
}

/// What a number is divided by to become the factor of a spectrum.
#[derive(Clone, Copy, PartialEq)]
enum Over {
    Nothing,
    /// ∫ S dλ.
    Watts,
    /// Km ∫ S ȳ dλ.
    Lumens,
}

/// A unit that is written.
struct Written {
    name: &'static str,
    value: f64,
    range: Range,
    over: Over,
}

impl Radiator {
    /// Factor from a unit to what the scene keeps; none where the unit does not fit.
    fn factor(self, unit: &str) -> Option<f64> {
        match (self, unit) {
            (Self::Distant(solid), "scale" | "irradiance_w_m2" | "illuminance_lux") => {
                Some(if solid > 0.0 { 1.0 / solid } else { 1.0 })
            }
            (Self::Distant(solid), "radiance" | "luminance_cd_m2") => (solid > 0.0).then_some(1.0),
            (_, "scale") => Some(1.0),
            (
                Self::Emitter | Self::Surroundings | Self::PartOfSurroundings,
                "radiance" | "luminance_cd_m2",
            )
            | (Self::Emitter, "power_w")
            | (Self::Point(_), "intensity_w_sr" | "intensity_cd") => Some(1.0),
            (Self::Surroundings, "irradiance_w_m2" | "illuminance_lux") => Some(1.0 / PI),
            (Self::Point(solid), "power_w") => Some(1.0 / solid),
            _ => None,
        }
    }

    fn noun(self) -> &'static str {
        match self {
            Self::Emitter => "an emitter",
            Self::Surroundings => "constant surroundings",
            Self::PartOfSurroundings => "a part of a gradient",
            Self::Distant(0.0) => "a distant light without a diameter",
            Self::Distant(_) => "a distant light",
            Self::Point(_) => "a point or spot",
        }
    }
}

fn written(strength: &Strength) -> Vec<Written> {
    let (emission, other) = (limits::EMISSION, limits::STRENGTH);
    [
        ("scale", strength.scale, emission, Over::Nothing),
        ("radiance", strength.radiance, other, Over::Watts),
        (
            "luminance_cd_m2",
            strength.luminance_cd_m2,
            other,
            Over::Lumens,
        ),
        ("power_w", strength.power_w, other, Over::Watts),
        (
            "irradiance_w_m2",
            strength.irradiance_w_m2,
            other,
            Over::Watts,
        ),
        (
            "illuminance_lux",
            strength.illuminance_lux,
            other,
            Over::Lumens,
        ),
        (
            "intensity_w_sr",
            strength.intensity_w_sr,
            other,
            Over::Watts,
        ),
        ("intensity_cd", strength.intensity_cd, other, Over::Lumens),
    ]
    .into_iter()
    .filter_map(|(name, value, range, over)| {
        let value = value?;
        Some(Written {
            name,
            value,
            range,
            over,
        })
    })
    .collect()
}

/// The unit of an emission and its number, checked.
pub(crate) struct Amount {
    /// The field that says it.
    pub(crate) field: FieldPath,
    value: f64,
    factor: f64,
    over: Over,
}

/// Checks that one unit at most is written, that it fits, and its number.
pub(crate) fn check(
    checks: &mut Checks,
    field: &FieldPath,
    strength: &Strength,
    radiator: Radiator,
) -> Option<Amount> {
    let all = written(strength);
    let plain = Written {
        name: "scale",
        value: 1.0,
        range: limits::EMISSION,
        over: Over::Nothing,
    };
    let unit = match all.as_slice() {
        [] => &plain,
        [only] => only,
        [first, others @ ..] => {
            let names: Vec<_> = others.iter().map(|u| format!("`{}`", u.name)).collect();
            let message = format!(
                "found `{}` beside {}; a light has one of them",
                first.name,
                names.join(", ")
            );
            let at = field.key(others[0].name);
            checks.report(Problem::new(ProblemKind::Inconsistent, &at, message));
            return None;
        }
    };
    let at = field.key(unit.name);
    let value = checks.number(&at, unit.value, &unit.range);
    let Some(factor) = radiator.factor(unit.name) else {
        report_misfit(checks, &at, unit.name, radiator);
        return None;
    };
    Some(Amount {
        field: at,
        value: value?,
        factor,
        over: unit.over,
    })
}

fn report_misfit(checks: &mut Checks, field: &FieldPath, unit: &str, radiator: Radiator) {
    let fits: Vec<_> = UNITS
        .iter()
        .filter(|unit| radiator.factor(unit).is_some())
        .map(|unit| format!("`{unit}`"))
        .collect();
    let message = format!("{} has no `{unit}`", radiator.noun());
    let help = format!("what it can have is one of {}", fits.join(", "));
    checks.report(Problem::new(ProblemKind::Inconsistent, field, message).help(help));
}

const UNITS: [&str; 8] = [
    "scale",
    "radiance",
    "luminance_cd_m2",
    "power_w",
    "irradiance_w_m2",
    "illuminance_lux",
    "intensity_w_sr",
    "intensity_cd",
];

impl Amount {
    /// The factor of a spectrum over the bands.
    pub(crate) fn scale(
        &self,
        checks: &mut Checks,
        spectrum: &BandTable,
        (grid, sampling): (&BandGrid, description::WavelengthSampling),
    ) -> Option<f64> {
        let total = match self.over {
            Over::Nothing => return Some(self.value * self.factor),
            Over::Watts => {
                let ones = spectrum.map(|_| 1.0);
                integral(spectrum, &ones, grid, sampling)
            }
            Over::Lumens => {
                let y = spectra::Spectrum::Table(observer_1931()[1].clone());
                let y = BandTable::new(grid, &y).ok()?;
                KM_LUMENS_PER_WATT * integral(spectrum, &y, grid, sampling)
            }
        };
        if self.value == 0.0 {
            return Some(0.0);
        }
        if total <= 0.0 {
            let message = format!(
                "found {}, but the spectrum is 0 over the scene's wavelengths",
                self.value
            );
            checks.report(Problem::new(
                ProblemKind::Inconsistent,
                &self.field,
                message,
            ));
            return None;
        }
        Some(self.value * self.factor / total)
    }
}

/// ∫ f g dλ over the bands as a render sums it: over all wavelengths, or at the bands' centres.
fn integral(
    f: &BandTable,
    g: &BandTable,
    grid: &BandGrid,
    sampling: description::WavelengthSampling,
) -> f64 {
    let bands = 0..grid.count();
    let value = |band, offset| (f.at(band, offset), g.at(band, offset));
    match sampling {
        description::WavelengthSampling::Centre => {
            let products = bands.map(|band| {
                let (f, g) = value(band, 0.5);
                f * g
            });
            grid.width_nm() * products.sum::<f64>()
        }
        description::WavelengthSampling::Random => {
            // Both are linear between knots, so Simpson's rule is exact for their product.
            let steps = f.steps();
            let offset = |step: u32| f64::from(step) / f64::from(steps);
            let products = bands.flat_map(|band| {
                (0..steps).map(move |step| {
                    let (f0, g0) = value(band, offset(step));
                    let (f1, g1) = value(band, offset(step + 1));
                    (f0 * g0 + f1 * g1) / 3.0 + (f0 * g1 + f1 * g0) / 6.0
                })
            });
            grid.width_nm() / f64::from(steps) * products.sum::<f64>()
        }
    }
}
