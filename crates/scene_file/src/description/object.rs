//! Objects as written in a scene file.

use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A shape made of a material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum Object {
    /// A sphere.
    Sphere {
        /// The name of one of the `materials`.
        material: String,
        /// Center.
        center: [f64; 3],
        /// Radius.
        #[schemars(range(min = limits::LENGTH.low, max = limits::LENGTH.high))]
        radius: f64,
    },
    /// An infinite plane.
    Plane {
        /// The name of one of the `materials`.
        material: String,
        /// A point of the plane, and the origin of patterns.
        point: [f64; 3],
        /// A direction perpendicular to the plane.
        normal: [f64; 3],
    },
    /// A rectangle.
    Rectangle {
        /// The name of one of the `materials`.
        material: String,
        /// Center.
        center: [f64; 3],
        /// A direction perpendicular to the rectangle.
        normal: [f64; 3],
        /// Width and height.
        #[schemars(inner(range(min = limits::LENGTH.low, max = limits::LENGTH.high)))]
        size: [f64; 2],
        /// The direction of the height; +Y when absent, or −Z for a rectangle that lies flat.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        up: Option<[f64; 3]>,
    },
    /// A disk.
    Disk {
        /// The name of one of the `materials`.
        material: String,
        /// Center.
        center: [f64; 3],
        /// A direction perpendicular to the disk.
        normal: [f64; 3],
        /// Radius.
        #[schemars(range(min = limits::LENGTH.low, max = limits::LENGTH.high))]
        radius: f64,
    },
}

impl Object {
    /// The name of the object's material.
    pub fn material(&self) -> &str {
        match self {
            Self::Sphere { material, .. }
            | Self::Plane { material, .. }
            | Self::Rectangle { material, .. }
            | Self::Disk { material, .. } => material,
        }
    }
}
