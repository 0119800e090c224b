//! Packing of emitters: objects that emit, the environment part by part, and lights that are not objects.

use super::tables::Tables;
use super::{emission_ref, polarization_row, vec3};
use crate::layout::{self, NONE};
use scene::{Emission, EmitterKind, EmitterSource, EnvironmentShape, LightShape, Scene};

/// Packs all emitters: first those that are sampled, in the order of the scene's emitters, then the parts of the environment that
/// are not sampled. Adds the emitter indices of all parts of the environment to the tables, and also returns the position of the
/// first of them.
pub(super) fn pack(
    scene: &Scene,
    shapes: &mut [layout::Shape],
    tables: &mut Tables,
) -> (Vec<layout::Emitter>, u32) {
    let environment = scene.environment_parts();
    let mut numbers = vec![None; environment.len()];
    let mut emitters = Vec::new();
    for source in scene.emitters() {
        let number = emitters.len() as u32;
        match source.kind {
            EmitterKind::Object(index) => shapes[index].emitter = number,
            EmitterKind::Environment(index) => numbers[index] = Some(number),
            EmitterKind::Light(_) => {}
        }
        emitters.push(sampled(scene, source, shapes, tables));
    }
    let mut places = Vec::new();
    for (part, number) in environment.iter().zip(numbers) {
        let number = number.unwrap_or_else(|| {
            let shape = surrounding(part.shape, part.emission, tables);
            emitters.push(emitter(shape, part.emission));
            emitters.len() as u32 - 1
        });
        places.push(f64::from(number));
    }
    (emitters, tables.look_up(&places))
}

fn sampled(
    scene: &Scene,
    source: EmitterSource,
    shapes: &[layout::Shape],
    tables: &mut Tables,
) -> layout::Emitter {
    let shape = match source.kind {
        EmitterKind::Object(index) => layout::Emitter {
            record: polarization_row(tables, source.emission),
            ..object(index, &shapes[index])
        },
        EmitterKind::Environment(index) => surrounding(
            scene.environment_parts()[index].shape,
            source.emission,
            tables,
        ),
        EmitterKind::Light(index) => layout::Emitter {
            record: polarization_row(tables, source.emission),
            ..single_direction(scene.lights()[index].shape)
        },
    };
    layout::Emitter {
        brightness: source.brightness as f32,
        ..emitter(shape, source.emission)
    }
}

fn emitter(shape: layout::Emitter, emission: Emission) -> layout::Emitter {
    layout::Emitter {
        emission: emission_ref(emission),
        scale: emission.scale as f32,
        ..shape
    }
}

/// Returns an emitter that is not an object and has no picture.
fn plain(kind: u32) -> layout::Emitter {
    layout::Emitter {
        kind,
        object: NONE,
        record: NONE,
        ..Default::default()
    }
}

/// Returns the emitter of an object, which is not an unbounded plane.
fn object(index: usize, shape: &layout::Shape) -> layout::Emitter {
    let kind = match shape.kind {
        layout::SHAPE_SPHERE => layout::EMITTER_SPHERE,
        layout::SHAPE_RECTANGLE => layout::EMITTER_RECTANGLE,
        _ => layout::EMITTER_DISK,
    };
    layout::Emitter {
        position: shape.center,
        axis: shape.normal,
        radius: shape.radius,
        tangent: shape.tangent,
        half_width: shape.half_width,
        bitangent: shape.bitangent,
        half_height: shape.half_height,
        object: index as u32,
        ..plain(kind)
    }
}

fn surrounding(
    shape: EnvironmentShape<'_>,
    emission: Emission,
    tables: &mut Tables,
) -> layout::Emitter {
    let polarization = polarization_row(tables, emission);
    let packed = match shape {
        EnvironmentShape::Everywhere => plain(layout::EMITTER_EVERYWHERE),
        EnvironmentShape::Horizon => plain(layout::EMITTER_HORIZON),
        EnvironmentShape::Pole(pole) => layout::Emitter {
            axis: vec3(pole),
            ..plain(layout::EMITTER_POLE)
        },
        EnvironmentShape::Picture(picture) => {
            let pictures = &mut tables.pictures;
            let panorama = layout::Panorama {
                polarization,
                ..pictures.add_environment(picture, &mut tables.numbers)
            };
            return layout::Emitter {
                axis: vec3(picture.forward),
                tangent: vec3(picture.right),
                record: tables.push(&panorama),
                ..plain(layout::EMITTER_PICTURE)
            };
        }
        EnvironmentShape::DistantDisk { toward, height } => layout::Emitter {
            axis: vec3(toward),
            edge_height: height as f32,
            ..plain(layout::EMITTER_DISTANT_DISK)
        },
    };
    layout::Emitter {
        record: polarization,
        ..packed
    }
}

/// Returns a light that reaches each point from a single direction. A disk is a part of the environment.
fn single_direction(shape: LightShape) -> layout::Emitter {
    match shape {
        LightShape::DistantDisk { toward, .. } | LightShape::Direction { toward } => {
            layout::Emitter {
                axis: vec3(toward),
                ..plain(layout::EMITTER_DIRECTION)
            }
        }
        LightShape::Point { position } => layout::Emitter {
            position: vec3(position),
            ..plain(layout::EMITTER_POINT)
        },
        LightShape::Spot {
            position,
            axis,
            full_height,
            edge_height,
        } => layout::Emitter {
            position: vec3(position),
            axis: vec3(axis),
            full_height: full_height as f32,
            edge_height: edge_height as f32,
            ..plain(layout::EMITTER_SPOT)
        },
    }
}
