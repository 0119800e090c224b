//! Geometry and reflectance of a surface at a point.

use crate::picture::{center_of, chosen_pixel, picture_uv};
use crate::{Ray, frame_of};
use glam::{DMat3, DVec3};
use scene::{Grain, Material, Pattern, Shape, SpectrumId};

/// The point that a ray hits and the unit normal there, on the ray's side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Position.
    pub position: DVec3,
    /// Unit normal, on the side of the ray's origin.
    pub normal: DVec3,
    /// Cosine between the ray and the normal, ≥ 0.
    pub cosine: f64,
    /// Whether the ray comes from the side of the shape's own normal: the outside of a sphere.
    pub is_front: bool,
}

/// Returns the point of a shape at a distance along a ray.
pub fn surface_point(shape: &Shape, ray: &Ray, distance: f64) -> SurfacePoint {
    let reached = ray.origin + ray.direction * distance;
    let (position, outward) = match *shape {
        Shape::Sphere { center, radius } => {
            let normal = (reached - center).normalize();
            (center + normal * radius, normal)
        }
        Shape::Plane { normal, .. }
        | Shape::Rectangle { normal, .. }
        | Shape::Disk { normal, .. } => (reached, normal),
    };
    let along = outward.dot(ray.direction);
    SurfacePoint {
        position,
        normal: if along > 0.0 { -outward } else { outward },
        cosine: along.abs(),
        is_front: along <= 0.0,
    }
}

/// Returns the frame of a surface at a point. The third column is the normal on the ray's side; where the surface is brushed, the
/// first column runs along the grain.
pub fn surface_frame(material: &Material, shape: &Shape, point: &SurfacePoint) -> DMat3 {
    let normal = point.normal;
    let grain = match material.microsurface().map(|facets| facets.grain) {
        None | Some(Grain::None) => return frame_of(normal),
        Some(Grain::Along(direction)) => direction,
        Some(Grain::Around(axis)) => axis.cross(point.position - center_of(shape)),
    };
    let along = grain - grain.dot(normal) * normal;
    if along.length_squared() <= 1e-10 * grain.length_squared() {
        return frame_of(normal);
    }
    let tangent = along.normalize();
    DMat3::from_cols(tangent, normal.cross(tangent), normal)
}

/// A reflectance over wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reflectance {
    /// One of the scene's spectra.
    Spectrum(SpectrumId),
    /// The smooth spectrum with these coefficients.
    Smooth([f64; 3]),
}

/// Returns the reflectance of a pattern at a point. `random` in [0, 1) chooses between the texels of a picture.
pub fn pattern_reflectance(
    pattern: &Pattern,
    shape: &Shape,
    position: DVec3,
    random: f64,
) -> Reflectance {
    match *pattern {
        Pattern::Uniform(spectrum) => Reflectance::Spectrum(spectrum),
        Pattern::Texture { ref texels, size } => {
            let (place, wraps) = picture_uv(size, shape, position);
            let pixel = chosen_pixel(texels, place, wraps, random);
            let [c0, c1, c2, _] = texels.at(pixel)[0].map(f64::from);
            Reflectance::Smooth([c0, c1, c2])
        }
        Pattern::Checker { even, odd, size } => {
            let local = (position - center_of(shape)) / size;
            let squares = match *shape {
                Shape::Sphere { .. } => local.x.floor() + local.y.floor() + local.z.floor(),
                Shape::Plane {
                    tangent, bitangent, ..
                }
                | Shape::Rectangle {
                    tangent, bitangent, ..
                }
                | Shape::Disk {
                    tangent, bitangent, ..
                } => local.dot(tangent).floor() + local.dot(bitangent).floor(),
            };
            let is_even = squares as i64 & 1 == 0;
            Reflectance::Spectrum(if is_even { even } else { odd })
        }
    }
}
