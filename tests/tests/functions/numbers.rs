//! Functions of trig.wgsl, random.wgsl and complex.wgsl.

use crate::{Check, lazy, pure, table};
use num_complex::Complex64;
use pellicle_tests::tolerances::{ARITHMETIC, EXACT, TRIGONOMETRY};
use std::f64::consts::{PI, TAU};

pub(crate) fn checks() -> Vec<Check> {
    [trig(), random(), sobol(), complex()]
        .into_iter()
        .flatten()
        .collect()
}

fn trig() -> Vec<Check> {
    vec![
        Check {
            probe: pure((1, 1), "put(0u, sin_pi4(vec4f(a(0u))).x);"),
            proves: &["sin_pi4"],
            inputs: lazy(move || table(&[(-0.5, 0.5)], &[&[0.0], &[0.5], &[-0.5], &[1e-20]])),
            twin: |a| vec![(PI * a[0]).sin()],
            tolerance: TRIGONOMETRY,
        },
        Check {
            probe: pure((1, 1), "put(0u, sine_of_half_turns(a(0u)));"),
            proves: &["sine_of_half_turns"],
            inputs: lazy(move || table(&[(-8.0, 8.0)], &[&[0.0], &[0.5], &[1.0], &[-3.0], &[2.5]])),
            twin: |a| vec![(PI * a[0]).sin()],
            tolerance: TRIGONOMETRY,
        },
        Check {
            probe: pure(
                (1, 2),
                "let d = direction_of_turn(a(0u)); put(0u, d.x); put(1u, d.y);",
            ),
            proves: &["direction_of_turn"],
            inputs: lazy(move || {
                table(
                    &[(-1.0, 1.0)],
                    &[&[0.0], &[0.25], &[0.5], &[0.75], &[1.0], &[-1.0]],
                )
            }),
            twin: |a| vec![(TAU * a[0]).cos(), (TAU * a[0]).sin()],
            tolerance: TRIGONOMETRY,
        },
        Check {
            probe: pure((2, 1), "put(0u, polar_angle(a(0u), a(1u)));"),
            proves: &["polar_angle"],
            inputs: lazy(move || {
                table(
                    &[(-1.0, 1.0), (0.0, 1.0)],
                    &[
                        &[1.0, 0.0],
                        &[-1.0, 0.0],
                        &[0.0, 1.0],
                        &[1.0, 1.0],
                        &[-1.0, 1.0],
                        &[1.0, 1e-6],
                    ],
                )
            }),
            twin: |a| vec![a[1].atan2(a[0])],
            tolerance: TRIGONOMETRY,
        },
    ]
}

fn halves(x: u32) -> [f64; 2] {
    [f64::from(x & 0xffff), f64::from(x >> 16)]
}

fn integer(a: &[f64], i: usize) -> u32 {
    (a[i] as u32) | ((a[i + 1] as u32) << 16)
}

fn integers(a: &[f64]) -> [u32; 4] {
    std::array::from_fn(|i| integer(a, 2 * i))
}

/// Rows of four random integers, as halves, and the extremes.
fn integer_table() -> Vec<f32> {
    integer_table_of(8)
}

/// The same with another number of halves.
fn integer_table_of(halves: usize) -> Vec<f32> {
    let edges = [vec![0.0; halves], vec![65535.0; halves]];
    let mut rows = table(&vec![(0.0, 65536.0); halves], &[&edges[0], &edges[1]]);
    for x in &mut rows {
        *x = x.floor().min(65535.0);
    }
    rows
}

fn random() -> Vec<Check> {
    vec![
        Check {
            probe: pure((8, 8),
                "let r = pcg4d(vec4u(integer(0u), integer(2u), integer(4u), integer(6u)));
                 put_integer(0u, r.x); put_integer(2u, r.y); put_integer(4u, r.z); put_integer(6u, r.w);",
            ),
            proves: &["pcg4d"],
            inputs: lazy(integer_table),
            twin: |a| reference::pcg4d(integers(a)).into_iter().flat_map(halves).collect(),
            tolerance: EXACT,
        },
        Check {
            probe: pure((8, 4),
                "put4(0u, unit_interval(vec4u(integer(0u), integer(2u), integer(4u), integer(6u))));",
            ),
            proves: &["unit_interval"],
            inputs: lazy(integer_table),
            twin: |a| reference::unit_interval(integers(a)).to_vec(),
            tolerance: EXACT,
        },
        Check {
            probe: pure((8, 4),
                "put4(0u, random4(vec2u(integer(0u) & 0xffffu, integer(2u) & 0xffffu), integer(4u), integer(6u), 5u));",
            ),
            proves: &["random4"],
            inputs: lazy(integer_table),
            twin: |a| {
                let [x, y, sample, dimension] = integers(a);
                reference::random4([x & 0xffff, y & 0xffff], sample, dimension, 5).to_vec()
            },
            tolerance: EXACT,
        },
    ]
}

fn sobol() -> Vec<Check> {
    vec![
        Check {
            probe: pure((4, 2),
                "put_integer(0u, scrambled(vec4u(integer(0u)), vec4u(integer(2u))).z);",
            ),
            proves: &["scrambled"],
            inputs: lazy(move || integer_table_of(4)),
            twin: |a| halves(reference::scrambled_reversed(integer(a, 0), integer(a, 2))).to_vec(),
            tolerance: EXACT,
        },
        Check {
            probe: pure((2, 8),
                "let p = sobol_point(integer(0u));
                 put_integer(0u, p.x); put_integer(2u, p.y); put_integer(4u, p.z); put_integer(6u, p.w);",
            ),
            proves: &["bit_of", "sobol_point"],
            inputs: lazy(move || integer_table_of(2)),
            twin: |a| {
                let point = reference::sobol_point(integer(a, 0).reverse_bits());
                point.iter().flat_map(|x| halves(x.reverse_bits())).collect()
            },
            tolerance: EXACT,
        },
        Check {
            probe: pure((8, 4),
                "put4(0u, sobol4(vec2u(integer(0u) & 0xffffu, integer(2u) & 0xffffu), integer(4u), integer(6u), 5u));",
            ),
            proves: &["sobol4"],
            inputs: lazy(integer_table),
            twin: |a| {
                let [x, y, sample, dimension] = integers(a);
                reference::sobol4([x & 0xffff, y & 0xffff], sample, dimension, 5).to_vec()
            },
            tolerance: EXACT,
        },
    ]
}

fn pair(a: &[f64]) -> (Complex64, Complex64) {
    (Complex64::new(a[0], a[1]), Complex64::new(a[2], a[3]))
}

fn parts(z: Complex64) -> Vec<f64> {
    vec![z.re, z.im]
}

fn complex() -> Vec<Check> {
    let numbers = || {
        table(
            &[(-4.0, 4.0); 4],
            &[&[0.0, 0.0, 1.0, 0.0], &[1.0, -1.0, 0.0, 2.0]],
        )
    };
    // Divisors away from 0, where the quotient would be large.
    let divisors = || {
        table(
            &[(-4.0, 4.0), (-4.0, 4.0), (0.5, 4.0), (-4.0, 4.0)],
            &[&[0.0, 0.0, 1.0, 0.0]],
        )
    };
    let roots = || {
        table(
            &[(-16.0, 16.0), (-16.0, 16.0)],
            &[
                &[4.0, 0.0],
                &[-4.0, 0.0],
                &[0.0, 2.0],
                &[0.0, -2.0],
                &[-9.0, 1e-4],
                &[9.0, 1e-4],
            ],
        )
    };
    macro_rules! binary {
        ($name:literal, $inputs:expr, $twin:expr) => {
            Check {
                probe: pure((4, 2),
                    concat!(
                        "let z = ", $name, "(Complex4(vec4f(a(0u)), vec4f(a(1u))), Complex4(vec4f(a(2u)), vec4f(a(3u))));",
                        "put(0u, z.re.y); put(1u, z.im.z);"
                    ),
                ),
                proves: &[$name],
                inputs: lazy($inputs),
                twin: $twin,
                tolerance: ARITHMETIC_OF_TENS,
            }
        };
    }
    vec![
        binary!("complex_add", numbers, |a| parts(pair(a).0 + pair(a).1)),
        binary!("complex_sub", numbers, |a| parts(pair(a).0 - pair(a).1)),
        binary!("complex_mul", numbers, |a| parts(pair(a).0 * pair(a).1)),
        binary!("complex_div", divisors, |a| parts(pair(a).0 / pair(a).1)),
        Check {
            probe: pure(
                (2, 1),
                "put(0u, complex_norm_sqr(Complex4(vec4f(a(0u)), vec4f(a(1u)))).w);",
            ),
            proves: &["complex_norm_sqr"],
            inputs: lazy(roots),
            twin: |a| vec![a[0] * a[0] + a[1] * a[1]],
            tolerance: ARITHMETIC,
        },
        Check {
            probe: pure(
                (2, 2),
                "let z = complex_sqrt(Complex4(vec4f(a(0u)), vec4f(a(1u)))); put(0u, z.re.x); put(1u, z.im.x);",
            ),
            proves: &["complex_sqrt"],
            inputs: lazy(roots),
            twin: |a| parts(Complex64::new(a[0], a[1]).sqrt()),
            tolerance: ARITHMETIC,
        },
    ]
}

/// Products of numbers up to 4: sums of terms up to 16, and their rounding.
const ARITHMETIC_OF_TENS: pellicle_tests::agreement::Tolerance =
    pellicle_tests::agreement::Tolerance {
        absolute: 8e-6,
        relative: 5e-7,
    };
