//! From a place in the picture to a ray.

use glam::DVec3;
use scene::{Projection, Scene};
use std::f64::consts::{FRAC_PI_2, PI};

/// A ray: an origin and a unit direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Unit vector.
    pub direction: DVec3,
}

/// The ray through a pixel; `jitter` in [0, 1)² is the place within the pixel, row 0 on top.
pub fn camera_ray(scene: &Scene, pixel: [u32; 2], jitter: [f64; 2]) -> Ray {
    let (camera, settings) = (scene.camera(), scene.settings());
    let (width, height) = (f64::from(settings.width), f64::from(settings.height));
    // From −1 at the left and the bottom to 1 at the right and the top.
    let across = 2.0 * (f64::from(pixel[0]) + jitter[0]) / width - 1.0;
    let upward = 1.0 - 2.0 * (f64::from(pixel[1]) + jitter[1]) / height;
    let aside = |half_height: f64| {
        camera.right * (across * half_height * width / height) + camera.up * (upward * half_height)
    };
    match camera.projection {
        Projection::Perspective { half_height } => Ray {
            origin: camera.origin,
            direction: (aside(half_height) - camera.back).normalize(),
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
