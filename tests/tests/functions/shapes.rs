//! Functions of sampling.wgsl and intersect.wgsl, and `mirrored_at` of path_state.wgsl.

use crate::{Check, lazy, pure, table};
use glam::DVec3;
use pellicle_tests::tolerances::{ARITHMETIC, DIRECTION, DISTANCE};

pub(crate) fn checks() -> Vec<Check> {
    [directions(), distances()].into_iter().flatten().collect()
}

fn unit(a: &[f64]) -> DVec3 {
    let (sine, phi) = (
        (1.0 - a[0] * a[0]).max(0.0).sqrt(),
        std::f64::consts::TAU * a[1],
    );
    DVec3::new(sine * phi.cos(), sine * phi.sin(), a[0])
}

fn directions() -> Vec<Check> {
    vec![
        Check {
            // The whole vector is an input, so that both sides see the same sign of z.
            probe: pure(
                (3, 9),
                "let f = frame_of(a3(0u)); put3(0u, f[0]); put3(3u, f[1]); put3(6u, f[2]);",
            ),
            proves: &["frame_of"],
            inputs: lazy(unit_vectors),
            twin: |a| {
                reference::frame_of(DVec3::from_slice(a))
                    .to_cols_array()
                    .to_vec()
            },
            tolerance: DIRECTION,
        },
        Check {
            probe: pure((2, 3), "put3(0u, sample_cosine_hemisphere(a(0u), a(1u)));"),
            proves: &["sample_cosine_hemisphere"],
            inputs: lazy(move || {
                table(
                    &[(0.0, 1.0), (0.0, 1.0)],
                    &[&[0.0, 0.0], &[0.999_999_94, 0.5]],
                )
            }),
            twin: |a| {
                reference::sample_cosine_hemisphere(a[0], a[1])
                    .to_array()
                    .to_vec()
            },
            tolerance: DIRECTION,
        },
        Check {
            probe: pure((3, 3), "put3(0u, sample_cone(a(0u), a(1u), a(2u)));"),
            proves: &["sample_cone"],
            inputs: lazy(move || {
                table(
                    &[(0.0, 1.0), (0.0, 1.0), (0.001, 2.0)],
                    &[&[0.0, 0.0, 1e-6], &[0.999_999_94, 0.25, 2.0]],
                )
            }),
            twin: |a| reference::sample_cone(a[0], a[1], a[2]).to_array().to_vec(),
            tolerance: DIRECTION,
        },
        Check {
            probe: pure((2, 1), "put(0u, cone_height(a(0u), a(1u)));"),
            proves: &["cone_height"],
            inputs: lazy(move || table(&[(0.1, 1.0), (1.1, 50.0)], &[&[1.0, 1.0001], &[0.5, 0.5]])),
            twin: |a| vec![reference::cone_height(a[0], a[1])],
            tolerance: pellicle_tests::tolerances::CONE,
        },
        Check {
            probe: pure((6, 3), "put3(0u, mirrored_at(a3(0u), a3(3u)));"),
            proves: &["mirrored_at"],
            inputs: lazy(pairs_of_unit_vectors),
            twin: |a| {
                let (d, n) = (DVec3::from_slice(a), DVec3::from_slice(&a[3..]));
                (d - 2.0 * d.dot(n) * n).normalize().to_array().to_vec()
            },
            tolerance: DIRECTION,
        },
    ]
}

/// Unit vectors rounded to f32, including the axes.
fn unit_vectors() -> Vec<f32> {
    let rows = table(
        &[(-1.0, 1.0), (0.0, 1.0)],
        &[
            &[1.0, 0.0],
            &[-1.0, 0.0],
            &[0.0, 0.0],
            &[0.0, 0.25],
            &[-0.999_999, 0.3],
        ],
    );
    rows.chunks(2)
        .flat_map(|row| {
            unit(&[f64::from(row[0]), f64::from(row[1])])
                .as_vec3()
                .to_array()
        })
        .collect()
}

fn pairs_of_unit_vectors() -> Vec<f32> {
    let vectors = unit_vectors();
    let shifted = vectors.iter().skip(3 * 1000).chain(&vectors[..3 * 1000]);
    vectors
        .chunks(3)
        .zip(shifted.copied().collect::<Vec<_>>().chunks(3))
        .flat_map(|(a, b)| [a, b].concat())
        .collect()
}

fn ray(a: &[f64]) -> reference::Ray {
    reference::Ray {
        origin: DVec3::from_slice(a),
        direction: DVec3::from_slice(&a[3..]),
    }
}

/// Rays that start within ±5 of the origin; `keep` leaves out those whose result depends on the last digit.
fn rays(keep: impl Fn(&[f64]) -> bool) -> Vec<f32> {
    let origins = table(
        &[(-5.0, 5.0); 3],
        &[&[0.0, 0.0, 3.0], &[0.0; 3], &[0.1, 0.0, 0.0]],
    );
    let directions = unit_vectors();
    let rows = origins
        .chunks(3)
        .zip(directions.chunks(3))
        .map(|(o, d)| [o, d].concat());
    rows.filter(|row| keep(&row.iter().map(|&x| f64::from(x)).collect::<Vec<_>>()))
        .flatten()
        .collect()
}

const MISS: f64 = -1.0;
const RADIUS: f64 = 1.5;

/// Whether the ray misses the sphere's edge and does not start at its surface, by a thousandth.
fn sphere_is_clear(a: &[f64]) -> bool {
    let ray = ray(a);
    let nearest = ray.origin - ray.origin.dot(ray.direction) * ray.direction;
    (nearest.length() - RADIUS).abs() > 1e-3 && (ray.origin.length() - RADIUS).abs() > 1e-3
}

/// A sphere through the origin with curvature 0.001, with its normal there rounded to `f32`.
fn large_sphere() -> (DVec3, f64) {
    let normal = DVec3::new(0.0, f64::from(0.6_f32), f64::from(0.8_f32));
    let radius = 1.0 / f64::from(0.001_f32);
    (-radius * normal, radius * normal.length())
}

/// Whether the ray starts off the sphere by a thousandth, and does not run along it.
fn large_sphere_is_clear(ray: &reference::Ray) -> bool {
    let (center, radius) = large_sphere();
    let outwards = (ray.origin - center).normalize();
    let height = (ray.origin - center).length() - radius;
    height.abs() > 1e-3 && ray.direction.dot(outwards).abs() > 0.05
}

fn distances() -> Vec<Check> {
    vec![
        Check {
            probe: pure(
                (6, 1),
                "put(0u, intersect_sphere(a3(0u), a3(3u), 1.5, false));",
            ),
            proves: &["intersect_sphere"],
            inputs: lazy(move || rays(sphere_is_clear)),
            twin: |a| {
                vec![
                    reference::intersect_sphere(&ray(a), DVec3::ZERO, RADIUS, false)
                        .unwrap_or(MISS),
                ]
            },
            tolerance: pellicle_tests::tolerances::SPHERE_DISTANCE,
        },
        Check {
            probe: pure(
                (6, 1),
                "put(0u, intersect_sphere(1.5 * a3(0u), a3(3u), 1.5, true));",
            ),
            proves: &["intersect_sphere"],
            inputs: lazy(pairs_of_unit_vectors),
            twin: |a| {
                let mut ray = ray(a);
                ray.origin *= RADIUS;
                // Tangents within rounding may go either way; both results are then 0 or a miss.
                let along = ray.origin.dot(ray.direction);
                if along.abs() < 1e-6 {
                    return vec![if along < 0.0 { -2.0 * along } else { MISS }];
                }
                vec![reference::intersect_sphere(&ray, DVec3::ZERO, RADIUS, true).unwrap_or(MISS)]
            },
            tolerance: ARITHMETIC,
        },
        Check {
            probe: pure(
                (6, 1),
                "let d = intersect_large_sphere(a3(0u), a3(3u), vec3f(0.0, 0.6, 0.8), 0.001, false); put(0u, select(-1.0, d, d > 0.0));",
            ),
            proves: &["intersect_large_sphere"],
            inputs: lazy(move || rays(|a| large_sphere_is_clear(&ray(a)))),
            twin: |a| {
                let (center, radius) = large_sphere();
                vec![reference::intersect_sphere(&ray(a), center, radius, false).unwrap_or(MISS)]
            },
            tolerance: pellicle_tests::tolerances::SPHERE_DISTANCE,
        },
        Check {
            probe: pure(
                (6, 1),
                "let d = intersect_large_sphere(vec3f(0.0), a3(3u), vec3f(0.0, 0.6, 0.8), 0.001, true); put(0u, select(-1.0, d, d > 0.0));",
            ),
            proves: &["intersect_large_sphere"],
            inputs: lazy(move || rays(|a| large_sphere_is_clear(&ray(a)))),
            twin: |a| {
                let (center, radius) = large_sphere();
                let mut ray = ray(a);
                ray.origin = DVec3::ZERO;
                vec![reference::intersect_sphere(&ray, center, radius, true).unwrap_or(MISS)]
            },
            tolerance: DISTANCE,
        },
        Check {
            probe: pure(
                (6, 1),
                "put(0u, intersect_plane(a3(0u), a3(3u), vec3f(0.0, 0.6, 0.8)));",
            ),
            proves: &["intersect_plane"],
            inputs: lazy(move || {
                rays(|a| {
                    let normal = DVec3::new(0.0, 0.6, 0.8);
                    let (height, speed) = (ray(a).origin.dot(normal), ray(a).direction.dot(normal));
                    height.abs() > 1e-3 && speed.abs() > 0.05
                })
            }),
            twin: |a| {
                let normal = DVec3::new(f64::from(0.0_f32), f64::from(0.6_f32), f64::from(0.8_f32));
                vec![reference::intersect_plane(&ray(a), DVec3::ZERO, normal).unwrap_or(MISS)]
            },
            tolerance: DISTANCE,
        },
    ]
}
