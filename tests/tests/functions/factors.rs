//! Factors by which surfaces and films change light: bsdf/diffuse.wgsl, bsdf/interface.wgsl and layers.wgsl.

use crate::world::{
    GROUPS, bands_of, center_of, everything, first_numbers, objects_where, pick, point_on, rounded,
    rows, value_of, vector, within,
};
use crate::{Check, lazy};
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

/// Whether a point is a ten-thousandth of a square away from the edges of its squares.
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

/// Rows of a diffuse object, a point on it and a random number, away from values at which the color changes.
fn patterned_points() -> Vec<f32> {
    let world = everything();
    let diffuse = objects_where(|_, material| matches!(material, Material::Diffuse { .. }));
    rows(4, |u| {
        let object = pick(&diffuse, u[0]);
        let shape = world.shape(object);
        let point = rounded(point_on(shape, u[1], u[2]));
        let row = vec![object as f64, point.x, point.y, point.z, u[3]];
        let is_clear = match *world.material(object) {
            Material::Diffuse {
                reflectance: scene::Pattern::Checker { size, .. },
            } => is_off_the_edges(shape, size, point),
            // The probabilities of a texel are off by some 1e-5.
            _ => [-1e-4, 1e-4].iter().all(|off| {
                let mut beside = row.clone();
                beside[4] += off;
                factor_of_pattern(&beside) == factor_of_pattern(&row)
            }),
        };
        is_clear.then_some(row)
    })
}

fn diffuse_factor() -> Check {
    Check {
        probe: within(
            everything,
            (5, 1),
            "let o = u32(a(0u));
             let f = diffuse_factor(material_at(shape_at(o).material).record, o, a3(1u), a(4u));
             put(0u, f32(1000u * factor_tag(f) + factor_number(f)));",
        ),
        proves: &[
            "chosen_pixel",
            "diffuse_factor",
            "factor_number",
            "factor_of",
            "factor_tag",
            "load_diffuse",
            "picture_uv",
            "reflectance_spectrum",
            "texel_at",
        ],
        inputs: lazy(patterned_points),
        twin: factor_of_pattern,
        tolerance: EXACT,
    }
}

/// The number of the spectrum or texel, plus a thousand times the kind of factor.
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
            let record = world.packed.material(material).record;
            let diffuse: gpu::layout::Diffuse = world.packed.record(record);
            let first = diffuse.picture as usize + 1;
            let is_it = |texel: &[f32; 4]| (0..3).all(|i| f64::from(texel[i]) == coefficients[i]);
            let texels = &world.packed.texels[first..];
            let place = texels.iter().position(is_it).expect("the texel exists");
            vec![(2_000 + first + place) as f64]
        }
    }
}

/// A surface vertex of weight 1, with its two cosines.
const OF_SURFACE: &str = "
    let f = factor_of(u32(a(0u)), u32(a(1u)));
    let at = At(0u, u32(a(4u)), wavelengths_at(a(5u)));
    begin_record();
    let v = Vertex(f, 1.0, a(2u), 0.0, 0u, 1.0, a(3u) / 2000.0, 0u, 0u);
    let found = bsdf_value(at, v, factor_value(f, at));
    put4(0u, found.onward); put4(4u, found.lit);";
const OF_FILM: &str = "
    let f = factor_of(u32(a(0u)), u32(a(1u)));
    let at = At(0u, u32(a(4u)), wavelengths_at(a(5u)));
    let found = film_value(FilmAt(f, a(2u), a(3u), 0u), factor_value(f, at), at);
    put4(0u, found.reflectance); put4(4u, found.transmittance);";

fn factor_twin(a: &[f64]) -> Vec<f64> {
    use gpu::layout::{FACTOR_DIFFUSE, FACTOR_INTERFACE};
    let (kind, spectrum) = (a[0] as u32, a[1] as usize);
    let index = |band| {
        let n = value_of(spectrum, band, a[5]);
        Complex64::new(n, value_of(spectrum + 1, band, a[5]))
    };
    let values = |band| match kind {
        FACTOR_DIFFUSE => [value_of(spectrum, band, a[5]); 2],
        FACTOR_INTERFACE => {
            [a[2], a[3] / 2000.0].map(|cosine| optics::reflectance_unpolarized(index(band), cosine))
        }
        _ => {
            let grid = &everything().scene.settings().bands;
            let film = optics::film(index(band), a[3], grid.wavelength_nm(band, a[5]), a[2]);
            [film.reflectance, film.transmittance].map(optics::Polarized::unpolarized)
        }
    };
    let both = bands_of(a[4]).map(values);
    let of = |which: usize| both.map(|values| values[which]);
    [of(0), of(1)].concat()
}

/// Rows of a factor, a group and an offset: each kind with each of its spectra.
fn factor_rows(choices: &[(u32, usize)]) -> Vec<f32> {
    rows(5, |u| {
        let (kind, spectrum) = pick(choices, u[0]);
        let cosine = 0.035 + 0.965 * u[1];
        let group = (u[3] * f64::from(GROUPS)).floor();
        Some(vec![
            f64::from(kind),
            spectrum as f64,
            cosine,
            70.0 + 1930.0 * u[2],
            group,
            u[4],
        ])
    })
}

/// The factors of surfaces and those of films, each with its spectra.
fn factor_choices() -> [Vec<(u32, usize)>; 2] {
    use gpu::layout::{FACTOR_DIFFUSE, FACTOR_FILM, FACTOR_INTERFACE, FACTOR_LOSSY_FILM};
    let world = everything();
    let (mut surfaces, mut films) = (Vec::new(), Vec::new());
    for material in world.scene.materials() {
        match *material {
            Material::Interface { n, .. } => surfaces.push((FACTOR_INTERFACE, n.index())),
            Material::Diffuse {
                reflectance:
                    scene::Pattern::Uniform(spectrum) | scene::Pattern::Checker { even: spectrum, .. },
            } => surfaces.push((FACTOR_DIFFUSE, spectrum.index())),
            Material::Film { ref layers, .. } => {
                let (n, k) = (layers[0].n, layers[0].k);
                let spectrum = n.index();
                let is_clear = world.scene.spectrum(n).extent().0 >= 1.0
                    && world.scene.spectrum(k).extent().1 <= 0.0;
                if is_clear {
                    films.push((FACTOR_FILM, spectrum));
                }
                films.push((FACTOR_LOSSY_FILM, spectrum));
            }
            Material::Emitter { .. }
            | Material::Cook(_)
            | Material::CoatedBody(_)
            | Material::Diffuse {
                reflectance: scene::Pattern::Texture { .. },
            } => {}
        }
    }
    [surfaces, films]
}

fn factors() -> Vec<Check> {
    let check = |proves, body, which: usize, tolerance| Check {
        probe: within(everything, (6, 8), body),
        proves,
        inputs: lazy(move || factor_rows(&factor_choices()[which])),
        twin: factor_twin,
        tolerance,
    };
    vec![
        check(
            &[
                "bsdf_value",
                "bare_value",
                "diffuse_value",
                "interface_value",
                "factor_value",
                "reflectance_at",
            ],
            OF_SURFACE,
            0,
            FRESNEL,
        ),
        check(&["film_value"], OF_FILM, 1, FILM),
    ]
}

/// The tables serve their purpose: they contain each color of a pattern and each kind of factor.
pub(crate) fn every_factor_occurs() {
    assert_eq!(
        // A spectrum and a texel may have the same number.
        first_numbers(&diffuse_factor(), factor_of_pattern).len(),
        // Seven spectra, and the 35 texels of each picture.
        7 + 35 + 35
    );
    let kinds: BTreeSet<i64> = factors()
        .iter()
        .flat_map(|check| first_numbers(check, <[f64]>::to_vec))
        .collect();
    // Factors of several layers read the record of a path, and are proved by the single paths of `frames`.
    assert_eq!(kinds, [1, 3, 7, 8].into());
}

/// The comparison can fail: a checker with its colors exchanged.
pub(crate) fn a_pattern_with_exchanged_colors_is_noticed() {
    let mut check = diffuse_factor();
    check.twin = |a| factor_of_pattern(&[a[0], a[1] + 0.01, a[2], a[3], a[4]]);
    assert!(check.run().is_err());
}
