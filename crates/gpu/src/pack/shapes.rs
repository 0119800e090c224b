//! What rays meet.

use super::vec3;
use crate::layout;
use scene::{Object, Shape};

/// An object; whether it is an emitter follows.
pub(super) fn pack(object: &Object) -> layout::Shape {
    let mut packed = layout::Shape {
        material: object.material.index() as u32,
        emitter: layout::NONE,
        ..Default::default()
    };
    match object.shape {
        Shape::Sphere { center, radius } => {
            packed.kind = layout::SHAPE_SPHERE;
            packed.center = vec3(center);
            packed.radius = radius as f32;
        }
        Shape::Plane {
            point,
            normal,
            tangent,
            bitangent,
        } => {
            packed.kind = layout::SHAPE_PLANE;
            packed.center = vec3(point);
            (packed.normal, packed.tangent, packed.bitangent) =
                (vec3(normal), vec3(tangent), vec3(bitangent));
        }
        Shape::Rectangle {
            center,
            normal,
            tangent,
            bitangent,
            half_width,
            half_height,
        } => {
            packed.kind = layout::SHAPE_RECTANGLE;
            packed.center = vec3(center);
            (packed.normal, packed.tangent, packed.bitangent) =
                (vec3(normal), vec3(tangent), vec3(bitangent));
            packed.half_width = half_width as f32;
            packed.half_height = half_height as f32;
        }
        Shape::Disk {
            center,
            normal,
            tangent,
            bitangent,
            radius,
        } => {
            packed.kind = layout::SHAPE_DISK;
            packed.center = vec3(center);
            (packed.normal, packed.tangent, packed.bitangent) =
                (vec3(normal), vec3(tangent), vec3(bitangent));
            packed.radius = radius as f32;
            (packed.half_width, packed.half_height) = (packed.radius, packed.radius);
        }
    }
    packed
}
