//! Functions of environment.wgsl.

use crate::Check;
use crate::world::{World, everything, pick, pictured, rounded, rows, unit, vector};
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
            everything(),
            |a| sampled(everything(), a),
            |a| density(everything(), a),
        ),
        of_world(
            furnace(),
            |a| sampled(furnace(), a),
            |a| density(furnace(), a),
        ),
        of_world(
            pictured(),
            |a| sampled(pictured(), a),
            |a| density(pictured(), a),
        ),
    ]
    .into_iter()
    .flatten()
    .collect()
}

type Twin = fn(&[f64]) -> Vec<f64>;

fn of_world(world: &'static World, sampled: Twin, density: Twin) -> Vec<Check> {
    let parts: Vec<usize> = (0..world.scene.environment_parts().len()).collect();
    let others = parts.clone();
    // The density of a picture jumps from cell to cell.
    let is_picture = matches!(
        part_of(world, parts[0] as f64),
        EnvironmentShape::Picture(_)
    );
    let mut numbers = rows(3, move |u| {
        Some(vec![pick(&parts, u[0]) as f64, u[1], u[2]])
    });
    for &part in &others {
        numbers.extend([part as f32, 0.0, 0.0, part as f32, 0.999_999_94, 0.5]);
    }
    let directions = rows(3, move |u| {
        let direction = rounded(unit(u[1], u[2]));
        let part = pick(&others, u[0]) as f64;
        let row = |d: DVec3| [[part].as_slice(), &d.to_array()].concat();
        let is_clear = !is_picture
            || [DVec3::X, DVec3::Y, DVec3::Z].iter().all(|&aside| {
                let beside = |step: f64| density(&row((direction + step * aside).normalize()));
                beside(-1e-4) == beside(1e-4)
            });
        is_clear.then(|| row(direction))
    });
    vec![
        Check {
            probe: world.probe((3, 3),
                "put3(0u, sample_environment(environment_part(u32(a(0u))), vec2f(a(1u), a(2u))));",
            ),
            proves: if is_picture { OF_PICTURES } else { &["sample_environment"] },
            inputs: numbers,
            twin: sampled,
            tolerance: if is_picture { NEAR_POLE } else { DIRECTION },
        },
        Check {
            probe: world.probe((4, 2),
                "let e = environment_part(u32(a(0u))); put(0u, environment_pdf(e, a3(1u))); put(1u, environment_strength(e, a3(1u)));",
            ),
            proves: if is_picture {
                &["environment_picture_pdf", "environment_uv"]
            } else {
                &["environment_part", "environment_pdf", "environment_strength"]
            },
            inputs: directions,
            twin: density,
            tolerance: if is_picture { EMITTER_PDF } else { ARITHMETIC },
        },
    ]
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
