//! Functions of stack.wgsl and two_beam.wgsl.

use crate::{Check, lazy, pure, table};
use num_complex::Complex64;
use optics::{Layer, PathDifference};
use pellicle_tests::agreement::Tolerance;
use pellicle_tests::tolerances::{FILM, FILM_GRAZING, FILM_THICK};

pub(crate) fn checks() -> Vec<Check> {
    let mut all = two_beams();
    all.extend([
        stack((STEEP, 1.0), 1000.0, FILM),
        stack((SHALLOW, STEEP), 500.0, FILM_GRAZING),
        stack((0.17, 1.0), 10_000.0, FILM_THICK),
    ]);
    all
}

/// cos 88°.
const STEEP: f32 = 0.0349;
/// cos 89.99°.
const SHALLOW: f32 = 1.745e-4;

/// Two layers on a substrate: incident index, its cosine, wavelength, the substrate's n and k, and n, k and thickness of each layer,
/// the upper one first.
const STACK: &str = "
    let n0 = a(0u);
    let incident = Incident(n0 * n0, n0 * n0 * a(1u) * a(1u));
    let substrate = substrate_admittances(vec4f(a(3u)), vec4f(a(4u)), incident);
    var stack = stack_layer(stack_on(substrate), vec4f(a(8u)), vec4f(a(9u)), vec4f(a(10u) / a(2u)), incident);
    stack = stack_layer(stack, vec4f(a(5u)), vec4f(a(6u)), vec4f(a(7u) / a(2u)), incident);
    let powers = stack_powers(stack, substrate, incident);
    put(0u, powers.reflectance_s.x); put(1u, powers.reflectance_p.y);
    put(2u, powers.transmittance_s.z); put(3u, powers.transmittance_p.w);";

fn stack(cosines: (f32, f32), thickest: f32, tolerance: Tolerance) -> Check {
    let thickness = (0.0, thickest);
    Check {
        probe: pure((11, 4), STACK),
        proves: &[
            "stack_on",
            "stack_layer",
            "substrate_admittances",
            "medium_q2",
            "layer_phase",
            "exponential_quotient",
            "fields_above",
            "stack_powers",
            "powers_of",
            "complex_recip",
            "complex_scale",
        ],
        inputs: lazy(move || {
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
                    // Nothing but air; a bare mirror; glass seen from within, below, near and beyond the critical angle.
                    &[1.0, 0.5, 500.0, 1.0, 0.0, 1.0, 0.0, 100.0, 1.0, 0.0, 100.0],
                    &[1.0, 1.0, 500.0, 0.05, 3.4, 1.5, 0.0, 0.0, 1.5, 0.0, 0.0],
                    &[1.5, 0.8, 500.0, 1.0, 0.0, 1.5, 0.0, 80.0, 1.0, 0.0, 0.0],
                    &[1.5, 0.745, 500.0, 1.0, 0.0, 1.5, 0.0, 80.0, 1.0, 0.0, 50.0],
                    &[1.5, 0.5, 500.0, 1.0, 0.0, 1.5, 0.0, 80.0, 1.0, 0.0, 50.0],
                    // Frustrated total reflection: glass, a gap of air, glass.
                    &[1.5, 0.5, 500.0, 1.5, 0.0, 1.0, 0.0, 90.0, 1.0, 0.0, 30.0],
                    // A layer at its critical angle, and close to it on either side.
                    &[
                        2.0,
                        0.866_025_4,
                        550.0,
                        2.0,
                        0.0,
                        1.0,
                        0.0,
                        300.0,
                        1.0,
                        0.0,
                        0.0,
                    ],
                    &[
                        2.0, 0.866_03, 550.0, 2.0, 0.0, 1.0, 0.0, 300.0, 1.0, 0.0, 0.0,
                    ],
                    &[
                        2.0, 0.866_02, 550.0, 1.0, 0.0, 1.0, 0.0, 300.0, 1.4, 0.0, 200.0,
                    ],
                    &[
                        1.5, 0.745_356, 500.0, 1.5, 0.0, 1.0, 0.0, 300.0, 1.0, 0.0, 0.0,
                    ],
                    // An opaque layer.
                    &[
                        1.0, 0.5, 500.0, 1.5, 0.0, 0.4, 2.6, 30_000.0, 1.5, 0.0, 300.0,
                    ],
                ],
            )
        }),
        twin: stack_twin,
        tolerance,
    }
}

fn stack_twin(a: &[f64]) -> Vec<f64> {
    let index = |n: usize| Complex64::new(a[n], a[n + 1]);
    let layers = [5, 8].map(|n| Layer {
        index: index(n),
        thickness_nm: a[n + 2],
    });
    let found = optics::stack(a[0], &layers, index(3), a[2], a[1]);
    let (r, t) = (found.reflectance, found.transmittance);
    vec![r.s, r.p, t.s, t.p]
}

fn two_beams() -> Vec<Check> {
    vec![Check {
        probe: pure(
            (4, 3),
            "let n = vec4f(a(0u)); let inverse = vec4f(1.0 / a(2u));
             put(0u, two_beam_reflectance(n, a(1u), inverse, a(3u), false).x);
             put(1u, two_beam_reflectance(n, a(1u), inverse, a(3u), true).y);
             put(2u, two_beam_transmittance(n, a(3u)).z);",
        ),
        proves: &[
            "two_beam_reflectance",
            "two_beam_transmittance",
            "two_beam_boundary",
            "two_beams",
        ],
        inputs: lazy(move || {
            table(
                &[(1.0, 2.5), (0.0, 2000.0), (360.0, 830.0), (STEEP, 1.0)],
                &[
                    &[1.333, 0.0, 500.0, 1.0],
                    &[1.0, 300.0, 500.0, 0.5],
                    &[1.333, 300.0, 500.0, 1e-6],
                ],
            )
        }),
        twin: |a| {
            let beams = |path| optics::two_beam(a[0], a[1], a[2], a[3].max(1e-6), path);
            let optical = beams(PathDifference::Optical);
            let printed = beams(PathDifference::AsPrinted);
            vec![
                optical.reflectance.unpolarized(),
                printed.reflectance.unpolarized(),
                optical.transmittance.unpolarized(),
            ]
        },
        tolerance: FILM,
    }]
}

/// The comparison can fail: the layers in the wrong order, and the path of one beam without its index.
pub(crate) fn a_wrong_twin_of_a_stack_is_noticed() {
    let mut check = stack((STEEP, 1.0), 1000.0, FILM);
    check.twin = |a| {
        let swapped = [&a[..5], &a[8..11], &a[5..8]].concat();
        stack_twin(&swapped)
    };
    assert!(check.run().is_err());
}
