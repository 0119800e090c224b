//! Samplers of emitters and environments.

use super::chi_square::{Experiment, direction, turns};
use glam::DVec3;
use reference::{
    cone_height, environment_pdf, frame_of, sample_environment, sample_shape, shape_pdf,
};
use scene::{EnvironmentShape, Shape};
use std::f64::consts::{PI, TAU};

/// Number of tests in this file.
pub(crate) const TESTS: usize = 4 + 3 + 3 + 6;

/// Spheres: by the angle to the center over the cone around it; from inside, over the whole sphere of directions.
#[test]
fn spheres_are_sampled_by_shape_pdf() {
    let center = DVec3::new(0.3, -0.2, 1.5);
    let distance2 = center.length_squared();
    for (seed, radius) in [(11, 0.01), (12, 0.5), (13, 1.4), (14, 3.0)] {
        let light = Shape::Sphere { center, radius };
        let inside = radius * radius > distance2;
        let height = if inside {
            2.0
        } else {
            cone_height(radius, distance2)
        };
        let frame = frame_of(center.normalize());
        let draw = |u: f64, v: f64| {
            let w = frame.transpose() * sample_shape(&light, DVec3::ZERO, u, v);
            let across = (1.0 - w.z) / height;
            (across <= 1.0 + 1e-9).then(|| [across, turns(w)])
        };
        let pdf = |across: f64, around: f64| {
            let w = frame * direction(1.0 - across * height, around);
            shape_pdf(&light, DVec3::ZERO, w) * TAU * height
        };
        let right = Experiment {
            name: format!("sphere of radius {radius}"),
            ranges: [(0.0, 1.0), (0.0, 1.0)],
            draw: &draw,
            density: &pdf,
            parts: 2,
            outside: Some(0.0),
        };
        right.holds(seed);
    }
}

/// Rectangles: by the point where the direction hits their plane, with dω = |cos θ| dA / d².
#[test]
fn rectangles_are_sampled_by_shape_pdf() {
    let normal = DVec3::new(0.2, -0.5, 1.0).normalize();
    let frame = frame_of(normal);
    let (tangent, bitangent) = (frame.x_axis, frame.y_axis);
    for (seed, center, half_width, half_height) in [
        (21, DVec3::new(0.1, 0.2, 2.0), 0.5, 1.5),
        (22, DVec3::new(2.0, 0.1, -0.6), 1.0, 1.0),
        (23, DVec3::new(0.0, 0.0, 0.05), 4.0, 3.0),
    ] {
        let light = Shape::Rectangle {
            center,
            normal,
            tangent,
            bitangent,
            half_width,
            half_height,
        };
        let draw = |u: f64, v: f64| {
            let w = sample_shape(&light, DVec3::ZERO, u, v);
            let distance = center.dot(normal) / w.dot(normal);
            let place = w * distance - center;
            let at = [
                place.dot(tangent) / half_width,
                place.dot(bitangent) / half_height,
            ];
            (distance > 0.0 && at.iter().all(|x| x.abs() <= 1.0 + 1e-9)).then_some(at)
        };
        let to =
            |x: f64, y: f64| center + tangent * (x * half_width) + bitangent * (y * half_height);
        let pdf = |x: f64, y: f64| {
            let place = to(x, y);
            let w = place.normalize();
            let solid_angle = w.dot(normal).abs() / place.length_squared();
            shape_pdf(&light, DVec3::ZERO, w) * solid_angle * half_width * half_height
        };
        let right = Experiment {
            name: format!("rectangle at {center}"),
            ranges: [(-1.0, 1.0), (-1.0, 1.0)],
            draw: &draw,
            density: &pdf,
            parts: 2,
            outside: Some(0.0),
        };
        right.holds(seed);
        let uneven = |x: f64, y: f64| pdf(x, y) * (1.0 + 0.1 * x);
        let wrong = Experiment {
            density: &uneven,
            ..right
        };
        wrong.is_refused(seed);
    }
}

/// Disks: by the squared distance from the center and the azimuth, in which the density is uniform.
#[test]
fn disks_are_sampled_by_shape_pdf() {
    let normal = DVec3::new(0.2, -0.5, 1.0).normalize();
    let frame = frame_of(normal);
    for (seed, center, radius) in [
        (24, DVec3::new(0.1, 0.2, 2.0), 0.5),
        (25, DVec3::new(2.0, 0.1, -0.6), 1.0),
        (26, DVec3::new(0.0, 0.0, 0.05), 4.0),
    ] {
        let light = Shape::Disk {
            center,
            normal,
            tangent: frame.x_axis,
            bitangent: frame.y_axis,
            radius,
        };
        let draw = |u: f64, v: f64| {
            let w = sample_shape(&light, DVec3::ZERO, u, v);
            let distance = center.dot(normal) / w.dot(normal);
            let place = frame.transpose() * (w * distance - center) / radius;
            let out = place.x * place.x + place.y * place.y;
            (distance > 0.0 && out <= 1.0 + 1e-9).then(|| [out, turns(place)])
        };
        let pdf = |out: f64, around: f64| {
            let aside = direction(0.0, around) * (radius * out.sqrt());
            let place = center + frame * aside;
            let w = place.normalize();
            let solid_angle = w.dot(normal).abs() / place.length_squared();
            // dA = ½ dr² dφ
            shape_pdf(&light, DVec3::ZERO, w) * solid_angle * PI * radius * radius
        };
        let right = Experiment {
            name: format!("disk at {center}"),
            ranges: [(0.0, 1.0), (0.0, 1.0)],
            draw: &draw,
            density: &pdf,
            outside: Some(0.0),
            parts: 4,
        };
        right.holds(seed);
        let uneven = |x: f64, y: f64| pdf(x, y) * (0.85 + 0.3 * x);
        let wrong = Experiment {
            density: &uneven,
            ..right
        };
        wrong.is_refused(seed);
    }
}

/// Parts of the environment and disks in the sky: by the height along an axis and the azimuth.
#[test]
fn environments_are_sampled_by_environment_pdf() {
    let toward = DVec3::new(0.3, 0.8, -0.4).normalize();
    let disk = |height| EnvironmentShape::DistantDisk { toward, height };
    for (seed, part, axis, least) in [
        (81, EnvironmentShape::Everywhere, DVec3::Y, -1.0),
        (82, EnvironmentShape::Horizon, DVec3::Y, -1.0),
        (83, EnvironmentShape::Pole(DVec3::Y), DVec3::Y, 0.0),
        (84, EnvironmentShape::Pole(DVec3::NEG_Y), DVec3::NEG_Y, 0.0),
        (85, disk(1.1e-5), toward, 1.0 - 1.1e-5),
        (86, disk(0.3), toward, 0.7),
    ] {
        let frame = frame_of(axis);
        let depth = 1.0 - least;
        let draw = |u: f64, v: f64| {
            let w = frame.transpose() * sample_environment(part, u, v);
            assert!((w.length() - 1.0).abs() < 1e-12);
            let across = (1.0 - w.z) / depth;
            (across <= 1.0 + 1e-9).then(|| [across, turns(w)])
        };
        let pdf = |across: f64, around: f64| {
            let w = frame * direction(1.0 - across * depth, around);
            environment_pdf(part, w) * TAU * depth
        };
        let right = Experiment {
            name: format!("{part:?}"),
            ranges: [(0.0, 1.0), (0.0, 1.0)],
            draw: &draw,
            density: &pdf,
            outside: Some(0.0),
            parts: 4,
        };
        right.holds(seed);
        let uneven = |x: f64, y: f64| pdf(x, y) * (0.85 + 0.3 * y);
        let wrong = Experiment {
            density: &uneven,
            ..right
        };
        wrong.is_refused(seed);
    }
}
