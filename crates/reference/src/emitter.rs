//! Emitters that are sampled for direct light, and the weights by which one is chosen.

use crate::emitter_shape::INSIDE;
use crate::{
    cone_height, environment_pdf, environment_strength, sample_environment, sample_shape, shape_pdf,
};
use glam::DVec3;
use scene::{EmitterKind, EnvironmentShape, LightShape, Scene, Shape};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI, TAU};

/// An emitter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Emitter<'a> {
    /// An object.
    Shape(&'a Shape),
    /// A part of the environment.
    Environment(EnvironmentShape<'a>),
    /// A light that reaches each point from a single direction.
    Delta(LightShape),
}

impl<'a> Emitter<'a> {
    /// Returns the emitter of this kind in a scene.
    pub fn of(scene: &'a Scene, kind: EmitterKind) -> Self {
        match kind {
            EmitterKind::Object(index) => Self::Shape(&scene.objects()[index].shape),
            EmitterKind::Environment(index) => {
                Self::Environment(scene.environment_parts()[index].shape)
            }
            EmitterKind::Light(index) => Self::Delta(scene.lights()[index].shape),
        }
    }

    /// Samples a direction from `point` toward the emitter.
    pub fn sample(&self, point: DVec3, u: f64, v: f64) -> DVec3 {
        match *self {
            Self::Shape(shape) => sample_shape(shape, point, u, v),
            Self::Environment(part) => sample_environment(part, u, v),
            Self::Delta(
                LightShape::Direction { toward } | LightShape::DistantDisk { toward, .. },
            ) => toward,
            Self::Delta(LightShape::Point { position } | LightShape::Spot { position, .. }) => {
                (position - point).normalize()
            }
        }
    }

    /// Returns the density with which [`Self::sample`] samples a direction, sr⁻¹; `None` for light from a single direction.
    pub fn pdf(&self, point: DVec3, direction: DVec3) -> Option<f64> {
        match *self {
            Self::Shape(shape) => Some(shape_pdf(shape, point, direction)),
            Self::Environment(part) => Some(environment_pdf(part, direction)),
            Self::Delta(_) => None,
        }
    }

    /// Returns the factor of the emission toward `point`: for a part of the environment, its relative radiance; for a point or a
    /// spot, the factor that makes an irradiance of its intensity.
    pub fn strength(&self, point: DVec3, direction: DVec3) -> f64 {
        match *self {
            Self::Shape(_)
            | Self::Delta(LightShape::Direction { .. } | LightShape::DistantDisk { .. }) => 1.0,
            Self::Environment(part) => environment_strength(part, direction),
            Self::Delta(LightShape::Point { position }) => 1.0 / point.distance_squared(position),
            Self::Delta(LightShape::Spot {
                position,
                axis,
                full_height,
                edge_height,
            }) => {
                spot_falloff(direction, axis, [full_height, edge_height])
                    / point.distance_squared(position)
            }
        }
    }

    /// Returns the distance to the emitter; `None` for an emitter without a position.
    pub(crate) fn distance(&self, point: DVec3) -> Option<f64> {
        match *self {
            Self::Delta(LightShape::Point { position } | LightShape::Spot { position, .. }) => {
                Some(point.distance(position))
            }
            _ => None,
        }
    }

    /// Returns roughly the irradiance at radiance 1; 0 only where no light can arrive.
    pub fn weight(&self, point: DVec3, normal: DVec3) -> f64 {
        match *self {
            Self::Shape(shape) => shape_weight(shape, point, normal),
            Self::Environment(part) => environment_weight(part, normal),
            Self::Delta(_) => {
                let direction = self.sample(point, 0.0, 0.0);
                self.strength(point, direction) * direction.dot(normal).max(0.0)
            }
        }
    }
}

/// Returns a spot's intensity in a direction, relative to that on its axis: 1 within the inner cone, 0 outside the outer one, and
/// 3t² − 2t³ in between, with t linear in the cosine (Pharr, Jakob and Humphreys, Physically Based Rendering, 4th edition, 2023,
/// section 12.2.3). Heights are 1 − cos of a cone's half angle.
fn spot_falloff(direction: DVec3, axis: DVec3, [full_height, edge_height]: [f64; 2]) -> f64 {
    let height = 0.5 * (direction + axis).length_squared();
    let t = ((edge_height - height) / (edge_height - full_height)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Returns the solid angle times the largest cosine in the cone around the shape.
fn shape_weight(shape: &Shape, point: DVec3, normal: DVec3) -> f64 {
    match *shape {
        Shape::Sphere { center, radius } => {
            let toward = center - point;
            let distance2 = toward.length_squared();
            if distance2 <= radius * radius * INSIDE {
                return PI;
            }
            let largest = most_cosine(toward.normalize().dot(normal), radius / distance2.sqrt());
            TAU * cone_height(radius, distance2) * largest
        }
        Shape::Rectangle {
            center,
            normal: across,
            half_width,
            half_height,
            ..
        } => {
            let reach = half_width.hypot(half_height);
            let area = 4.0 * half_width * half_height;
            plane_weight(center - point, (across, normal), reach, area)
        }
        Shape::Disk {
            center,
            normal: across,
            radius,
            ..
        } => plane_weight(
            center - point,
            (across, normal),
            radius,
            PI * radius * radius,
        ),
        Shape::Plane { .. } => 0.0,
    }
}

fn plane_weight(toward: DVec3, (across, normal): (DVec3, DVec3), reach: f64, area: f64) -> f64 {
    let distance = toward.length();
    let distance2 = distance * distance;
    let facing = (toward.dot(across).abs() * distance + reach * reach) / distance2.max(1e-20);
    let solid_angle = area * facing.min(1.0) / (distance2 + area / TAU);
    if distance <= reach {
        return solid_angle;
    }
    solid_angle * most_cosine(toward.dot(normal) / distance, reach / distance)
}

fn environment_weight(part: EnvironmentShape<'_>, normal: DVec3) -> f64 {
    match part {
        EnvironmentShape::Everywhere | EnvironmentShape::Picture(_) => PI,
        EnvironmentShape::Horizon => FRAC_PI_2,
        EnvironmentShape::Pole(pole) => FRAC_PI_3 * (1.0 + pole.dot(normal)).max(0.0),
        EnvironmentShape::DistantDisk { toward, height } => {
            let sine = (height * (2.0 - height)).sqrt();
            TAU * height * most_cosine(toward.dot(normal), sine)
        }
    }
}

/// Returns the largest cosine with a normal within a cone, whose axis has the cosine `axis` with the normal.
fn most_cosine(axis: f64, sine_of_half_angle: f64) -> f64 {
    let between = axis.clamp(-1.0, 1.0).acos() - sine_of_half_angle.min(1.0).asin();
    between.max(0.0).cos().max(0.0)
}
