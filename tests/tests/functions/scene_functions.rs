//! camera.wgsl, spectrum.wgsl, surface.wgsl, hit.wgsl, light.wgsl and the factors of evaluate.wgsl: what reads a scene.

use crate::{Check, table};
use glam::DVec3;
use gpu::PackedScene;
use num_complex::Complex64;
use pellicle_tests::probe::Probe;
use pellicle_tests::scenes::small;
use pellicle_tests::tolerances::{
    ARITHMETIC, ARITHMETIC_OF_TABLES, DIRECTION, DISTANCE, EXACT, FILM, FILTER, FRESNEL, KNOT,
    LIGHT_PDF, NEAR_LIGHT, SMOOTH, SPECTRUM, SPHERE_DISTANCE,
};
use reference::{Ray, Reflectance};
use scene::{Material, Scene, Shape, SourceKind};
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// Bands, of which the last group of four has two.
const BANDS: u32 = 22;
const MISS: f64 = -1.0;

/// A scene as both sides read it.
pub(crate) struct World {
    pub(crate) scene: Scene,
    pub(crate) packed: PackedScene,
}

impl World {
    pub(crate) fn new(name: &str) -> Self {
        let scene = small(name, [96, 64], 1, BANDS, 3);
        let packed = PackedScene::new(&scene);
        Self { scene, packed }
    }

    pub(crate) fn shape(&self, object: usize) -> &Shape {
        &self.scene.objects()[object].shape
    }

    pub(crate) fn material(&self, object: usize) -> &Material {
        self.scene.material(self.scene.objects()[object].material)
    }

    pub(crate) fn probe(
        &'static self,
        roots: &'static [&'static str],
        shape: (usize, usize),
        body: &'static str,
    ) -> Probe<'static> {
        Probe {
            roots,
            body,
            shape,
            scene: Some(&self.packed),
        }
    }
}

pub(crate) fn everything() -> &'static World {
    static WORLD: OnceLock<World> = OnceLock::new();
    WORLD.get_or_init(|| World::new("everything"))
}

/// Its surroundings are a picture, and its camera sees all directions.
pub(crate) fn pictured() -> &'static World {
    static WORLD: OnceLock<World> = OnceLock::new();
    WORLD.get_or_init(|| World::new("everything_pictured"))
}

/// Its camera is orthographic.
fn wedge() -> &'static World {
    static WORLD: OnceLock<World> = OnceLock::new();
    WORLD.get_or_init(|| World::new("film_wedge"))
}

pub(crate) fn checks() -> Vec<Check> {
    let mut all = vec![
        diffuse_factor(),
        surface_point(),
        distance_to(),
        nearest_hit(),
    ];
    all.extend(cameras());
    all.extend(splits());
    all.extend(lights());
    all.extend(spectra());
    all.extend(factors());
    all
}

/// Rows made of `columns` uniform numbers in [0, 1) each; those for which there is none are left out.
pub(crate) fn rows(columns: usize, row: impl Fn(&[f64]) -> Option<Vec<f64>>) -> Vec<f32> {
    let uniform = table(&vec![(0.0, 1.0); columns], &[]);
    let made = uniform.chunks(columns).filter_map(|u| {
        let u: Vec<f64> = u.iter().map(|&x| f64::from(x)).collect();
        row(&u)
    });
    let made: Vec<f32> = made.flatten().map(|x| x as f32).collect();
    assert!(!made.is_empty(), "every row was left out");
    made
}

pub(crate) fn pick<T: Copy>(list: &[T], u: f64) -> T {
    list[(u * list.len() as f64) as usize]
}

pub(crate) fn unit(u: f64, v: f64) -> DVec3 {
    let (z, phi) = (2.0 * u - 1.0, TAU * v);
    let sine = (1.0 - z * z).sqrt();
    DVec3::new(sine * phi.cos(), sine * phi.sin(), z)
}

/// Rounded, so that both sides see the same numbers.
pub(crate) fn rounded(v: DVec3) -> DVec3 {
    v.as_vec3().as_dvec3()
}

pub(crate) fn vector(a: &[f64]) -> DVec3 {
    DVec3::from_slice(a)
}

fn ray_at(a: &[f64]) -> Ray {
    Ray {
        origin: vector(a),
        direction: vector(&a[3..]),
    }
}

pub(crate) fn center_of(shape: &Shape) -> DVec3 {
    match *shape {
        Shape::Sphere { center, .. }
        | Shape::Rectangle { center, .. }
        | Shape::Disk { center, .. } => center,
        Shape::Plane { point, .. } => point,
    }
}

/// A point of a shape, of a plane near its middle.
pub(crate) fn point_on(shape: &Shape, u: f64, v: f64) -> DVec3 {
    let (across, along) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    match *shape {
        Shape::Sphere { center, radius } => center + radius * unit(u, v),
        Shape::Plane {
            point,
            tangent,
            bitangent,
            ..
        } => point + 6.0 * (across * tangent + along * bitangent),
        Shape::Rectangle {
            center,
            tangent,
            bitangent,
            half_width,
            half_height,
            ..
        } => center + across * half_width * tangent + along * half_height * bitangent,
        Shape::Disk {
            center,
            tangent,
            bitangent,
            radius,
            ..
        } => {
            let (sine, cosine) = (TAU * v).sin_cos();
            center + radius * u.sqrt() * (cosine * tangent + sine * bitangent)
        }
    }
}

/// The objects for which something holds.
pub(crate) fn objects_where(keep: impl Fn(&Shape, &Material) -> bool) -> Vec<usize> {
    let world = everything();
    (0..world.scene.objects().len())
        .filter(|&object| keep(world.shape(object), world.material(object)))
        .collect()
}

// Cameras.

const CAMERA: &str =
    "let r = camera_ray(vec2u(u32(a(0u)), u32(a(1u))), vec2f(a(2u), a(3u)), vec2f(a(4u), a(5u)));
    put3(0u, r.origin); put3(3u, r.direction);";

fn camera_twin(world: &World, a: &[f64]) -> Vec<f64> {
    let pixel = [a[0] as u32, a[1] as u32];
    let ray = reference::sampled_camera_ray(&world.scene, pixel, [a[2], a[3]], [a[4], a[5]]);
    [ray.origin.to_array(), ray.direction.to_array()].concat()
}

fn cameras() -> Vec<Check> {
    let pixels = || {
        let mut pixels = table(
            &[
                (0.0, 96.0),
                (0.0, 64.0),
                (0.0, 1.0),
                (0.0, 1.0),
                (0.0, 1.0),
                (0.0, 1.0),
            ],
            &[
                &[0.0; 6],
                &[
                    95.0,
                    63.0,
                    0.999_999_94,
                    0.999_999_94,
                    0.999_999_94,
                    0.999_999_94,
                ],
                &[48.0, 32.0, 0.0, 0.0, 0.0, 0.5],
            ],
        );
        for pixel in pixels.chunks_mut(6) {
            pixel[0] = pixel[0].floor().min(95.0);
            pixel[1] = pixel[1].floor().min(63.0);
        }
        pixels
    };
    let check = |world: &'static World, twin| Check {
        probe: world.probe(&["camera"], (6, 6), CAMERA),
        proves: &["camera_ray"],
        inputs: pixels(),
        twin,
        tolerance: DIRECTION,
    };
    vec![
        check(everything(), |a| camera_twin(everything(), a)),
        check(wedge(), |a| camera_twin(wedge(), a)),
        check(pictured(), |a| camera_twin(pictured(), a)),
        Check {
            probe: everything().probe(&["camera"], (1, 1), "put(0u, filter_offset(a(0u)));"),
            proves: &["filter_offset"],
            inputs: table(&[(0.0, 1.0)], &[&[0.0], &[0.5], &[0.999_999_94]]),
            twin: |a| vec![everything().scene.camera().filter.offset_at(a[0])],
            tolerance: FILTER,
        },
    ]
}

// Where paths divide.

fn splits() -> Vec<Check> {
    vec![
        Check {
            probe: everything().probe(
                &["split"],
                (2, 1),
                "put(0u, reflected_part(u32(a(0u)), a(1u)));",
            ),
            proves: &["reflected_part"],
            inputs: rows(2, |u| {
                let materials = everything().scene.estimates();
                let material = (u[0] * materials.len() as f64) as usize;
                let cosine = (1.02 * u[1]).min(1.0);
                (!materials[material].reflected.is_empty()).then(|| vec![material as f64, cosine])
            }),
            twin: |a| vec![everything().scene.estimates()[a[0] as usize].reflected_at(a[1])],
            tolerance: ARITHMETIC_OF_TABLES,
        },
        Check {
            probe: everything().probe(
                &["split"],
                (1, 2),
                "put(0u, reflected_share(a(0u))); put(1u, chance_to_go_on(a(0u)));",
            ),
            proves: &["chance_to_go_on", "reflected_share"],
            inputs: table(&[(0.0, 1.2)], &[&[0.0], &[1.0]]),
            twin: |a| {
                let chance = reference::chance_to_go_on(a[0]);
                vec![reference::reflected_share(a[0]), chance]
            },
            tolerance: ARITHMETIC,
        },
    ]
}

// Lights.

/// A point from which a light is seen, or that lies in it. Of a sphere: within half a radius and more of its surface
/// when `far`, from just outside it otherwise, or anywhere inside. Of a rectangle: within some five units of it, but
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

/// Points just outside a sphere light, within a hundredth of its radius.
fn close_points() -> Vec<f32> {
    let world = everything();
    let spheres: Vec<usize> = lights_of(|shape| matches!(shape, Shape::Sphere { .. }));
    rows(6, move |u| {
        let light = pick(&spheres, u[0]);
        let Shape::Sphere { center, radius } = *world.shape(light) else {
            return None;
        };
        // At 1.000 005 radii the point counts as inside; half of that on either side is left out.
        let distance = radius * (1.0 + 0.01 * u[1].powi(4) + 8e-6);
        let point = rounded(center + distance * unit(u[2], u[3]));
        let row = [light as f64, point.x, point.y, point.z, u[4], u[5]];
        Some(row.to_vec())
    })
}

fn lights_of(keep: impl Fn(&Shape) -> bool) -> Vec<usize> {
    let world = everything();
    let sources = world.scene.light_sources().into_iter();
    let objects = sources.filter_map(|source| match source.kind {
        SourceKind::Object(index) => Some(index),
        _ => None,
    });
    objects.filter(|&light| keep(world.shape(light))).collect()
}

/// Rows of a light, a point and two numbers.
fn light_rows(far: bool) -> Vec<f32> {
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

/// The same with the direction that the numbers choose.
fn pdf_rows(points: &[f32]) -> Vec<f32> {
    let world = everything();
    let made = points.chunks(6).filter_map(|row| {
        let a: Vec<f64> = row.iter().map(|&x| f64::from(x)).collect();
        let shape = world.shape(a[0] as usize);
        let direction = reference::sample_light(shape, vector(&a[1..]), a[4], a[5]).as_vec3();
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
    reference::sample_light(light, vector(&a[1..]), a[4], a[5])
        .to_array()
        .to_vec()
}

fn density(a: &[f64]) -> Vec<f64> {
    let light = everything().shape(a[0] as usize);
    vec![reference::light_pdf(
        light,
        vector(&a[1..]),
        vector(&a[4..]),
    )]
}

const INSIDE: f64 = 1.000_01;

fn lights() -> Vec<Check> {
    let world = everything();
    let sample = |inputs, tolerance| Check {
        probe: world.probe(
            &["light"],
            (6, 3),
            "put3(0u, sample_light(u32(a(0u)), a3(1u), a(4u), a(5u)));",
        ),
        proves: &["sample_light"],
        inputs,
        twin: sampled,
        tolerance,
    };
    let pdf = |points: &[f32], tolerance| Check {
        probe: world.probe(
            &["light"],
            (7, 1),
            "put(0u, light_pdf(u32(a(0u)), a3(1u), a3(4u)));",
        ),
        proves: &["light_pdf"],
        inputs: pdf_rows(points),
        twin: density,
        tolerance,
    };
    vec![
        sample(light_rows(true), DIRECTION),
        sample(close_points(), NEAR_LIGHT),
        pdf(&light_rows(false), LIGHT_PDF),
        pdf(&close_points(), NEAR_LIGHT),
        Check {
            probe: world.probe(
                &["light"],
                (2, 1),
                "put(0u, select(0.0, 1.0, sphere_surrounds(u32(a(0u)), a(1u))));",
            ),
            proves: &["sphere_surrounds"],
            inputs: squared_distances(),
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

/// Spheres with squared distances from their centres: anywhere, and close to the one that decides, but not within the
/// rounding of a product.
fn squared_distances() -> Vec<f32> {
    let world = everything();
    let spheres = objects_where(|shape, _| matches!(shape, Shape::Sphere { .. }));
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

// Surfaces.

/// Whether a point lies a ten-thousandth of a square off the edges of its squares.
fn is_off_the_edges(shape: &Shape, size: f64, point: DVec3) -> bool {
    let local = (point - center_of(shape)) / size;
    let axes = match *shape {
        Shape::Sphere { .. } => local.to_array().to_vec(),
        Shape::Plane {
            tangent, bitangent, ..
        }
        | Shape::Rectangle {
            tangent, bitangent, ..
        }
        | Shape::Disk {
            tangent, bitangent, ..
        } => vec![local.dot(tangent), local.dot(bitangent)],
    };
    axes.iter().all(|x| (x - x.round()).abs() > 1e-4)
}

fn diffuse_factor() -> Check {
    let world = everything();
    let diffuse = objects_where(|_, material| matches!(material, Material::Diffuse { .. }));
    let inputs = rows(4, |u| {
        let object = pick(&diffuse, u[0]);
        let shape = world.shape(object);
        let point = rounded(point_on(shape, u[1], u[2]));
        let row = vec![object as f64, point.x, point.y, point.z, u[3]];
        let is_clear = match *world.material(object) {
            Material::Diffuse {
                reflectance: scene::Pattern::Checker { size, .. },
            } => is_off_the_edges(shape, size, point),
            // The odds of a texel are off by some 1e-5.
            _ => [-1e-4, 1e-4].iter().all(|off| {
                let mut beside = row.clone();
                beside[4] += off;
                factor_of_pattern(&beside) == factor_of_pattern(&row)
            }),
        };
        is_clear.then_some(row)
    });
    Check {
        probe: world.probe(
            &["factor"],
            (5, 1),
            "let factor = diffuse_factor(u32(a(0u)), a3(1u), a(4u)); put(0u, f32(1000u * factor.kind + factor.spectrum));",
        ),
        proves: &[
            "chosen_pixel",
            "diffuse_factor",
            "picture_place",
            "reflectance_spectrum",
            "texel_at",
        ],
        inputs,
        twin: factor_of_pattern,
        tolerance: EXACT,
    }
}

/// The number of the spectrum or texel, and a thousand times the kind of factor.
fn factor_of_pattern(a: &[f64]) -> Vec<f64> {
    let (world, object) = (everything(), a[0] as usize);
    let Material::Diffuse { reflectance } = world.material(object) else {
        return vec![f64::NAN];
    };
    let shape = world.shape(object);
    match reference::pattern_reflectance(reflectance, shape, vector(&a[1..]), a[4]) {
        Reflectance::Spectrum(spectrum) => vec![1000.0 + spectrum.index() as f64],
        Reflectance::Smooth(coefficients) => {
            let material = world.scene.objects()[object].material.index();
            let first = world.packed.materials[material].picture as usize + 1;
            let is_it = |texel: &[f32; 4]| (0..3).all(|i| f64::from(texel[i]) == coefficients[i]);
            let texels = &world.packed.texels[first..];
            let place = texels.iter().position(is_it).expect("one of its own");
            vec![(4_000 + first + place) as f64]
        }
    }
}

// Rays.

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

/// How far a point in the plane of a rectangle or disk lies outside it, below 0 inside.
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

/// Whether the ray passes a shape's edge and starts off its surface by a thousandth, and does not run along it.
fn is_clear(shape: &Shape, ray: &Ray, starts_here: bool) -> bool {
    const LEAST: f64 = 1e-3;
    let origin = ray.origin - center_of(shape);
    match *shape {
        Shape::Sphere { radius, .. } => {
            let along = origin.dot(ray.direction);
            let off_axis = (origin - along * ray.direction).length();
            if starts_here {
                return along.abs() > LEAST;
            }
            (off_axis - radius).abs() > LEAST && (origin.length() - radius).abs() > LEAST
        }
        _ if starts_here => true,
        Shape::Plane { normal, .. }
        | Shape::Rectangle { normal, .. }
        | Shape::Disk { normal, .. } => {
            let (height, speed) = (origin.dot(normal), ray.direction.dot(normal));
            let place = ray.origin - height / speed * ray.direction;
            height.abs() > LEAST
                && speed.abs() > 0.05
                && beyond_the_edge(shape, place).abs() > LEAST
        }
    }
}

/// A ray made of nine numbers: from anywhere or from the surface of an object, mostly towards one.
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

/// No object is −1 in a table.
fn number_of(object: Option<usize>) -> f64 {
    object.map_or(-1.0, |index| index as f64)
}

fn object_of(number: f64) -> Option<usize> {
    (number >= 0.0).then_some(number as usize)
}

fn distance_to() -> Check {
    let world = everything();
    let all = objects_where(|_, _| true);
    Check {
        probe: world.probe(
            &["hit"],
            (8, 1),
            "let r = Ray(a3(2u), a3(5u));
             put(0u, max(distance_to(u32(a(0u)), r, select(u32(max(a(1u), 0.0)), NONE, a(1u) < 0.0)), -1.0));",
        ),
        proves: &["distance_to"],
        inputs: rows(9, |u| {
            let (from, ray) = ray_of(u);
            // The object aimed at, or the one that the ray starts on.
            let starts_here = u[5] < 0.2 && from.is_some();
            let object = from.filter(|_| starts_here).unwrap_or(pick(&all, u[4]));
            let is_clear = is_clear(world.shape(object), &ray, from == Some(object));
            is_clear.then(|| ray_row(&[object as f64, number_of(from)], &ray))
        }),
        twin: |a| {
            let object = a[0] as usize;
            let starts_here = object_of(a[1]) == Some(object);
            vec![distance(everything().shape(object), &ray_at(&a[2..]), starts_here)]
        },
        tolerance: SPHERE_DISTANCE,
    }
}

fn nearest_hit() -> Check {
    let world = everything();
    Check {
        probe: world.probe(
            &["hit"],
            (7, 2),
            "let h = nearest_hit(Ray(a3(1u), a3(4u)), select(u32(max(a(0u), 0.0)), NONE, a(0u) < 0.0));
             let hits = h.object != NONE;
             put(0u, select(-1.0, f32(h.object), hits)); put(1u, select(-1.0, h.distance, hits));",
        ),
        proves: &["nearest_hit"],
        inputs: rows(9, |u| {
            let (from, ray) = ray_of(u);
            let shapes = || world.scene.objects().iter().map(|object| &object.shape).enumerate();
            let mut distances: Vec<f64> = shapes()
                .map(|(index, shape)| distance(shape, &ray, from == Some(index)))
                .filter(|&t| t > 0.0)
                .collect();
            distances.sort_by(f64::total_cmp);
            // Where two objects touch either may be the nearer one.
            let is_decided = distances.len() < 2 || distances[1] - distances[0] > 1e-3 * distances[1];
            let is_kept = is_decided
                && shapes().all(|(index, shape)| is_clear(shape, &ray, from == Some(index)));
            is_kept.then(|| ray_row(&[number_of(from)], &ray))
        }),
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
    let world = everything();
    let all = objects_where(|_, _| true);
    Check {
        probe: world.probe(
            &["surface"],
            (8, 7),
            "let p = surface_point(u32(a(0u)), Ray(a3(1u), a3(4u)), a(7u));
             put3(0u, p.position); put3(3u, p.normal); put(6u, p.cosine);",
        ),
        proves: &["surface_point"],
        inputs: rows(9, |u| {
            let (from, ray) = ray_of(u);
            let object = pick(&all, u[4]);
            let (shape, starts_here) = (world.shape(object), from == Some(object));
            let distance = distance(shape, &ray, starts_here);
            let is_kept = distance > 0.0 && distance < 30.0 && is_clear(shape, &ray, starts_here);
            let mut row = ray_row(&[object as f64], &ray);
            row.push(distance);
            is_kept.then_some(row)
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

// Spectra.

/// Groups of four bands.
const GROUPS: u32 = BANDS.div_ceil(4);

fn steps() -> u32 {
    everything().packed.frame.steps
}

/// A spectrum in a band; behind the last band it keeps its value.
fn value_of(spectrum: usize, band: u32, offset: f64) -> f64 {
    everything().scene.spectra()[spectrum].at(band.min(BANDS - 1), offset)
}

/// The four bands of a group.
fn bands_of(group: f64) -> [u32; 4] {
    [0, 1, 2, 3].map(|lane| 4 * group as u32 + lane)
}

/// A spectrum, or one of the observer's after them, which are 0 behind the last band.
fn spectrum_twin(a: &[f64]) -> Vec<f64> {
    let (scene, spectrum) = (&everything().scene, a[0] as usize);
    let value = |band| match spectrum.checked_sub(scene.spectra().len()) {
        None => value_of(spectrum, band, a[2]),
        Some(_) if band >= BANDS => 0.0,
        Some(of_three) => scene.observer()[of_three].at(band, a[2]),
    };
    bands_of(a[1]).map(value).to_vec()
}

fn world_bands() -> &'static spectra::BandGrid {
    &everything().scene.settings().bands
}

fn spectra() -> Vec<Check> {
    let world = everything();
    let count = (world.scene.spectra().len() + 3) as f64;
    let mut offsets = rows(1, |u| {
        let position = u[0] * f64::from(steps());
        ((position - position.round()).abs() > 1e-5).then(|| u.to_vec())
    });
    offsets.extend([0.0, 0.5, 0.999_999_94]);
    vec![
        Check {
            probe: world.probe(
                &["spectrum"],
                (1, 3),
                "let w = wavelengths_at(a(0u)); put(0u, w.offset); put(1u, f32(w.knot)); put(2u, w.fraction);",
            ),
            proves: &["wavelengths_at"],
            inputs: offsets,
            twin: |a| {
                let position = a[0] * f64::from(steps());
                vec![a[0], position.floor(), position - position.floor()]
            },
            tolerance: KNOT,
        },
        Check {
            probe: world.probe(
                &["spectrum"],
                (3, 4),
                "put4(0u, spectrum_at(u32(a(0u)), u32(a(1u)), wavelengths_at(a(2u))));",
            ),
            proves: &["spectrum_at"],
            inputs: rows(3, |u| {
                let group = (u[1] * f64::from(GROUPS)).floor();
                Some(vec![(u[0] * count).floor(), group, u[2]])
            }),
            twin: spectrum_twin,
            tolerance: SPECTRUM,
        },
        Check {
            probe: world.probe(
                &["lifting"],
                (5, 4),
                "put4(0u, smooth_value(a3(0u), u32(a(3u)), wavelengths_at(a(4u))));",
            ),
            proves: &["smooth_value"],
            inputs: rows(5, |u| {
                let spread = |u: f64| 20.0 * (2.0 * u - 1.0).powi(3);
                let group = (u[3] * f64::from(GROUPS)).floor();
                Some(vec![spread(u[0]), spread(u[1]), spread(u[2]), group, u[4]])
            }),
            twin: |a| {
                let bands = world_bands();
                let value = |lane: u32| {
                    let nm = bands.wavelength_nm(4 * a[3] as u32 + lane, a[4]);
                    reference::smooth_value([a[0], a[1], a[2]], nm)
                };
                (0..4).map(value).collect()
            },
            tolerance: SMOOTH,
        },
        Check {
            // In 1/µm, so that the numbers are of order one.
            probe: world.probe(
                &["spectrum"],
                (2, 4),
                "put4(0u, 1000.0 * inverse_wavelengths(u32(a(0u)), wavelengths_at(a(1u))));",
            ),
            proves: &["inverse_wavelengths"],
            inputs: rows(2, |u| Some(vec![(u[0] * f64::from(GROUPS)).floor(), u[1]])),
            twin: |a| {
                let grid = &everything().scene.settings().bands;
                bands_of(a[0]).map(|band| 1000.0 / grid.wavelength_nm(band, a[1])).to_vec()
            },
            tolerance: ARITHMETIC,
        },
    ]
}

// Factors.

const OF_SURFACE: &str = "put4(0u, surface_value(Factor(u32(a(0u)), u32(a(1u)), a(2u), a(3u), 0u), u32(a(4u)), wavelengths_at(a(5u))));";
const OF_FILM: &str = "put4(0u, film_value(Factor(u32(a(0u)), u32(a(1u)), a(2u), a(3u), 0u), u32(a(4u)), wavelengths_at(a(5u))));";

fn factor_twin(a: &[f64]) -> Vec<f64> {
    use gpu::layout::{
        FACTOR_CONDUCTOR, FACTOR_FILM_REFLECTS, FACTOR_LOSSY_FILM_REFLECTS, FACTOR_REFLECTANCE,
    };
    let (kind, spectrum) = (a[0] as u32, a[1] as usize);
    let value = |band| {
        let n = value_of(spectrum, band, a[5]);
        if kind == FACTOR_REFLECTANCE {
            return n;
        }
        let index = Complex64::new(n, value_of(spectrum + 1, band, a[5]));
        if kind == FACTOR_CONDUCTOR {
            return optics::reflectance_unpolarised(index, a[2]);
        }
        let grid = &everything().scene.settings().bands;
        let film = optics::film(index, a[3], grid.wavelength_nm(band, a[5]), a[2]);
        if kind == FACTOR_FILM_REFLECTS || kind == FACTOR_LOSSY_FILM_REFLECTS {
            film.reflectance.unpolarised()
        } else {
            film.transmittance.unpolarised()
        }
    };
    bands_of(a[4]).map(value).to_vec()
}

/// Rows of a factor, a group and an offset: each of the kinds with each of its spectra.
fn factor_rows(choices: &[(u32, usize)]) -> Vec<f32> {
    rows(5, |u| {
        let (kind, spectrum) = pick(choices, u[0]);
        let cosine = 0.035 + 0.965 * u[1];
        let group = (u[3] * f64::from(GROUPS)).floor();
        Some(vec![
            f64::from(kind),
            spectrum as f64,
            cosine,
            2000.0 * u[2],
            group,
            u[4],
        ])
    })
}

fn factors() -> Vec<Check> {
    use gpu::layout::{
        FACTOR_CONDUCTOR, FACTOR_FILM_REFLECTS, FACTOR_FILM_TRANSMITS, FACTOR_LOSSY_FILM_REFLECTS,
        FACTOR_LOSSY_FILM_TRANSMITS, FACTOR_REFLECTANCE,
    };
    let world = everything();
    let (mut surfaces, mut films) = (Vec::new(), Vec::new());
    for material in world.scene.materials() {
        match *material {
            Material::Conductor { n, .. } => surfaces.push((FACTOR_CONDUCTOR, n.index())),
            Material::Diffuse {
                reflectance:
                    scene::Pattern::Uniform(spectrum) | scene::Pattern::Checker { even: spectrum, .. },
            } => surfaces.push((FACTOR_REFLECTANCE, spectrum.index())),
            Material::Film { ref layers, .. } => {
                let (n, k) = (layers[0].n, layers[0].k);
                let spectrum = n.index();
                let is_clear = world.scene.spectrum(n).extent().0 >= 1.0
                    && world.scene.spectrum(k).extent().1 <= 0.0;
                if is_clear {
                    films.push((FACTOR_FILM_REFLECTS, spectrum));
                    films.push((FACTOR_FILM_TRANSMITS, spectrum));
                }
                films.push((FACTOR_LOSSY_FILM_REFLECTS, spectrum));
                films.push((FACTOR_LOSSY_FILM_TRANSMITS, spectrum));
            }
            Material::Emitter { .. }
            | Material::Cook(_)
            | Material::CoatedBody(_)
            | Material::Diffuse {
                reflectance: scene::Pattern::Texture { .. },
            } => {}
        }
    }
    let check = |proves, body, choices: &[(u32, usize)], tolerance| Check {
        probe: world.probe(&["evaluate"], (6, 4), body),
        proves,
        inputs: factor_rows(choices),
        twin: factor_twin,
        tolerance,
    };
    vec![
        check(&["surface_value"], OF_SURFACE, &surfaces, FRESNEL),
        check(&["film_value"], OF_FILM, &films, FILM),
    ]
}

/// The tables hold what they are for: hits of each object and of none, each colour of a pattern, each kind of factor.
#[test]
fn every_case_occurs() {
    let firsts = |check: &Check, of: fn(&[f64]) -> Vec<f64>| -> BTreeSet<i64> {
        let chunks = check.inputs.chunks(check.probe.shape.0);
        let rows = chunks.map(|row| row.iter().map(|&x| f64::from(x)).collect::<Vec<_>>());
        rows.map(|row| of(&row)[0] as i64).collect()
    };
    let objects = everything().scene.objects().len() as i64;
    assert_eq!(firsts(&nearest_hit(), nearest), (-1..objects).collect());
    assert_eq!(
        firsts(&distance_to(), <[f64]>::to_vec),
        (0..objects).collect()
    );
    assert_eq!(
        firsts(&surface_point(), <[f64]>::to_vec),
        (0..objects).collect()
    );
    assert_eq!(
        // A spectrum and a texel may have the same number.
        firsts(&diffuse_factor(), factor_of_pattern).len(),
        // Seven spectra, and the 35 texels of either picture.
        7 + 35 + 35
    );
    let kinds: BTreeSet<i64> = factors()
        .iter()
        .flat_map(|check| firsts(check, <[f64]>::to_vec))
        .collect();
    // Factors of several layers read what a path has put on record, and are proved there.
    assert_eq!(kinds, [1, 2, 5, 6, 7, 8].into());
}

/// The comparison can fail: an area one part in a thousand off, and a checker with its colours changed over.
#[test]
fn a_wrong_twin_of_a_scene_is_noticed() {
    let mut check = lights()
        .into_iter()
        .find(|check| check.proves.contains(&"light_pdf"))
        .expect("exists");
    assert!(check.run().is_ok());
    check.twin = |a| vec![1.001 * density(a)[0]];
    assert!(check.run().is_err());
    let mut check = diffuse_factor();
    check.twin = |a| factor_of_pattern(&[a[0], a[1] + 0.01, a[2], a[3], a[4]]);
    assert!(check.run().is_err());
}
