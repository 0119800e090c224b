//! All that light is sent from, and the choice among it by an estimate of what each source brings to a point.

use crate::{
    cone_height, environment_pdf, environment_share, light_pdf, sample_environment, sample_light,
};
use glam::DVec3;
use scene::{EnvironmentShape, LightShape, LightSource, Scene, Shape, SourceKind};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI, TAU};

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source<'a> {
    /// An object.
    Shape(&'a Shape),
    /// A part of the surroundings.
    Surrounding(EnvironmentShape<'a>),
    /// A light of a single direction at each place.
    Single(LightShape),
}

impl<'a> Source<'a> {
    /// What a source of a scene is.
    pub fn of(scene: &'a Scene, kind: SourceKind) -> Self {
        match kind {
            SourceKind::Object(index) => Self::Shape(&scene.objects()[index].shape),
            SourceKind::Environment(index) => Self::Surrounding(scene.surroundings()[index].shape),
            SourceKind::Light(index) => Self::Single(scene.lights()[index].shape),
        }
    }

    /// A direction from `point` towards it.
    pub fn sample(&self, point: DVec3, u: f64, v: f64) -> DVec3 {
        match *self {
            Self::Shape(shape) => sample_light(shape, point, u, v),
            Self::Surrounding(part) => sample_environment(part, u, v),
            Self::Single(LightShape::Direction { towards } | LightShape::Disc { towards, .. }) => {
                towards
            }
            Self::Single(LightShape::Point { position } | LightShape::Spot { position, .. }) => {
                (position - point).normalize()
            }
        }
    }

    /// Density with which [`Self::sample`] draws a direction, sr⁻¹; none for light from a single direction.
    pub fn pdf(&self, point: DVec3, direction: DVec3) -> Option<f64> {
        match *self {
            Self::Shape(shape) => Some(light_pdf(shape, point, direction)),
            Self::Surrounding(part) => Some(environment_pdf(part, direction)),
            Self::Single(_) => None,
        }
    }

    /// Factor of its emission towards `point`: the share of a part of the surroundings; of a point and of a spot what makes their
    /// intensity an irradiance.
    pub fn share(&self, point: DVec3, direction: DVec3) -> f64 {
        match *self {
            Self::Shape(_)
            | Self::Single(LightShape::Direction { .. } | LightShape::Disc { .. }) => 1.0,
            Self::Surrounding(part) => environment_share(part, direction),
            Self::Single(LightShape::Point { position }) => 1.0 / point.distance_squared(position),
            Self::Single(LightShape::Spot {
                position,
                axis,
                full_height,
                edge_height,
            }) => {
                let height = 0.5 * (direction + axis).length_squared();
                let t = ((edge_height - height) / (edge_height - full_height)).clamp(0.0, 1.0);
                t * t * (3.0 - 2.0 * t) / point.distance_squared(position)
            }
        }
    }

    /// How far away it is; none where it is no place.
    pub(crate) fn distance(&self, point: DVec3) -> Option<f64> {
        match *self {
            Self::Single(LightShape::Point { position } | LightShape::Spot { position, .. }) => {
                Some(point.distance(position))
            }
            _ => None,
        }
    }

    /// About the irradiance that it gives at radiance 1; 0 only where nothing of it can arrive.
    pub fn estimate(&self, point: DVec3, normal: DVec3) -> f64 {
        match *self {
            Self::Shape(shape) => shape_estimate(shape, point, normal),
            Self::Surrounding(part) => surrounding_estimate(part, normal),
            Self::Single(_) => {
                let direction = self.sample(point, 0.0, 0.0);
                self.share(point, direction) * direction.dot(normal).max(0.0)
            }
        }
    }
}

/// Solid angle times the largest cosine in the cone that holds the shape.
fn shape_estimate(shape: &Shape, point: DVec3, normal: DVec3) -> f64 {
    match *shape {
        Shape::Sphere { center, radius } => {
            let towards = center - point;
            let distance2 = towards.length_squared();
            if distance2 <= radius * radius * 1.000_01 {
                return PI;
            }
            let largest = most_cosine(towards.normalize().dot(normal), radius / distance2.sqrt());
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
            plane_estimate(center - point, (across, normal), reach, area)
        }
        Shape::Disk {
            center,
            normal: across,
            radius,
            ..
        } => plane_estimate(
            center - point,
            (across, normal),
            radius,
            PI * radius * radius,
        ),
        Shape::Plane { .. } => 0.0,
    }
}

fn plane_estimate(towards: DVec3, (across, normal): (DVec3, DVec3), reach: f64, area: f64) -> f64 {
    let distance = towards.length();
    let distance2 = distance * distance;
    let facing = (towards.dot(across).abs() * distance + reach * reach) / distance2.max(1e-20);
    let solid_angle = area * facing.min(1.0) / (distance2 + area / TAU);
    if distance <= reach {
        return solid_angle;
    }
    solid_angle * most_cosine(towards.dot(normal) / distance, reach / distance)
}

fn surrounding_estimate(part: EnvironmentShape<'_>, normal: DVec3) -> f64 {
    match part {
        EnvironmentShape::Everywhere | EnvironmentShape::Picture(_) => PI,
        EnvironmentShape::Horizon => FRAC_PI_2,
        EnvironmentShape::Pole(pole) => FRAC_PI_3 * (1.0 + pole.dot(normal)).max(0.0),
        EnvironmentShape::Disc { towards, height } => {
            let sine = (height * (2.0 - height)).sqrt();
            TAU * height * most_cosine(towards.dot(normal), sine)
        }
    }
}

/// The largest cosine with a normal within a cone about an axis that has the cosine `axis` with it.
fn most_cosine(axis: f64, sine_of_half_angle: f64) -> f64 {
    let between = axis.clamp(-1.0, 1.0).acos() - sine_of_half_angle.min(1.0).asin();
    between.max(0.0).cos().max(0.0)
}

/// A source of light and the probability with which it is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Number of the source.
    pub source: usize,
    /// Its probability.
    pub probability: f64,
}

/// Probability of each source at a point, in proportion to its estimate; all 0 where none can shine there.
pub fn choice_probabilities(
    scene: &Scene,
    sources: &[LightSource],
    point: DVec3,
    normal: DVec3,
) -> Vec<f64> {
    if sources.len() == 1 {
        return vec![1.0];
    }
    let estimate = |source: &LightSource| {
        source.brightness * Source::of(scene, source.kind).estimate(point, normal)
    };
    let estimates: Vec<f64> = sources.iter().map(estimate).collect();
    let total: f64 = estimates.iter().sum();
    if total <= 0.0 {
        return vec![0.0; sources.len()];
    }
    estimates.iter().map(|estimate| estimate / total).collect()
}

/// Chooses a source by a uniform number.
pub fn choose_light(probabilities: &[f64], random: f64) -> Option<Choice> {
    let mut sum = 0.0;
    let mut choice = None;
    for (source, &probability) in probabilities.iter().enumerate() {
        if probability > 0.0 {
            choice = Some(Choice {
                source,
                probability,
            });
        }
        sum += probability;
        if random < sum {
            break;
        }
    }
    choice
}

/// Scattering is left out where its density is less than this part of the other's.
const CUTOFF: f64 = 0.1875;

/// Share of sending in a direction to a source that it finds with `probability` times `density`, and scattering with density `scattered`;
/// scattering has the rest.
///
/// Of a picture only what is brighter than the mean is sent for (MIS compensation, Karlík et al. 2019), and no more of the light than
/// that belongs to sending. Against scattering counts the density with which all of the picture's light would be sent for: a mirror
/// that finds an even picture without noise shall not leave the rim of what it mirrors to a few rays.
pub fn sending_share(source: Source<'_>, scattered: f64, probability: f64, density: f64) -> f64 {
    if let Source::Surrounding(EnvironmentShape::Picture(picture)) = source {
        let even = f64::from(picture.table.even_density);
        if even > 0.0 {
            let excess = density / even;
            let sent = probability * excess / (4.0 * PI);
            return excess / (1.0 + excess) * (1.0 - scattering_share(scattered, sent));
        }
    }
    1.0 - scattering_share(scattered, probability * density)
}

/// Share of scattering in a direction that it finds with density `scattered` and sending with density `sent`, 1 less the share of
/// sending: the power heuristic (Veach 1997, section 9.2.2), with a cutoff of scattering alone.
pub fn scattering_share(scattered: f64, sent: f64) -> f64 {
    if scattered < CUTOFF * sent {
        return 0.0;
    }
    scattered * scattered / (scattered * scattered + sent * sent)
}
