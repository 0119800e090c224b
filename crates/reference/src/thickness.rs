//! The thickness of a layer at a point of its surface.

use crate::noise::swirls;
use crate::picture::{center_of, half_turns, picture_uv};
use glam::DVec3;
use scene::limits::THICKNESS_NM;
use scene::{Coordinate, Picture, Profile, Shape, Thickness};
use spectra::linear;

/// Returns the thickness of a layer at a point of its surface, nm.
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
            let half_turns = field_coordinate(&Coordinate::Polar { axis }, shape, position);
            pole_nm + 2.0 * (equator_nm - pole_nm) * half_turns
        }
        Thickness::Linear {
            start,
            end,
            start_nm,
            end_nm,
        } => {
            let along = field_coordinate(&Coordinate::Line { start, end }, shape, position);
            start_nm + (end_nm - start_nm) * along
        }
        Thickness::Steps { start, end, ref nm } => {
            let along = field_coordinate(&Coordinate::Line { start, end }, shape, position);
            nm[((along * nm.len() as f64) as usize).min(nm.len() - 1)]
        }
        Thickness::Profile(ref profile) => profile_value(
            profile,
            field_coordinate(&profile.coordinate, shape, position),
        ),
        Thickness::Swirls(ref field) => swirls(field, shape, position),
        Thickness::Picture(ref picture) => picture_value(picture, shape, position),
        Thickness::Sum(ref parts) => parts.iter().map(value_of).sum(),
        Thickness::Product(ref parts) => parts.iter().map(value_of).product(),
    }
}

/// Returns the coordinate along which a field varies, from 0 to 1.
fn field_coordinate(coordinate: &Coordinate, shape: &Shape, position: DVec3) -> f64 {
    match *coordinate {
        Coordinate::Polar { axis } => half_turns(position - center_of(shape), axis),
        Coordinate::Line { start, end } => {
            let along = (position - start).dot(end - start) / (end - start).length_squared();
            along.clamp(0.0, 1.0)
        }
    }
}

fn profile_value(profile: &Profile, along: f64) -> f64 {
    let square = linear(&profile.squares_nm2, along);
    let nm = square.sqrt().min(profile.most_nm);
    match profile.black {
        Some(black) if nm < black.below_nm => black.nm,
        _ => nm,
    }
}

/// Returns the value of a picture, by longitude and latitude on spheres, by the surface's two axes elsewhere.
fn picture_value(picture: &Picture, shape: &Shape, position: DVec3) -> f64 {
    let (place, wraps) = picture_uv(picture.size, shape, position);
    let value = bilinear(picture, place, wraps);
    picture.black_nm + (picture.white_nm - picture.black_nm) * value
}

/// Interpolates linearly between the centers of the pixels.
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

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{BlackFilm, PictureFile};
    use std::sync::Arc;

    const GLOBE: Shape = Shape::Sphere {
        center: DVec3::new(1.0, 2.0, 3.0),
        radius: 2.0,
    };
    const SLIDE: Shape = Shape::Rectangle {
        center: DVec3::new(1.0, 2.0, 3.0),
        normal: DVec3::Z,
        tangent: DVec3::X,
        bitangent: DVec3::Y,
        half_width: 2.0,
        half_height: 1.0,
    };

    /// Four columns by two rows: 0, 100, 200, 300 above 400, 500, 600, 700.
    fn picture(size: Option<[f64; 2]>) -> Thickness {
        Thickness::Picture(Picture {
            file: Arc::new(PictureFile {
                width: 4,
                height: 2,
                values: (0..8_u8).map(|i| f32::from(i) / 8.0).collect(),
            }),
            black_nm: 0.0,
            white_nm: 800.0,
            size,
        })
    }

    fn at(thickness: &Thickness, shape: &Shape, place: [f64; 3]) -> f64 {
        layer_thickness(
            thickness,
            shape,
            center_of(shape) + DVec3::from_array(place),
        )
    }

    fn assert_near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-9, "{found} for {expected}");
    }

    /// The center of the picture faces +Z, its right half lies toward +X, its top at +Y, and it closes behind.
    #[test]
    fn a_picture_lies_on_a_sphere_as_a_map_on_a_globe() {
        let globe = |place| at(&picture(None), &GLOBE, place);
        // On the equator both rows have weight one half: the columns are 200, 300, 400, 500.
        assert_near(globe([0.0, 0.0, 2.0]), 350.0);
        assert_near(globe([2.0, 0.0, 0.0]), 450.0);
        assert_near(globe([-2.0, 0.0, 0.0]), 250.0);
        assert_near(globe([0.0, 0.0, -2.0]), 350.0);
        let eighth = 2.0 * 0.5_f64.sqrt();
        assert_near(globe([eighth, 0.0, eighth]), 400.0);
        assert_near(globe([-eighth, 0.0, -eighth]), 200.0);
        assert_near(globe([1e-3, 2.0, 1e-3]), globe([1.0, 3.0_f64.sqrt(), 1.0]));
        let (left, right) = (globe([-1e-7, 0.0, -2.0]), globe([1e-7, 0.0, -2.0]));
        assert!((left - right).abs() < 1e-3, "{left} {right}");
    }

    #[test]
    fn a_picture_lies_upright_on_a_rectangle() {
        let slide = |place| at(&picture(None), &SLIDE, place);
        assert_near(slide([-1.5, 0.5, 0.0]), 0.0);
        assert_near(slide([1.5, 0.5, 0.0]), 300.0);
        assert_near(slide([-1.5, -0.5, 0.0]), 400.0);
        assert_near(slide([2.0, -1.0, 0.0]), 700.0);
        let half = |place| at(&picture(Some([2.0, 1.0])), &SLIDE, place);
        assert_near(half([0.75, 0.25, 0.0]), 300.0);
        assert_near(half([1.9, 0.9, 0.0]), 300.0);
    }

    #[test]
    fn steps_profiles_and_combinations_have_their_values() {
        let (start, end) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 2.0, 3.0));
        let steps = Thickness::Steps {
            start,
            end,
            nm: vec![10.0, 20.0, 30.0],
        };
        let found = [-5.0, 0.5, 1.5, 2.5, 9.0].map(|x| at(&steps, &SLIDE, [x, 0.0, 0.0]));
        assert_eq!(found, [10.0, 10.0, 20.0, 30.0, 30.0]);
        let profile = Thickness::Profile(Profile {
            coordinate: Coordinate::Line { start, end },
            squares_nm2: vec![0.0, 1e4, 4e4],
            most_nm: 150.0,
            black: Some(BlackFilm {
                below_nm: 60.0,
                nm: 7.0,
            }),
        });
        let found = [0.3, 1.5, 2.25, 3.0].map(|x| at(&profile, &SLIDE, [x, 0.0, 0.0]));
        assert_eq!(found[0], 7.0);
        assert_near(found[1], 100.0);
        assert_near(found[2], 150.0);
        assert_eq!(found[3], 150.0);
        let sum = Thickness::Sum(vec![steps.clone(), Thickness::Constant { nm: 5.0 }]);
        let product = Thickness::Product(vec![sum, Thickness::Constant { nm: 4.0 }]);
        assert_eq!(at(&product, &SLIDE, [1.5, 0.0, 0.0]), 100.0);
        let thick = Thickness::Product(vec![Thickness::Constant { nm: 1e4 }, product]);
        assert_eq!(
            at(&thick, &SLIDE, [1.5, 0.0, 0.0]),
            1e5,
            "the largest possible thickness"
        );
    }
}
