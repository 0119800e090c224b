//! Functions of microsurface.wgsl, and of the facets in bsdf/.

use crate::world::{
    center_of, direction, everything, objects_where, pick, point_on, rounded, rows, vector, within,
};
use crate::{Check, Lazy, lazy, pure, table};
use optics::{Distribution, Microsurface};
use pellicle_tests::agreement::Tolerance;
use pellicle_tests::tolerances::{
    FACET_DIRECTION, FACET_ENERGY, FACETS, FRAME, LAMBDA, ROUGH_INVERSE, SCALED_ERFC,
};
use reference::Facets;
use scene::{Grain, Shape};
use std::f64::consts::PI;

pub(crate) fn checks() -> Vec<Check> {
    [special_functions(), surfaces(), samplers(), of_materials()]
        .into_iter()
        .flatten()
        .collect()
}

/// A surface from three numbers: a tag and two widths.
fn surface_of(a: &[f64]) -> Microsurface {
    let distribution = if a[0] < 1.0 {
        Distribution::Beckmann
    } else {
        Distribution::Ggx
    };
    Microsurface {
        distribution,
        alpha: [a[1], a[2]],
    }
}

const SURFACE: [(f32, f32); 3] = [(0.0, 1.999_999), (0.1, 1.0), (0.1, 1.0)];

/// Rows with the columns of a surface and others.
fn with_surface(others: &'static [(f32, f32)], edges: &'static [&'static [f32]]) -> Lazy<Vec<f32>> {
    lazy(move || table(&[&SURFACE, others].concat(), edges))
}

fn special_functions() -> Vec<Check> {
    vec![
        Check {
            probe: pure((1, 1), "put(0u, scaled_erfc(a(0u)));"),
            proves: &["scaled_erfc"],
            inputs: lazy(move || table(&[(0.0, 6.0)], &[&[0.0], &[6.0]])),
            twin: |a| vec![(a[0] * a[0]).exp() * libm::erfc(a[0])],
            tolerance: SCALED_ERFC,
        },
        Check {
            probe: pure(
                (2, 1),
                "put(0u, visible_cdf(a(0u), sqrt(1.0 - a(0u) * a(0u)), a(1u)) * exp(a(1u) * a(1u)));",
            ),
            proves: &["visible_cdf"],
            inputs: lazy(move || table(&[(0.0, 1.0), (-4.0, 1.0)], &[&[1.0, 0.0], &[0.0, 0.0]])),
            twin: |a| {
                let (cosine, sine) = (a[0], (1.0 - a[0] * a[0]).sqrt());
                vec![cosine * libm::erfc(-a[1]) * (a[1] * a[1]).exp() + sine / PI.sqrt()]
            },
            tolerance: SCALED_ERFC,
        },
        Check {
            // Winitzki's formula itself is off by 2e-3.
            probe: pure((1, 1), "put(0u, rough_inverse_erf(a(0u)));"),
            proves: &["rough_inverse_erf"],
            inputs: lazy(move || table(&[(0.001, 1.999)], &[&[1.0], &[0.5], &[1e-4]])),
            twin: |a| vec![inverse_erf(a[0])],
            tolerance: ROUGH_INVERSE,
        },
    ]
}

/// The x for which erfc(−x) is `share`, by bisection.
fn inverse_erf(share: f64) -> f64 {
    let (mut low, mut high) = (-6.0, 6.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if libm::erfc(-middle) < share {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Checks densities of a facet, from a surface and the facet's cosine and turn.
pub(crate) fn densities(inputs: Lazy<Vec<f32>>, tolerance: Tolerance) -> Check {
    Check {
        probe: pure(
            (5, 1),
            "let facet = direction_at(3u);
             put(0u, microsurface_density(Microsurface(u32(a(0u)), vec2f(a(1u), a(2u))), facet));",
        ),
        proves: &["microsurface_density"],
        inputs,
        twin: |a| vec![surface_of(a).density(direction(a[3], a[4]).to_array())],
        tolerance,
    }
}

/// Checks Smith's Λ, from a surface and a direction's cosine and turn.
pub(crate) fn lambdas(inputs: Lazy<Vec<f32>>, tolerance: Tolerance) -> Check {
    Check {
        probe: pure(
            (5, 1),
            "let w = direction_at(3u);
             put(0u, microsurface_lambda(Microsurface(u32(a(0u)), vec2f(a(1u), a(2u))), w));",
        ),
        proves: &["microsurface_lambda"],
        inputs,
        twin: |a| vec![surface_of(a).lambda(direction(a[3], a[4]).to_array())],
        tolerance,
    }
}

/// Checks the reflection of facets, from a surface, the cosine of `wo`, and the cosine and turn of `wi`.
pub(crate) fn reflections(inputs: Lazy<Vec<f32>>, tolerance: Tolerance) -> Check {
    Check {
        probe: pure(
            (6, 3),
            "let wo = vec3f(sqrt(1.0 - a(3u) * a(3u)), 0.0, a(3u));
             let wi = direction_at(4u);
             let f = microsurface_reflection(Microsurface(u32(a(0u)), vec2f(a(1u), a(2u))), wo, wi);
             put(0u, f.value); put(1u, f.pdf); put(2u, f.cosine);",
        ),
        proves: &["microsurface_reflection"],
        inputs,
        twin: |a| {
            let (wo, wi) = (direction(a[3], 0.0), direction(a[4], a[5]));
            let (e, l) = (wo.to_array(), wi.to_array());
            let surface = surface_of(a);
            let cosine = wo.dot((wo + wi).normalize());
            vec![surface.reflection(e, l) * wi.z, surface.pdf(e, l), cosine]
        },
        tolerance,
    }
}

fn surfaces() -> Vec<Check> {
    vec![
        densities(
            with_surface(
                &[(0.0, 1.0), (0.0, 1.0)],
                &[
                    &[0.0, 0.1, 0.1, 1.0, 0.0],
                    &[1.0, 0.1, 0.2, 1.0, 0.0],
                    &[1.0, 0.1, 0.2, 0.0, 0.2],
                ],
            ),
            FACETS,
        ),
        lambdas(
            with_surface(
                &[(0.001, 1.0), (0.0, 1.0)],
                &[
                    &[0.0, 0.1, 0.1, 1.0, 0.0],
                    &[1.0, 0.1, 0.2, 1.0, 0.0],
                    &[1.0, 0.1, 0.2, 1e-4, 0.2],
                ],
            ),
            LAMBDA,
        ),
        reflections(
            with_surface(
                &[(0.02, 1.0), (0.02, 1.0), (0.0, 1.0)],
                &[
                    &[0.0, 0.1, 0.1, 1.0, 1.0, 0.0],
                    &[1.0, 0.1, 0.2, 1.0, 0.01, 0.0],
                ],
            ),
            FACETS,
        ),
    ]
}

fn sampled(a: &[f64]) -> Vec<f64> {
    let wo = direction(a[3], a[4]).to_array();
    surface_of(a).sample(wo, a[5], a[6]).to_vec()
}

const SAMPLED: [(f32, f32); 4] = [(0.001, 1.0), (0.0, 1.0), (1e-6, 0.999), (1e-6, 0.999)];

/// Checks sampled facets, from a surface, the cosine and turn of `wo`, and two numbers.
pub(crate) fn facet_draws(inputs: Lazy<Vec<f32>>, tolerance: Tolerance) -> Check {
    Check {
        probe: pure((7, 3),
            "let wo = direction_at(3u);
             put3(0u, microsurface_sample(Microsurface(u32(a(0u)), vec2f(a(1u), a(2u))), wo, a(5u), a(6u)));",
        ),
        proves: &["microsurface_sample"],
        inputs,
        twin: sampled,
        tolerance,
    }
}

/// Checks sampled slopes, from a cosine and a number.
pub(crate) fn slopes(inputs: Lazy<Vec<f32>>, tolerance: Tolerance) -> Check {
    Check {
        // The slope across is 0 where its number is a half.
        probe: pure(
            (2, 1),
            "put(0u, visible_slope(a(0u), sqrt(1.0 - a(0u) * a(0u)), a(1u)));",
        ),
        proves: &["visible_slope"],
        inputs,
        twin: |a| {
            let facet =
                surface_of(&[0.0, 1.0, 1.0]).sample(direction(a[0], 0.0).to_array(), a[1], 0.5);
            vec![-facet[0] / facet[2]]
        },
        tolerance,
    }
}

fn samplers() -> Vec<Check> {
    let upright: fn(&[f64]) -> Vec<f64> = |a| {
        let surface = surface_of(&[a[0], 1.0, 1.0]);
        surface
            .sample(direction(a[1], a[2]).to_array(), a[3], a[4])
            .to_vec()
    };
    let of_unit_width = |tag: f32| {
        let fixed = [&[(tag, tag)][..], &SAMPLED].concat();
        table(&fixed, &[&[tag, 1.0, 0.0, 0.5, 0.5]])
    };
    vec![
        facet_draws(
            with_surface(&SAMPLED, &[&[0.0, 0.5, 0.5, 1.0, 0.0, 0.5, 0.5]]),
            FACET_DIRECTION,
        ),
        Check {
            probe: pure(
                (5, 3),
                "let wo = direction_at(1u);
                 put3(0u, normalize(sample_visible_beckmann(wo, a(3u), a(4u))));",
            ),
            proves: &["sample_visible_beckmann"],
            inputs: lazy(move || of_unit_width(0.0)),
            twin: upright,
            tolerance: FACET_DIRECTION,
        },
        Check {
            probe: pure(
                (5, 3),
                "let wo = direction_at(1u);
                 let facet = normalize(sample_visible_ggx(wo, a(3u), a(4u)));
                 put3(0u, facet);",
            ),
            proves: &["sample_visible_ggx"],
            inputs: lazy(move || of_unit_width(1.0)),
            twin: upright,
            tolerance: FACET_DIRECTION,
        },
        slopes(
            lazy(|| {
                table(
                    &[(0.0, 1.0), (1e-6, 0.999)],
                    &[&[1.0, 0.5], &[0.0, 0.1], &[1.0, 1e-7], &[0.0, 0.0]],
                )
            }),
            FACET_DIRECTION,
        ),
    ]
}

/// Facets of an object.
fn facets_of(object: f64) -> Facets<'static> {
    let material = everything().material(object as usize);
    Facets::new(material.microsurface().expect("chosen to be rough"))
}

/// Rows of a rough object, two directions and three numbers.
fn rough_rows() -> Vec<f32> {
    let rough = objects_where(|_, material| material.microsurface().is_some());
    let brushed = |&object: &usize| {
        let facets = everything().material(object).microsurface();
        facets.is_some_and(scene::Microsurface::is_brushed)
    };
    assert!(rough.iter().filter(|object| brushed(object)).count() >= 2);
    rows(8, move |u| {
        let object = pick(&rough, u[0]) as f64;
        // Leaves out rows where the choice between the two samplers depends on the last digit.
        let wo = direction(0.02 + 0.98 * u[1], u[2]);
        let lost = facets_of(object).sample(wo, [0.5, 0.5, u[7] + 1e-5])
            == facets_of(object).sample(wo, [0.5, 0.5, u[7] - 1e-5]);
        let row = [
            object,
            u[1] * 0.98 + 0.02,
            u[2],
            u[3] * 0.98 + 0.02,
            u[4],
            0.999 * u[5],
            0.999 * u[6],
            u[7],
        ];
        lost.then(|| row.to_vec())
    })
}

fn of_materials() -> Vec<Check> {
    vec![
        Check {
            probe: within(everything, (8, 1),
                "let wo = direction_at(1u);
                 put(0u, facets_albedo(load_facets(material_at(shape_at(u32(a(0u))).material).facets), wo));",
            ),
            proves: &["facets_albedo"],
            inputs: lazy(rough_rows),
            twin: |a| {
                let material = everything().material(a[0] as usize);
                let facets = material.microsurface().expect("chosen to be rough");
                vec![facets.energy.at(direction(a[1], a[2]).to_array())]
            },
            tolerance: FACET_ENERGY,
        },
        Check {
            probe: within(everything, (8, 4),
                "let wo = direction_at(1u);
                 let wi = direction_at(3u);
                 let s = facets_eval(load_facets(material_at(shape_at(u32(a(0u))).material).facets), wo, wi);
                 put(0u, s.lobes.single); put(1u, s.lobes.multiple); put(2u, s.lobes.cosine); put(3u, s.pdf);",
            ),
            proves: &["facets_eval", "load_facets", "load_material", "material_at", "microsurface_of", "records_row"],
            inputs: lazy(rough_rows),
            twin: |a| {
                let (wo, wi) = (direction(a[1], a[2]), direction(a[3], a[4]));
                let found = facets_of(a[0]).eval(wo, wi).expect("both are above");
                vec![found.single, found.multiple, found.cosine, found.pdf]
            },
            tolerance: FACETS,
        },
        Check {
            probe: within(everything, (8, 3),
                "let wo = direction_at(1u);
                 let random = vec4f(a(5u), a(6u), a(7u), 0.0);
                 put3(0u, facets_sample(load_facets(material_at(shape_at(u32(a(0u))).material).facets), wo, random));",
            ),
            proves: &["facets_sample"],
            inputs: lazy(rough_rows),
            twin: |a| {
                let wo = direction(a[1], a[2]);
                facets_of(a[0]).sample(wo, [a[5], a[6], a[7]]).to_array().to_vec()
            },
            tolerance: FACET_DIRECTION,
        },
        surface_frames(),
    ]
}

/// Rows of an object, a point on it and the normal there, away from points where its grain has no direction.
fn framed_points() -> Vec<f32> {
    let world = everything();
    let mut objects = objects_where(|_, material| material.microsurface().is_some());
    objects.push(0);
    rows(3, |u| {
        let object = pick(&objects, u[0]);
        let shape = world.shape(object);
        let position = rounded(point_on(shape, u[1], u[2]));
        let normal = match *shape {
            Shape::Sphere { center, .. } => rounded((position - center).normalize()),
            Shape::Plane { normal, .. }
            | Shape::Rectangle { normal, .. }
            | Shape::Disk { normal, .. } => normal,
        };
        let is_clear = match world.material(object).microsurface().map(|m| m.grain) {
            Some(Grain::Along(grain)) => grain.cross(normal).length() > 0.1,
            Some(Grain::Around(axis)) => axis.cross(position - center_of(shape)).length() > 0.1,
            _ => normal.z.abs() > 1e-3,
        };
        let row = [
            &[object as f64][..],
            &position.to_array(),
            &normal.to_array(),
        ]
        .concat();
        is_clear.then_some(row)
    })
}

/// Checks frames of rough objects, brushed or not, and of a diffuse one.
fn surface_frames() -> Check {
    Check {
        probe: within(
            everything,
            (7, 9),
            "let p = SurfacePoint(a3(1u), a3(4u), 1.0, true);
             let f = surface_frame(u32(a(0u)), p); put3(0u, f[0]); put3(3u, f[1]); put3(6u, f[2]);",
        ),
        proves: &["surface_frame"],
        inputs: lazy(framed_points),
        twin: |a| {
            let (world, object) = (everything(), a[0] as usize);
            let point = reference::SurfacePoint {
                position: vector(&a[1..]),
                normal: vector(&a[4..]),
                cosine: 1.0,
                is_front: true,
            };
            let shape = world.shape(object);
            let frame = reference::surface_frame(world.material(object), shape, &point);
            frame.to_cols_array().to_vec()
        },
        tolerance: FRAME,
    }
}
