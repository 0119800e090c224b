//! From a position in the picture to a ray.

use glam::DVec3;
use optics::wide::sin_cos_turns;
use scene::{Projection, Scene};
use std::f64::consts::{FRAC_PI_2, PI};

/// A ray: an origin and a unit direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin.
    pub origin: DVec3,
    /// Unit direction.
    pub direction: DVec3,
}

/// Returns the ray through the center of the lens and a position within a pixel, in [0, 1)² with row 0 on top.
pub fn camera_ray(scene: &Scene, pixel: [u32; 2], place: [f64; 2]) -> Ray {
    let offset = place.map(|inside| inside - 0.5);
    ray_off_middle(scene, pixel, offset, [0.0; 2])
}

/// Returns the camera ray of a sample: `jitter` in [0, 1)² distributes the samples by the pixel's filter, `on_lens` in [0, 1)² over
/// the lens.
pub fn sampled_camera_ray(
    scene: &Scene,
    pixel: [u32; 2],
    jitter: [f64; 2],
    on_lens: [f64; 2],
) -> Ray {
    let filter = &scene.camera().filter;
    ray_off_middle(scene, pixel, jitter.map(|u| filter.offset_at(u)), on_lens)
}

/// Returns the ray at an offset from a pixel's center.
fn ray_off_middle(scene: &Scene, pixel: [u32; 2], offset: [f64; 2], [u, v]: [f64; 2]) -> Ray {
    let (camera, settings) = (scene.camera(), scene.settings());
    let (width, height) = (f64::from(settings.width), f64::from(settings.height));
    // From −1 at the left and the bottom to 1 at the right and the top.
    let across = 2.0 * (f64::from(pixel[0]) + 0.5 + offset[0]) / width - 1.0;
    let upward = 1.0 - 2.0 * (f64::from(pixel[1]) + 0.5 + offset[1]) / height;
    let aside = |half_height: f64| {
        camera.right * (across * half_height * width / height) + camera.up * (upward * half_height)
    };
    let (on_lens, focus) = match camera.lens {
        // Uniform over the lens.
        Some(lens) => {
            let (sine, cosine) = sin_cos_turns(v);
            let at = camera.right * cosine + camera.up * sine;
            (at * (lens.radius * u.sqrt()), lens.focus_distance)
        }
        None => (DVec3::ZERO, 1.0),
    };
    match camera.projection {
        // All rays of a position in the picture meet where the pinhole's ray reaches the plane of focus.
        Projection::Perspective { half_height } => Ray {
            origin: camera.origin + on_lens,
            direction: (focus * (aside(half_height) - camera.back) - on_lens).normalize(),
        },
        Projection::Orthographic { half_height } => Ray {
            origin: camera.origin + aside(half_height),
            direction: -camera.back,
        },
        Projection::Panorama => {
            let (sine, cosine) = (PI * across).sin_cos();
            let (height, radius) = (FRAC_PI_2 * upward).sin_cos();
            let around = camera.right * sine - camera.back * cosine;
            Ray {
                origin: camera.origin,
                direction: around * radius + camera.up * height,
            }
        }
    }
}
