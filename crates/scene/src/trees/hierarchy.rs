//! Bounding boxes of objects, so that a ray tests only a few of many objects.

use crate::{Object, Shape};
use glam::DVec3;

/// A bounding volume hierarchy over the objects that have bounds.
///
/// Boxes contain their objects with a margin of 1e-5 of their size and distance from the origin, about a hundred rounding errors of an
/// `f32`.
#[derive(Clone, Debug, PartialEq)]
pub struct Hierarchy {
    /// Indices of the objects that every ray tests: those without bounds, and all if there are few.
    pub everywhere: Vec<u32>,
    /// The boxes, with the one around everything first; empty if there are few objects.
    pub nodes: Vec<Node>,
    /// Indices of the objects of the leaves.
    pub leaves: Vec<u32>,
}

/// A box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Its corner with the smallest coordinates.
    pub low: DVec3,
    /// Its corner with the largest coordinates.
    pub high: DVec3,
    /// For a leaf, the first of its objects in [`Hierarchy::leaves`]; otherwise the first of its two child boxes, which are adjacent.
    pub first: u32,
    /// The number of objects of a leaf; 0 for an inner box.
    pub count: u32,
}

/// Up to this many objects are tested one by one.
const FEW: usize = 6;
/// The maximum number of objects of a leaf.
const LEAF: usize = 4;
/// Number of intervals along an axis; a box may be split between any two.
const CUTS: usize = 16;
/// From this depth on, boxes are split into halves of their objects, so that [`Hierarchy::DEPTH`] is never reached.
const HALVES_FROM: usize = 40;
/// Relative margin of boxes around their contents.
const MARGIN: f64 = 1e-5;

#[derive(Clone, Copy)]
struct Bounds {
    low: DVec3,
    high: DVec3,
}

impl Bounds {
    const NOTHING: Self = Self {
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
    };

    /// The bounds of an object; `None` for an infinite plane.
    fn of(shape: &Shape) -> Option<Self> {
        let (center, reach) = match *shape {
            Shape::Plane { .. } => return None,
            Shape::Sphere { center, radius } => (center, DVec3::splat(radius)),
            Shape::Rectangle {
                center,
                tangent,
                bitangent,
                half_width,
                half_height,
                ..
            } => (
                center,
                (tangent * half_width).abs() + (bitangent * half_height).abs(),
            ),
            Shape::Disk {
                center,
                normal,
                radius,
                ..
            } => {
                let sine = |c: f64| (1.0 - c * c).max(0.0).sqrt();
                (
                    center,
                    DVec3::from_array(normal.to_array().map(sine)) * radius,
                )
            }
        };
        let margin = DVec3::splat(MARGIN * (reach.max_element() + center.abs().max_element()));
        Some(Self {
            low: center - reach - margin,
            high: center + reach + margin,
        })
    }

    fn with(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Half its surface area, to which the probability of a hit is roughly proportional.
    fn area(&self) -> f64 {
        let size = (self.high - self.low).max(DVec3::ZERO);
        size.x * size.y + size.y * size.z + size.z * size.x
    }

    fn middle(&self, axis: usize) -> f64 {
        0.5 * (self.low[axis] + self.high[axis])
    }
}

impl Hierarchy {
    /// No box is nested this deep.
    pub const DEPTH: usize = 64;

    /// The hierarchy of a scene's objects.
    pub(crate) fn new(objects: &[Object]) -> Self {
        let bounds: Vec<_> = objects.iter().map(|o| Bounds::of(&o.shape)).collect();
        let (mut bounded, mut everywhere): (Vec<u32>, Vec<u32>) =
            (0..objects.len() as u32).partition(|&i| bounds[i as usize].is_some());
        if bounded.len() <= FEW {
            everywhere.append(&mut bounded);
            everywhere.sort_unstable();
        }
        let bounds: Vec<_> = bounds
            .into_iter()
            .map(|b| b.unwrap_or(Bounds::NOTHING))
            .collect();
        let mut nodes = Vec::new();
        if !bounded.is_empty() {
            nodes.push(leaf(&bounds, &bounded, 0));
            divide(&bounds, &mut nodes, &mut bounded, (0, 0), 0);
        }
        Self {
            everywhere,
            nodes,
            leaves: bounded,
        }
    }
}

/// A leaf of objects, the first of which is at `first`.
fn leaf(bounds: &[Bounds], objects: &[u32], first: usize) -> Node {
    let around = objects.iter().fold(Bounds::NOTHING, |around, &object| {
        around.with(bounds[object as usize])
    });
    Node {
        low: around.low,
        high: around.high,
        first: first as u32,
        count: objects.len() as u32,
    }
}

/// Splits the leaf `node`, whose objects are from `first` on, recursively down to small leaves: among the cuts across each axis, by the one
/// with the least sum of objects times area (MacDonald and Booth, Heuristics for Ray Tracing Using Space Subdivision, 1990).
fn divide(
    bounds: &[Bounds],
    nodes: &mut Vec<Node>,
    objects: &mut [u32],
    (node, first): (usize, usize),
    depth: usize,
) {
    if objects.len() <= LEAF {
        return;
    }
    let Some((axis, place)) = best_cut(bounds, objects) else {
        return;
    };
    let middle = |object: u32| bounds[object as usize].middle(axis);
    objects.sort_by(|&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
    let below = if depth < HALVES_FROM {
        objects.partition_point(|&object| middle(object) < place)
    } else {
        objects.len() / 2
    };
    let (left, right) = objects.split_at_mut(below);
    let children = nodes.len();
    nodes.push(leaf(bounds, left, first));
    nodes.push(leaf(bounds, right, first + below));
    (nodes[node].first, nodes[node].count) = (children as u32, 0);
    divide(bounds, nodes, left, (children, first), depth + 1);
    divide(
        bounds,
        nodes,
        right,
        (children + 1, first + below),
        depth + 1,
    );
}

/// The axis and the position of the best cut; `None` if all objects have the same center.
fn best_cut(bounds: &[Bounds], objects: &[u32]) -> Option<(usize, f64)> {
    let mut best: Option<(f64, usize, f64)> = None;
    for axis in 0..3 {
        let middles = || objects.iter().map(|&o| bounds[o as usize].middle(axis));
        let least = middles().fold(f64::INFINITY, f64::min);
        let most = middles().fold(f64::NEG_INFINITY, f64::max);
        for cut in 1..CUTS {
            let place = least + (most - least) * cut as f64 / CUTS as f64;
            let (mut below, mut above) = ((Bounds::NOTHING, 0), (Bounds::NOTHING, 0));
            for &object in objects {
                let of = &bounds[object as usize];
                let side = if of.middle(axis) < place {
                    &mut below
                } else {
                    &mut above
                };
                *side = (side.0.with(*of), side.1 + 1);
            }
            if below.1 == 0 || above.1 == 0 {
                continue;
            }
            let cost = below.0.area() * f64::from(below.1) + above.0.area() * f64::from(above.1);
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, place));
            }
        }
    }
    best.map(|(_, axis, place)| (axis, place))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MaterialId;

    fn object(shape: Shape) -> Object {
        let material = MaterialId(0);
        Object { shape, material }
    }

    fn sphere(center: DVec3, radius: f64) -> Object {
        object(Shape::Sphere { center, radius })
    }

    /// Every object occurs once, each box contains its contents, and leaves are small, except where many objects are in one position.
    #[test]
    fn boxes_hold_their_objects() {
        let place = |i: u32| {
            let of = |k: u32| f64::from(i.wrapping_mul(k) >> 8 & 0xffff) / 6553.6;
            DVec3::new(of(0x9e37_79b9), of(0x85eb_ca6b), of(0xc2b2_ae35))
        };
        let mut objects: Vec<_> = (0..500)
            .map(|i| sphere(place(i), 0.05 + 0.001 * f64::from(i)))
            .collect();
        objects.extend((0..20).map(|_| sphere(DVec3::ONE, 0.5)));
        let plane = Shape::Plane {
            point: DVec3::ZERO,
            normal: DVec3::Y,
            tangent: DVec3::Z,
            bitangent: DVec3::X,
        };
        objects.push(object(plane));
        let found = Hierarchy::new(&objects);
        assert_eq!(found.everywhere, [520]);
        let mut leaves = found.leaves.clone();
        leaves.sort_unstable();
        assert_eq!(leaves, (0..520).collect::<Vec<_>>());
        let mut met = 0;
        for node in &found.nodes {
            let first = node.first as usize;
            let inner: Vec<Bounds> = if node.count == 0 {
                let children = &found.nodes[first..first + 2];
                let bounds = |n: &Node| Bounds {
                    low: n.low,
                    high: n.high,
                };
                children.iter().map(bounds).collect()
            } else {
                met += node.count;
                let of = |&i: &u32| Bounds::of(&objects[i as usize].shape).unwrap();
                let leaf = &found.leaves[first..first + node.count as usize];
                leaf.iter().map(of).collect()
            };
            for bounds in inner {
                assert!(node.low.cmple(bounds.low).all() && node.high.cmpge(bounds.high).all());
            }
        }
        assert_eq!(met, 520);
        let largest = found.nodes.iter().map(|n| n.count).max();
        assert_eq!(
            largest,
            Some(20),
            "those in one position cannot be separated"
        );
    }

    #[test]
    fn few_objects_need_no_boxes() {
        let objects: Vec<_> = (0..6)
            .map(|i| sphere(f64::from(i) * DVec3::X, 0.4))
            .collect();
        let found = Hierarchy::new(&objects);
        assert_eq!(found.everywhere, [0, 1, 2, 3, 4, 5]);
        assert!(found.nodes.is_empty() && found.leaves.is_empty());
    }
}
