//! Packing of objects.

use super::vec3;
use crate::features::is_large;
use crate::layout;
use glam::DVec3;
use scene::{Object, Scene, Shape, Sheet};

/// Packs the objects; whether they are emitters is set later.
pub(super) fn pack_all(scene: &Scene) -> Vec<layout::Shape> {
    let pack = |(index, object): (usize, &Object)| {
        let mut shape = pack(object, scene.sheets().get(index).copied().flatten());
        if is_large(scene, &object.shape) {
            anchor(&mut shape, &object.shape, scene.camera().origin);
        }
        shape
    };
    scene.objects().iter().enumerate().map(pack).collect()
}

/// Describes a large sphere by its point nearest to the camera.
fn anchor(packed: &mut layout::Shape, shape: &Shape, camera: DVec3) {
    if let Shape::Sphere { center, radius } = *shape {
        let normal = (camera - center).normalize();
        packed.normal = vec3(normal);
        packed.nearest = vec3(center + radius * normal);
        packed.curvature = (1.0 / radius) as f32;
    }
}

fn pack(object: &Object, sheet: Option<Sheet>) -> layout::Shape {
    let mut packed = layout::Shape {
        material: object.material.index() as u32,
        emitter: layout::NONE,
        stack: sheet.map_or(layout::NONE, |sheet| sheet.stack),
        sheet: sheet.map_or(0, |sheet| 2 * sheet.depth + u32::from(sheet.is_turned)),
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
