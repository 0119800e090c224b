//! Reflectances: from the description to a spectrum.

use crate::description::{Extrapolate, Reflectance};
use crate::points::{self, Column, FileTable};
use crate::{Advice, extrapolated, limits};
use colorimetry::lifting::SigmoidReflectance;
use colorimetry::srgb::decode;
use document::{Checks, FieldPath, Range};
use spectra::table_file::QuantityKind;
use spectra::{BandGrid, Spectrum, Tabulated};

/// A reflectance over wavelength, and advice for the case that it does not cover the bands. Written numbers must be in `range`.
pub fn read_reflectance<'w>(
    checks: &mut Checks,
    range: &'static Range,
    field: &FieldPath,
    written: &'w Reflectance,
) -> Option<(Spectrum, Advice<'w>)> {
    let column = Column::new("reflectance", "values", range, QuantityKind::Part);
    Some(match written {
        Reflectance::Constant(value) => {
            let value = checks.number(field, *value, range)?;
            (Spectrum::Constant(value), Advice::None)
        }
        Reflectance::Name(name) => (
            named_reflectance(checks, field, name, Extrapolate::Error)?,
            Advice::Name(name),
        ),
        Reflectance::Srgb { srgb } => {
            let rgb = color(checks, &field.key("srgb"), *srgb)?;
            (smooth_reflectance(rgb.map(decode)), Advice::None)
        }
        Reflectance::LinearSrgb { linear_srgb } => {
            let rgb = color(checks, &field.key("linear_srgb"), *linear_srgb)?;
            (smooth_reflectance(rgb), Advice::None)
        }
        Reflectance::Named { name, extrapolate } => (
            named_reflectance(checks, &field.key("name"), name, *extrapolate)?,
            Advice::Add,
        ),
        Reflectance::Table {
            nm,
            values,
            extrapolate,
        } => {
            let columns = [(column, values.as_slice())];
            let [spectrum] = points::inline(checks, field, nm, columns, *extrapolate)?;
            (spectrum, Advice::Add)
        }
        Reflectance::File {
            csv,
            column: chosen,
            unit,
            extrapolate,
        } => {
            let table = FileTable {
                path: &checks.path(&field.key("csv"), csv)?,
                columns: points::chosen(chosen.as_ref()),
                unit: unit.as_deref(),
                extrapolate: *extrapolate,
            };
            let [spectrum] = points::file(checks, field, table, [column])?;
            (spectrum, Advice::Add)
        }
    })
}

fn named_reflectance(
    checks: &mut Checks,
    field: &FieldPath,
    name: &str,
    extrapolate: Extrapolate,
) -> Option<Spectrum> {
    let Some(set) = spectra::reflectance(name) else {
        checks.unknown_name(field, ("reflectance", name), &spectra::reflectance_names());
        return None;
    };
    Some(extrapolated(set.data, extrapolate))
}

/// Checks that red, green and blue are from 0 to 1.
fn color(checks: &mut Checks, field: &FieldPath, rgb: [f64; 3]) -> Option<[f64; 3]> {
    let checked: Vec<_> = (0..3)
        .map(|i| checks.number(&field.index(i), rgb[i], &limits::REFLECTANCE))
        .collect();
    checked
        .into_iter()
        .all(|value| value.is_some())
        .then_some(rgb)
}

/// The smooth reflectance of a color, tabulated at every nanometer that bands may cover.
fn smooth_reflectance(linear_rgb: [f64; 3]) -> Spectrum {
    let reflectance = SigmoidReflectance::of_linear_srgb(linear_rgb);
    let (first, last) = BandGrid::LIMITS_NM;
    let points =
        (first as u32..=last as u32).map(|nm| (f64::from(nm), reflectance.at(f64::from(nm))));
    Spectrum::Table(Tabulated::new(points.collect()).expect("its wavelengths increase"))
}
