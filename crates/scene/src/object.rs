//! Shapes in space, in a validated scene.

use crate::MaterialId;
use glam::DVec3;

/// A shape made of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Where and how large.
    pub shape: Shape,
    /// What it is made of.
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
    /// A plane without bounds.
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
    /// A plane bounded to a rectangle.
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
    /// A plane bounded to a disk.
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
