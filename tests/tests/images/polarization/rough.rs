//! Rough metals: the matrix between two directions, measured with four lights.

use super::bench::NM;
use super::bench::{SAMPLE, about, angle_between, assert_stokes, camera, mueller, render};
use super::oracle::airy;
use glam::DVec3;
use optics::{Complex64, Layer, Mueller};
use pellicle_tests::device::lend;

const METAL: Complex64 = Complex64::new(0.2, 3.2);
const FILM: Layer = Layer {
    index: Complex64::new(1.7, 0.1),
    thickness_nm: 150.0,
};

/// Rough samples, and the layers on their facets.
const ROUGH: [(&str, &str, &[Layer]); 3] = [
    (
        "bare",
        "type = \"conductor\"\nindex = [0.2, 3.2]\nroughness = 0.3",
        &[],
    ),
    (
        "brushed",
        "type = \"conductor\"\nindex = [0.2, 3.2]\nroughness = [0.2, 0.6]\nbrushed = { along = [1, 0, 0.4] }\ndistribution = \"ggx\"",
        &[],
    ),
    (
        "coated",
        "type = \"coated\"\nsubstrate = [0.2, 3.2]\nroughness = 0.4\nlayers = [{ index = [1.7, 0.1], thickness_nm = 150 }]",
        &[FILM],
    ),
];

/// A direction from its angles to the normal and around it.
fn direction(degrees: f64, around: f64) -> DVec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (y, x) = around.to_radians().sin_cos();
    DVec3::new(sin * x, cos, sin * y)
}

/// A direction, and an axis across it that is in no plane of symmetry.
fn port(degrees: f64, around: f64) -> [DVec3; 2] {
    let toward = direction(degrees, around);
    [toward, toward.cross(DVec3::new(0.3, 0.2, 0.9)).normalize()]
}

/// The sample from the camera's direction in the light of another, each with the axis of its Stokes vectors.
fn parts(
    material: &str,
    [eye, right]: [DVec3; 2],
    [toward, axis]: [DVec3; 2],
    stokes: [f64; 3],
) -> String {
    let light = format!(
        "[[lights]]\ntype = \"distant\"\ndirection = {:?}\ndiameter_deg = 0\nemission = {{ constant = 1, {} }}\n",
        toward.to_array(),
        about(stokes, axis)
    );
    let sample = format!("[materials.sample]\n{material}\n");
    let render = format!("{}direct_light = \"emitters\"\n", render(1));
    [&camera(eye, right, ""), &render, &sample, SAMPLE, &light]
        .map(ToString::to_string)
        .join("\n")
}

/// What leaves a surface backward of how it arrived has the matrix Q Mᵀ Q with Q = diag(1, 1, −1, 1), for axes x that stay, since y = d × x
/// changes its direction with d (van de Hulst, Light Scattering by Small Particles, 1957, section 5.22). The BSDF is the matrix over cos θᵢ.
#[test]
fn rough_metals_are_reciprocal_and_physical() {
    let gpu = lend();
    let [one, other] = [port(30.0, 20.0), port(60.0, 170.0)];
    for (name, material, _) in ROUGH {
        let there = mueller(&gpu, |stokes| parts(material, one, other, stokes));
        let back = mueller(&gpu, |stokes| parts(material, other, one, stokes));
        for ((renderer, there), (_, back)) in there.iter().zip(&back) {
            for (there, back) in there.iter().zip(back) {
                assert!(
                    there.is_physical(renderer.tolerance()),
                    "{name}, {renderer}: {there:?}"
                );
                let reversed = transposed_back(back);
                // The signs matter.
                assert!(
                    (there.0[0][2] * one[0].y - back.0[2][0] * other[0].y).abs()
                        > 0.01 * there.0[0][0],
                    "{name}, {renderer}: {there:?}"
                );
                for (row, reversed) in there.0.iter().zip(reversed.0) {
                    let scaled =
                        |row: [f64; 4], cosine: f64| row.map(|m| m / cosine / there.0[0][0]);
                    let (found, expected) = (scaled(*row, other[0].y), scaled(reversed, one[0].y));
                    let off = super::bench::furthest(found, expected);
                    println!("{name}, {renderer}: reciprocal, off by {off:.1e}");
                    assert!(
                        off <= renderer.tolerance(),
                        "{name}, {renderer}: {found:?} {expected:?}"
                    );
                }
            }
        }
    }
}

/// Q Mᵀ Q.
fn transposed_back(m: &Mueller) -> Mueller {
    let sign = |i| if i == 2 { -1.0 } else { 1.0 };
    let element = |row: usize, column: usize| sign(row) * sign(column) * m.0[column][row];
    Mueller(std::array::from_fn(|row| {
        std::array::from_fn(|column| element(row, column))
    }))
}

/// The facet between two directions reflects by its own Fresnel amplitudes, in its own plane of incidence; light that met several facets
/// is unpolarized and adds to M00 alone. The amount of both is not compared here.
#[test]
fn a_facet_has_the_matrix_of_its_amplitudes() {
    let gpu = lend();
    let [eye, light] = [port(40.0, 75.0), port(65.0, 200.0)];
    let ([to_eye, eye_axis], [to_light, light_axis]) = (eye, light);
    let degrees = 0.5 * to_eye.angle_between(to_light).to_degrees();
    let across = to_light.cross(to_eye).normalize();
    for (name, material, layers) in ROUGH {
        let found = mueller(&gpu, |stokes| parts(material, eye, light, stokes));
        for (renderer, found) in found {
            for (found, nm) in found.iter().zip(NM) {
                let [r, _] = airy(layers, METAL, nm, degrees);
                let facet = Mueller::from_amplitudes(r.s, r.p);
                let arrives = Mueller::rotation(angle_between(light_axis, across, -to_light));
                let leaves = Mueller::rotation(angle_between(across, eye_axis, to_eye));
                let expected = leaves * facet * arrives;
                // Its strength, from the elements that several facets leave alone.
                let product = |a: &Mueller, b: &Mueller| -> f64 {
                    let all = a.0.as_flattened().iter().zip(b.0.as_flattened()).skip(1);
                    all.map(|(a, b)| a * b).sum()
                };
                let strength = product(found, &expected) / product(&expected, &expected);
                assert!(strength > 1e-3, "{name}, {renderer}: {strength}");
                let several = found.0[0][0] / strength - expected.0[0][0];
                assert!(
                    (-1e-6..2.0).contains(&several),
                    "{name}, {renderer}: {several}"
                );
                for (row, (found, mut expected)) in found.0.iter().zip(expected.0).enumerate() {
                    if row == 0 {
                        expected[0] += several;
                    }
                    let what = format!("{name}, row {row}, {nm} nm");
                    let off = super::bench::furthest(found.map(|m| m / strength), expected);
                    println!("{what}, {renderer}: off by {off:.1e}");
                    assert!(
                        off <= renderer.tolerance(),
                        "{what}, {renderer}: {found:?} {expected:?}"
                    );
                }
            }
        }
    }
}

/// Light that a distant source sends to the sample without polarization is the first column.
#[test]
fn a_rough_metal_polarizes() {
    let gpu = lend();
    let [eye, light] = [port(50.0, 0.0), port(70.0, 180.0)];
    let [(renderer, found), _] = mueller(&gpu, |stokes| parts(ROUGH[0].1, eye, light, stokes));
    let [s0, s1, s2, s3] = found[0].apply([1.0, 0.0, 0.0, 0.0]);
    assert!(s1.hypot(s2) > 0.01 * s0, "{renderer}: {found:?}");
    assert_stokes("no S3", renderer, [s0, s1, s2, s3], [s0, s1, s2, 0.0]);
}
