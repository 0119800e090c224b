//! Objects of a validated scene.

use crate::MaterialId;
use crate::rounding::RoundToF32;
use glam::DVec3;

/// A shape made of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// The shape, with its position and size.
    pub shape: Shape,
    /// Its material.
    pub material: MaterialId,
}

/// An analytic shape. `normal`, `tangent` and `bitangent` are orthonormal and right-handed
/// (tangent × bitangent = normal).
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A sphere.
    Sphere {
        /// Center.
        center: DVec3,
        /// Radius, > 0.
        radius: f64,
    },
    /// An infinite plane.
    Plane {
        /// A point of the plane, the origin of its two axes.
        point: DVec3,
        /// Unit normal.
        normal: DVec3,
        /// First axis.
        tangent: DVec3,
        /// Second axis.
        bitangent: DVec3,
    },
    /// A rectangle.
    Rectangle {
        /// Center, the origin of its two axes.
        center: DVec3,
        /// Unit normal.
        normal: DVec3,
        /// Direction of the width.
        tangent: DVec3,
        /// Direction of the height.
        bitangent: DVec3,
        /// Half the width, > 0.
        half_width: f64,
        /// Half the height, > 0.
        half_height: f64,
    },
    /// A disk.
    Disk {
        /// Center, the origin of its two axes.
        center: DVec3,
        /// Unit normal.
        normal: DVec3,
        /// First axis.
        tangent: DVec3,
        /// Second axis.
        bitangent: DVec3,
        /// Radius, > 0.
        radius: f64,
    },
}

impl RoundToF32 for Object {
    fn rounded(&self) -> Self {
        Self {
            shape: self.shape.rounded(),
            material: self.material,
        }
    }
}

impl RoundToF32 for Shape {
    fn rounded(&self) -> Self {
        match self {
            Self::Sphere { center, radius } => Self::Sphere {
                center: center.rounded(),
                radius: radius.rounded(),
            },
            Self::Plane {
                point,
                normal,
                tangent,
                bitangent,
            } => Self::Plane {
                point: point.rounded(),
                normal: normal.rounded(),
                tangent: tangent.rounded(),
                bitangent: bitangent.rounded(),
            },
            Self::Rectangle {
                center,
                normal,
                tangent,
                bitangent,
                half_width,
                half_height,
            } => Self::Rectangle {
                center: center.rounded(),
                normal: normal.rounded(),
                tangent: tangent.rounded(),
                bitangent: bitangent.rounded(),
                half_width: half_width.rounded(),
                half_height: half_height.rounded(),
            },
            Self::Disk {
                center,
                normal,
                tangent,
                bitangent,
                radius,
            } => Self::Disk {
                center: center.rounded(),
                normal: normal.rounded(),
                tangent: tangent.rounded(),
                bitangent: bitangent.rounded(),
                radius: radius.rounded(),
            },
        }
    }
}
