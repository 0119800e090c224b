//! Objects of a validated scene.

use crate::MaterialId;
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
