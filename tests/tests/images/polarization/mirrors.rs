//! Smooth surfaces: Brewster's angle, metals, two mirrors, and films that light passes.

use super::bench::{
    NM, SAMPLE, about, angle_between, assert_matrix, assert_stokes, body, camera_at, coated, free,
    in_plane, mueller, render, seen, surroundings,
};
use super::oracle::{Pair, airy, bare};
use glam::DVec3;
use gpu::Gpu;
use optics::{Complex64, Layer, Mueller};
use pellicle_tests::device::lend;

const GLASS: Complex64 = Complex64::new(1.5, 0.0);
const GOLD: Complex64 = Complex64::new(0.2, 3.2);

/// tan θ = n (Brewster, Philosophical Transactions 105, 125–159, 1815).
fn brewster_deg() -> f64 {
    1.5_f64.atan().to_degrees()
}

/// At tan θ = 1.5, θ = 56.3099°: rₛ = −5/13, rₚ = 0.
#[test]
fn glass_at_brewsters_angle_reflects_s_alone() {
    let gpu = lend();
    let half = 25.0 / 338.0;
    assert!((half - 0.073_964_5_f64).abs() < 1e-7);
    let camera = camera_at(brewster_deg(), "");
    for (stokes, expected) in [
        ([0.0, 0.0, 0.0], half),
        ([1.0, 0.0, 0.0], 2.0 * half),
        ([-1.0, 0.0, 0.0], 0.0),
        ([0.4, 0.0, 0.0], 1.4 * half),
        ([0.0, 1.0, 0.0], half),
        ([0.0, 0.0, -1.0], half),
    ] {
        let parts = [
            &camera,
            &render(1),
            &body(GLASS),
            SAMPLE,
            &surroundings(stokes),
        ];
        for (renderer, found) in seen(&gpu, &parts) {
            for found in found {
                let expected = [expected, expected, 0.0, 0.0];
                assert_stokes(&format!("{stokes:?}"), renderer, found, expected);
            }
        }
    }
}

/// All of a surface's matrix, from every side of Brewster's angle to near grazing.
#[test]
fn surfaces_have_the_matrices_of_their_amplitudes() {
    let gpu = lend();
    for index in [GLASS, GOLD] {
        for degrees in [0.0, 20.0, 45.0, 60.0, 75.0, 85.0] {
            let camera = camera_at(degrees, "");
            let parts = |stokes| {
                [
                    &camera,
                    &render(1),
                    &body(index),
                    SAMPLE,
                    &surroundings(stokes),
                ]
                .join("\n")
            };
            let amplitudes = bare(index, degrees);
            for (renderer, matrices) in mueller(&gpu, parts) {
                let what = format!("{index}, {degrees}°");
                for matrix in &matrices {
                    assert_matrix(&what, renderer, matrix, |s| amplitudes.apply(s));
                }
            }
        }
    }
}

/// At normal incidence S1 stays and S2 and S3 change their signs, since the reflected light travels back; near grazing a metal leaves both.
#[test]
fn a_metal_turns_circular_light_around() {
    let gpu = lend();
    let circular = surroundings([0.0, 0.0, 1.0]);
    for (degrees, sign) in [(0.0, -1.0), (30.0, -1.0), (89.0, 1.0)] {
        let camera = camera_at(degrees, "");
        let parts = [&camera, &render(1), &body(GOLD), SAMPLE, &circular];
        for (renderer, found) in seen(&gpu, &parts) {
            assert!(
                found[0][3] * sign > 0.5 * found[0][0],
                "{renderer}, {degrees}°: {found:?}"
            );
        }
    }
}

/// Unpolarized light that two mirrors reflect, with the angle φ between the planes of incidence: S0 = a² + b² cos 2φ, with a and b half the
/// sum and half the difference of Rₛ and Rₚ. Without polarization it would be a². At Brewster's angle crossed mirrors extinguish.
#[test]
fn crossed_mirrors_extinguish_at_brewsters_angle() {
    let gpu = lend();
    for (degrees, index) in [(brewster_deg(), GLASS), (45.0, GLASS), (65.0, GOLD)] {
        for between in [0.0_f64, 30.0, 90.0, 135.0] {
            let amplitudes = bare(index, degrees);
            let [r_s, r_p] = amplitudes.powers();
            let (a, b) = (0.5 * (r_s + r_p), 0.5 * (r_s - r_p));
            let s0 = a * a + b * b * (2.0 * between).to_radians().cos();
            let camera = camera_at(degrees, "");
            let second = second_mirror(degrees, between);
            let light = surroundings([0.0; 3]);
            let parts = [&camera, &render(2), &body(index), SAMPLE, &second, &light];
            for (renderer, found) in seen(&gpu, &parts) {
                let what = format!("{index}, {degrees:.1}°, {between}° between");
                let mut expected = found[0];
                expected[0] = s0;
                assert_stokes(&what, renderer, found[0], expected);
            }
        }
    }
}

/// A mirror that the light meets before the sample, at the same angle, in a plane of incidence turned by an angle.
fn second_mirror(degrees: f64, between: f64) -> String {
    let [center, normal] = second_place(degrees, between);
    format!(
        "[[objects]]\ntype = \"rectangle\"\nmaterial = \"sample\"\ncenter = {:?}\nnormal = {:?}\nsize = [1, 1]\n",
        center.to_array(),
        normal.to_array()
    )
}

/// The center and the normal of the second mirror.
fn second_place(degrees: f64, between: f64) -> [DVec3; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    // From the sample along the reflected ray of the camera.
    let along = in_plane(-degrees);
    let (turn_sin, turn_cos) = between.to_radians().sin_cos();
    let aside = DVec3::new(cos, sin, 0.0) * turn_cos + DVec3::Z * turn_sin;
    [along * 3.0, aside * sin - along * cos]
}

/// A panel, a mirror and the sample, or a film and another one: the product of their matrices, with the turn between their axes. The films
/// also transmit, to where it is dark.
#[test]
fn two_surfaces_have_the_product_of_their_matrices() {
    let gpu = lend();
    let degrees = 55.0;
    let films = &[CLEAR, METAL][..];
    for (name, sample, amplitudes) in [
        ("mirrors", body(GOLD), [bare(GOLD, degrees); NM.len()]),
        (
            "films",
            free(films),
            NM.map(|nm| airy(films, Complex64::ONE, nm, degrees)[0]),
        ),
    ] {
        for between in [0.0, 35.0, 115.0] {
            let [center, normal] = second_place(degrees, between);
            let ray = center.normalize();
            let onward = ray.reflect(normal);
            let [axis, first_axis] =
                [(ray, normal), (ray, DVec3::Y)].map(|(ray, n)| ray.cross(n).normalize());
            let panel = panel(center + onward * 2.0, -onward, |stokes| about(stokes, axis));
            let camera = camera_at(degrees, "");
            let render = format!("{}film_splits = 2\n", render(2));
            let second = second_mirror(degrees, between);
            let parts =
                |stokes| [&camera, &render, &sample, SAMPLE, &second, &panel(stokes)].join("\n");
            let turn = Mueller::rotation(angle_between(axis, first_axis, -ray));
            for (renderer, matrices) in mueller(&gpu, parts) {
                for ((matrix, pair), nm) in matrices.iter().zip(amplitudes).zip(NM) {
                    let what = format!("{name}, {between}°, {nm} nm");
                    let expected = |light| pair.apply(turn.apply(pair.apply(light)));
                    assert_matrix(&what, renderer, matrix, expected);
                }
            }
        }
    }
}

/// A luminous panel of radiance 1.
fn panel(
    center: DVec3,
    normal: DVec3,
    polarization: impl Fn([f64; 3]) -> String,
) -> impl Fn([f64; 3]) -> String {
    move |stokes| {
        format!(
            "[materials.panel]\ntype = \"emitter\"\nemission = {{ constant = 1, {} }}\n[[objects]]\ntype = \"rectangle\"\n\
             material = \"panel\"\ncenter = {:?}\nnormal = {:?}\nsize = [1, 1]\n",
            polarization(stokes),
            center.to_array(),
            normal.to_array()
        )
    }
}

const METAL: Layer = Layer {
    index: Complex64::new(0.15, 3.5),
    thickness_nm: 12.0,
};
const CLEAR: Layer = Layer {
    index: Complex64::new(2.2, 0.0),
    thickness_nm: 130.0,
};

/// The camera sees a luminous panel through the film or in it, from either side of the film.
#[test]
fn a_film_has_the_matrices_of_its_amplitudes() {
    let gpu = lend();
    let degrees = 62.0;
    let behind = SAMPLE.replace("normal = [0, 1, 0]", "normal = [0, -1, 0]");
    for (name, layers, object, seen) in [
        ("clear", &[CLEAR][..], SAMPLE, &[CLEAR][..]),
        ("absorbing", &[CLEAR, METAL], SAMPLE, &[CLEAR, METAL]),
        ("from behind", &[CLEAR, METAL], &behind, &[METAL, CLEAR]),
    ] {
        let sample = [&free(layers), object].concat();
        let expected = |nm| airy(seen, Complex64::ONE, nm, degrees);
        assert_film(&gpu, name, &sample, degrees, expected);
    }
}

/// R is the square of r − (1 − r²) r exp(2πil/λ) with l = 2nd cos θ', and T that of 1 − r², for Fresnel's amplitude r of the upper surface.
#[test]
fn two_beams_have_the_matrices_of_their_amplitudes() {
    let gpu = lend();
    let (n, thickness_nm, degrees) = (1.4, 350.0, 50.0_f64);
    let sample = format!(
        "[materials.sample]\ntype = \"film\"\nmodel = \"two_beam\"\nindex = {n:?}\nthickness_nm = {thickness_nm:?}\n\
         {SAMPLE}"
    );
    assert_film(&gpu, "two beams", &sample, degrees, |nm| {
        let r = bare(n.into(), degrees);
        let path = 2.0 * thickness_nm * (n * n - degrees.to_radians().sin().powi(2)).sqrt();
        let late = (Complex64::I * std::f64::consts::TAU * path / nm).exp();
        let both = |r: Complex64| [r - (1.0 - r * r) * r * late, 1.0 - r * r];
        let ([r_s, t_s], [r_p, t_p]) = (both(r.s), both(r.p));
        [Pair { s: r_s, p: r_p }, Pair { s: t_s, p: t_p }]
    });
}

/// Compares the matrices of a film with its amplitudes of reflection and transmission at each wavelength.
#[track_caller]
fn assert_film(
    gpu: &Gpu,
    name: &str,
    sample: &str,
    degrees: f64,
    expected: impl Fn(f64) -> [Pair; 2],
) {
    let camera = camera_at(degrees, "");
    for (which, toward) in [(0, in_plane(-degrees)), (1, -in_plane(degrees))] {
        let panel = panel(toward * 3.0, -toward, |stokes| about(stokes, DVec3::Z));
        let parts = |stokes| [&camera, &render(1), sample, &panel(stokes)].join("\n");
        for (renderer, matrices) in mueller(gpu, parts) {
            for (matrix, nm) in matrices.iter().zip(NM) {
                let what = format!("{name}, {}, {nm} nm", ["R", "T"][which]);
                let amplitudes = expected(nm)[which];
                assert_matrix(&what, renderer, matrix, |light| amplitudes.apply(light));
            }
        }
    }
}

/// Layers count from the outside.
#[test]
fn a_coating_has_the_matrix_of_its_stack() {
    let gpu = lend();
    let (layers, degrees) = ([CLEAR, METAL], 50.0);
    let camera = camera_at(degrees, "");
    let parts = |stokes| {
        let sample = coated(&layers, GLASS);
        [&camera, &render(1), &sample, SAMPLE, &surroundings(stokes)].join("\n")
    };
    for (renderer, matrices) in mueller(&gpu, parts) {
        for (matrix, nm) in matrices.iter().zip(NM) {
            let [r, _] = airy(&layers, GLASS, nm, degrees);
            assert_matrix(&format!("{nm} nm"), renderer, matrix, |s| r.apply(s));
        }
    }
}
