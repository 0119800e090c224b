//! The maximum number of passes of loops in a sample.

use super::surface::Passes;
use crate::counts::RecordLimits;
use scene::{Environment, Scene};

/// Returns a bound on the passes of all loops of one sample: those of tracing it (every segment and every film on the way to an
/// emitter tests every object and computes thicknesses), and those of its spectrum (every group of four bands visits every vertex
/// and every crossing).
pub(super) fn of_sample(scene: &Scene, limits: RecordLimits, surfaces: Passes) -> u64 {
    // A hierarchy has fewer boxes than twice its objects.
    let objects = match scene.hierarchy().nodes.len() as u64 {
        0 => scene.objects().len() as u64 + 1,
        nodes => scene.objects().len() as u64 + nodes + 1,
    };
    let segments = u64::from(limits.vertices);
    let crossings = u64::from(limits.crossings);
    let light_groups = u64::from(limits.light_groups) + 1;
    let groups = u64::from(scene.settings().bands.count().div_ceil(4)) + 1;

    let trace = (2 * segments + crossings) * (1 + objects + surfaces.shading);
    let factors = segments * (1 + surfaces.spectrum) + crossings * (1 + surfaces.crossing);
    // The clamp evaluates the whole spectrum before it is added.
    let times = 1 + u64::from(scene.settings().clamp.is_some());
    // Loops over the light groups at each vertex, and over the components in the end.
    let polarized = if scene.settings().polarization {
        (segments + u64::from(limits.splits) + 5) * light_groups
    } else {
        0
    };
    let spectrum = times * groups * (1 + 2 * segments + factors + 2 * light_groups + polarized);
    let environment = scene.environment_parts().len() as u64 + 1 + segments * searches(scene);
    // The sum of the emitters' weights, the choice among them, and the probability of an emitter that a path hits.
    let choices = segments * 3 * (2 + scene.emitter_tree().nodes.len() as u64);
    1 + trace + choices + environment + spectrum + 3 * light_groups
}

/// Returns the passes of the two binary searches that sample a direction toward a picture of the environment.
fn searches(scene: &Scene) -> u64 {
    let Environment::Picture { picture, .. } = scene.environment() else {
        return 0;
    };
    let table = &picture.table;
    let among = |count: u32| 1 + u64::from(count.next_power_of_two().ilog2());
    among(table.rows) + among(table.columns)
}
