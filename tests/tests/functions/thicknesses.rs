//! Functions of thickness.wgsl and noise.wgsl: the thickness of layers over their surfaces.

use crate::world::{
    center_of, everything, objects_where, pick, point_on, rounded, rows, vector, within,
};
use crate::{Check, lazy, pure, table};
use glam::DVec3;
use pellicle_tests::agreement::Tolerance;
use pellicle_tests::tolerances::{EXACT, NOISE, PICTURE_NM, PROFILE_NM, SWIRLS_NM, THICKNESS_NM};
use scene::{Coordinate, Material, Profile, Shape, Thickness};
use std::collections::BTreeSet;

pub(crate) fn checks() -> Vec<Check> {
    vec![
        noise(),
        lattice_noise(),
        thickness(
            is_plain,
            THICKNESS_NM,
            &[
                "layer_thickness",
                "field_value",
                "field_coordinate",
                "load_field",
                "load_film",
                "load_interface",
                "load_layer",
            ],
        ),
        thickness(is_sampled, PROFILE_NM, &["profile_value", "number_at"]),
        thickness(is_swirls, SWIRLS_NM, &["swirls"]),
        thickness(
            is_picture,
            PICTURE_NM,
            &["picture_value", "picture_uv", "bilinear"],
        ),
        thickness(is_combined, SWIRLS_NM, &["combined_fields"]),
    ]
}

fn thickness_of(object: usize) -> Option<&'static Thickness> {
    everything().material(object).thicknesses().next()
}

fn is_plain(thickness: &Thickness) -> bool {
    matches!(
        thickness,
        Thickness::Constant { .. } | Thickness::Polar { .. } | Thickness::Linear { .. }
    )
}

fn is_sampled(thickness: &Thickness) -> bool {
    matches!(thickness, Thickness::Steps { .. } | Thickness::Profile(_))
}

fn is_swirls(thickness: &Thickness) -> bool {
    matches!(thickness, Thickness::Swirls(_))
}

fn is_picture(thickness: &Thickness) -> bool {
    matches!(thickness, Thickness::Picture(_))
}

fn is_combined(thickness: &Thickness) -> bool {
    matches!(thickness, Thickness::Sum(_) | Thickness::Product(_))
}

/// Rows of a film for which `wanted` holds and a point, on its surface or off it.
fn points_about(wanted: fn(&Thickness) -> bool) -> Vec<f32> {
    let world = everything();
    let films = films(wanted);
    let mut inputs = rows(4, |u| {
        let object = pick(&films, u[0]);
        let shape = world.shape(object);
        let on = point_on(shape, u[1], u[2]);
        // Half of the points are off the object, beyond the ends of a linear thickness.
        let scale = if u[3] < 0.5 { 1.0 } else { 4.0 * u[3] };
        let point = rounded(center_of(shape) + scale * (on - center_of(shape)));
        is_clear(object, point).then(|| vec![object as f64, point.x, point.y, point.z])
    });
    for object in films {
        for end in ends_of(object) {
            inputs.push(object as f32);
            inputs.extend(end.as_vec3().to_array());
        }
    }
    inputs
}

/// Checks the layers for which `wanted` holds.
fn thickness(
    wanted: fn(&Thickness) -> bool,
    tolerance: Tolerance,
    proves: &'static [&'static str],
) -> Check {
    Check {
        probe: within(
            everything,
            (4, 1),
            "let i = u32(a(0u)); let m = material_at(shape_at(i).material);
             var first = load_film(m.record).first_layer;
             if (m.surface != SURFACE_FILM) { first = load_interface(m.record).first_layer; }
             put(0u, layer_thickness(first, i, a3(1u)));",
        ),
        proves,
        inputs: lazy(move || points_about(wanted)),
        twin: |a| {
            let object = a[0] as usize;
            let shape = everything().shape(object);
            let found = thickness_of(object)
                .map(|thickness| reference::layer_thickness(thickness, shape, vector(&a[1..])));
            vec![found.unwrap_or(f64::NAN)]
        },
        tolerance,
    }
}

fn films(wanted: fn(&Thickness) -> bool) -> Vec<usize> {
    objects_where(|_, material| material.thicknesses().any(wanted))
}

/// Points where a thickness begins and ends.
fn ends_of(object: usize) -> Vec<DVec3> {
    let center = center_of(everything().shape(object));
    match thickness_of(object) {
        Some(Thickness::Polar { axis, .. }) => vec![center + axis, center - axis],
        Some(Thickness::Linear { start, end, .. }) => vec![*start, *end],
        _ => Vec::new(),
    }
}

/// Whether a point is away from positions where a thickness jumps, or is too steep for any tolerance.
fn is_clear(object: usize, point: DVec3) -> bool {
    let shape = everything().shape(object);
    let clear_part = |part: &Thickness| match part {
        Thickness::Steps { start, end, nm } => {
            let along = (point - start).dot(end - start) / (end - start).length_squared();
            let place = along * nm.len() as f64;
            (place - place.round()).abs() > 1e-4
        }
        Thickness::Profile(profile) => is_clear_of_edges(profile, shape, point),
        Thickness::Picture(_) => {
            // The seam behind and the poles, where positions are magnified.
            let local = (point - center_of(shape)).normalize();
            !matches!(shape, Shape::Sphere { .. }) || local.y.abs() < 0.999
        }
        _ => true,
    };
    thickness_of(object).is_some_and(|thickness| thickness.parts().all(clear_part))
}

/// Whether a point is away from the edge of the black film, the last thickness and a bubble's lowest point.
fn is_clear_of_edges(profile: &Profile, shape: &Shape, point: DVec3) -> bool {
    if let Coordinate::Polar { axis } = profile.coordinate
        && (point - center_of(shape)).angle_between(axis) > 2.9
    {
        return false;
    }
    let Some(black) = profile.black else {
        return true;
    };
    let without = Thickness::Profile(Profile {
        black: None,
        ..profile.clone()
    });
    let nm = reference::layer_thickness(&without, shape, point);
    (nm - black.below_nm).abs() > 0.05
}

const NOISE_BODY: &str = "let n = gradient_noise(a3(0u), u32(a(3u)), u32(a(4u))); put4(0u, n);";

fn noise_twin(a: &[f64]) -> Vec<f64> {
    let noise = reference::gradient_noise(vector(a), a[3] as u32, a[4] as u32);
    let [x, y, z] = noise.gradient.to_array();
    vec![x, y, z, noise.value]
}

fn noise() -> Check {
    Check {
        probe: pure((5, 4), NOISE_BODY),
        proves: &["gradient_noise"],
        inputs: lazy(|| {
            let mut inputs = table(
                &[
                    (-20.0, 20.0),
                    (-20.0, 20.0),
                    (-20.0, 20.0),
                    (0.0, 9.0),
                    (0.0, 9.0),
                ],
                &[&[0.5, 0.25, 0.75, 16_777_215.0, 16_777_215.0]],
            );
            whole(&mut inputs, &[3, 4]);
            inputs
        }),
        twin: noise_twin,
        tolerance: NOISE,
    }
}

/// At lattice points the value is 0 and the gradient is random: the same bits on both sides.
fn lattice_noise() -> Check {
    Check {
        probe: pure((5, 4), NOISE_BODY),
        proves: &["gradient_noise"],
        inputs: lazy(|| {
            let mut inputs = table(
                &[
                    (-99.0, 99.0),
                    (-99.0, 99.0),
                    (-99.0, 99.0),
                    (0.0, 9.0),
                    (0.0, 9.0),
                ],
                &[&[0.0; 5]],
            );
            whole(&mut inputs, &[0, 1, 2, 3, 4]);
            inputs
        }),
        twin: noise_twin,
        tolerance: EXACT,
    }
}

fn whole(table: &mut [f32], columns: &[usize]) {
    for row in table.chunks_mut(5) {
        for &column in columns {
            row[column] = row[column].floor();
        }
    }
}

/// A kind of thickness that the scene lacks would not be proved.
pub(crate) fn the_scene_has_every_kind_of_thickness_on_spheres_and_elsewhere() {
    let world = everything();
    let mut kinds = BTreeSet::new();
    for object in objects_where(|_, material| matches!(material, Material::Film { .. })) {
        let is_sphere = matches!(world.shape(object), Shape::Sphere { .. });
        for part in thickness_of(object).into_iter().flat_map(Thickness::parts) {
            let kind = match part {
                Thickness::Constant { .. } => "constant",
                Thickness::Polar { .. } => "polar",
                Thickness::Linear { .. } => "linear",
                Thickness::Steps { .. } => "steps",
                Thickness::Profile(Profile { black: None, .. }) => "growth",
                Thickness::Profile(_) => "drainage",
                Thickness::Swirls(_) => "swirls",
                Thickness::Picture(_) => "picture",
                Thickness::Sum(_) => "sum",
                Thickness::Product(_) => "product",
            };
            kinds.insert((kind, is_sphere));
        }
    }
    for kind in ["drainage", "swirls", "picture"] {
        assert!(
            kinds.contains(&(kind, true)) && kinds.contains(&(kind, false)),
            "{kind}: {kinds:?}"
        );
    }
    let names: BTreeSet<_> = kinds.iter().map(|(kind, _)| kind).collect();
    assert_eq!(names.len(), 10, "{names:?}");
}

/// The comparison can fail: a thickness one part in a thousand off, another seed, a picture upside down.
pub(crate) fn a_wrong_twin_of_a_thickness_is_noticed() {
    for (index, mut check) in checks().into_iter().enumerate() {
        check.twin = match index {
            0 | 1 => |a| noise_twin(&[a[0], a[1], a[2], a[3], a[4] + 1.0]),
            _ => |a| {
                let object = a[0] as usize;
                let shape = everything().shape(object);
                let turned = 2.0 * center_of(shape) - vector(&a[1..]);
                let found = thickness_of(object)
                    .map(|thickness| reference::layer_thickness(thickness, shape, turned));
                vec![found.unwrap_or(f64::NAN)]
            },
        };
        assert!(check.run().is_err(), "check {index}");
    }
}
