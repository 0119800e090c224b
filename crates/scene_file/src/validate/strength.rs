//! The strength of emitters: from the units of a file to the factor of a spectrum.

use super::checks::Checks;
use crate::description::{self, Strength};
use crate::limits;
use document::{FieldPath, Problem, ProblemKind, Range, Shown};
use spectra::{BandGrid, BandTable, KM_LUMENS_PER_WATT, observer_1931};
use std::f64::consts::PI;

/// The kind of an emitter, as far as its units depend on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Radiator {
    /// The material of objects. Its factor by power is that of an object with πA = 1.
    Emitter,
    /// An environment with the same radiance from everywhere.
    Environment,
    /// A part of an environment that is brighter in some directions.
    PartOfEnvironment,
    /// Ambient light from everywhere, which nothing occludes.
    Ambient,
    /// A distant light: ∫ cos dω over it; 0 for a single direction.
    Distant(f64),
    /// A point or spot: ∫ dω of its intensity relative to the largest.
    Point(f64),
}

/// The integral that a number is divided by to become the factor of a spectrum.
#[derive(Clone, Copy, PartialEq)]
enum Over {
    Nothing,
    /// ∫ S dλ.
    Watts,
    /// Km ∫ S ȳ dλ.
    Lumens,
}

/// A unit in which a strength can be written.
struct Unit {
    name: &'static str,
    written: fn(&Strength) -> Option<f64>,
    range: Range,
    over: Over,
}

impl Unit {
    const fn new(name: &'static str, written: fn(&Strength) -> Option<f64>, over: Over) -> Self {
        let range = limits::STRENGTH;
        Self {
            name,
            written,
            range,
            over,
        }
    }
}

/// A dimensionless number: the factor of the spectrum itself.
const SCALE: Unit = Unit {
    name: "scale",
    written: |strength| strength.scale,
    range: limits::EMISSION,
    over: Over::Nothing,
};

const UNITS: [Unit; 9] = [
    SCALE,
    Unit::new("radiance", |s| s.radiance, Over::Watts),
    Unit::new("luminance_cd_m2", |s| s.luminance_cd_m2, Over::Lumens),
    Unit::new("power_w", |s| s.power_w, Over::Watts),
    Unit::new("power_lm", |s| s.power_lm, Over::Lumens),
    Unit::new("irradiance_w_m2", |s| s.irradiance_w_m2, Over::Watts),
    Unit::new("illuminance_lux", |s| s.illuminance_lux, Over::Lumens),
    Unit::new("intensity_w_sr", |s| s.intensity_w_sr, Over::Watts),
    Unit::new("intensity_cd", |s| s.intensity_cd, Over::Lumens),
];

impl Radiator {
    /// Factor from a unit to what the scene stores; `None` if the unit does not apply.
    fn factor(self, unit: &str) -> Option<f64> {
        match (self, unit) {
            (Self::Distant(solid), "scale" | "irradiance_w_m2" | "illuminance_lux") => {
                Some(if solid > 0.0 { 1.0 / solid } else { 1.0 })
            }
            (Self::Distant(solid), "radiance" | "luminance_cd_m2") => (solid > 0.0).then_some(1.0),
            (_, "scale")
            | (
                Self::Emitter | Self::Environment | Self::PartOfEnvironment | Self::Ambient,
                "radiance" | "luminance_cd_m2",
            )
            | (Self::Emitter, "power_w" | "power_lm")
            | (Self::Point(_), "intensity_w_sr" | "intensity_cd") => Some(1.0),
            (Self::Environment | Self::Ambient, "irradiance_w_m2" | "illuminance_lux") => {
                Some(1.0 / PI)
            }
            (Self::Point(solid), "power_w" | "power_lm") => Some(1.0 / solid),
            _ => None,
        }
    }

    pub(crate) fn noun(self) -> &'static str {
        match self {
            Self::Emitter => "an emitter",
            Self::Environment => "a constant environment",
            Self::PartOfEnvironment => "a part of a gradient",
            Self::Ambient => "ambient light",
            Self::Distant(0.0) => "a distant light without a diameter",
            Self::Distant(_) => "a distant light",
            Self::Point(_) => "a point or spot",
        }
    }

    /// The quantity of the spectrum times its factor, and its unit.
    pub(crate) fn quantity(self) -> (&'static str, &'static str) {
        match self {
            Self::Distant(0.0) => ("an irradiance", "W m⁻² nm⁻¹"),
            Self::Point(_) => ("an intensity", "W sr⁻¹ nm⁻¹"),
            _ => ("a radiance", "W m⁻² sr⁻¹ nm⁻¹"),
        }
    }

    /// The units that apply, as a list.
    fn units(self) -> String {
        let fits = UNITS.iter().map(|unit| unit.name);
        let fits = fits.filter(|unit| self.factor(unit).is_some());
        let fits: Vec<_> = fits.map(|unit| format!("`{unit}`")).collect();
        fits.join(", ")
    }
}

/// The unit of an emission and its number, both checked.
pub(crate) struct Amount {
    /// The field of the number.
    pub(crate) field: FieldPath,
    /// Its unit, the last part of the field.
    pub(crate) unit: &'static str,
    /// The number as written.
    pub(crate) value: f64,
    factor: f64,
    over: Over,
}

/// Checks that at most one unit is written, that it applies, and its number.
pub(crate) fn check(
    checks: &mut Checks,
    field: &FieldPath,
    strength: &Strength,
    radiator: Radiator,
) -> Option<Amount> {
    let written = UNITS
        .iter()
        .filter_map(|unit| Some((unit, (unit.written)(strength)?)));
    let (unit, value) = match written.collect::<Vec<_>>().as_slice() {
        [] => (&SCALE, 1.0),
        [only] => *only,
        several => {
            report_several(
                checks,
                field,
                several.iter().map(|(unit, _)| unit.name),
                radiator,
            );
            return None;
        }
    };
    let at = field.key(unit.name);
    let value = checks.number(&at, value, &unit.range);
    let Some(factor) = radiator.factor(unit.name) else {
        let message = format!("{} has no `{}`", radiator.noun(), unit.name);
        let help = format!("write one of {}", radiator.units());
        checks.report(Problem::new(ProblemKind::Inconsistent, &at, message).help(help));
        return None;
    };
    Some(Amount {
        field: at,
        unit: unit.name,
        value: value?,
        factor,
        over: unit.over,
    })
}

/// Reports several units at the emission as a whole, since each of them is as wrong as the others.
fn report_several(
    checks: &mut Checks,
    field: &FieldPath,
    units: impl Iterator<Item = &'static str>,
    radiator: Radiator,
) {
    let names: Vec<_> = units.map(|unit| format!("`{unit}`")).collect();
    let message = format!(
        "found {}; the strength of an emission is given by only one of them",
        names.join(" and ")
    );
    let help = format!("{} takes one of {}", radiator.noun(), radiator.units());
    checks.report(Problem::new(ProblemKind::Inconsistent, field, message).help(help));
}

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
                Shown(self.value)
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

/// ∫ f g dλ over the bands as a render estimates it: over all wavelengths, or at the bands' centers.
fn integral(
    f: &BandTable,
    g: &BandTable,
    grid: &BandGrid,
    sampling: description::WavelengthSampling,
) -> f64 {
    let bands = 0..grid.count();
    let value = |band, offset| (f.at(band, offset), g.at(band, offset));
    match sampling {
        description::WavelengthSampling::Center => {
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
