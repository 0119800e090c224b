//! Functions of polarized.wgsl, mueller.wgsl and polarization.wgsl. Interfaces and films are compared with complex amplitudes.

use crate::{Check, lazy, pure, table};
use glam::DVec3;
use num_complex::Complex64;
use optics::{Layer, PathDifference};
use pellicle_tests::agreement::Tolerance;
use pellicle_tests::tolerances::{
    ARITHMETIC, AXIS, FILM, FILM_GRAZING, FILM_POLARIZED, FILM_POLARIZED_GRAZING, FILM_THICK,
    FRESNEL,
};
use reference::{Turn, axis_across};
use std::f64::consts::TAU;

pub(crate) fn checks() -> Vec<Check> {
    let mut all = vec![interface(), two_beams(), parts(), axes(), turns()];
    all.extend(clear_films());
    all.extend(lossy_films());
    all.extend(stacks());
    all.extend(matrices());
    all
}

/// cos 88°.
const STEEP: f32 = 0.0349;
/// cos 89.99°.
const SHALLOW: f32 = 1.745e-4;

/// |a|², |b|², and the real and imaginary part of a b*.
fn powers(a: Complex64, b: Complex64) -> [f64; 4] {
    let both = a * b.conj();
    [a.norm_sqr(), b.norm_sqr(), both.re, both.im]
}

fn interface() -> Check {
    Check {
        probe: pure(
            (3, 4),
            "let r = interface_polarized(vec4f(a(0u)), vec4f(a(1u)), a(2u));
             put4(0u, vec4f(r.s.x, r.p.y, r.re.z, r.im.w));",
        ),
        proves: &["interface_polarized"],
        inputs: lazy(move || {
            table(
                &[(0.02, 5.0), (0.0, 8.0), (SHALLOW, 1.0)],
                &[
                    &[1.5, 0.0, 1.0],
                    &[1.5, 0.0, 0.554_700_2],
                    &[0.136, 4.011, std::f32::consts::FRAC_1_SQRT_2],
                    &[1.0, 0.0, 0.5],
                    &[1.0, 0.0, 1e-6],
                    &[0.05, 0.0, 0.3],
                    &[4.0, 8.0, 1e-6],
                ],
            )
        }),
        twin: |a| {
            let found = optics::stack(1.0, &[], Complex64::new(a[0], a[1]), 500.0, a[2]);
            powers(found.amplitudes.r_s, found.amplitudes.r_p).to_vec()
        },
        tolerance: FRESNEL,
    }
}

/// What a stack between equal media reflects and transmits, by its amplitudes.
fn film_twin(layers: &[Layer], wavelength_nm: f64, cosine: f64) -> Vec<f64> {
    let found = optics::stack(1.0, layers, Complex64::ONE, wavelength_nm, cosine.max(1e-6));
    let all = found.amplitudes;
    [powers(all.r_s, all.r_p), powers(all.t_s, all.t_p)].concat()
}

fn one_layer(index: Complex64, thickness_nm: f64) -> [Layer; 1] {
    [Layer {
        index,
        thickness_nm,
    }]
}

fn clear_films() -> Vec<Check> {
    let edges: &[&[f32]] = &[
        &[1.333, 0.0, 500.0, 1.0],
        &[1.0, 300.0, 500.0, 0.5],
        &[1.0, 300.0, 500.0, 1e-6],
        &[1.000_000_1, 300.0, 500.0, 1e-4],
        &[1.333, 300.0, 380.0, 0.6],
    ];
    let check = |thickest, cosines, tolerance| Check {
        probe: pure((4, 8), CLEAR),
        proves: &["clear_film_polarized"],
        inputs: lazy(move || {
            table(
                &[(1.0, 2.5), (0.0, thickest), (360.0, 830.0), cosines],
                edges,
            )
        }),
        twin: |a| film_twin(&one_layer(a[0].into(), a[1]), a[2], a[3]),
        tolerance,
    };
    vec![
        check(2000.0, (STEEP, 1.0), FILM_POLARIZED),
        check(1000.0, (SHALLOW, STEEP), FILM_POLARIZED_GRAZING),
        check(20_000.0, (0.17, 1.0), FILM_THICK),
    ]
}

const CLEAR: &str = "let f = clear_film_polarized(vec4f(a(0u)), a(1u), vec4f(1.0 / a(2u)), a(3u));
    put4(0u, vec4f(f.reflected.s.x, f.reflected.p.y, f.reflected.re.z, f.reflected.im.w));
    put4(4u, vec4f(f.transmitted.s.x, f.transmitted.p.y, f.transmitted.re.z, f.transmitted.im.w));";

fn lossy_films() -> Vec<Check> {
    let edges: &[&[f32]] = &[
        &[0.4, 2.6, 1e5, 550.0, 0.5],
        &[1.5, 0.0, 300.0, 500.0, 1.0],
        &[0.5, 0.0, 200.0, 500.0, 0.3],
        &[1.0, 0.0, 200.0, 500.0, 1e-4],
    ];
    let check = |cosines, tolerance| Check {
        probe: pure((5, 8), LOSSY),
        proves: &["film_polarized", "boundary_amplitudes"],
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
        twin: |a| film_twin(&one_layer(Complex64::new(a[0], a[1]), a[2]), a[3], a[4]),
        tolerance,
    };
    vec![
        check((STEEP, 1.0), FILM),
        check((SHALLOW, STEEP), FILM_GRAZING),
    ]
}

const LOSSY: &str =
    "let f = film_polarized(vec4f(a(0u)), vec4f(a(1u)), a(2u), vec4f(1.0 / a(3u)), a(4u));
    put4(0u, vec4f(f.reflected.s.x, f.reflected.p.y, f.reflected.re.z, f.reflected.im.w));
    put4(4u, vec4f(f.transmitted.s.x, f.transmitted.p.y, f.transmitted.re.z, f.transmitted.im.w));";

/// The amplitudes of two beams, from Fresnel's.
fn two_beam_twin(a: &[f64]) -> Vec<f64> {
    let (n, cosine) = (Complex64::from(a[0]), a[3].max(1e-6));
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    let inside = optics::cos_refracted(n, sine.into());
    let first = optics::fresnel(Complex64::ONE, cosine.into(), n, inside);
    let length = 2.0 * a[1] * inside.re * if a[4] > 0.5 { 1.0 } else { a[0] };
    let turn = Complex64::from_polar(1.0, TAU * length / a[2]);
    let beams = |r: Complex64| r - (1.0 - r * r) * r * turn;
    let through = |r: Complex64| 1.0 - r * r;
    [
        powers(beams(first.r_s), beams(first.r_p)),
        powers(through(first.r_s), through(first.r_p)),
    ]
    .concat()
}

fn two_beams() -> Check {
    Check {
        probe: pure(
            (5, 8),
            "let f = two_beam_polarized(vec4f(a(0u)), a(1u), vec4f(1.0 / a(2u)), a(3u), a(4u) > 0.5);
             put4(0u, vec4f(f.reflected.s.x, f.reflected.p.y, f.reflected.re.z, f.reflected.im.w));
             put4(4u, vec4f(f.transmitted.s.x, f.transmitted.p.y, f.transmitted.re.z, f.transmitted.im.w));",
        ),
        proves: &["two_beam_polarized", "amplitude_powers"],
        inputs: lazy(move || {
            table(
                &[(1.0, 2.5), (0.0, 2000.0), (360.0, 830.0), (STEEP, 1.0), (0.0, 1.0)],
                &[&[1.333, 0.0, 500.0, 1.0, 0.0], &[1.0, 300.0, 500.0, 0.5, 1.0]],
            )
        }),
        twin: |a| {
            let path = [PathDifference::Optical, PathDifference::AsPrinted][usize::from(a[4] > 0.5)];
            let found = two_beam_twin(a);
            let printed = optics::two_beam(a[0], a[1], a[2], a[3].max(1e-6), path);
            assert!((found[0] - printed.reflectance.s).abs() < 1e-9, "{a:?}");
            found
        },
        tolerance: FILM,
    }
}

/// Two layers on a substrate, as in the check of unpolarized stacks.
const STACK: &str = "
    let n0 = a(0u);
    let incident = Incident(n0 * n0, n0 * n0 * a(1u) * a(1u));
    let substrate = substrate_admittances(vec4f(a(3u)), vec4f(a(4u)), incident);
    var stack = stack_layer(stack_on(substrate), vec4f(a(8u)), vec4f(a(9u)), vec4f(a(10u) / a(2u)), incident);
    stack = stack_layer(stack, vec4f(a(5u)), vec4f(a(6u)), vec4f(a(7u) / a(2u)), incident);
    let f = stack_polarized(stack, substrate, incident);
    put4(0u, vec4f(f.reflected.s.x, f.reflected.p.y, f.reflected.re.z, f.reflected.im.w));
    put4(4u, vec4f(f.transmitted.s.x, f.transmitted.p.y, f.transmitted.re.z, f.transmitted.im.w));";

/// Transmitted light has the powers that enter the substrate, and the phases of the electric field of s and the magnetic field of p.
fn stack_twin(a: &[f64]) -> Vec<f64> {
    let index = |n: usize| Complex64::new(a[n], a[n + 1]);
    let layers = [5, 8].map(|n| Layer {
        index: index(n),
        thickness_nm: a[n + 2],
    });
    let found = optics::stack(a[0], &layers, index(3), a[2], a[1]);
    let all = found.amplitudes;
    let with_power = |amplitude: Complex64, power: f64| {
        let size = amplitude.norm();
        if size > 0.0 {
            amplitude * (power.sqrt() / size)
        } else {
            Complex64::ZERO
        }
    };
    let s = with_power(all.t_s, found.transmittance.s);
    let p = with_power(all.t_p * index(3), found.transmittance.p);
    [powers(all.r_s, all.r_p), powers(s, p)].concat()
}

fn stacks() -> Vec<Check> {
    let check = |cosines, thickest, tolerance| Check {
        probe: pure((11, 8), STACK),
        proves: &["stack_polarized", "top_amplitudes"],
        inputs: lazy(move || {
            let thickness = (0.0, thickest);
            table(
                &[
                    (1.0, 1.0),
                    cosines,
                    (360.0, 830.0),
                    (0.05, 4.5),
                    (0.0, 6.0),
                    (1.2, 2.6),
                    (0.0, 0.3),
                    thickness,
                    (0.1, 3.0),
                    (0.0, 3.0),
                    thickness,
                ],
                &[
                    &[1.0, 0.5, 500.0, 1.0, 0.0, 1.0, 0.0, 100.0, 1.0, 0.0, 100.0],
                    &[1.5, 0.8, 500.0, 1.0, 0.0, 1.5, 0.0, 80.0, 1.0, 0.0, 0.0],
                    &[1.5, 0.5, 500.0, 1.5, 0.0, 1.0, 0.0, 90.0, 1.0, 0.0, 30.0],
                    &[1.0, 0.5, 500.0, 1.5, 0.0, 1.46, 0.0, 120.0, 2.3, 0.0, 60.0],
                ],
            )
        }),
        twin: stack_twin,
        tolerance,
    };
    vec![
        check((STEEP, 1.0), 1000.0, FILM),
        check((SHALLOW, STEEP), 500.0, FILM_GRAZING),
    ]
}

fn parts() -> Check {
    Check {
        probe: pure(
            (5, 4),
            "let f = scaled_powers(PolarizedPowers(vec4f(a(0u)), vec4f(a(1u)), vec4f(a(2u)), vec4f(a(3u))), vec4f(a(4u)));
             put4(0u, vec4f(f.s.x, f.p.y, f.re.z, f.im.w));",
        ),
        proves: &["scaled_powers"],
        inputs: lazy(|| table(&[(-1.0, 1.0); 5], &[])),
        twin: |a| a[..4].iter().map(|x| x * a[4]).collect(),
        tolerance: ARITHMETIC,
    }
}

/// The range of elements.
const VECTORS: (f32, f32) = (-1.0, 1.0);

fn matrices() -> Vec<Check> {
    vec![
        Check {
            probe: pure(
                (12, 4),
                "let m = Mueller(vec4f(a(0u)), vec4f(a(1u)), vec4f(a(2u)), vec4f(a(3u)), vec4f(a(4u)), vec4f(a(5u)));
                 let light = Stokes4(vec4f(a(6u)), vec4f(a(7u)), vec4f(a(8u)), vec4f(a(9u)));
                 let turn = direction_of_turn(a(10u));
                 let sum = mueller_and_depolarizer(mueller_sum(m, mueller_depolarizer(vec4f(a(11u)))), vec4f(1.0));
                 let turned = stokes_turned(turn, mueller_apply(sum, light));
                 let found = stokes_sum(turned, mueller_apply(mueller_identity(), stokes_scaled(light, a(11u))));
                 put4(0u, vec4f(found.s0.x, found.s1.y, found.s2.z, found.s3.w));",
            ),
            proves: &[
                "mueller_apply",
                "mueller_sum",
                "mueller_depolarizer",
                "mueller_and_depolarizer",
                "stokes_turned",
                "stokes_sum",
                "stokes_scaled",
                "mueller_identity",
            ],
            inputs: lazy(|| table(&[VECTORS; 12], &[])),
            twin: |a| {
                // By matrices of 4×4, and the rotation of the crate `optics`.
                let mut rows = [[0.0; 4]; 4];
                rows[0][..2].copy_from_slice(&[a[0] + a[11] + 1.0, a[1]]);
                rows[1][..2].copy_from_slice(&[a[2], a[3]]);
                rows[2][2..].copy_from_slice(&[a[4], a[5]]);
                rows[3][2..].copy_from_slice(&[-a[5], a[4]]);
                let light = [a[6], a[7], a[8], a[9]];
                let turned = optics::Mueller::rotation(0.5 * TAU * a[10]) * optics::Mueller(rows);
                let found = turned.apply(light);
                found.iter().zip(light).map(|(x, y)| x + a[11] * y).collect()
            },
            tolerance: Tolerance {
                absolute: 2e-6,
                relative: 0.0,
            },
        },
        Check {
            probe: pure(
                (9, 12),
                "let m = mueller_of(PolarizedPowers(vec4f(a(0u)), vec4f(a(1u)), vec4f(a(2u)), vec4f(a(3u))), a(8u));
                 put4(0u, vec4f(m.m00.x, m.m01.y, m.m10.z, m.m11.w)); put(4u, m.m22.x); put(5u, m.m23.y);
                 let p = mueller_product(vec4f(a(4u)), vec4f(a(5u)), vec4f(a(6u)), vec4f(a(7u)), vec4f(a(8u)));
                 put4(6u, vec4f(p.m00.x, p.m01.y, p.m10.z, p.m11.w)); put(10u, p.m22.x); put(11u, p.m23.y);",
            ),
            proves: &["mueller_of", "mueller_product"],
            inputs: lazy(|| table(&[VECTORS; 9], &[])),
            twin: |a| {
                let by_amplitudes = optics::Mueller::from_powers(optics::wide::PolarizedPowers {
                    s: a[0],
                    p: a[1],
                    re: a[2],
                    im: a[3],
                });
                // Two diattenuators without phases, with a depolarizer in between.
                let diattenuator = |s, p| {
                    optics::Mueller::from_powers(optics::wide::PolarizedPowers {
                        s,
                        p,
                        re: 0.0,
                        im: 0.0,
                    })
                };
                let mut depolarizer = [[0.0; 4]; 4];
                depolarizer[0][0] = a[8];
                let through = diattenuator(a[4], a[5])
                    * optics::Mueller(depolarizer)
                    * diattenuator(a[6], a[7]);
                let elements = |m: optics::Mueller, weight: f64| {
                    let m = m.0;
                    [m[0][0], m[0][1], m[1][0], m[1][1], m[2][2], m[2][3]].map(|x| weight * x)
                };
                [elements(by_amplitudes, a[8]), elements(through, 1.0)].concat()
            },
            tolerance: ARITHMETIC,
        },
    ]
}

fn vector(a: &[f64]) -> DVec3 {
    DVec3::new(a[0], a[1], a[2])
}

/// Axes where directions are not almost parallel: there, the last digits decide, and the matrices do not depend on the axis.
fn axes() -> Check {
    Check {
        probe: pure(
            (6, 3),
            "put3(0u, axis_across(normalize(a3(0u)), normalize(a3(3u))));",
        ),
        proves: &["axis_across"],
        inputs: lazy(|| {
            table(
                &[
                    (0.5, 1.0),
                    (-1.0, 1.0),
                    (-1.0, 1.0),
                    (-1.0, 0.4),
                    (-1.0, 1.0),
                    (1.5, 3.0),
                ],
                &[
                    &[1.0, 0.0, 0.0, 1.0, 0.0, 0.0],
                    &[0.0, 1.0, 0.0, 0.0, -1.0, 0.0],
                ],
            )
        }),
        twin: |a| {
            let (a, b) = (vector(a).normalize(), vector(&a[3..]).normalize());
            axis_across(a, b).to_array().to_vec()
        },
        tolerance: AXIS,
    }
}

fn turns() -> Check {
    Check {
        probe: pure(
            (7, 4),
            "let across = frame_of(normalize(a3(0u)));
             let before = across[0];
             let aside = direction_of_turn(a(3u));
             let after = aside.x * across[0] + aside.y * across[1];
             let turn = turn_between(before, after, across[2]);
             put(0u, turn.x); put(1u, turn.y);
             let turned = turned_axis(turn, vec2f(a(4u), a(5u)));
             put(2u, turned.x); put(3u, turned.y);",
        ),
        proves: &["turn_between", "turned_axis"],
        inputs: lazy(|| {
            table(
                &[
                    VECTORS,
                    VECTORS,
                    (1.1, 2.0),
                    (0.0, 1.0),
                    VECTORS,
                    VECTORS,
                    VECTORS,
                ],
                &[],
            )
        }),
        twin: |a| {
            let direction = vector(a).normalize();
            let frame = reference::frame_of(direction);
            let angle = TAU * a[3];
            let after = frame.x_axis * angle.cos() + frame.y_axis * angle.sin();
            let turn = Turn::between(frame.x_axis, after, direction);
            // The angle itself is the twin of the turn.
            assert!((turn.cos - (2.0 * angle).cos()).abs() < 1e-12);
            assert!((turn.sin - (2.0 * angle).sin()).abs() < 1e-12);
            let [s1, s2] = turn.turned([a[4], a[5]]);
            vec![turn.cos, turn.sin, s1, s2]
        },
        tolerance: Tolerance {
            absolute: 4e-6,
            relative: 0.0,
        },
    }
}
