//! Turns the cells of a column into a table over wavelength.

use super::error::TableFileError;
use super::options::{Options, Unit};
use super::{Notes, Point, Quantity, QuantityKind, Series};
use crate::Tabulated;
use crate::sprague::sprague;

/// The range of wavelengths that a table may have, nm.
const POSSIBLE_NM: (f64, f64) = (1.0, 1e6);
/// Tables in nm extend beyond this; a table entirely below it may be in µm.
pub(super) const SHORTEST_NM: f64 = 50.0;
/// How far noise may make a fraction negative, or an amount relative to the largest in the table.
const NOISE: f64 = 1e-3;

/// Makes the table of a column, with values in the range of the quantity.
pub(super) fn table(
    series: &Series,
    quantity: Quantity,
    options: &Options,
    notes: &mut Notes,
) -> Result<Tabulated, TableFileError> {
    let points = &series.points;
    let unit = unit(series, options, notes)?;
    let nm = wavelengths(points, unit)?;
    let is_falling = is_falling(points, &nm)?;
    let scale = scale(series, quantity, options, notes);
    let values = values(points, (scale, quantity), notes)?;
    let mut table: Vec<(f64, f64)> = nm.into_iter().zip(values).collect();
    if is_falling {
        table.reverse();
        if unit != Unit::Ev {
            notes.add("rows reversed, because wavelengths fall");
        }
    }
    let table = Tabulated::new(table).map_err(|_| TableFileError::Empty)?;
    match sprague(&table, quantity.range) {
        Some((fine, step_nm)) if quantity.kind == QuantityKind::Part => {
            notes.add(format!(
                "Sprague's interpolation between points {step_nm} nm apart"
            ));
            Ok(fine)
        }
        _ => Ok(table),
    }
}

/// Returns the unit of the wavelengths: the requested one, the one in the file, or else nm.
fn unit(series: &Series, options: &Options, notes: &mut Notes) -> Result<Unit, TableFileError> {
    if let Some(unit) = options.unit {
        return Ok(unit);
    }
    if let Some((unit, how)) = series.unit {
        if unit != Unit::Nm {
            notes.add(format!("wavelengths in {}, {how}", unit.name()));
        }
        return Ok(unit);
    }
    let is_short = |point: &Point| point.place < SHORTEST_NM;
    let Some(first) = series.points.first() else {
        return Err(TableFileError::Empty);
    };
    if series.points.iter().all(is_short) && first.place > 0.0 {
        return Err(TableFileError::Ambiguous {
            line: first.line,
            text: first.place_text.to_string(),
            one: format!("{} nm", first.place_text),
            other: format!("{} µm, as all wavelengths are below {SHORTEST_NM}", first.place_text),
            way_out: "name the unit in the header, as in \"wavelength (um)\", or write `unit = \"um\"` next to `csv` (`--unit um`)".to_owned(),
        });
    }
    Ok(Unit::Nm)
}

/// Converts the wavelengths to nm.
fn wavelengths(points: &[Point], unit: Unit) -> Result<Vec<f64>, TableFileError> {
    let nm = |point: &Point| {
        let nm = match unit {
            Unit::Ev => whole(unit.nm(point.place)),
            _ => unit.nm(point.place),
        };
        if (POSSIBLE_NM.0..=POSSIBLE_NM.1).contains(&nm) {
            return Ok(nm);
        }
        let text = match unit {
            Unit::Nm => point.place_text.to_string(),
            _ => format!("{} {}", point.place_text, unit.name()),
        };
        Err(TableFileError::Value {
            line: point.line,
            noun: "wavelength",
            text,
            range: POSSIBLE_NM,
            hint: " nm",
        })
    };
    points.iter().map(nm).collect()
}

/// Rounds to a whole number of nm where that is probably meant, since the digits of an energy may not reproduce it exactly.
fn whole(nm: f64) -> f64 {
    let near = nm.round();
    if (nm - near).abs() < 1e-6 * nm {
        near
    } else {
        nm
    }
}

/// Whether the wavelengths fall from row to row; a single row counts as rising.
fn is_falling(points: &[Point], nm: &[f64]) -> Result<bool, TableFileError> {
    let mut falling = None;
    for (pair, nm) in points.windows(2).zip(nm.windows(2)) {
        let ([before, here], &[before_nm, here_nm]) = (pair, nm) else {
            continue;
        };
        let falls = here_nm < before_nm;
        if falls == (here_nm > before_nm) {
            return Err(TableFileError::Repeated {
                lines: (before.line, here.line),
                text: here.place_text.to_string(),
            });
        }
        if *falling.get_or_insert(falls) != falls {
            return Err(TableFileError::NotInOrder {
                line: here.line,
                text: here.place_text.to_string(),
                before: before.place_text.to_string(),
                direction: if falls { "they rise" } else { "they fall" },
            });
        }
    }
    Ok(falling == Some(true))
}

/// Returns the divisor of the values.
fn scale(series: &Series, quantity: Quantity, options: &Options, notes: &mut Notes) -> f64 {
    if quantity.kind != QuantityKind::Part {
        return 1.0;
    }
    match series.scale {
        _ if options.is_percent => 100.0,
        Some(scale) => {
            notes.add(if scale == 100.0 {
                "values in percent, as the file says".to_owned()
            } else {
                format!("values divided by {scale}, as the file says")
            });
            scale
        }
        None => 1.0,
    }
}

/// Scales the values and checks their range; values just below 0 become 0.
fn values(
    points: &[Point],
    (scale, quantity): (f64, Quantity),
    notes: &mut Notes,
) -> Result<Vec<f64>, TableFileError> {
    let largest = points.iter().map(|point| point.value).fold(0.0, f64::max);
    let noise = match quantity.kind {
        QuantityKind::Part => NOISE,
        QuantityKind::Amount => NOISE * largest,
        QuantityKind::Plain => 0.0,
    };
    let (low, high) = quantity.range;
    let mut lowest: Option<&Point> = None;
    let mut count = 0;
    let mut values = Vec::with_capacity(points.len());
    for point in points {
        // Adding 0 turns −0 into 0.
        let value = point.value / scale + 0.0;
        if value < low && low == 0.0 && value >= -noise {
            count += 1;
            lowest = Some(
                lowest
                    .filter(|lowest| lowest.value <= point.value)
                    .unwrap_or(point),
            );
            values.push(0.0);
        } else if (low..=high).contains(&value) {
            values.push(value);
        } else {
            return Err(out_of_range(point, scale, quantity));
        }
    }
    if let Some(lowest) = lowest {
        notes.add(format!(
            "{count} {} just below 0 taken as 0, the lowest {} in line {}",
            if count == 1 { "value" } else { "values" },
            lowest.text,
            lowest.line
        ));
    }
    Ok(values)
}

fn out_of_range(point: &Point, scale: f64, quantity: Quantity) -> TableFileError {
    let may_be_percent = quantity.kind == QuantityKind::Part && scale == 1.0 && point.value > 1.0;
    TableFileError::Value {
        line: point.line,
        noun: quantity.noun,
        text: if scale == 1.0 {
            point.text.to_string()
        } else {
            format!("{} / {scale}", point.text)
        },
        range: quantity.range,
        hint: if may_be_percent {
            "; values in percent need a header that says so, as in \"nm,%R\", or `unit = \"percent\"` next to `csv` (`--unit percent`)"
        } else {
            ""
        },
    }
}
