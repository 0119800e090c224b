//! From a place in the picture to a ray.

use glam::DVec3;
use scene::{Projection, Scene};

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
    let (Projection::Perspective { half_height } | Projection::Orthographic { half_height }) =
        camera.projection;
    // From −1 at the left and the bottom to 1 at the right and the top.
    let across = 2.0 * (f64::from(pixel[0]) + jitter[0]) / width - 1.0;
    let upward = 1.0 - 2.0 * (f64::from(pixel[1]) + jitter[1]) / height;
    let aside =
        camera.right * (across * half_height * width / height) + camera.up * (upward * half_height);
    match camera.projection {
        Projection::Perspective { .. } => Ray {
            origin: camera.origin,
            direction: (aside - camera.back).normalize(),
        },
        Projection::Orthographic { .. } => Ray {
            origin: camera.origin + aside,
            direction: -camera.back,
        },
    }
}
