//! Draining soap films: tables of the drainage model at the scene's time.

use super::{KNOTS, line};
use crate::description::Drainage;
use crate::drainage::{Liquid, sphere_profile2};
use crate::limits;
use crate::validate::checks::Checks;
use document::{FieldPath, Problem, ProblemKind};
use glam::DVec3;
use scene::{BlackFilm, Coordinate, Profile};
use std::f64::consts::PI;

/// At time 0 the profile of a plane film is infinitely steep: the whole film has its initial thickness.
const STEEPEST_NM2: f64 = 1e20;

/// The parameters that both kinds of draining films have.
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

/// Checks a draining film.
pub(super) fn check(checks: &mut Checks, field: &FieldPath, written: &Drainage) -> Option<Profile> {
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

/// The sine of the slope from `from` down to `to`, which must be lower.
fn falling(checks: &mut Checks, field: &FieldPath, top: DVec3, bottom: DVec3) -> Option<f64> {
    let sine = (top - bottom).normalize().y;
    if sine >= limits::MIN_SINE {
        return Some(sine);
    }
    let message = "the film does not run down: `to` must be lower than `from` in y";
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
        // Without liquid, no drop gathers.
        squares_nm2: match film.initial_nm {
            0.0 => vec![0.0; 2],
            _ => (0..KNOTS).map(square).collect(),
        },
        most_nm,
        black: Some(film.black),
    }
}

/// h² = z / (3 K t) is linear in z; the film is cut off at its initial thickness.
fn draining_plane(
    film: &Film,
    height_m: f64,
    (start, end): (DVec3, DVec3),
    time_s: f64,
) -> Profile {
    let thinning = film.liquid.thinning(time_s, height_m);
    let bottom_nm2 = (1.0 / thinning).min(STEEPEST_NM2);
    let top_nm2 = if bottom_nm2 < STEEPEST_NM2 {
        0.0
    } else {
        STEEPEST_NM2
    };
    Profile {
        coordinate: Coordinate::Line { start, end },
        squares_nm2: vec![top_nm2, bottom_nm2],
        most_nm: film.initial_nm,
        black: Some(film.black),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the error that [`KNOTS`] states: linear interpolation of squares against the model itself.
    #[test]
    fn the_table_of_a_bubble_is_fine_enough() {
        for tau in [0.3, 3.0, 300.0] {
            let film = Film {
                initial_nm: 300.0,
                liquid: Liquid {
                    viscosity_pa_s: 1.0,
                    density_kg_m3: 1.0,
                },
                black: BlackFilm {
                    below_nm: 0.0,
                    nm: 0.0,
                },
            };
            let time_s = tau / (9e4 * film.liquid.thinning(1.0, 1.0));
            let squares = draining_sphere(&film, 1.0, time_s).squares_nm2;
            let error = |degrees: f64| {
                let place = degrees / 180.0 * f64::from(KNOTS - 1);
                let (knot, part) = (place as usize, place.fract());
                let square = squares[knot] + (squares[knot + 1] - squares[knot]) * part;
                let exact = 9e4 * sphere_profile2(degrees.to_radians(), tau);
                ((square / exact).sqrt() - 1.0).abs()
            };
            let worst = |from: u32, to: u32| {
                let places = (4 * from..4 * to).map(|i| f64::from(i) / 4.0 + 0.1);
                places.map(error).fold(0.0, f64::max)
            };
            assert!(worst(0, 160) < 1e-4, "{}", worst(0, 160));
            assert!(worst(160, 175) < 1e-3, "{}", worst(160, 175));
        }
    }
}
