//! The nearest surface along a ray.

use crate::{Ray, intersect_plane, intersect_sphere};
use glam::DVec3;
use scene::{Hierarchy, Node, Object, Scene, Shape, Sheet};

/// The nearest intersection of a ray with the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the object.
    pub object: usize,
    /// Distance along the ray.
    pub distance: f64,
}

/// Returns the nearest object along a ray, which may start on `from_object`. Of two objects at the same distance, the first counts;
/// coincident surfaces are met one after another, in the order of their [`Sheet`]s.
pub fn nearest_hit(scene: &Scene, ray: &Ray, from_object: Option<usize>) -> Option<Hit> {
    let mut nearest = Nearest {
        objects: scene.objects(),
        sheets: scene.sheets(),
        ray,
        from: from_object.unwrap_or(usize::MAX),
        hit: Hit {
            object: usize::MAX,
            distance: f64::INFINITY,
        },
    };
    let hierarchy = scene.hierarchy();
    nearest.among(&hierarchy.everywhere);
    if !hierarchy.nodes.is_empty() {
        nearest.in_hierarchy(hierarchy);
    }
    (nearest.hit.object != usize::MAX).then_some(nearest.hit)
}

/// The search for the nearest object, with the nearest one so far.
struct Nearest<'a> {
    objects: &'a [Object],
    sheets: &'a [Option<Sheet>],
    ray: &'a Ray,
    from: usize,
    hit: Hit,
}

impl Nearest<'_> {
    /// Tests some objects.
    fn among(&mut self, objects: &[u32]) {
        for &object in objects {
            let object = object as usize;
            if let Some(distance) = self.distance_to(object) {
                let hit = Hit { object, distance };
                if self.is_nearer(hit) {
                    self.hit = hit;
                }
            }
        }
    }

    fn distance_to(&self, object: usize) -> Option<f64> {
        let shape = &self.objects[object].shape;
        if object == self.from || self.sheets.is_empty() {
            return distance_to_shape(shape, self.ray, object == self.from);
        }
        let start = self.sheets.get(self.from).copied().flatten();
        match (self.sheets[object], start) {
            (Some(sheet), Some(start)) if sheet.stack == start.stack => {
                let leaves = is_outward(self.ray, shape, self.ray.origin, sheet);
                let is_ahead = (sheet.depth < start.depth) == leaves;
                if is_ahead && covers(shape, self.ray.origin) {
                    Some(0.0)
                } else {
                    distance_to_shape(shape, self.ray, true)
                }
            }
            _ => distance_to_shape(shape, self.ray, false),
        }
    }

    fn is_nearer(&self, hit: Hit) -> bool {
        let nearest = self.hit;
        if let Some(&Some(sheet)) = self.sheets.get(hit.object)
            && let Some(&Some(other)) = self.sheets.get(nearest.object)
            && sheet.stack == other.stack
            && is_same_crossing(hit.distance, nearest.distance)
        {
            let place = self.ray.origin + self.ray.direction * hit.distance;
            let shape = &self.objects[hit.object].shape;
            let leaves = is_outward(self.ray, shape, place, sheet);
            return (sheet.depth > other.depth) == leaves;
        }
        hit.distance < nearest.distance
            || hit.distance == nearest.distance && hit.object < nearest.object
    }

    /// Tests the objects in the boxes that the ray meets, the nearer of two boxes first.
    fn in_hierarchy(&mut self, hierarchy: &Hierarchy) {
        let inverse = self
            .ray
            .direction
            .map(|d| if d.abs() < 1e-300 { 1e300 } else { 1.0 / d });
        let origin = self.ray.origin;
        // The distance at which the ray enters a box, if that is before it meets the nearest object.
        let entry = |node: &Node, before: f64| {
            let (a, b) = (
                (node.low - origin) * inverse,
                (node.high - origin) * inverse,
            );
            let near = a.min(b).max_element().max(0.0);
            (near <= a.max(b).min_element().min(before)).then_some(near)
        };
        let mut open = [(0.0, 0_u32); Hierarchy::DEPTH];
        let mut count = usize::from(entry(&hierarchy.nodes[0], f64::INFINITY).is_some());
        while count > 0 {
            count -= 1;
            let (enters, node) = open[count];
            if enters > self.hit.distance {
                continue;
            }
            let Node {
                first,
                count: objects,
                ..
            } = hierarchy.nodes[node as usize];
            if objects > 0 {
                self.among(&hierarchy.leaves[first as usize..(first + objects) as usize]);
                continue;
            }
            let children = [first, first + 1];
            let mut entries = children.map(|child| {
                entry(&hierarchy.nodes[child as usize], self.hit.distance).map(|near| (near, child))
            });
            if let [Some((left, _)), Some((right, _))] = entries
                && left < right
            {
                entries.swap(0, 1);
            }
            for (near, child) in entries.into_iter().flatten() {
                open[count] = (near, child);
                count += 1;
            }
        }
    }
}

/// Whether a ray leaves a stack of coincident surfaces where it meets one of them.
fn is_outward(ray: &Ray, shape: &Shape, place: DVec3, sheet: Sheet) -> bool {
    let speed = match *shape {
        Shape::Sphere { center, .. } => ray.direction.dot(place - center),
        Shape::Plane { normal, .. }
        | Shape::Rectangle { normal, .. }
        | Shape::Disk { normal, .. } => ray.direction.dot(normal),
    };
    (speed > 0.0) != sheet.is_turned
}

/// Whether coincident surfaces at these distances are met at the same position: an `f32` does not distinguish them.
fn is_same_crossing(a: f64, b: f64) -> bool {
    (a > 0.0) == (b > 0.0) && (a - b).abs() <= 1e-5 * a.max(b)
}

/// Whether a point in the plane of a shape lies in the shape.
fn covers(shape: &Shape, point: DVec3) -> bool {
    match *shape {
        Shape::Sphere { .. } | Shape::Plane { .. } => true,
        Shape::Rectangle {
            center,
            tangent,
            bitangent,
            half_width,
            half_height,
            ..
        } => {
            let place = point - center;
            place.dot(tangent).abs() <= half_width && place.dot(bitangent).abs() <= half_height
        }
        Shape::Disk { center, radius, .. } => (point - center).length_squared() <= radius * radius,
    }
}

fn distance_to_shape(shape: &Shape, ray: &Ray, starts_here: bool) -> Option<f64> {
    match *shape {
        Shape::Sphere { center, radius } => intersect_sphere(ray, center, radius, starts_here),
        Shape::Plane { .. } | Shape::Rectangle { .. } | Shape::Disk { .. } if starts_here => None,
        Shape::Plane { point, normal, .. } => intersect_plane(ray, point, normal),
        Shape::Rectangle { center, normal, .. } | Shape::Disk { center, normal, .. } => {
            intersect_plane(ray, center, normal)
                .filter(|distance| covers(shape, ray.origin + ray.direction * *distance))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{random4, sample_cone};
    use scene_file::SceneFile;
    use std::fmt::Write as _;
    use std::path::Path;

    /// `spheres` spheres of all sizes, some rectangles and disks, and a plane.
    fn crowd(spheres: u32) -> Scene {
        let mut text = String::from(
            "camera = { type = 'orthographic', position = [0, 0, 9], look_at = [0, 0, 0], height = 9 }\n\
             environment = { type = 'constant', emission = { constant = 1 } }\n\
             render = { bands = 1 }\nmaterials = { gray = { type = 'diffuse', reflectance = 0.5 } }\n\
             [[objects]]\ntype = 'plane'\nmaterial = 'gray'\npoint = [0, -6, 0]\nnormal = [0, 1, 0]\n",
        );
        for i in 0..spheres {
            let [x, y, z, size] = random4([i, 0], 0, 0, 5);
            let [nx, ny, nz, _] = random4([i, 0], 0, 1, 5).map(|u| u - 0.5);
            let center = [x, y, z].map(|u| 10.0 * u - 5.0);
            let size = 0.02 + 0.3 * size * size;
            let shape = match i % 5 {
                0 => {
                    format!("type = 'rectangle'\nnormal = [{nx}, {ny}, {nz}]\nsize = [{size}, 0.4]")
                }
                1 => format!("type = 'disk'\nnormal = [{nx}, {ny}, {nz}]\nradius = {size}"),
                _ => format!("type = 'sphere'\nradius = {size}"),
            };
            writeln!(
                text,
                "[[objects]]\nmaterial = 'gray'\ncenter = {center:?}\n{shape}"
            )
            .unwrap();
        }
        SceneFile::parse("crowd.toml", &text, Path::new(""))
            .and_then(|file| file.validate())
            .unwrap_or_else(|problems| panic!("{problems}"))
    }

    /// Returns the nearest of some objects by testing each.
    fn one_by_one(
        scene: &Scene,
        objects: std::ops::RangeInclusive<usize>,
        ray: &Ray,
        from: Option<usize>,
    ) -> Option<Hit> {
        let hits = objects.filter_map(|object| {
            let distance =
                distance_to_shape(&scene.objects()[object].shape, ray, from == Some(object))?;
            Some(Hit { object, distance })
        });
        hits.reduce(|a, b| if b.distance < a.distance { b } else { a })
    }

    /// The hierarchy of boxes finds the same as testing all objects: from outside, from inside and from the objects themselves.
    #[test]
    fn rays_meet_the_nearest_of_many_objects() {
        let (many, mut hits) = (crowd(700), 0);
        assert!(many.hierarchy().nodes.len() > 100);
        for i in 0..4000 {
            let [x, y, z, _] = random4([i, 1], 0, 0, 5).map(|u| 16.0 * u - 8.0);
            let [u, v, pick, _] = random4([i, 1], 0, 1, 5);
            let direction = match i % 7 {
                0 => DVec3::X,
                1 => DVec3::NEG_Y,
                _ => sample_cone(u, v, 2.0),
            };
            let mut ray = Ray {
                origin: DVec3::new(x, y, z),
                direction,
            };
            let mut from = None;
            if i % 3 == 0 {
                let object = (pick * 701.0) as usize;
                let toward = one_by_one(&many, 0..=object, &ray, None);
                if let Some(hit) = toward {
                    ray.origin += ray.direction * hit.distance;
                    from = Some(hit.object);
                }
            }
            let expected = one_by_one(&many, 0..=700, &ray, from);
            assert_eq!(nearest_hit(&many, &ray, from), expected, "{ray:?}");
            hits += u32::from(expected.is_some());
        }
        assert!((1000..3900).contains(&hits), "{hits}");
    }
}
