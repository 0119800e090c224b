//! Functions of fresnel.wgsl, film.wgsl and microfacet.wgsl.

use crate::{Check, lazy, pure, table};
use num_complex::Complex64;
use pellicle_tests::tolerances::{DIRECTION, FILM, FILM_GRAZING, FILM_THICK, FRESNEL, PHASE};
use std::f64::consts::PI;

pub(crate) fn checks() -> Vec<Check> {
    [surfaces(), films(), film_parts(), facets()]
        .into_iter()
        .flatten()
        .collect()
}

/// cos 88°.
const STEEP: f32 = 0.0349;
/// cos 89.99°.
const SHALLOW: f32 = 1.745e-4;

fn surfaces() -> Vec<Check> {
    vec![Check {
        probe: pure(
            (3, 1),
            "put(0u, reflectance_unpolarized(vec4f(a(0u)), vec4f(a(1u)), a(2u)).x);",
        ),
        proves: &["reflectance_unpolarized"],
        inputs: lazy(move || {
            table(
                &[(0.02, 5.0), (0.0, 8.0), (SHALLOW, 1.0)],
                &[
                    &[1.5, 0.0, 1.0],
                    &[0.05, 3.4, 1.0],
                    &[1.0, 0.0, 0.5],
                    &[1.0, 0.0, 1e-4],
                    &[1.0, 0.0, 1e-6],
                    &[0.05, 0.0, 0.3],
                    &[4.0, 8.0, 1e-6],
                ],
            )
        }),
        twin: |a| {
            vec![optics::reflectance_unpolarized(
                Complex64::new(a[0], a[1]),
                a[2],
            )]
        },
        tolerance: FRESNEL,
    }]
}

fn transparent_film(a: &[f64]) -> Vec<f64> {
    vec![
        optics::film(a[0].into(), a[1], a[2], a[3])
            .reflectance
            .unpolarized(),
    ]
}

fn lossy_film(a: &[f64]) -> Vec<f64> {
    let film = optics::film(Complex64::new(a[0], a[1]), a[2], a[3], a[4]);
    vec![
        film.reflectance.unpolarized(),
        film.transmittance.unpolarized(),
    ]
}

const TRANSPARENT: &str =
    "put(0u, clear_film_reflectance(vec4f(a(0u)), a(1u), vec4f(1.0 / a(2u)), a(3u)).x);";
const LOSSY: &str =
    "let f = film_powers(vec4f(a(0u)), vec4f(a(1u)), a(2u), vec4f(1.0 / a(3u)), a(4u));
    put(0u, f.reflectance.x); put(1u, f.transmittance.x);";

/// Ordinary films up to 88° and beyond, and thick ones: one check per tolerance.
fn films() -> Vec<Check> {
    [transparent_films(), lossy_films()]
        .into_iter()
        .flatten()
        .collect()
}

fn transparent_films() -> Vec<Check> {
    let edges: &[&[f32]] = &[
        &[1.333, 0.0, 500.0, 1.0],
        &[1.0, 300.0, 500.0, 0.5],
        &[1.0, 300.0, 500.0, 1e-6],
        &[1.0, 300.0, 500.0, 1e-4],
        &[1.000_000_1, 300.0, 500.0, 1e-4],
        &[1.333, 300.0, 380.0, 1.0],
    ];
    let check = |thickest, cosines, tolerance| Check {
        probe: pure((4, 1), TRANSPARENT),
        proves: &["clear_film_reflectance"],
        inputs: lazy(move || {
            table(
                &[(1.0, 2.5), (0.0, thickest), (360.0, 830.0), cosines],
                edges,
            )
        }),
        twin: transparent_film,
        tolerance,
    };
    vec![
        check(2000.0, (STEEP, 1.0), FILM),
        check(1000.0, (SHALLOW, STEEP), FILM_GRAZING),
        check(20_000.0, (0.17, 1.0), FILM_THICK),
    ]
}

fn lossy_films() -> Vec<Check> {
    let edges: &[&[f32]] = &[
        &[0.4, 2.6, 1e5, 550.0, 0.5],
        &[1.5, 0.0, 300.0, 500.0, 1.0],
        &[0.5, 0.0, 200.0, 500.0, 0.3],
        &[1.0, 0.0, 200.0, 500.0, 1e-4],
    ];
    let check = |cosines, tolerance| Check {
        probe: pure((5, 2), LOSSY),
        proves: &["film_powers"],
        inputs: lazy(move || {
            table(
                &[
                    (0.05, 2.5),
                    (0.0, 4.0),
                    (0.0, 2000.0),
                    (360.0, 830.0),
                    cosines,
                ],
                edges,
            )
        }),
        twin: lossy_film,
        tolerance,
    };
    vec![
        check((STEEP, 1.0), FILM),
        check((SHALLOW, STEEP), FILM_GRAZING),
    ]
}

fn boundary(a: &[f64]) -> Vec<f64> {
    let (r, beta2) = (Complex64::new(a[0], a[1]), Complex64::new(a[2], a[3]));
    let below = 1.0 - r * r * beta2;
    let reflected = (r * (1.0 - beta2) / below).norm_sqr();
    let transmitted = ((1.0 - r * r) / below).norm_sqr() * beta2.norm();
    vec![reflected, transmitted]
}

fn film_parts() -> Vec<Check> {
    vec![
        Check {
            probe: pure((4, 2),
                "let f = film_of_boundary(Complex4(vec4f(a(0u)), vec4f(a(1u))), Complex4(vec4f(a(2u)), vec4f(a(3u))));
                 put(0u, f.reflectance.x); put(1u, f.transmittance.x);",
            ),
            proves: &["film_of_boundary"],
            inputs: lazy(move || table(&[(-0.6, 0.6); 4], &[&[0.0; 4], &[0.6, 0.0, 0.6, 0.6], &[0.3, 0.0, 1.0, 0.0]])),
            twin: boundary,
            tolerance: FRESNEL,
        },
        Check {
            probe: pure((2, 2),
                "let z = phase_factor(vec4f(a(0u)), vec4f(a(1u))); put(0u, z.re.x); put(1u, z.im.x);",
            ),
            proves: &["phase_factor"],
            inputs: lazy(move || table(&[(-6.0, 6.0), (0.0, 3.0)], &[&[0.0, 0.0], &[1.0, 0.0], &[0.5, 0.0], &[0.0, 1e4]])),
            twin: |a| {
                let z = Complex64::new(-PI * a[1], PI * a[0]).exp();
                vec![z.re, z.im]
            },
            // The angle of up to 6π is rounded before it is reduced.
            tolerance: PHASE,
        },
    ]
}

fn facets() -> Vec<Check> {
    let slopes = (0.05, 1.0);
    vec![
        Check {
            probe: pure((2, 1), "put(0u, beckmann_d(a(0u), a(1u)));"),
            proves: &["beckmann_d"],
            inputs: lazy(move || {
                table(
                    &[(0.05, 1.0), slopes],
                    &[&[1.0, 0.05], &[0.0, 0.1], &[-1.0, 0.1], &[1.0, 1.0]],
                )
            }),
            twin: |a| vec![optics::beckmann_d(a[0], a[1])],
            tolerance: pellicle_tests::tolerances::BECKMANN,
        },
        Check {
            probe: pure((4, 1), "put(0u, v_groove_g(a(0u), a(1u), a(2u), a(3u)));"),
            proves: &["v_groove_g"],
            inputs: lazy(move || {
                table(
                    &[(0.0, 1.0), (0.0, 1.0), (0.0, 1.0), (0.05, 1.0)],
                    &[&[0.5, 0.0, 0.5, 0.5], &[0.5, 0.5, -0.5, 0.5]],
                )
            }),
            twin: |a| vec![optics::v_groove_g(a[0], a[1], a[2], a[3])],
            tolerance: FRESNEL,
        },
        Check {
            probe: pure((3, 3), "put3(0u, sample_beckmann(a(0u), a(1u), a(2u)));"),
            proves: &["sample_beckmann"],
            inputs: lazy(move || {
                table(
                    &[(0.0, 0.999_999), (0.0, 0.999_999), slopes],
                    &[&[0.0, 0.0, 0.1], &[0.999_999_9, 0.5, 1.0]],
                )
            }),
            twin: |a| optics::sample_beckmann(a[0], a[1], a[2]).to_vec(),
            tolerance: DIRECTION,
        },
        Check {
            probe: pure((1, 1), "put(0u, log_one_minus(a(0u)));"),
            proves: &["log_one_minus"],
            inputs: lazy(move || {
                table(
                    &[(0.0, 0.999_999)],
                    &[&[0.0], &[1e-7], &[0.031_25], &[0.031_26], &[0.999_999_94]],
                )
            }),
            twin: |a| vec![(-a[0]).ln_1p()],
            tolerance: pellicle_tests::tolerances::LOGARITHM,
        },
    ]
}
