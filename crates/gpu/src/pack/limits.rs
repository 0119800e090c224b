//! The maximum length of a path's record, and other numbers that its shader is made for.

use super::thickness;
use crate::counts::{Counts, RecordLimits};
use scene::{EnvironmentPart, EnvironmentShape, Material, Object, Scene, Shape};

/// Returns the maximum length of a path's record.
///
/// A path has a vertex for each segment but the last, which may end in two terms of the environment. Where a film splits it, the
/// record has the film, the path that continues, and the other path.
pub(super) fn of(scene: &Scene) -> RecordLimits {
    let settings = scene.settings();
    let has_films = scene
        .objects()
        .iter()
        .any(|object| is_film(scene.material(object.material)));
    let splits = if has_films { settings.film_splits } else { 0 };
    let segments = settings.max_path_segments;
    let crossings = crossings(scene, segments, splits);
    let surfaces = vertices(segments, splits);
    // The emission of a surface has its own vertex. Two parts of a gradient are visible in a direction; one of them is the vertex
    // of the segment that escapes.
    let glowing = if glows(scene) { surfaces } else { 0 };
    let vertices = surfaces + glowing + (disks(scene) << splits);
    RecordLimits {
        vertices,
        crossings: u32::max(crossings, 1),
        thicknesses: u32::max(
            most_varying(scene, |_| true) * surfaces + most_varying(scene, is_film) * crossings,
            1,
        ),
        light_groups: scene.light_groups().len() as u32,
        splits: u32::max(splits, 1),
    }
}

/// Returns the numbers of passes of the loops over all things of a kind.
pub(super) fn counts(scene: &Scene, hierarchy_rows: u32) -> Counts {
    let settings = scene.settings();
    Counts {
        objects: scene.objects().len() as u32,
        // There is no hierarchy where this is not read.
        hierarchy_rows: hierarchy_rows.max(1),
        emitters: scene.emitters().len() as u32,
        environment_parts: scene.environment_parts().len() as u32,
        groups: settings.bands.count().div_ceil(4),
        max_path_segments: settings.max_path_segments,
        roulette_after: settings.roulette_after,
    }
}

/// Returns the number of vertices of a path with this many segments and splits left.
fn vertices(segments: u32, splits: u32) -> u32 {
    if splits == 0 || segments < 2 {
        return segments + 1;
    }
    1 + 2 * vertices(segments - 1, splits - 1)
}

/// Whether a surface both emits and reflects: its emission has its own vertex.
fn glows(scene: &Scene) -> bool {
    let mut materials = scene.objects().iter().map(|o| scene.material(o.material));
    materials.any(|material| match material {
        Material::Cook(cook) => cook.ambient.is_some(),
        Material::Emitter { reflectance, .. } => reflectance.is_some(),
        _ => false,
    })
}

/// Returns the number of films that all emitter samples of a path cross. Each crosses a film's sphere at most twice and a film's
/// plane once (and the edge where films touch once more), and never more often than segments are left. A path that has sampled an
/// emitter is not split any more.
fn crossings(scene: &Scene, segments: u32, splits: u32) -> u32 {
    let films = scene.objects().iter().filter_map(|object| {
        is_film(scene.material(object.material)).then_some(match object.shape {
            Shape::Sphere { .. } => 2,
            _ => 1,
        })
    });
    let straight: u32 = films.sum();
    let per_connection = if straight == 0 {
        0
    } else {
        straight.saturating_add(2)
    };
    let of_path = |first: u32| -> u32 {
        (first..segments)
            .map(|segment| per_connection.min(segments - segment - 1))
            .sum()
    };
    // With i splits there are 2ⁱ paths, each of which is i segments further on.
    (0..=splits).map(|i| of_path(1 + i) << i).max().unwrap_or(0)
}

/// Returns the number of disks in the sky.
fn disks(scene: &Scene) -> u32 {
    let parts = scene.environment_parts();
    let is_distant_disk =
        |part: &&EnvironmentPart| matches!(part.shape, EnvironmentShape::DistantDisk { .. });
    parts.iter().filter(is_distant_disk).count() as u32
}

fn is_film(material: &Material) -> bool {
    matches!(material, Material::Film { .. })
}

/// Returns the most thicknesses that are recorded where a path meets a material that is `wanted`. The thickness of a film's only
/// layer is in the factor.
fn most_varying(scene: &Scene, wanted: fn(&Material) -> bool) -> u32 {
    let of_object = |object: &Object| {
        let material = scene.material(object.material);
        let is_recorded = wanted(material) && !(is_film(material) && material.layers().len() == 1);
        if is_recorded {
            thickness::varying(material.layers())
        } else {
            0
        }
    };
    scene.objects().iter().map(of_object).max().unwrap_or(0)
}
