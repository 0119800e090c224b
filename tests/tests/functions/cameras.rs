//! Functions of camera.wgsl: rays of the cameras, and pixel filters.

use crate::world::{World, everything, pictured, within};
use crate::{Check, lazy, table};
use pellicle_tests::tolerances::{DIRECTION, FILTER};
use std::sync::OnceLock;

/// A world whose camera is orthographic.
fn wedge() -> &'static World {
    static WORLD: OnceLock<World> = OnceLock::new();
    WORLD.get_or_init(|| World::new("film_wedge"))
}

const CAMERA: &str =
    "let r = camera_ray(vec2u(u32(a(0u)), u32(a(1u))), vec2f(a(2u), a(3u)), vec2f(a(4u), a(5u)));
    put3(0u, r.origin); put3(3u, r.direction);";

fn camera_twin(world: &World, a: &[f64]) -> Vec<f64> {
    let pixel = [a[0] as u32, a[1] as u32];
    let ray = reference::sampled_camera_ray(&world.scene, pixel, [a[2], a[3]], [a[4], a[5]]);
    [ray.origin.to_array(), ray.direction.to_array()].concat()
}

pub(crate) fn checks() -> Vec<Check> {
    let check = |world: fn() -> &'static World, twin| Check {
        probe: within(world, (6, 6), CAMERA),
        proves: &["camera_ray"],
        inputs: lazy(pixels),
        twin,
        tolerance: DIRECTION,
    };
    vec![
        check(everything, |a| camera_twin(everything(), a)),
        check(wedge, |a| camera_twin(wedge(), a)),
        check(pictured, |a| camera_twin(pictured(), a)),
        Check {
            probe: within(everything, (1, 1), "put(0u, filter_offset(a(0u)));"),
            proves: &["filter_offset"],
            inputs: lazy(move || table(&[(0.0, 1.0)], &[&[0.0], &[0.5], &[0.999_999_94]])),
            twin: |a| vec![everything().scene.camera().filter.offset_at(a[0])],
            tolerance: FILTER,
        },
    ]
}

/// A pixel and the numbers that choose a ray in it.
fn pixels() -> Vec<f32> {
    let mut pixels = table(
        &[
            (0.0, 96.0),
            (0.0, 64.0),
            (0.0, 1.0),
            (0.0, 1.0),
            (0.0, 1.0),
            (0.0, 1.0),
        ],
        &[
            &[0.0; 6],
            &[
                95.0,
                63.0,
                0.999_999_94,
                0.999_999_94,
                0.999_999_94,
                0.999_999_94,
            ],
            &[48.0, 32.0, 0.0, 0.0, 0.0, 0.5],
        ],
    );
    for pixel in pixels.chunks_mut(6) {
        pixel[0] = pixel[0].floor().min(95.0);
        pixel[1] = pixel[1].floor().min(63.0);
    }
    pixels
}
