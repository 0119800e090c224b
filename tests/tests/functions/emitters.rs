//! Functions of emitter.wgsl: directions toward emitters that are objects, and their densities.

use crate::world::{center_of, everything, pick, rounded, rows, unit, vector, within};
use crate::{Check, lazy};
use glam::DVec3;
use pellicle_tests::tolerances::{DIRECTION, EMITTER_PDF, EXACT, NEAR_LIGHT};
use scene::{EmitterKind, Shape};

/// A point from which an emitter is seen, or that lies inside it. For a sphere: outside by half a radius or more
/// when `far`, otherwise from just outside, or anywhere inside. For a rectangle: within some five units of it, but
/// not in its plane.
fn point_about(light: &Shape, u: &[f64], far: bool) -> Option<DVec3> {
    match *light {
        Shape::Sphere { center, radius } => {
            let outside = if far {
                1.5 * (60.0 * u[1]).exp().powf(0.08)
            } else {
                1.01 + u[1]
            };
            let distance = if u[0] < 0.3 { 0.999 * u[1] } else { outside };
            Some(rounded(center + radius * distance * unit(u[2], u[3])))
        }
        Shape::Rectangle { center, normal, .. } | Shape::Disk { center, normal, .. } => {
            let aside = 5.0 * (2.0 * DVec3::new(u[1], u[2], u[3]) - 1.0);
            let least = if far { 0.5 } else { 0.1 };
            (aside.dot(normal).abs() > least).then(|| rounded(center + aside))
        }
        Shape::Plane { .. } => None,
    }
}

/// Points just outside a sphere emitter, within a hundredth of its radius.
fn close_points() -> Vec<f32> {
    let world = everything();
    let spheres: Vec<usize> = lights_of(|shape| matches!(shape, Shape::Sphere { .. }));
    rows(6, move |u| {
        let light = pick(&spheres, u[0]);
        let Shape::Sphere { center, radius } = *world.shape(light) else {
            return None;
        };
        // Up to 1.000 005 radii the point counts as inside; points within half of that on either side are left out.
        let distance = radius * (1.0 + 0.01 * u[1].powi(4) + 8e-6);
        let point = rounded(center + distance * unit(u[2], u[3]));
        let row = [light as f64, point.x, point.y, point.z, u[4], u[5]];
        Some(row.to_vec())
    })
}

fn lights_of(keep: impl Fn(&Shape) -> bool) -> Vec<usize> {
    let world = everything();
    let sources = world.scene.emitters().into_iter();
    let objects = sources.filter_map(|source| match source.kind {
        EmitterKind::Object(index) => Some(index),
        _ => None,
    });
    objects.filter(|&light| keep(world.shape(light))).collect()
}

/// Rows of an emitter, a point and two numbers.
fn emitter_rows(far: bool) -> Vec<f32> {
    let world = everything();
    let lights = lights_of(|_| true);
    let mut all = rows(7, |u| {
        let light = pick(&lights, u[0]);
        let point = point_about(world.shape(light), &u[1..], far)?;
        Some(vec![light as f64, point.x, point.y, point.z, u[5], u[6]])
    });
    // In the middle of a sphere; with the extremes of the numbers.
    for light in lights {
        let shape = world.shape(light);
        let point = match *shape {
            Shape::Rectangle { center, normal, .. } | Shape::Disk { center, normal, .. } => {
                center + normal
            }
            _ => center_of(shape),
        };
        for (u, v) in [(0.0, 0.0), (0.999_999_94, 0.999_999_94), (0.0, 0.5)] {
            let [x, y, z] = point.as_vec3().to_array();
            all.extend([light as f32, x, y, z, u, v]);
        }
    }
    all
}

/// The same rows with the direction that the numbers choose.
fn pdf_rows(points: &[f32]) -> Vec<f32> {
    let world = everything();
    let made = points.chunks(6).filter_map(|row| {
        let a: Vec<f64> = row.iter().map(|&x| f64::from(x)).collect();
        let shape = world.shape(a[0] as usize);
        let direction = reference::sample_shape(shape, vector(&a[1..]), a[4], a[5]).as_vec3();
        if let Shape::Rectangle { normal, .. } | Shape::Disk { normal, .. } = *shape
            && direction.as_dvec3().dot(normal).abs() < 0.1
        {
            return None;
        }
        Some([&row[..4], &direction.to_array()].concat())
    });
    made.flatten().collect()
}

fn sampled(a: &[f64]) -> Vec<f64> {
    let light = everything().shape(a[0] as usize);
    reference::sample_shape(light, vector(&a[1..]), a[4], a[5])
        .to_array()
        .to_vec()
}

fn density(a: &[f64]) -> Vec<f64> {
    let light = everything().shape(a[0] as usize);
    vec![reference::shape_pdf(
        light,
        vector(&a[1..]),
        vector(&a[4..]),
    )]
}

const INSIDE: f64 = 1.000_01;

pub(crate) fn checks() -> Vec<Check> {
    let sample = |inputs, tolerance| Check {
        probe: within(
            everything,
            (6, 3),
            "put3(0u, emitter_sample(shape_at(u32(a(0u))).emitter, a3(1u), a(4u), a(5u)));",
        ),
        proves: &["emitter_sample"],
        inputs,
        twin: sampled,
        tolerance,
    };
    let pdf = |points: fn() -> Vec<f32>, tolerance| Check {
        probe: within(
            everything,
            (7, 1),
            "put(0u, emitter_pdf(shape_at(u32(a(0u))).emitter, a3(1u), a3(4u)));",
        ),
        proves: &["emitter_pdf"],
        inputs: lazy(move || pdf_rows(&points())),
        twin: density,
        tolerance,
    };
    vec![
        sample(lazy(|| emitter_rows(true)), DIRECTION),
        sample(lazy(close_points), NEAR_LIGHT),
        pdf(|| emitter_rows(false), EMITTER_PDF),
        pdf(close_points, NEAR_LIGHT),
        Check {
            probe: within(
                everything,
                (2, 1),
                "put(0u, select(0.0, 1.0, sphere_surrounds(shape_at(u32(a(0u))).emitter, a(1u))));",
            ),
            proves: &["sphere_surrounds"],
            inputs: lazy(squared_distances),
            twin: |a| {
                let Shape::Sphere { radius, .. } = *everything().shape(a[0] as usize) else {
                    return vec![f64::NAN];
                };
                vec![f64::from(u8::from(a[1] <= radius * radius * INSIDE))]
            },
            tolerance: EXACT,
        },
    ]
}

/// Spheres with squared distances from their centers: anywhere, and close to the deciding distance, but not within the
/// rounding of a product.
fn squared_distances() -> Vec<f32> {
    let world = everything();
    let spheres = lights_of(|shape| matches!(shape, Shape::Sphere { .. }));
    let radius_of = move |object: usize| match *world.shape(object) {
        Shape::Sphere { radius, .. } => radius,
        _ => 0.0,
    };
    let mut all = rows(3, |u| {
        let object = pick(&spheres, u[0]);
        let edge = radius_of(object).powi(2);
        let distance2 = if u[1] < 0.5 {
            edge * 3.0 * u[2]
        } else {
            edge * (INSIDE + 1e-4 * (u[2] - 0.5))
        };
        let is_clear = (distance2 / (edge * INSIDE) - 1.0).abs() > 4e-7;
        is_clear.then(|| vec![object as f64, distance2])
    });
    for object in spheres {
        let radius = radius_of(object) as f32;
        all.extend([object as f32, 0.0, object as f32, radius * radius]);
    }
    all
}

/// The comparison can fail: an area that is one part in a thousand off.
pub(crate) fn a_wrong_density_of_a_light_is_noticed() {
    let mut check = checks()
        .into_iter()
        .find(|check| check.proves.contains(&"emitter_pdf"))
        .expect("exists");
    assert!(check.run().is_ok());
    check.twin = |a| vec![1.001 * density(a)[0]];
    assert!(check.run().is_err());
}
