//! The choice of an emitter at a point of a surface by estimates of the contributions; among many emitters, by a tree of groups.

use crate::PreparedScene;
use glam::DVec3;
use scene::{EmitterNode, EmitterTree};

/// An emitter and the probability with which it is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmitterChoice {
    /// Index of the emitter.
    pub emitter: usize,
    /// The probability.
    pub pmf: f64,
}

/// A point of a surface at which emitters are weighted.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadingPoint {
    pub(crate) position: DVec3,
    pub(crate) normal: DVec3,
}

/// A node of the tree with its weight at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Weighted {
    pub(crate) node: u32,
    pub(crate) weight: f64,
}

/// One of several options, chosen by a number in [0, 1).
struct Pick {
    index: usize,
    pmf: f64,
    /// The position of the number within the interval of the chosen option, rescaled to [0, 1).
    rest: f64,
}

/// Chooses an option by probabilities and a uniform number.
fn pick(pmfs: impl Iterator<Item = f64>, random: f64) -> Option<Pick> {
    let mut sum = 0.0;
    let mut choice = None;
    for (index, pmf) in pmfs.enumerate() {
        if pmf > 0.0 {
            choice = Some((index, pmf, sum));
        }
        sum += pmf;
        if random < sum {
            break;
        }
    }
    let (index, pmf, before) = choice?;
    let rest = ((random - before) / pmf).clamp(0.0, 1.0 - f64::EPSILON);
    Some(Pick { index, pmf, rest })
}

/// Chooses an emitter by probabilities and a uniform number.
pub fn choose_emitter(pmfs: impl Iterator<Item = f64>, random: f64) -> Option<EmitterChoice> {
    let Pick { index, pmf, .. } = pick(pmfs, random)?;
    Some(EmitterChoice {
        emitter: index,
        pmf,
    })
}

/// Fraction of the variance of the positions that is added to the squared distance: within a group, irradiance does not grow toward
/// the center. Between 0.2 and 0.7 the quality of the choice is the same to within 1 %.
const SOFTENING: f64 = 0.4;
/// 2/(3π). For heights with a normal distribution about 0, the mean of max(0, h) is √(2/π)/2 of the standard deviation, which is
/// √(variance/3) for positions with the same spread along all axes.
const HORIZON: f64 = 0.212_206_590_789;
/// Tolerance of the cosine at the edge of a cone: the sine of a cone of 0.1°, the narrowest of a spot, is not known more precisely
/// from its cosine in an `f32`.
const EDGE: f64 = 1e-4;

/// Returns roughly the contribution of a group of emitters at a place, in the unit of [`Emitter::weight`](crate::Emitter::weight)
/// times brightness; 0 only where no light of the group can arrive.
///
/// The weight is the one of Pharr, Jakob and Humphreys (Physically Based Rendering, 4th edition, 2023, section 12.6.3), power times
/// cosine over squared distance, but with the mean in place of the largest cosine: outside a ball, the mean of cos θ / r² over the
/// ball equals the value at its center (Newton's shell theorem).
pub(crate) fn group_weight(node: &EmitterNode, place: ShadingPoint) -> f64 {
    let toward = node.center - place.position;
    let height = toward.dot(place.normal);
    let distance2 = toward.length_squared();
    if height + node.reach <= 0.0 || is_outside_cone(node, toward, distance2) {
        return 0.0;
    }
    let soft = distance2 + SOFTENING * node.variance;
    let above = mean_above(height, HORIZON * node.variance);
    node.power * directional_weight(node, toward, distance2) * above / (soft * soft.sqrt())
}

/// Returns roughly the mean of max(0, h) over heights h with a mean and a squared width, without a difference of nearly equal numbers.
fn mean_above(mean: f64, width2: f64) -> f64 {
    let root = (mean * mean + width2).sqrt();
    if mean > 0.0 {
        0.5 * (root + mean)
    } else {
        0.5 * width2 / (root - mean)
    }
}

/// Returns the fraction of its power that a group emits toward a point; toward near points the direction is uncertain.
fn directional_weight(node: &EmitterNode, toward: DVec3, distance2: f64) -> f64 {
    let along = toward.dot(node.axis);
    let third = node.variance / 3.0;
    let square = (along * along + third) / (distance2 + node.variance);
    (node.even + node.along * square).sqrt()
}

/// Whether no direction toward a point lies in the group's cone of emission, widened by the angle that the group subtends.
fn is_outside_cone(node: &EmitterNode, toward: DVec3, distance2: f64) -> bool {
    let reach2 = node.reach * node.reach;
    if node.cone <= -1.0 || distance2 <= reach2 {
        return false;
    }
    let sine = (reach2 / distance2).sqrt();
    let cosine = (1.0 - reach2 / distance2).sqrt();
    let cone_sine = (1.0 - node.cone * node.cone).max(0.0).sqrt();
    // From here on the sum of both angles is more than π.
    if cosine <= -node.cone {
        return false;
    }
    let edge = node.cone * cosine - cone_sine * sine;
    -toward.dot(node.axis) < (edge - EDGE) * distance2.sqrt()
}

/// Whether a place is so near to a group that its children are weighted instead.
fn is_near(node: &EmitterNode, place: ShadingPoint) -> bool {
    node.center.distance_squared(place.position) < node.near * node.near
}

/// Returns the node that is weighted for a node at a place: the outermost group around it that is not near, or the node itself.
fn weighted_node(tree: &EmitterTree, mut node: u32, place: ShadingPoint) -> u32 {
    let mut top = node;
    while tree.nodes[node as usize].parent != EmitterTree::NONE {
        node = tree.nodes[node as usize].parent;
        if !is_near(&tree.nodes[node as usize], place) {
            top = node;
        }
    }
    top
}

impl PreparedScene<'_> {
    /// Returns the probability with which each emitter is chosen at a point of a surface; all 0 where none contributes.
    ///
    /// The sum is less than 1 where a group has a weight but none of its emitters does.
    pub fn emitter_pmfs(&self, point: DVec3, normal: DVec3) -> Vec<f64> {
        let place = ShadingPoint {
            position: point,
            normal,
        };
        let sum = self.weigh_emitters(place, &mut Vec::new());
        let numbers = 0..self.emitters.len();
        numbers.map(|i| self.emitter_pmf(i, place, sum)).collect()
    }

    /// Chooses an emitter at a point of a surface by a number in [0, 1), if any contributes there.
    pub fn choose_emitter_at(
        &self,
        point: DVec3,
        normal: DVec3,
        random: f64,
    ) -> Option<EmitterChoice> {
        let place = ShadingPoint {
            position: point,
            normal,
        };
        let mut weighted = Vec::new();
        let sum = self.weigh_emitters(place, &mut weighted);
        self.choose_weighted(place, (&weighted, sum), random)
    }

    /// Weights the emitters and groups that a place is not near to; together they contain each emitter once. Returns the sum of the
    /// weights, or 1 where that is 0.
    pub(crate) fn weigh_emitters(&self, place: ShadingPoint, weighted: &mut Vec<Weighted>) -> f64 {
        let nodes = &self.scene.emitter_tree().nodes;
        weighted.clear();
        let mut node = 0;
        while let Some(of) = nodes.get(node as usize) {
            if is_near(of, place) {
                node += 1;
                continue;
            }
            let weight = self.node_weight(of, place);
            weighted.push(Weighted { node, weight });
            node = of.next;
        }
        let sum = weighted.iter().map(|of| of.weight).sum();
        if sum > 0.0 { sum } else { 1.0 }
    }

    /// Chooses one of the weighted nodes, then one of the two children of a group until an emitter is reached.
    pub(crate) fn choose_weighted(
        &self,
        place: ShadingPoint,
        (weighted, sum): (&[Weighted], f64),
        random: f64,
    ) -> Option<EmitterChoice> {
        let tree = self.scene.emitter_tree();
        let first = pick(weighted.iter().map(|of| of.weight / sum), random)?;
        let mut node = weighted[first.index].node;
        let (mut pmf, mut random) = (first.pmf, first.rest);
        loop {
            let of = &tree.nodes[node as usize];
            if of.source != EmitterTree::NONE {
                let emitter = of.source as usize;
                return Some(EmitterChoice { emitter, pmf });
            }
            let children = tree.children(node);
            let weights =
                children.map(|child| self.node_weight(&tree.nodes[child as usize], place));
            let sum = weights[0] + weights[1];
            let step = pick(weights.into_iter().map(|weight| weight / sum), random)?;
            node = children[step.index];
            (pmf, random) = (pmf * step.pmf, step.rest);
        }
    }

    /// Returns the probability with which an emitter is chosen; `sum` is the value that [`Self::weigh_emitters`] returned.
    pub(crate) fn emitter_pmf(&self, emitter: usize, place: ShadingPoint, sum: f64) -> f64 {
        let tree = self.scene.emitter_tree();
        let mut node = tree.leaves[emitter];
        let top = weighted_node(tree, node, place);
        let mut weight = self.node_weight(&tree.nodes[node as usize], place);
        let mut pmf = 1.0;
        while node != top && weight > 0.0 {
            let parent = tree.nodes[node as usize].parent;
            let [first, second] = tree.children(parent);
            let other = if node == first { second } else { first };
            let other = self.node_weight(&tree.nodes[other as usize], place);
            pmf *= weight / (weight + other);
            node = parent;
            weight = self.node_weight(&tree.nodes[node as usize], place);
        }
        pmf * (weight / sum)
    }

    /// Returns roughly the contribution of a node at a place. A single emitter is always chosen.
    fn node_weight(&self, node: &EmitterNode, place: ShadingPoint) -> f64 {
        if node.source == EmitterTree::NONE {
            return group_weight(node, place);
        }
        if self.emitters.len() == 1 {
            return 1.0;
        }
        let of = &self.emitters[node.source as usize];
        of.source.brightness * of.emitter.weight(place.position, place.normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Emitter, random4, sample_cone};
    use scene::Scene;
    use scene_file::SceneFile;
    use std::fmt::Write;
    use std::path::Path;

    const HEAD: &str = "camera = { type = 'orthographic', position = [0, 0, 9], look_at = [0, 0, 0], height = 9 }\n\
        render = { bands = 1 }\n";

    fn parsed(text: &str) -> Scene {
        SceneFile::parse("lamps.toml", text, Path::new(""))
            .and_then(|file| file.validate())
            .unwrap_or_else(|problems| panic!("{problems}"))
    }

    /// Lamps of four kinds at random positions in a cube, with axes in all directions, and the sun.
    fn lamps(count: u32) -> Scene {
        let mut text = format!(
            "{HEAD}[[lights]]\ntype = 'distant'\ndirection = [0, 1, 0]\nemission = {{ constant = 1e-3 }}\n"
        );
        for level in 0..8 {
            let value = 0.1 * f64::from(2_u32.pow(level));
            writeln!(
                text,
                "[materials.m{level}]\ntype = 'emitter'\nemission = {{ constant = {value} }}"
            )
            .unwrap();
        }
        for i in 0..count {
            let [x, y, z, size] = random4([i, 0], 0, 0, 5);
            let [nx, ny, nz, level] = random4([i, 0], 0, 1, 5).map(|u| u - 0.5);
            let place = [x, y, z].map(|u| 10.0 * u - 5.0);
            let normal = [nx, ny, nz];
            let level = ((level + 0.5) * 8.0) as u32;
            let size = 0.02 + 0.1 * size;
            let object = format!("[[objects]]\nmaterial = 'm{level}'\ncenter = {place:?}");
            let value = 0.001 * f64::from(2_u32.pow(level));
            let light =
                format!("[[lights]]\nemission = {{ constant = {value} }}\nposition = {place:?}");
            match i % 4 {
                0 => writeln!(text, "{object}\ntype = 'sphere'\nradius = {size}"),
                1 => writeln!(
                    text,
                    "{object}\ntype = 'rectangle'\nnormal = {normal:?}\nsize = [{size}, 0.2]"
                ),
                2 => writeln!(text, "{light}\ntype = 'point'"),
                _ => writeln!(
                    text,
                    "{light}\ntype = 'spot'\ndirection = {normal:?}\nangle_deg = 40"
                ),
            }
            .unwrap();
        }
        parsed(&text)
    }

    fn place(i: u32, size: f64) -> ShadingPoint {
        let [x, y, z, _] = random4([i, 1], 0, 0, 5).map(|u| size * (u - 0.5));
        let [u, v, ..] = random4([i, 1], 0, 1, 5);
        ShadingPoint {
            position: DVec3::new(x, y, z),
            normal: sample_cone(u, v, 2.0),
        }
    }

    fn estimates(prepared: &PreparedScene<'_>, place: ShadingPoint) -> Vec<f64> {
        let of = |of: &crate::prepared::SceneEmitter<'_>| {
            of.source.brightness * Emitter::weight(&of.emitter, place.position, place.normal)
        };
        prepared.emitters.iter().map(of).collect()
    }

    /// Second moment of the one-sample estimate of all light, relative to its square: 1 where the choice is exact.
    fn second_moment(prepared: &PreparedScene<'_>, place: ShadingPoint) -> Option<f64> {
        let estimates = estimates(prepared, place);
        let pmfs = prepared.emitter_pmfs(place.position, place.normal);
        let sum: f64 = estimates.iter().sum();
        let parts = estimates.iter().zip(pmfs).filter(|(e, _)| **e > 0.0);
        let moment: f64 = parts.map(|(e, pmf)| e * e / pmf).sum();
        (sum > 0.0).then(|| moment / (sum * sum))
    }

    fn pmfs(prepared: &PreparedScene<'_>, place: ShadingPoint) -> Vec<f64> {
        prepared.emitter_pmfs(place.position, place.normal)
    }

    /// Nothing is chosen where a group has a weight but none of its emitters does. Measured: one choice in 17, most of them on
    /// surfaces that face away from nearly all lamps.
    #[test]
    fn probabilities_sum_to_one() {
        let scene = lamps(1000);
        let prepared = PreparedScene::new(&scene);
        let (mut missing, mut places) = (0.0, 0.0);
        for i in 0..500 {
            let place = place(i, 15.0);
            let sum: f64 = pmfs(&prepared, place).iter().sum();
            let shines = estimates(&prepared, place).iter().any(|of| *of > 0.0);
            assert!(sum <= 1.0 + 1e-12 && (sum > 0.0) == shines, "{sum}");
            if shines {
                places += 1.0;
                missing += 1.0 - sum;
            }
        }
        assert!(missing < 0.1 * places, "{}", missing / places);
        let dark = parsed(HEAD);
        assert!(pmfs(&PreparedScene::new(&dark), place(0, 1.0)).is_empty());
    }

    /// No light is lost: every emitter that contributes can be chosen, even with all numbers as on a GPU.
    #[test]
    fn what_shines_can_be_chosen() {
        let made = lamps(300);
        for scene in [&made, &made.rounded_to_f32()] {
            let prepared = PreparedScene::new(scene);
            let mut met = 0;
            for i in 0..1000 {
                let place = place(i, 15.0);
                let of = estimates(&prepared, place).into_iter();
                for (estimate, pmf) in of.zip(pmfs(&prepared, place)) {
                    assert_eq!(estimate > 0.0, pmf > 0.0, "{estimate} {pmf} at {place:?}");
                    met += u32::from(estimate > 0.0);
                }
            }
            assert!(met > 50_000, "{met}");
        }
    }

    /// Counts how many of many draws at a place choose each emitter. Returns the sum of squared differences over the expected
    /// counts (Pearson's χ²), and the number of emitters that are expected at least five times.
    fn chi_squared(
        prepared: &PreparedScene<'_>,
        (drawn_at, expected_at): (ShadingPoint, ShadingPoint),
    ) -> (f64, f64) {
        const DRAWS: u32 = 40_000;
        let mut counts = vec![0.0; prepared.emitters.len()];
        for i in 0..DRAWS {
            let random = (f64::from(i) + random4([i, 2], 0, 0, 5)[0]) / f64::from(DRAWS);
            let choice = prepared.choose_emitter_at(drawn_at.position, drawn_at.normal, random);
            if let Some(EmitterChoice { emitter, pmf }) = choice {
                counts[emitter] += 1.0;
                let expected = pmfs(prepared, drawn_at)[emitter];
                assert!((pmf / expected - 1.0).abs() < 1e-9, "{pmf} {expected}");
            }
        }
        let expected = pmfs(prepared, expected_at);
        let often = expected
            .iter()
            .map(|pmf| pmf * f64::from(DRAWS))
            .zip(counts);
        let often = often.filter(|(expected, _)| *expected >= 5.0);
        often.fold((0.0, 0.0), |(sum, of), (expected, count)| {
            (sum + (count - expected).powi(2) / expected, of + 1.0)
        })
    }

    /// One number is drawn from each of as many equal intervals of [0, 1): the sum is then below its mean for independent numbers.
    #[test]
    fn draws_follow_the_probabilities() {
        let scene = lamps(100);
        let prepared = PreparedScene::new(&scene);
        let (mut right, mut wrong, mut all) = (0.0, 0.0, 0.0);
        for i in 0..4 {
            let here = place(i, 8.0);
            let there = ShadingPoint {
                position: here.position + 0.5,
                ..here
            };
            let (sum, emitters) = chi_squared(&prepared, (here, here));
            (right, all) = (right + sum, all + emitters);
            wrong += chi_squared(&prepared, (here, there)).0;
        }
        assert!(all > 50.0 && right < all, "{right} {all}");
        assert!(
            wrong > 3.0 * all,
            "wrong draws are not detected: {wrong} {all}"
        );
    }

    #[test]
    fn few_emitters_are_chosen_by_their_estimates() {
        let scene = lamps(12);
        let prepared = PreparedScene::new(&scene);
        assert!(prepared.emitters.len() <= 16);
        for i in 0..200 {
            let place = place(i, 10.0);
            let estimates = estimates(&prepared, place);
            let sum: f64 = estimates.iter().sum();
            let sum = if sum > 0.0 { sum } else { 1.0 };
            let exact: Vec<f64> = estimates.iter().map(|estimate| estimate / sum).collect();
            assert_eq!(pmfs(&prepared, place), exact);
            let random = random4([i, 3], 0, 0, 5)[0];
            assert_eq!(
                prepared.choose_emitter_at(place.position, place.normal, random),
                choose_emitter(exact.into_iter(), random)
            );
        }
    }

    /// Mean second moment over places in a cube of the given size.
    fn mean_second_moment(prepared: &PreparedScene<'_>, size: f64) -> f64 {
        let places = (0..1000).map(|i| place(i, size));
        let moments: Vec<f64> = places
            .filter_map(|at| second_moment(prepared, at))
            .collect();
        moments.iter().sum::<f64>() / moments.len() as f64
    }

    /// Measured among the lamps: 1.14; within a cube twice as large, where some surfaces face away from all but a few: 1.55.
    #[test]
    fn groups_choose_about_as_well_as_all_estimates() {
        let scene = lamps(1000);
        let prepared = PreparedScene::new(&scene);
        let moments = [10.0, 20.0].map(|size| mean_second_moment(&prepared, size));
        assert!(moments[0] < 1.2 && moments[1] < 1.7, "{moments:?}");
    }

    /// Returns how many nodes are weighted for a choice.
    fn weighed_for(prepared: &PreparedScene<'_>, place: ShadingPoint, random: f64) -> usize {
        let mut weighted = Vec::new();
        let sum = prepared.weigh_emitters(place, &mut weighted);
        let tree = prepared.scene.emitter_tree();
        let mut steps = 0;
        if let Some(choice) = prepared.choose_weighted(place, (&weighted, sum), random) {
            let mut node = tree.leaves[choice.emitter];
            let top = weighted_node(tree, node, place);
            while node != top {
                node = tree.nodes[node as usize].parent;
                steps += 1;
            }
        }
        weighted.len() + 2 * steps
    }

    /// Measured: 53 on average, 84 at most.
    #[test]
    fn few_of_many_emitters_are_weighed() {
        let scene = lamps(1000);
        let prepared = PreparedScene::new(&scene);
        let count = |i| weighed_for(&prepared, place(i, 10.0), random4([i, 4], 0, 0, 5)[0]);
        let counts: Vec<usize> = (0..1000).map(count).collect();
        let mean = counts.iter().sum::<usize>() as f64 / 1000.0;
        assert!(mean < 60.0, "{mean}");
        let most = counts.iter().max();
        assert!(most < Some(&100), "{most:?}");
    }
}
