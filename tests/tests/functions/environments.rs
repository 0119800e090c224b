//! Functions of environment.wgsl.

use crate::world::{World, everything, pick, pictured, rounded, rows, unit, vector, within};
use crate::{Check, lazy};
use glam::DVec3;
use pellicle_tests::tolerances::{ARITHMETIC, DIRECTION, EMITTER_PDF, NEAR_POLE};
use scene::EnvironmentShape;
use std::sync::OnceLock;

/// A world whose environment is the same in all directions.
fn furnace() -> &'static World {
    static WORLD: OnceLock<World> = OnceLock::new();
    WORLD.get_or_init(|| World::new("furnace"))
}

pub(crate) fn checks() -> Vec<Check> {
    [
        of_world(
            everything,
            false,
            |a| sampled(everything(), a),
            |a| density(everything(), a),
        ),
        of_world(
            furnace,
            false,
            |a| sampled(furnace(), a),
            |a| density(furnace(), a),
        ),
        of_world(
            pictured,
            true,
            |a| sampled(pictured(), a),
            |a| density(pictured(), a),
        ),
    ]
    .into_iter()
    .flatten()
    .collect()
}

type Twin = fn(&[f64]) -> Vec<f64>;

fn of_world(
    world: fn() -> &'static World,
    is_picture: bool,
    sampled: Twin,
    density: Twin,
) -> Vec<Check> {
    vec![
        Check {
            probe: within(
                world,
                (3, 3),
                "put3(0u, sample_environment(environment_part(u32(a(0u))), vec2f(a(1u), a(2u))));",
            ),
            proves: if is_picture {
                OF_PICTURES
            } else {
                &["sample_environment"]
            },
            inputs: lazy(move || numbers(world())),
            twin: sampled,
            tolerance: if is_picture { NEAR_POLE } else { DIRECTION },
        },
        Check {
            probe: within(
                world,
                (4, 2),
                "let e = environment_part(u32(a(0u))); put(0u, environment_pdf(e, a3(1u))); put(1u, environment_strength(e, a3(1u)));",
            ),
            proves: if is_picture {
                &["environment_picture_pdf", "environment_uv"]
            } else {
                &[
                    "environment_part",
                    "environment_pdf",
                    "environment_strength",
                ]
            },
            inputs: lazy(move || directions(world(), density)),
            twin: density,
            tolerance: if is_picture { EMITTER_PDF } else { ARITHMETIC },
        },
    ]
}

/// The numbers of the environment's parts.
fn parts(world: &World) -> Vec<usize> {
    (0..world.scene.environment_parts().len()).collect()
}

/// Rows of a part and two random numbers.
fn numbers(world: &World) -> Vec<f32> {
    let parts = parts(world);
    let mut numbers = rows(3, |u| Some(vec![pick(&parts, u[0]) as f64, u[1], u[2]]));
    for part in parts {
        numbers.extend([part as f32, 0.0, 0.0, part as f32, 0.999_999_94, 0.5]);
    }
    numbers
}

/// Rows of a part and a direction.
fn directions(world: &World, density: Twin) -> Vec<f32> {
    let parts = parts(world);
    // The density of a picture jumps from cell to cell.
    let is_picture = matches!(part_of(world, 0.0), EnvironmentShape::Picture(_));
    rows(3, |u| {
        let direction = rounded(unit(u[1], u[2]));
        let part = pick(&parts, u[0]) as f64;
        let row = |d: DVec3| [[part].as_slice(), &d.to_array()].concat();
        let is_clear = !is_picture
            || [DVec3::X, DVec3::Y, DVec3::Z].iter().all(|&aside| {
                let beside = |step: f64| density(&row((direction + step * aside).normalize()));
                beside(-1e-4) == beside(1e-4)
            });
        is_clear.then(|| row(direction))
    })
}

/// Functions of environments from pictures.
const OF_PICTURES: &[&str] = &[
    "direction_table",
    "load_panorama",
    "interval_of",
    "position_in_interval",
    "sample_environment_picture",
];

fn part_of(world: &World, part: f64) -> EnvironmentShape<'_> {
    world.scene.environment_parts()[part as usize].shape
}

fn sampled(world: &World, a: &[f64]) -> Vec<f64> {
    let direction = reference::sample_environment(part_of(world, a[0]), a[1], a[2]);
    direction.to_array().to_vec()
}

fn density(world: &World, a: &[f64]) -> Vec<f64> {
    let (part, direction) = (part_of(world, a[0]), vector(&a[1..]));
    vec![
        reference::environment_pdf(part, direction),
        reference::environment_strength(part, direction),
    ]
}
