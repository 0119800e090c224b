//! How many passes of loops a sample takes at most.

use crate::modules::RecordLimits;
use scene::{Material, Scene, Thickness};

/// Passes of `gradient_noise` (eight corners) for each of the flow's steps and the streaks' octaves, at most.
const SWIRLS: u64 = 9 * (3 + 6);
/// Passes for a layer of a stack: its own, and those of the series for small thicknesses.
const LAYER: u64 = 1 + 8;

/// Passes of the two searches by which a direction towards a picture of the surroundings is drawn, among 1024 and 512.
const SEARCHES: u64 = 1 + 10 + 1 + 9;

/// A bound on the passes of all loops of one sample: those of tracing it (every segment and every film on the way to a light looks
/// at every object, and works out thicknesses), and those of its spectrum (every group of four bands looks at every vertex, with
/// its own factor and that of its connection, and at every crossing).
pub(super) fn of_sample(scene: &Scene, limits: RecordLimits) -> u64 {
    let materials = || scene.objects().iter().map(|o| scene.material(o.material));
    let most = |count: fn(&Material) -> u64| materials().map(count).max().unwrap_or(0);
    let objects = scene.objects().len() as u64 + 1;
    let segments = u64::from(limits.vertices);
    let crossings = u64::from(limits.crossings);
    let light_groups = u64::from(limits.light_groups) + 1;
    let groups = u64::from(scene.settings().bands.count().div_ceil(4)) + 1;

    let surfaces = most(thickness_passes) + 3 * most(slope_passes);
    let facets = segments * most(facet_passes);
    let trace = (2 * segments + crossings) * (1 + objects + surfaces) + facets;
    let factors =
        (2 * segments + crossings) * (1 + most(layer_passes)) + facets * (1 + most(layer_passes));
    // The clamp looks at the whole spectrum before it is added.
    let times = 1 + u64::from(scene.settings().clamp.is_some());
    let spectrum = times * groups * (1 + segments + factors + 2 * light_groups);
    let environment = scene.surroundings().len() as u64 + 1 + segments * SEARCHES;
    // The sum of the lights' estimates and the choice among them.
    let choices = segments * 2 * (1 + scene.light_sources().len() as u64);
    1 + trace + choices + environment + spectrum + 3 * light_groups
}

/// Of drawing a facet (two slopes) or of the mean reflectance of facets (three cosines), at most.
fn facet_passes(material: &Material) -> u64 {
    if material.microsurface().is_some() {
        2 * (1 + 4)
    } else {
        0
    }
}

/// Of working out all thicknesses of a material.
fn thickness_passes(material: &Material) -> u64 {
    let of_part = |part: &Thickness| match part {
        Thickness::Swirls(_) => 1 + SWIRLS,
        _ => 1,
    };
    let of_layer = |thickness: &Thickness| thickness.parts().map(of_part).sum::<u64>();
    material.thicknesses().map(|t| 1 + of_layer(t)).sum()
}

/// Of Cook's model between two directions, or of drawing one.
fn slope_passes(material: &Material) -> u64 {
    match material {
        Material::Cook(cook) => 1 + cook.facets.len() as u64,
        _ => 0,
    }
}

/// Of the factor of a material with a stack; a film of one layer has none.
fn layer_passes(material: &Material) -> u64 {
    match material {
        Material::Film { layers, .. } if layers.len() == 1 => 0,
        _ => LAYER * material.layers().len() as u64,
    }
}
