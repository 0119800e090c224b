//! Lights: which objects they are, and those that are no objects, which follow the others and which no ray meets.

use super::texels::Pictures;
use super::{light, vec3};
use crate::layout;
use scene::{Emission, EnvironmentShape, LightShape, Scene, SourceKind};

/// Appends the surroundings and the lights that are no objects, each with a material of its own, and numbers all that light is
/// sent from.
pub(super) fn append(
    scene: &Scene,
    objects: &mut Vec<layout::Object>,
    materials: &mut Vec<layout::Material>,
    (pictures, numbers): (&mut Pictures, &mut Vec<f32>),
) {
    let mut add = |mut object: layout::Object, emission: Emission, picture: u32| {
        (object.material, object.light) = (materials.len() as u32, layout::NONE);
        objects.push(object);
        materials.push(layout::Material {
            picture,
            ..emitter(emission)
        });
    };
    for part in scene.surroundings() {
        let head = match part.shape {
            EnvironmentShape::Picture(picture) => pictures.add_environment(picture, numbers),
            _ => layout::NONE,
        };
        add(surrounding(part.shape), part.emission, head);
    }
    for light in scene.lights() {
        if let Some(object) = single_direction(light.shape) {
            add(object, light.emission, layout::NONE);
        }
    }
    for (number, source) in scene.light_sources().iter().enumerate() {
        let index = object_of(scene, source.kind);
        objects[number].light = index as u32;
        objects[index].is_light = 1;
        objects[index].brightness = source.brightness as f32;
    }
}

/// The object that a source of light is.
fn object_of(scene: &Scene, kind: SourceKind) -> usize {
    let first = scene.objects().len();
    match kind {
        SourceKind::Object(index) => index,
        SourceKind::Environment(index) => first + index,
        // Discs, which stand first among the lights, are the last of the surroundings.
        SourceKind::Light(index) => first + scene.environment().parts().len() + index,
    }
}

fn surrounding(shape: EnvironmentShape<'_>) -> layout::Object {
    let mut packed = layout::Object::default();
    match shape {
        EnvironmentShape::Everywhere => packed.shape = layout::SHAPE_EVERYWHERE,
        EnvironmentShape::Horizon => packed.shape = layout::SHAPE_HORIZON,
        EnvironmentShape::Pole(pole) => {
            (packed.shape, packed.normal) = (layout::SHAPE_POLE, vec3(pole));
        }
        EnvironmentShape::Picture(picture) => {
            packed.shape = layout::SHAPE_PICTURE;
            (packed.normal, packed.tangent) = (vec3(picture.forward), vec3(picture.right));
        }
        EnvironmentShape::Disc { towards, height } => {
            (packed.shape, packed.normal) = (layout::SHAPE_DISC, vec3(towards));
            packed.radius = height as f32;
        }
    }
    packed
}

/// A light of a single direction at each place; none for a disc.
fn single_direction(shape: LightShape) -> Option<layout::Object> {
    let mut packed = layout::Object::default();
    match shape {
        LightShape::Disc { .. } => return None,
        LightShape::Direction { towards } => {
            (packed.shape, packed.normal) = (layout::SHAPE_DIRECTION, vec3(towards));
        }
        LightShape::Point { position } => {
            (packed.shape, packed.center) = (layout::SHAPE_POINT, vec3(position));
        }
        LightShape::Spot {
            position,
            axis,
            full_height,
            edge_height,
        } => {
            packed.shape = layout::SHAPE_SPOT;
            (packed.center, packed.normal) = (vec3(position), vec3(axis));
            (packed.half_width, packed.half_height) = (full_height as f32, edge_height as f32);
        }
    }
    Some(packed)
}

/// What only emits.
fn emitter(emission: Emission) -> layout::Material {
    layout::Material {
        emission: light(emission),
        emission_scale: emission.scale as f32,
        is_black: 1,
        ..Default::default()
    }
}
