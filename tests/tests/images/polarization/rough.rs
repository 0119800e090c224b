//! Rough surfaces and coats: the matrix between two directions, measured with four lights.

use super::bench::NM;
use super::bench::{SAMPLE, about, angle_between, assert_stokes, camera, mueller, render};
use super::oracle::{airy, bare};
use glam::DVec3;
use optics::{Complex64, Layer, Mueller};
use pellicle_tests::device::lend;

const METAL: Complex64 = Complex64::new(0.2, 3.2);
const GLASS: Complex64 = Complex64::new(1.5, 0.0);
const FILM: Layer = Layer {
    index: Complex64::new(1.7, 0.1),
    thickness_nm: 150.0,
};

/// Rough samples: their name, how they are written, and the layers and the body of their facets.
const ROUGH: [(&str, &str, &[Layer], Complex64); 5] = [
    (
        "bare",
        "type = \"conductor\"\nindex = [0.2, 3.2]\nroughness = 0.3",
        &[],
        METAL,
    ),
    (
        "brushed",
        "type = \"conductor\"\nindex = [0.2, 3.2]\nroughness = [0.2, 0.6]\nbrushed = { along = [1, 0, 0.4] }\ndistribution = \"ggx\"",
        &[],
        METAL,
    ),
    (
        "under a layer",
        "type = \"coated\"\nsubstrate = [0.2, 3.2]\nroughness = 0.4\nlayers = [{ index = [1.7, 0.1], thickness_nm = 150 }]",
        &[FILM],
        METAL,
    ),
    (
        "coat",
        "type = \"dielectric\"\nindex = 1.5\nroughness = 0.4\nbase = 0.1",
        &[],
        GLASS,
    ),
    (
        "cook",
        "type = \"conductor\"\nindex = [0.2, 3.2]\n[materials.sample.model.cook1981]\nspecular = 0.7\ndiffuse = 0.3\n\
         diffuse_reflectance = 0.2\nslopes = [{ m = 0.4, weight = 0.4 }, { m = 0.6, weight = 0.6 }]",
        &[],
        METAL,
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
fn rough_surfaces_are_reciprocal_and_physical() {
    let gpu = lend();
    let [one, other] = [port(30.0, 20.0), port(60.0, 170.0)];
    for (name, material, ..) in ROUGH {
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

/// The facet between two directions reflects by its own Fresnel amplitudes, in its own plane of incidence; light that met several facets,
/// or a body below a rough coat, is unpolarized and adds to M00 alone. The amount of both is not compared here.
#[test]
fn a_facet_has_the_matrix_of_its_amplitudes() {
    let gpu = lend();
    let [eye, light] = [port(40.0, 75.0), port(65.0, 200.0)];
    let ([to_eye, eye_axis], [to_light, light_axis]) = (eye, light);
    let degrees = 0.5 * to_eye.angle_between(to_light).to_degrees();
    let across = to_light.cross(to_eye).normalize();
    for (name, material, layers, body) in ROUGH {
        let found = mueller(&gpu, |stokes| parts(material, eye, light, stokes));
        for (renderer, found) in found {
            for (found, nm) in found.iter().zip(NM) {
                let [r, _] = airy(layers, body, nm, degrees);
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
                    (-1e-6..20.0).contains(&several),
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
                        off <= renderer.tolerance() * (1.0 + several),
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

/// What a body below a smooth coat scatters: what arrives is transmitted by Tₛ and Tₚ, loses its polarization, and is transmitted again, so
/// that M/M00 is the product of the column (1, a(θₒ), 0, 0) and the row (1, a(θᵢ), 0, 0) with a = (Tₛ − Tₚ) / (Tₛ + Tₚ), about s on both ways.
#[test]
fn a_coat_polarizes_what_its_body_scatters() {
    let gpu = lend();
    let material = "type = \"dielectric\"\nindex = 1.5\nbase = 0.6";
    for (eye, light) in [
        (port(70.0, 40.0), port(55.0, 160.0)),
        (port(20.0, 0.0), port(80.0, 75.0)),
    ] {
        let along = |[toward, _]: [DVec3; 2], to: [f64; 2]| {
            let [r_s, r_p] = bare(GLASS, toward.angle_between(DVec3::Y).to_degrees()).powers();
            let a = (r_p - r_s) / (2.0 - r_s - r_p);
            [1.0, a * to[0], a * to[1], 0.0]
        };
        let double = |from, to, direction| {
            let (sin, cos) = (2.0 * angle_between(from, to, direction)).sin_cos();
            [cos, sin]
        };
        let across = |[toward, _]: [DVec3; 2]| DVec3::Y.cross(toward).normalize();
        // Components about s of light that is polarized along the light's axis, and along s about the camera's axis.
        let row = along(light, double(light[1], across(light), -light[0]));
        let [cos, sin] = double(across(eye), eye[1], eye[0]);
        let column = along(eye, [cos, -sin]);
        let found = mueller(&gpu, |stokes| parts(material, eye, light, stokes));
        for (renderer, found) in found {
            for found in found {
                assert!(
                    found.is_physical(renderer.tolerance()),
                    "{renderer}: {found:?}"
                );
                for (m, element) in found.0.iter().zip(column) {
                    let off = super::bench::furthest(
                        m.map(|m| m / found.0[0][0]),
                        row.map(|m| m * element),
                    );
                    println!("body, {renderer}: off by {off:.1e}");
                    assert!(
                        off <= renderer.tolerance(),
                        "{renderer}: {found:?}, {column:?} {row:?}"
                    );
                }
            }
        }
    }
}
