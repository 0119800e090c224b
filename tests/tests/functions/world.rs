//! Scenes for both sides, and rows of numbers that fit them.

use crate::{Check, Lazy, lazy, table};
use glam::DVec3;
use gpu::PackedScene;
use pellicle_tests::probe::Probe;
use pellicle_tests::scenes::small;
use scene::{Material, Scene, Shape};
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// Number of bands; the last group of four has two.
pub(crate) const BANDS: u32 = 22;
/// A scene in the forms that both sides read.
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
}

/// A probe within a world.
pub(crate) fn within(
    world: fn() -> &'static World,
    shape: (usize, usize),
    body: &'static str,
) -> Lazy<Probe<'static>> {
    lazy(move || Probe {
        body,
        shape,
        scene: Some(&world().packed),
    })
}

pub(crate) fn everything() -> &'static World {
    static WORLD: OnceLock<World> = OnceLock::new();
    WORLD.get_or_init(|| World::new("everything"))
}

/// A world whose environment is a picture, and whose camera sees all directions.
pub(crate) fn pictured() -> &'static World {
    static WORLD: OnceLock<World> = OnceLock::new();
    WORLD.get_or_init(|| World::new("everything_pictured"))
}

/// Rows made from `columns` uniform numbers in [0, 1) each; numbers for which `row` returns `None` are left out.
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

/// A unit vector whose cosine with the third axis is `cosine`; its azimuth is in turns.
pub(crate) fn direction(cosine: f64, turns: f64) -> DVec3 {
    let (sine, phi) = ((1.0 - cosine * cosine).sqrt(), TAU * turns);
    DVec3::new(sine * phi.cos(), sine * phi.sin(), cosine)
}

/// A vector rounded to f32, so that both sides see the same numbers.
pub(crate) fn rounded(v: DVec3) -> DVec3 {
    v.as_vec3().as_dvec3()
}

pub(crate) fn vector(a: &[f64]) -> DVec3 {
    DVec3::from_slice(a)
}

pub(crate) fn center_of(shape: &Shape) -> DVec3 {
    match *shape {
        Shape::Sphere { center, .. }
        | Shape::Rectangle { center, .. }
        | Shape::Disk { center, .. } => center,
        Shape::Plane { point, .. } => point,
    }
}

/// A point on a shape; for a plane, near its middle.
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

/// The objects for which a condition holds.
pub(crate) fn objects_where(keep: impl Fn(&Shape, &Material) -> bool) -> Vec<usize> {
    let world = everything();
    (0..world.scene.objects().len())
        .filter(|&object| keep(world.shape(object), world.material(object)))
        .collect()
}

/// Number of groups of four bands.
pub(crate) const GROUPS: u32 = BANDS.div_ceil(4);

/// Value of a spectrum in a band; beyond the last band it keeps its value.
pub(crate) fn value_of(spectrum: usize, band: u32, offset: f64) -> f64 {
    everything().scene.spectra()[spectrum].at(band.min(BANDS - 1), offset)
}

/// The four bands of a group.
pub(crate) fn bands_of(group: f64) -> [u32; 4] {
    [0, 1, 2, 3].map(|lane| 4 * group as u32 + lane)
}

/// The integers that come first in the results of a check's rows.
pub(crate) fn first_numbers(check: &Check, of: fn(&[f64]) -> Vec<f64>) -> BTreeSet<i64> {
    let chunks = check.inputs.chunks(check.probe.shape.0);
    let rows = chunks.map(|row| row.iter().map(|&x| f64::from(x)).collect::<Vec<_>>());
    rows.map(|row| of(&row)[0] as i64).collect()
}
