//! Functions of hit.wgsl and surface.wgsl: the object that a ray hits, and the point.

use crate::world::{
    center_of, everything, first_numbers, objects_where, pick, point_on, rounded, rows, unit,
    vector, within,
};
use crate::{Check, lazy};
use glam::DVec3;
use pellicle_tests::tolerances::{DISTANCE, SPHERE_DISTANCE};
use reference::Ray;
use scene::Shape;

const MISS: f64 = -1.0;

pub(crate) fn checks() -> Vec<Check> {
    vec![surface_point(), distance_to(), nearest_hit()]
}

fn ray_at(a: &[f64]) -> Ray {
    Ray {
        origin: vector(a),
        direction: vector(&a[3..]),
    }
}

/// Distance along a ray to a shape, or a miss.
fn distance(shape: &Shape, ray: &Ray, starts_here: bool) -> f64 {
    let found = match *shape {
        Shape::Sphere { center, radius } => {
            reference::intersect_sphere(ray, center, radius, starts_here)
        }
        _ if starts_here => None,
        Shape::Plane { point, normal, .. } => reference::intersect_plane(ray, point, normal),
        Shape::Rectangle { center, normal, .. } | Shape::Disk { center, normal, .. } => {
            reference::intersect_plane(ray, center, normal)
                .filter(|&t| beyond_the_edge(shape, ray.origin + t * ray.direction) <= 0.0)
        }
    };
    found.unwrap_or(MISS)
}

/// How far a point in the plane of a rectangle or disk lies outside it; negative inside.
fn beyond_the_edge(shape: &Shape, place: DVec3) -> f64 {
    if let Shape::Disk { center, radius, .. } = *shape {
        return (place - center).length() - radius;
    }
    let Shape::Rectangle {
        center,
        tangent,
        bitangent,
        half_width,
        half_height,
        ..
    } = *shape
    else {
        return f64::NEG_INFINITY;
    };
    let place = place - center;
    let aside = place.dot(tangent).abs() - half_width;
    aside.max(place.dot(bitangent).abs() - half_height)
}

/// Whether the ray misses the shape's edge and starts off its surface by a thousandth, and does not run along it.
fn is_clear(shape: &Shape, ray: &Ray, starts_here: bool) -> bool {
    const MIN: f64 = 1e-3;
    let origin = ray.origin - center_of(shape);
    match *shape {
        Shape::Sphere { radius, .. } => {
            let along = origin.dot(ray.direction);
            let off_axis = (origin - along * ray.direction).length();
            if starts_here {
                return along.abs() > MIN;
            }
            (off_axis - radius).abs() > MIN && (origin.length() - radius).abs() > MIN
        }
        _ if starts_here => true,
        Shape::Plane { normal, .. }
        | Shape::Rectangle { normal, .. }
        | Shape::Disk { normal, .. } => {
            let (height, speed) = (origin.dot(normal), ray.direction.dot(normal));
            let place = ray.origin - height / speed * ray.direction;
            height.abs() > MIN && speed.abs() > 0.05 && beyond_the_edge(shape, place).abs() > MIN
        }
    }
}

/// A ray made from nine numbers: from anywhere or from the surface of an object, mostly toward an object.
fn ray_of(u: &[f64]) -> (Option<usize>, Ray) {
    let world = everything();
    let all = objects_where(|_, _| true);
    let (from, origin) = if u[0] < 0.5 {
        let place = DVec3::new(u[1], u[2], u[3]);
        (None, 5.0 * (2.0 * place - 1.0))
    } else {
        let object = pick(&all, u[1]);
        (Some(object), point_on(world.shape(object), u[2], u[3]))
    };
    let origin = rounded(origin);
    let shape = world.shape(pick(&all, u[4]));
    let target = center_of(shape) + 1.4 * u[5] * (point_on(shape, u[6], u[7]) - center_of(shape));
    let direction = if u[8] < 0.8 {
        (target - origin).normalize()
    } else {
        unit(u[6], u[7])
    };
    let direction = rounded(direction);
    (from, Ray { origin, direction })
}

fn ray_row(first: &[f64], ray: &Ray) -> Vec<f64> {
    [first, &ray.origin.to_array(), &ray.direction.to_array()].concat()
}

/// The number of an object in a table; −1 for none.
fn number_of(object: Option<usize>) -> f64 {
    object.map_or(-1.0, |index| index as f64)
}

fn object_of(number: f64) -> Option<usize> {
    (number >= 0.0).then_some(number as usize)
}

fn distance_to() -> Check {
    Check {
        probe: within(everything, (8, 1),
            "let r = Ray(a3(2u), a3(5u));
             put(0u, max(distance_to(u32(a(0u)), r, select(u32(max(a(1u), 0.0)), NONE, a(1u) < 0.0)), -1.0));",
        ),
        proves: &["covers", "distance_to", "distance_to_shape"],
        inputs: lazy(|| {
            let world = everything();
            let all = objects_where(|_, _| true);
            rows(9, |u| {
            let (from, ray) = ray_of(u);
            // The object that the ray is aimed at, or the one that it starts on.
            let starts_here = u[5] < 0.2 && from.is_some();
            let object = from.filter(|_| starts_here).unwrap_or(pick(&all, u[4]));
            let is_clear = is_clear(world.shape(object), &ray, from == Some(object));
            is_clear.then(|| ray_row(&[object as f64, number_of(from)], &ray))
        }) }),
        twin: |a| {
            let object = a[0] as usize;
            let starts_here = object_of(a[1]) == Some(object);
            vec![distance(everything().shape(object), &ray_at(&a[2..]), starts_here)]
        },
        tolerance: SPHERE_DISTANCE,
    }
}

fn nearest_hit() -> Check {
    Check {
        probe: within(everything, (7, 2),
            "let h = nearest_hit(Ray(a3(1u), a3(4u)), select(u32(max(a(0u), 0.0)), NONE, a(0u) < 0.0));
             let hits = h.object != NONE;
             put(0u, select(-1.0, f32(h.object), hits)); put(1u, select(-1.0, h.distance, hits));",
        ),
        proves: &["is_met", "is_nearer", "load_node", "load_shape", "meets_box", "nearest_hit", "nearest_in_hierarchy", "shape_at", "shapes_row"],
        inputs: lazy(|| {
            let world = everything();
            rows(9, |u| {
            let (from, ray) = ray_of(u);
            let shapes = || world.scene.objects().iter().map(|object| &object.shape).enumerate();
            let mut distances: Vec<f64> = shapes()
                .map(|(index, shape)| distance(shape, &ray, from == Some(index)))
                .filter(|&t| t > 0.0)
                .collect();
            distances.sort_by(f64::total_cmp);
            // Where two objects touch, either may be the nearer one.
            let is_decided = distances.len() < 2 || distances[1] - distances[0] > 1e-3 * distances[1];
            let is_kept = is_decided
                && shapes().all(|(index, shape)| is_clear(shape, &ray, from == Some(index)));
            is_kept.then(|| ray_row(&[number_of(from)], &ray))
        }) }),
        twin: nearest,
        tolerance: SPHERE_DISTANCE,
    }
}

fn nearest(a: &[f64]) -> Vec<f64> {
    let hit = reference::nearest_hit(&everything().scene, &ray_at(&a[1..]), object_of(a[0]));
    hit.map_or(vec![MISS, MISS], |hit| {
        vec![hit.object as f64, hit.distance]
    })
}

fn surface_point() -> Check {
    Check {
        probe: within(
            everything,
            (8, 7),
            "let p = surface_point(u32(a(0u)), Ray(a3(1u), a3(4u)), a(7u));
             put3(0u, p.position); put3(3u, p.normal); put(6u, p.cosine);",
        ),
        proves: &["surface_point"],
        inputs: lazy(|| {
            let world = everything();
            let all = objects_where(|_, _| true);
            rows(9, |u| {
                let (from, ray) = ray_of(u);
                let object = pick(&all, u[4]);
                let (shape, starts_here) = (world.shape(object), from == Some(object));
                let distance = distance(shape, &ray, starts_here);
                let is_kept =
                    distance > 0.0 && distance < 30.0 && is_clear(shape, &ray, starts_here);
                let mut row = ray_row(&[object as f64], &ray);
                row.push(distance);
                is_kept.then_some(row)
            })
        }),
        twin: |a| {
            let shape = everything().shape(a[0] as usize);
            let point = reference::surface_point(shape, &ray_at(&a[1..]), a[7]);
            let mut row = [point.position.to_array(), point.normal.to_array()].concat();
            row.push(point.cosine);
            row
        },
        tolerance: DISTANCE,
    }
}

/// The tables serve their purpose: they contain hits of each object and misses.
pub(crate) fn every_object_is_hit() {
    let objects = everything().scene.objects().len() as i64;
    assert_eq!(
        first_numbers(&nearest_hit(), nearest),
        (-1..objects).collect()
    );
    assert_eq!(
        first_numbers(&distance_to(), <[f64]>::to_vec),
        (0..objects).collect()
    );
    assert_eq!(
        first_numbers(&surface_point(), <[f64]>::to_vec),
        (0..objects).collect()
    );
}
