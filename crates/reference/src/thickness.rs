//! How thick a layer is at a point of its surface.

use crate::noise::swirls;
use crate::surface::center_of;
use glam::DVec3;
use scene::limits::THICKNESS_NM;
use scene::{Coordinate, Picture, Profile, Shape, Thickness};
use std::f64::consts::{PI, TAU};

/// Thickness of a layer at a point of its surface, nm.
pub fn layer_thickness(thickness: &Thickness, shape: &Shape, position: DVec3) -> f64 {
    field_value(thickness, shape, position).clamp(THICKNESS_NM.low, THICKNESS_NM.high)
}

fn field_value(thickness: &Thickness, shape: &Shape, position: DVec3) -> f64 {
    let value_of = |part: &Thickness| field_value(part, shape, position);
    match *thickness {
        Thickness::Constant { nm } => nm,
        Thickness::Polar {
            axis,
            pole_nm,
            equator_nm,
        } => {
            let half_turns = coordinate(&Coordinate::Polar { axis }, shape, position);
            pole_nm + 2.0 * (equator_nm - pole_nm) * half_turns
        }
        Thickness::Linear {
            start,
            end,
            start_nm,
            end_nm,
        } => {
            let along = coordinate(&Coordinate::Line { start, end }, shape, position);
            start_nm + (end_nm - start_nm) * along
        }
        Thickness::Steps { start, end, ref nm } => {
            let along = coordinate(&Coordinate::Line { start, end }, shape, position);
            nm[((along * nm.len() as f64) as usize).min(nm.len() - 1)]
        }
        Thickness::Profile(ref profile) => {
            profile_value(profile, coordinate(&profile.coordinate, shape, position))
        }
        Thickness::Swirls(ref field) => swirls(field, shape, position),
        Thickness::Picture(ref picture) => picture_value(picture, shape, position),
        Thickness::Sum(ref parts) => parts.iter().map(value_of).sum(),
        Thickness::Product(ref parts) => parts.iter().map(value_of).product(),
    }
}

/// What a field runs along, from 0 to 1.
fn coordinate(coordinate: &Coordinate, shape: &Shape, position: DVec3) -> f64 {
    match *coordinate {
        Coordinate::Polar { axis } => (position - center_of(shape)).angle_between(axis) / PI,
        Coordinate::Line { start, end } => {
            let along = (position - start).dot(end - start) / (end - start).length_squared();
            along.clamp(0.0, 1.0)
        }
    }
}

fn profile_value(profile: &Profile, along: f64) -> f64 {
    let squares = &profile.squares_nm2;
    let place = along * (squares.len() - 1) as f64;
    let knot = (place as usize).min(squares.len() - 2);
    let part = place - knot as f64;
    let square = squares[knot] + (squares[knot + 1] - squares[knot]) * part;
    let nm = square.sqrt().min(profile.most_nm);
    match profile.black {
        Some(black) if nm < black.below_nm => black.nm,
        _ => nm,
    }
}

/// A picture by longitude and latitude on spheres, by the surface's two axes elsewhere.
fn picture_value(picture: &Picture, shape: &Shape, position: DVec3) -> f64 {
    let (place, wraps) = picture_place(picture, shape, position);
    let value = bilinear(picture, place, wraps);
    picture.black_nm + (picture.white_nm - picture.black_nm) * value
}

/// Place in a picture, from its upper left corner in its width and height, and whether it goes on beyond its sides.
fn picture_place(picture: &Picture, shape: &Shape, position: DVec3) -> ([f64; 2], bool) {
    let local = position - center_of(shape);
    match *shape {
        Shape::Sphere { .. } => {
            let longitude = local.x.atan2(local.z) / TAU;
            let from_pole = local.angle_between(DVec3::Y) / PI;
            ([0.5 + longitude, from_pole], true)
        }
        Shape::Plane {
            tangent, bitangent, ..
        }
        | Shape::Rectangle {
            tangent, bitangent, ..
        } => {
            let [width, height] = picture.size.unwrap_or(match *shape {
                Shape::Rectangle {
                    half_width,
                    half_height,
                    ..
                } => [2.0 * half_width, 2.0 * half_height],
                _ => [1.0, 1.0],
            });
            let across = 0.5 + local.dot(tangent) / width;
            let down = 0.5 - local.dot(bitangent) / height;
            ([across, down], false)
        }
    }
}

/// Linear between the centres of the pixels.
fn bilinear(picture: &Picture, [across, down]: [f64; 2], wraps: bool) -> f64 {
    let file = &*picture.file;
    let (width, height) = (f64::from(file.width), f64::from(file.height));
    let x = (across * width - 0.5).clamp(-1.0, width);
    let y = (down * height - 0.5).clamp(0.0, height - 1.0);
    let pixel = |column: f64, row: f64| {
        let column = if wraps {
            column.rem_euclid(width)
        } else {
            column.clamp(0.0, width - 1.0)
        };
        let row = row.min(height - 1.0);
        f64::from(file.values[row as usize * file.width as usize + column as usize])
    };
    let (left, above) = (x.floor(), y.floor());
    let (right, below) = (left + 1.0, above + 1.0);
    let mix = |a: f64, b: f64, part: f64| a + (b - a) * part;
    mix(
        mix(pixel(left, above), pixel(right, above), x - left),
        mix(pixel(left, below), pixel(right, below), x - left),
        y - above,
    )
}
