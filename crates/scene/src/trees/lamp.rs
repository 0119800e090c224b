//! Emitters as the tree of emitters knows them: where they are, how much they emit, and in which directions.

use crate::{EmitterKind, EmitterSource, Light, LightShape, Object, Shape};
use glam::{DMat3, DVec3};
use std::f64::consts::PI;

/// An emitter that has a position.
#[derive(Clone, Copy)]
pub(super) struct Lamp {
    pub(super) source: u32,
    pub(super) center: DVec3,
    pub(super) reach: f64,
    /// Mean square distance of its surface from its center.
    pub(super) variance: f64,
    /// Mean over all directions of its emission, in units of brightness times area, or of intensity.
    pub(super) mean_power: f64,
    /// Variance of this emission over all directions, for a lamp that emits only in some.
    pub(super) uneven_power: f64,
    /// Square of its emission as a function of direction: a quadratic form of mean power 1.
    pub(super) form: DMat3,
    pub(super) cone: Cone,
}

/// Directions about an axis.
#[derive(Clone, Copy)]
pub(super) struct Cone {
    pub(super) axis: DVec3,
    /// Cosine of the half-angle; −1 for all directions.
    pub(super) cosine: f64,
}

impl Cone {
    pub(super) const ALL: Self = Self {
        axis: DVec3::Z,
        cosine: -1.0,
    };

    /// A cone that contains both (Pharr, Jakob and Humphreys, Physically Based Rendering, 4th edition, 2023, section 3.8.4).
    pub(super) fn with(self, other: Self) -> Self {
        let (wide, narrow) = if self.cosine <= other.cosine {
            (self, other)
        } else {
            (other, self)
        };
        if wide.cosine <= -1.0 {
            return Self::ALL;
        }
        let (a, b) = (wide.cosine.acos(), narrow.cosine.acos());
        let between = wide.axis.angle_between(narrow.axis);
        if between + b <= a {
            return wide;
        }
        let half = 0.5 * (a + between + b);
        let across = wide.axis.cross(narrow.axis);
        let Some(across) = across.try_normalize().filter(|_| half < PI) else {
            return Self::ALL;
        };
        let turned = glam::DQuat::from_axis_angle(across, half - a) * wide.axis;
        Self {
            axis: turned.normalize(),
            cosine: half.cos(),
        }
    }

    /// The fraction of all directions.
    pub(super) fn share(self) -> f64 {
        0.5 * (1.0 - self.cosine)
    }
}

impl Lamp {
    /// The lamp of an emitter; `None` if it has no position.
    pub(super) fn of(
        number: usize,
        source: &EmitterSource,
        (objects, lights): (&[Object], &[Light]),
    ) -> Option<Self> {
        let lamp = Self {
            source: number as u32,
            center: DVec3::ZERO,
            reach: 0.0,
            variance: 0.0,
            mean_power: source.brightness,
            uneven_power: 0.0,
            form: DMat3::IDENTITY,
            cone: Cone::ALL,
        };
        match source.kind {
            EmitterKind::Object(index) => lamp.with_shape(&objects[index].shape),
            EmitterKind::Environment(_) => None,
            EmitterKind::Light(index) => lamp.with_emission(lights[index].shape),
        }
    }

    fn with_shape(self, shape: &Shape) -> Option<Self> {
        match *shape {
            Shape::Plane { .. } => None,
            Shape::Sphere { center, radius } => Some(Self {
                center,
                reach: radius,
                variance: radius * radius,
                mean_power: self.mean_power * PI * radius * radius,
                ..self
            }),
            Shape::Rectangle {
                center,
                normal,
                half_width,
                half_height,
                ..
            } => {
                let reach = half_width.hypot(half_height);
                let area = 4.0 * half_width * half_height;
                Some(self.with_sides((center, normal), reach, (reach * reach / 3.0, area)))
            }
            Shape::Disk {
                center,
                normal,
                radius,
                ..
            } => {
                let square = radius * radius;
                Some(self.with_sides((center, normal), radius, (0.5 * square, PI * square)))
            }
        }
    }

    /// Emission from both sides of an area: its mean over all directions is half its value along the normal.
    fn with_sides(
        self,
        (center, normal): (DVec3, DVec3),
        reach: f64,
        (variance, area): (f64, f64),
    ) -> Self {
        Self {
            center,
            reach,
            variance,
            mean_power: 0.5 * self.mean_power * area,
            form: 4.0 * outer(normal),
            ..self
        }
    }

    fn with_emission(self, shape: LightShape) -> Option<Self> {
        match shape {
            LightShape::DistantDisk { .. } | LightShape::Direction { .. } => None,
            LightShape::Point { position } => Some(Self {
                center: position,
                ..self
            }),
            LightShape::Spot {
                position,
                axis,
                full_height,
                edge_height,
            } => {
                // The fraction of all directions that are lit: the smooth step from full intensity to 0 has the mean 1/2.
                let lit = 0.25 * (full_height + edge_height);
                Some(Self {
                    center: position,
                    mean_power: self.mean_power * lit,
                    uneven_power: self.mean_power.powi(2) * lit * (1.0 - lit),
                    cone: Cone {
                        axis,
                        cosine: 1.0 - edge_height,
                    },
                    ..self
                })
            }
        }
    }
}

pub(super) fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}
