//! How pictures are mapped to surfaces, and which of their pixels a path uses.

use glam::DVec3;
use scene::{Shape, Texels};
use std::f64::consts::{PI, TAU};

/// Returns a shape's center, or the origin of a plane's axes.
pub(crate) fn center_of(shape: &Shape) -> DVec3 {
    match *shape {
        Shape::Sphere { center, .. }
        | Shape::Rectangle { center, .. }
        | Shape::Disk { center, .. } => center,
        Shape::Plane { point, .. } => point,
    }
}

/// Returns the angle between two directions over π. The arc cosine of their product would lose half the digits near 0.
pub(crate) fn half_turns(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b)) / PI
}

/// Returns the position in a picture, from its upper left corner, in units of its width and height, and whether it wraps at its sides.
pub(crate) fn picture_uv(
    size: Option<[f64; 2]>,
    shape: &Shape,
    position: DVec3,
) -> ([f64; 2], bool) {
    let local = position - center_of(shape);
    match *shape {
        Shape::Sphere { .. } => {
            let longitude = local.x.atan2(local.z) / TAU;
            let from_pole = half_turns(local, DVec3::Y);
            ([0.5 + longitude, from_pole], true)
        }
        Shape::Plane {
            tangent, bitangent, ..
        }
        | Shape::Rectangle {
            tangent, bitangent, ..
        }
        | Shape::Disk {
            tangent, bitangent, ..
        } => {
            let [width, height] = size.unwrap_or(match *shape {
                Shape::Rectangle {
                    half_width,
                    half_height,
                    ..
                } => [2.0 * half_width, 2.0 * half_height],
                Shape::Disk { radius, .. } => [2.0 * radius; 2],
                _ => [1.0, 1.0],
            });
            let across = 0.5 + local.dot(tangent) / width;
            let down = 0.5 - local.dot(bitangent) / height;
            ([across, down], false)
        }
    }
}

/// Returns the pixel that a path uses at a position in a picture: one of the four whose centers surround it, with the weights of
/// bilinear interpolation as probabilities (`random` in [0, 1)).
pub(crate) fn chosen_pixel(
    texels: &Texels,
    [across, down]: [f64; 2],
    wraps: bool,
    random: f64,
) -> [u32; 2] {
    let (width, height) = (f64::from(texels.width), f64::from(texels.height));
    let x = (across * width - 0.5).clamp(-1.0, width);
    let y = (down * height - 0.5).clamp(0.0, height - 1.0);
    let (to_right, below) = (x - x.floor(), y - y.floor());
    let is_right = random < to_right;
    let rest = if is_right {
        random / to_right
    } else {
        (random - to_right) / (1.0 - to_right)
    };
    let column = x.floor() + f64::from(u8::from(is_right));
    let column = if wraps {
        column.rem_euclid(width)
    } else {
        column.clamp(0.0, width - 1.0)
    };
    let row = (y.floor() + f64::from(u8::from(rest < below))).min(height - 1.0);
    [column as u32, row as u32]
}
