//! factor.wgsl and the factors of evaluate.wgsl: what surfaces and films make of light.

use crate::Check;
use crate::world::{
    GROUPS, bands_of, center_of, everything, first_numbers, objects_where, pick, point_on, rounded,
    rows, value_of, vector,
};
use glam::DVec3;
use num_complex::Complex64;
use pellicle_tests::tolerances::{EXACT, FILM, FRESNEL};
use reference::Reflectance;
use scene::{Material, Shape};
use std::collections::BTreeSet;

pub(crate) fn checks() -> Vec<Check> {
    let mut all = factors();
    all.push(diffuse_factor());
    all
}

/// Whether a point lies a ten-thousandth of a square off the edges of its squares.
fn is_off_the_edges(shape: &Shape, size: f64, point: DVec3) -> bool {
    let local = (point - center_of(shape)) / size;
    let axes = match *shape {
        Shape::Sphere { .. } => local.to_array().to_vec(),
        Shape::Plane {
            tangent, bitangent, ..
        }
        | Shape::Rectangle {
            tangent, bitangent, ..
        }
        | Shape::Disk {
            tangent, bitangent, ..
        } => vec![local.dot(tangent), local.dot(bitangent)],
    };
    axes.iter().all(|x| (x - x.round()).abs() > 1e-4)
}

fn diffuse_factor() -> Check {
    let world = everything();
    let diffuse = objects_where(|_, material| matches!(material, Material::Diffuse { .. }));
    let inputs = rows(4, |u| {
        let object = pick(&diffuse, u[0]);
        let shape = world.shape(object);
        let point = rounded(point_on(shape, u[1], u[2]));
        let row = vec![object as f64, point.x, point.y, point.z, u[3]];
        let is_clear = match *world.material(object) {
            Material::Diffuse {
                reflectance: scene::Pattern::Checker { size, .. },
            } => is_off_the_edges(shape, size, point),
            // The odds of a texel are off by some 1e-5.
            _ => [-1e-4, 1e-4].iter().all(|off| {
                let mut beside = row.clone();
                beside[4] += off;
                factor_of_pattern(&beside) == factor_of_pattern(&row)
            }),
        };
        is_clear.then_some(row)
    });
    Check {
        probe: world.probe(
            &["factor"],
            (5, 1),
            "let factor = diffuse_factor(u32(a(0u)), a3(1u), a(4u)); put(0u, f32(1000u * factor.kind + factor.spectrum));",
        ),
        proves: &[
            "chosen_pixel",
            "diffuse_factor",
            "picture_place",
            "reflectance_spectrum",
            "texel_at",
        ],
        inputs,
        twin: factor_of_pattern,
        tolerance: EXACT,
    }
}

/// The number of the spectrum or texel, and a thousand times the kind of factor.
fn factor_of_pattern(a: &[f64]) -> Vec<f64> {
    let (world, object) = (everything(), a[0] as usize);
    let Material::Diffuse { reflectance } = world.material(object) else {
        return vec![f64::NAN];
    };
    let shape = world.shape(object);
    match reference::pattern_reflectance(reflectance, shape, vector(&a[1..]), a[4]) {
        Reflectance::Spectrum(spectrum) => vec![1000.0 + spectrum.index() as f64],
        Reflectance::Smooth(coefficients) => {
            let material = world.scene.objects()[object].material.index();
            let first = world.packed.materials[material].picture as usize + 1;
            let is_it = |texel: &[f32; 4]| (0..3).all(|i| f64::from(texel[i]) == coefficients[i]);
            let texels = &world.packed.texels[first..];
            let place = texels.iter().position(is_it).expect("one of its own");
            vec![(4_000 + first + place) as f64]
        }
    }
}

const OF_SURFACE: &str = "put4(0u, surface_value(Factor(u32(a(0u)), u32(a(1u)), a(2u), a(3u), 0u), u32(a(4u)), wavelengths_at(a(5u))));";
const OF_FILM: &str = "put4(0u, film_value(Factor(u32(a(0u)), u32(a(1u)), a(2u), a(3u), 0u), u32(a(4u)), wavelengths_at(a(5u))));";

fn factor_twin(a: &[f64]) -> Vec<f64> {
    use gpu::layout::{
        FACTOR_CONDUCTOR, FACTOR_FILM_REFLECTS, FACTOR_LOSSY_FILM_REFLECTS, FACTOR_REFLECTANCE,
    };
    let (kind, spectrum) = (a[0] as u32, a[1] as usize);
    let value = |band| {
        let n = value_of(spectrum, band, a[5]);
        if kind == FACTOR_REFLECTANCE {
            return n;
        }
        let index = Complex64::new(n, value_of(spectrum + 1, band, a[5]));
        if kind == FACTOR_CONDUCTOR {
            return optics::reflectance_unpolarised(index, a[2]);
        }
        let grid = &everything().scene.settings().bands;
        let film = optics::film(index, a[3], grid.wavelength_nm(band, a[5]), a[2]);
        if kind == FACTOR_FILM_REFLECTS || kind == FACTOR_LOSSY_FILM_REFLECTS {
            film.reflectance.unpolarised()
        } else {
            film.transmittance.unpolarised()
        }
    };
    bands_of(a[4]).map(value).to_vec()
}

/// Rows of a factor, a group and an offset: each of the kinds with each of its spectra.
fn factor_rows(choices: &[(u32, usize)]) -> Vec<f32> {
    rows(5, |u| {
        let (kind, spectrum) = pick(choices, u[0]);
        let cosine = 0.035 + 0.965 * u[1];
        let group = (u[3] * f64::from(GROUPS)).floor();
        Some(vec![
            f64::from(kind),
            spectrum as f64,
            cosine,
            2000.0 * u[2],
            group,
            u[4],
        ])
    })
}

fn factors() -> Vec<Check> {
    use gpu::layout::{
        FACTOR_CONDUCTOR, FACTOR_FILM_REFLECTS, FACTOR_FILM_TRANSMITS, FACTOR_LOSSY_FILM_REFLECTS,
        FACTOR_LOSSY_FILM_TRANSMITS, FACTOR_REFLECTANCE,
    };
    let world = everything();
    let (mut surfaces, mut films) = (Vec::new(), Vec::new());
    for material in world.scene.materials() {
        match *material {
            Material::Conductor { n, .. } => surfaces.push((FACTOR_CONDUCTOR, n.index())),
            Material::Diffuse {
                reflectance:
                    scene::Pattern::Uniform(spectrum) | scene::Pattern::Checker { even: spectrum, .. },
            } => surfaces.push((FACTOR_REFLECTANCE, spectrum.index())),
            Material::Film { ref layers, .. } => {
                let (n, k) = (layers[0].n, layers[0].k);
                let spectrum = n.index();
                let is_clear = world.scene.spectrum(n).extent().0 >= 1.0
                    && world.scene.spectrum(k).extent().1 <= 0.0;
                if is_clear {
                    films.push((FACTOR_FILM_REFLECTS, spectrum));
                    films.push((FACTOR_FILM_TRANSMITS, spectrum));
                }
                films.push((FACTOR_LOSSY_FILM_REFLECTS, spectrum));
                films.push((FACTOR_LOSSY_FILM_TRANSMITS, spectrum));
            }
            Material::Emitter { .. }
            | Material::Cook(_)
            | Material::CoatedBody(_)
            | Material::Diffuse {
                reflectance: scene::Pattern::Texture { .. },
            } => {}
        }
    }
    let check = |proves, body, choices: &[(u32, usize)], tolerance| Check {
        probe: world.probe(&["evaluate"], (6, 4), body),
        proves,
        inputs: factor_rows(choices),
        twin: factor_twin,
        tolerance,
    };
    vec![
        check(&["surface_value"], OF_SURFACE, &surfaces, FRESNEL),
        check(&["film_value"], OF_FILM, &films, FILM),
    ]
}

/// The tables hold what they are for: each colour of a pattern, each kind of factor.
#[test]
fn every_factor_occurs() {
    assert_eq!(
        // A spectrum and a texel may have the same number.
        first_numbers(&diffuse_factor(), factor_of_pattern).len(),
        // Seven spectra, and the 35 texels of either picture.
        7 + 35 + 35
    );
    let kinds: BTreeSet<i64> = factors()
        .iter()
        .flat_map(|check| first_numbers(check, <[f64]>::to_vec))
        .collect();
    // Factors of several layers read what a path has put on record, and are proved there.
    assert_eq!(kinds, [1, 2, 5, 6, 7, 8].into());
}

/// The comparison can fail: a checker with its colours changed over.
#[test]
fn a_pattern_out_of_place_is_noticed() {
    let mut check = diffuse_factor();
    check.twin = |a| factor_of_pattern(&[a[0], a[1] + 0.01, a[2], a[3], a[4]]);
    assert!(check.run().is_err());
}
