//! Thicknesses: fields at the scene's time, with every value within bounds.

use super::checks::Checks;
use super::picture_file;
use crate::description::{self, Drainage, Quantity};
use crate::drainage::{Liquid, sphere_profile2};
use crate::growth::heat_tint_nm2;
use crate::limits::{self, Range};
use crate::problem::{Problem, ProblemKind};
use crate::{BlackFilm, Coordinate, FieldPath, Picture, Profile, Swirls, Thickness};
use glam::DVec3;
use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

/// Knots of a profile that is no straight line. On a draining bubble what lies between them is off by less than 3e-5 of the
/// thickness to 160° from the top, and by 1e-3 to 175°.
const KNOTS: u32 = 513;

/// Checks a thickness.
pub(crate) fn check(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Thickness,
) -> Option<Thickness> {
    check_extent(checks, field, written)?;
    part(checks, field, written)
}

/// Refuses what is too deep or too long before anything walks through it.
fn check_extent(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Thickness,
) -> Option<()> {
    let (mut parts, mut deepest) = (0, 0);
    let mut open = vec![(written, 0)];
    while let Some((part, depth)) = open.pop() {
        parts += 1;
        deepest = deepest.max(depth);
        if let description::Thickness::Sum { sum: inner }
        | description::Thickness::Product { product: inner } = part
        {
            open.extend(inner.iter().map(|part| (part, depth + 1)));
        }
    }
    let (what, found, most) = if deepest > limits::MAX_FIELD_DEPTH {
        (
            "levels of sums and products",
            deepest,
            limits::MAX_FIELD_DEPTH,
        )
    } else if parts > limits::MAX_FIELD_PARTS {
        ("parts", parts, limits::MAX_FIELD_PARTS)
    } else {
        return Some(());
    };
    let message = format!("found {found} {what}; at most {most} are possible");
    checks.report(Problem::new(ProblemKind::TooLarge, field, message));
    None
}

fn part(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Thickness,
) -> Option<Thickness> {
    use description::Thickness as Written;
    let range = &limits::THICKNESS_NM;
    match written {
        Written::Constant(nm) => {
            let nm = checks.number(field, *nm, range)?;
            Some(Thickness::Constant { nm })
        }
        Written::Polar {
            pole,
            equator,
            axis,
        } => polar(checks, field, (*pole, *equator), *axis),
        Written::Linear {
            start,
            end,
            from,
            to,
        } => linear(checks, field, (*start, *end), (*from, *to), range),
        Written::Steps { steps } => stepped(checks, &field.key("steps"), steps),
        Written::Drainage { drainage } => {
            draining(checks, &field.key("drainage"), drainage).map(Thickness::Profile)
        }
        Written::Swirls { swirls } => swirled(checks, &field.key("swirls"), swirls),
        Written::Image {
            image,
            min,
            max,
            size,
        } => pictured(checks, field, image, (*min, *max), *size),
        Written::Sum { sum } => combined(checks, &field.key("sum"), sum).map(Thickness::Sum),
        Written::Product { product } => {
            combined(checks, &field.key("product"), product).map(Thickness::Product)
        }
        Written::Anodising { anodising } => anodised(checks, &field.key("anodising"), anodising),
        Written::HeatTint { heat_tint } => tinted(checks, &field.key("heat_tint"), heat_tint),
    }
}

fn polar(
    checks: &mut Checks,
    field: &FieldPath,
    (pole, equator): (f64, f64),
    axis: [f64; 3],
) -> Option<Thickness> {
    let range = &limits::THICKNESS_NM;
    let pole_nm = checks.number(&field.key("pole"), pole, range);
    let equator_nm = checks.number(&field.key("equator"), equator, range);
    let axis = checks.direction(&field.key("axis"), axis);
    let (pole_nm, equator_nm) = (pole_nm?, equator_nm?);
    check_far_pole(checks, field, pole_nm, equator_nm)?;
    Some(Thickness::Polar {
        axis: axis?,
        pole_nm,
        equator_nm,
    })
}

/// Linear from the pole over the equator, the thickness at the far pole is 2 equator − pole.
fn check_far_pole(
    checks: &mut Checks,
    field: &FieldPath,
    pole_nm: f64,
    equator_nm: f64,
) -> Option<()> {
    let far_nm = 2.0 * equator_nm - pole_nm;
    let range = &limits::THICKNESS_NM;
    if range.contains(far_nm) {
        return Some(());
    }
    let message = format!(
        "from {pole_nm} nm at the pole over {equator_nm} nm at the equator the thickness comes to {far_nm} nm at \
         the far pole; it must be from {range} everywhere"
    );
    let least_nm = pole_nm / 2.0;
    let most_nm = f64::midpoint(pole_nm, range.high);
    let help = format!("with this pole, `equator` can be from {least_nm} to {most_nm} nm");
    checks.report(Problem::new(ProblemKind::OutOfRange, field, message).help(help));
    None
}

fn linear(
    checks: &mut Checks,
    field: &FieldPath,
    (start, end): (f64, f64),
    points: ([f64; 3], [f64; 3]),
    range: &Range,
) -> Option<Thickness> {
    let start_nm = checks.number(&field.key("start"), start, range);
    let end_nm = checks.number(&field.key("end"), end, range);
    let (start, end) = line(checks, field, points)?;
    Some(Thickness::Linear {
        start,
        end,
        start_nm: start_nm?,
        end_nm: end_nm?,
    })
}

/// The points `from` and `to`, which must not coincide.
fn line(
    checks: &mut Checks,
    field: &FieldPath,
    (from, to): ([f64; 3], [f64; 3]),
) -> Option<(DVec3, DVec3)> {
    let (from_field, to_field) = (field.key("from"), field.key("to"));
    let from = checks.point(&from_field, from);
    let to = checks.point(&to_field, to);
    let (from, to) = (from?, to?);
    checks.distance((&to_field, to), (&from_field, from))?;
    Some((from, to))
}

fn stepped(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Steps,
) -> Option<Thickness> {
    let values = field.key("values");
    let count = written.values.len();
    if !(1..=limits::MAX_STEPS).contains(&count) {
        let most = limits::MAX_STEPS;
        let message = format!("found {count} steps; there must be from 1 to {most}");
        checks.report(Problem::new(ProblemKind::OutOfRange, &values, message));
        return None;
    }
    let nm: Vec<_> = written
        .values
        .iter()
        .enumerate()
        .map(|(index, &nm)| checks.number(&values.index(index), nm, &limits::THICKNESS_NM))
        .collect();
    let (start, end) = line(checks, field, (written.from, written.to))?;
    let nm = nm.into_iter().collect::<Option<_>>()?;
    Some(Thickness::Steps { start, end, nm })
}

/// What both kinds of draining films have.
struct Film {
    initial_nm: f64,
    liquid: Liquid,
    black: BlackFilm,
}

fn film(
    checks: &mut Checks,
    field: &FieldPath,
    initial: f64,
    (viscosity, density): (f64, f64),
    (black_below, black): (f64, f64),
) -> Option<Film> {
    let nm = &limits::DRAINING_NM;
    let initial_nm = checks.number(&field.key("initial"), initial, nm);
    let viscosity_pa_s = checks.number(
        &field.key("viscosity_pa_s"),
        viscosity,
        &limits::VISCOSITY_PA_S,
    );
    let density_kg_m3 = checks.number(&field.key("density_kg_m3"), density, &limits::DENSITY_KG_M3);
    let below_nm = checks.number(&field.key("black_below"), black_below, nm);
    let black_nm = checks.number(&field.key("black"), black, nm);
    Some(Film {
        initial_nm: initial_nm?,
        liquid: Liquid {
            viscosity_pa_s: viscosity_pa_s?,
            density_kg_m3: density_kg_m3?,
        },
        black: BlackFilm {
            below_nm: below_nm?,
            nm: black_nm?,
        },
    })
}

fn draining(checks: &mut Checks, field: &FieldPath, written: &Drainage) -> Option<Profile> {
    match *written {
        Drainage::Sphere {
            initial,
            radius_m,
            viscosity_pa_s: viscosity,
            density_kg_m3: density,
            black_below,
            black,
        } => {
            let film = film(
                checks,
                field,
                initial,
                (viscosity, density),
                (black_below, black),
            );
            let radius = field.key("radius_m");
            let radius_m = checks.number(&radius, radius_m, &limits::FILM_SIZE_M)?;
            Some(draining_sphere(&film?, radius_m, checks.time_s))
        }
        Drainage::Plane {
            initial,
            from,
            to,
            height_m,
            viscosity_pa_s: viscosity,
            density_kg_m3: density,
            black_below,
            black,
        } => {
            let film = film(
                checks,
                field,
                initial,
                (viscosity, density),
                (black_below, black),
            );
            let height = field.key("height_m");
            let height_m = checks.number(&height, height_m, &limits::FILM_SIZE_M);
            let (top, bottom) = line(checks, field, (from, to))?;
            let slope = falling(checks, field, top, bottom)?;
            let time_s = slope * checks.time_s;
            Some(draining_plane(&film?, height_m?, (top, bottom), time_s))
        }
    }
}

/// The sine of the slope from `from` down to `to`, which must lie lower.
fn falling(checks: &mut Checks, field: &FieldPath, top: DVec3, bottom: DVec3) -> Option<f64> {
    let sine = (top - bottom).normalize().y;
    if sine >= limits::MIN_SINE {
        return Some(sine);
    }
    let message = "the film does not run down: `to` must lie lower than `from` in y";
    let problem = Problem::new(ProblemKind::Inconsistent, &field.key("to"), message);
    checks.report(problem.involving(field.key("from")));
    None
}

fn draining_sphere(film: &Film, radius_m: f64, time_s: f64) -> Profile {
    let initial2 = film.initial_nm * film.initial_nm;
    let tau = initial2 * film.liquid.thinning(time_s, radius_m);
    let most_nm = limits::DRAINING_NM.high;
    let square = |knot| {
        let theta = PI * f64::from(knot) / f64::from(KNOTS - 1);
        (initial2 * sphere_profile2(theta, tau)).min(most_nm * most_nm)
    };
    Profile {
        coordinate: Coordinate::Polar { axis: DVec3::Y },
        // With no film at all there is nothing that could gather.
        squares_nm2: match film.initial_nm {
            0.0 => vec![0.0; 2],
            _ => (0..KNOTS).map(square).collect(),
        },
        most_nm,
        black: Some(film.black),
    }
}

/// h² = z / (3 K t) is a straight line, cut off at the first thickness.
fn draining_plane(
    film: &Film,
    height_m: f64,
    (start, end): (DVec3, DVec3),
    time_s: f64,
) -> Profile {
    let thinning = film.liquid.thinning(time_s, height_m);
    // Before the first instant the line is endlessly steep.
    let most_nm2 = limits::MAX_FIELD_VALUE;
    let bottom_nm2 = (1.0 / thinning).min(most_nm2);
    let top_nm2 = if thinning > 1.0 / most_nm2 {
        0.0
    } else {
        most_nm2
    };
    Profile {
        coordinate: Coordinate::Line { start, end },
        squares_nm2: vec![top_nm2, bottom_nm2],
        most_nm: film.initial_nm,
        black: Some(film.black),
    }
}

fn swirled(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Swirls,
) -> Option<Thickness> {
    let nm = &limits::THICKNESS_NM;
    let mean = checks.number(&field.key("mean"), written.mean, nm);
    let amplitude = checks.number(&field.key("amplitude"), written.amplitude, nm);
    let scale = checks.number(&field.key("scale"), written.scale, &limits::SWIRL_SCALE);
    let warp = checks.number(&field.key("warp"), written.warp, &limits::WARP);
    let rate = checks.number(&field.key("rate"), written.rate, &limits::SWIRL_RATE);
    let octaves = checks.number(
        &field.key("octaves"),
        f64::from(written.octaves),
        &limits::OCTAVES,
    );
    let lives = rate? * checks.time_s;
    octaves?;
    Some(Thickness::Swirls(Swirls {
        mean: mean?,
        amplitude: amplitude?,
        cells_per_unit: 1.0 / scale?,
        seed: written.seed,
        octaves: written.octaves,
        warp: warp?,
        cells: (lives.floor() % 2.0_f64.powi(32)) as u32,
        phase: lives.fract(),
    }))
}

fn pictured(
    checks: &mut Checks,
    field: &FieldPath,
    image: &Path,
    (min, max): (f64, f64),
    size: Option<[f64; 2]>,
) -> Option<Thickness> {
    let black_nm = checks.number(&field.key("min"), min, &limits::THICKNESS_NM);
    let white_nm = checks.number(&field.key("max"), max, &limits::THICKNESS_NM);
    let sides = size.map(|size| {
        let side = |index: usize| field.key("size").index(index);
        let width = checks.number(&side(0), size[0], &limits::LENGTH);
        let height = checks.number(&side(1), size[1], &limits::LENGTH);
        Some([width?, height?])
    });
    let path = checks.directory.join(image);
    let file = match picture_file::read(&path) {
        Ok(file) => Some(Arc::new(file)),
        Err(error) => {
            let message = format!("{}: {error}", path.display());
            checks.report(Problem::new(
                ProblemKind::File,
                &field.key("image"),
                message,
            ));
            None
        }
    };
    let size = match sides {
        Some(size) => Some(size?),
        None => None,
    };
    Some(Thickness::Picture(Picture {
        file: file?,
        black_nm: black_nm?,
        white_nm: white_nm?,
        size,
    }))
}

/// The parts of a sum or product, which must stay within numbers that `f32` has room for.
fn combined(
    checks: &mut Checks,
    field: &FieldPath,
    written: &[description::Thickness],
) -> Option<Vec<Thickness>> {
    if written.is_empty() {
        let message = "found an empty array; there must be at least one part";
        checks.report(Problem::new(ProblemKind::OutOfRange, field, message));
        return None;
    }
    let parts: Vec<_> = written
        .iter()
        .enumerate()
        .map(|(index, written)| part(checks, &field.index(index), written))
        .collect();
    let parts = parts.into_iter().collect::<Option<Vec<_>>>()?;
    let is_product = field
        .steps()
        .last()
        .is_some_and(|step| *step == crate::Step::Key("product".to_owned()));
    let bounds = parts.iter().map(largest);
    let most: f64 = if is_product {
        bounds.product()
    } else {
        bounds.sum()
    };
    if most > limits::MAX_FIELD_VALUE {
        let message = format!(
            "the values here may come to {most:.1e}; at most {:e} can be computed with",
            limits::MAX_FIELD_VALUE
        );
        checks.report(Problem::new(ProblemKind::TooLarge, field, message));
        return None;
    }
    Some(parts)
}

/// A bound of the absolute value of a thickness.
fn largest(thickness: &Thickness) -> f64 {
    match thickness {
        Thickness::Constant { nm } => *nm,
        Thickness::Polar {
            pole_nm,
            equator_nm,
            ..
        } => pole_nm.max(2.0 * equator_nm - pole_nm),
        Thickness::Linear {
            start_nm, end_nm, ..
        } => start_nm.max(*end_nm),
        Thickness::Steps { nm, .. } => nm.iter().copied().fold(0.0, f64::max),
        Thickness::Profile(profile) => {
            let black = profile.black.map_or(0.0, |black| black.nm);
            profile.most_nm.max(black)
        }
        Thickness::Swirls(swirls) => swirls.mean + swirls.amplitude,
        Thickness::Picture(picture) => picture.black_nm.max(picture.white_nm),
        Thickness::Sum(parts) => parts.iter().map(largest).sum(),
        Thickness::Product(parts) => parts.iter().map(largest).product(),
    }
}

/// Linear in the voltage, so it is linear where the voltage is.
fn anodised(
    checks: &mut Checks,
    field: &FieldPath,
    written: &description::Anodising,
) -> Option<Thickness> {
    let description::AnodisedMetal::Titanium = written.metal;
    let growth = field.key("nm_per_volt");
    let nm_per_volt = checks.number(&growth, written.nm_per_volt, &limits::NM_PER_VOLT);
    let native_nm = checks.number(&field.key("native"), written.native, &limits::THICKNESS_NM);
    let volts = quantity(checks, &field.key("volts"), &written.volts, &limits::VOLTS);
    let (nm_per_volt, native_nm) = (nm_per_volt?, native_nm?);
    let oxide = |volts: f64| native_nm + nm_per_volt * volts;
    Some(match volts? {
        Thickness::Linear {
            start,
            end,
            start_nm,
            end_nm,
        } => Thickness::Linear {
            start,
            end,
            start_nm: oxide(start_nm),
            end_nm: oxide(end_nm),
        },
        Thickness::Constant { nm } => Thickness::Constant { nm: oxide(nm) },
        other => other,
    })
}

fn tinted(
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
        Thickness::Linear {
            start,
            end,
            start_nm: cool,
            end_nm: hot,
        } => {
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
        Thickness::Constant { nm: celsius } => Thickness::Constant {
            nm: heat_tint_nm2(celsius, minutes).sqrt(),
        },
        other => other,
    })
}

/// A quantity in the form of a thickness: constant or linear, its values in the quantity's own unit.
fn quantity(
    checks: &mut Checks,
    field: &FieldPath,
    written: &Quantity,
    range: &Range,
) -> Option<Thickness> {
    match *written {
        Quantity::Constant(value) => {
            let nm = checks.number(field, value, range)?;
            Some(Thickness::Constant { nm })
        }
        Quantity::Linear {
            start,
            end,
            from,
            to,
        } => linear(checks, field, (start, end), (from, to), range),
    }
}
