//! Coincident surfaces, for which the distance does not determine which one a ray hits first.
//!
//! A decal in the plane of a wall, or a film on a ball of the same radius, stands for a stack without gaps. The object that comes first is
//! outermost: outside on a sphere, and on a plane on the side that the normal of the stack's first object points to. Gaps that an `f32` can
//! barely resolve make a stack as well; there the gap determines which surface is outside.

use crate::{Object, Shape};
use glam::DVec3;

/// The position of an object in a stack of coincident surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sheet {
    /// Number of the stack, the same for all its objects.
    pub stack: u32,
    /// How many of its surfaces are outside this one.
    pub depth: u32,
    /// Whether the shape's normal points into the stack instead of out of it.
    pub is_turned: bool,
}

/// The largest gap that counts as none, relative to sizes and distances from the origin: sixteen rounding errors of an `f32`.
const GAP: f64 = 1e-6;

/// The position of each object in a stack, if any; empty if no two surfaces coincide.
pub(crate) fn sheets(objects: &[Object]) -> Vec<Option<Sheet>> {
    let mut stacks: Vec<Vec<usize>> = Vec::new();
    let mut stack_of: Vec<Option<usize>> = vec![None; objects.len()];
    for (a, b) in near_pairs(objects) {
        if coincide(&objects[a].shape, &objects[b].shape) {
            join(&mut stacks, &mut stack_of, a, b);
        }
    }
    stacks.retain(|members| !members.is_empty());
    if stacks.is_empty() {
        return Vec::new();
    }
    let mut sheets = vec![None; objects.len()];
    for (stack, members) in stacks.iter_mut().enumerate() {
        members.sort_unstable();
        order(objects, members, stack as u32, &mut sheets);
    }
    sheets
}

/// Puts two objects, and all that coincide with them, into one stack.
fn join(stacks: &mut Vec<Vec<usize>>, stack_of: &mut [Option<usize>], a: usize, b: usize) {
    let stack = stack_of[a].or(stack_of[b]).unwrap_or_else(|| {
        stacks.push(Vec::new());
        stacks.len() - 1
    });
    for object in [a, b] {
        let joining = match stack_of[object] {
            Some(own) if own == stack => Vec::new(),
            Some(own) => std::mem::take(&mut stacks[own]),
            None => vec![object],
        };
        for object in joining {
            stack_of[object] = Some(stack);
            stacks[stack].push(object);
        }
    }
}

/// Numbers the surfaces of a stack from the outside; `members` are in the order of the objects.
fn order(objects: &[Object], members: &[usize], stack: u32, sheets: &mut [Option<Sheet>]) {
    let Some(first) = members.first().map(|&object| &objects[object].shape) else {
        return;
    };
    let mut outwards: Vec<(f64, usize)> = members
        .iter()
        .map(|&object| (height(&objects[object].shape, first), object))
        .collect();
    // A stable sort: at the same height, objects keep their order.
    outwards.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (depth, &(_, object)) in (0..).zip(&outwards) {
        let is_turned = match (normal(&objects[object].shape), normal(first)) {
            (Some(own), Some(out)) => own.dot(out) < 0.0,
            _ => false,
        };
        sheets[object] = Some(Sheet {
            stack,
            depth,
            is_turned,
        });
    }
}

/// How far outside the first surface of a stack another one is; differences within the rounding of an `f64` count as 0.
fn height(shape: &Shape, first: &Shape) -> f64 {
    let height = match (shape, first) {
        (Shape::Sphere { radius, .. }, Shape::Sphere { radius: of, .. }) => radius - of,
        _ => normal(first).map_or(0.0, |out| (middle(shape) - middle(first)).dot(out)),
    };
    if height.abs() < 1e-12 * size(first) {
        0.0
    } else {
        height
    }
}

/// Pairs of objects that may coincide: neighbors by the distance from the origin for planes, and by a coordinate for spheres.
fn near_pairs(objects: &[Object]) -> Vec<(usize, usize)> {
    let key = |shape: &Shape| match shape {
        Shape::Sphere { center, .. } => center.x,
        _ => normal(shape).map_or(0.0, |normal| middle(shape).dot(normal).abs()),
    };
    let is_sphere = |object: &usize| normal(&objects[*object].shape).is_none();
    let (spheres, planes): (Vec<usize>, Vec<usize>) = (0..objects.len()).partition(is_sphere);
    let mut pairs = Vec::new();
    for mut some in [spheres, planes] {
        let of = |object: usize| (key(&objects[object].shape), size(&objects[object].shape));
        some.sort_by(|&a, &b| of(a).0.total_cmp(&of(b).0));
        for (i, &a) in some.iter().enumerate() {
            let (start, size) = of(a);
            let near = some[i + 1..]
                .iter()
                .take_while(|&&b| of(b).0 - start <= GAP * size.max(of(b).1));
            pairs.extend(near.map(|&b| (a, b)));
        }
    }
    pairs
}

fn coincide(a: &Shape, b: &Shape) -> bool {
    let gap = GAP * size(a).min(size(b));
    match (a, b) {
        (
            Shape::Sphere { center, radius },
            Shape::Sphere {
                center: other,
                radius: of_other,
            },
        ) => center.distance(*other) + (radius - of_other).abs() <= gap,
        _ => match (normal(a), normal(b)) {
            (Some(n), Some(m)) => {
                let apart = (middle(b) - middle(a)).dot(n).abs();
                let tilt = n.cross(m).length() * reach(a).min(reach(b));
                apart + tilt <= gap
            }
            _ => false,
        },
    }
}

/// The unit normal of a flat shape.
fn normal(shape: &Shape) -> Option<DVec3> {
    match *shape {
        Shape::Sphere { .. } => None,
        Shape::Plane { normal, .. }
        | Shape::Rectangle { normal, .. }
        | Shape::Disk { normal, .. } => Some(normal),
    }
}

fn middle(shape: &Shape) -> DVec3 {
    match *shape {
        Shape::Sphere { center, .. }
        | Shape::Rectangle { center, .. }
        | Shape::Disk { center, .. } => center,
        Shape::Plane { point, .. } => point,
    }
}

/// How far a surface extends from its center.
fn reach(shape: &Shape) -> f64 {
    match *shape {
        Shape::Sphere { radius, .. } | Shape::Disk { radius, .. } => radius,
        Shape::Rectangle {
            half_width,
            half_height,
            ..
        } => half_width.hypot(half_height),
        Shape::Plane { .. } => 1e6,
    }
}

/// The size that rounding errors are relative to: the distance from the origin, plus the extent of bounded shapes.
fn size(shape: &Shape) -> f64 {
    let far = middle(shape).abs().max_element();
    match shape {
        Shape::Plane { .. } => far.max(1.0),
        _ => far + reach(shape),
    }
}

/// Whether two coincident surfaces overlap, so that their order matters.
pub(crate) fn overlap(a: &Shape, b: &Shape) -> bool {
    let (Some(n), false) = (normal(a), matches!(b, Shape::Plane { .. })) else {
        return true;
    };
    let along = match *a {
        Shape::Rectangle { tangent, .. } | Shape::Disk { tangent, .. } => tangent,
        Shape::Plane { .. } | Shape::Sphere { .. } => return true,
    };
    [along, n.cross(along)].into_iter().all(|axis| {
        let extent = |shape: &Shape| match *shape {
            Shape::Rectangle {
                tangent,
                bitangent,
                half_width,
                half_height,
                ..
            } => half_width * axis.dot(tangent).abs() + half_height * axis.dot(bitangent).abs(),
            _ => reach(shape),
        };
        let apart = (middle(b) - middle(a)).dot(axis).abs();
        apart < (extent(a) + extent(b)) * (1.0 - 1e-9)
    })
}
