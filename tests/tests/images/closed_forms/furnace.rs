//! White furnace for rough surfaces, bare and under films: a surface that absorbs nothing is invisible against white, from any angle.

use super::comparison::{WHITE, pictures, scene};
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::{CLOSED_FORM_EXACT, FURNACE_ROUGH, PROVING_ERROR, Z_MEAN};
use scene::Scene;
use spectra::SpectralImage;

const DEGREES: [f64; 4] = [0.0, 50.0, 75.0, 85.0];
/// Layers that absorb nothing: none, one, and two.
const LAYERS: [&str; 3] = [
    "",
    "{ index = 2.2, thickness_nm = 300 }",
    "{ index = 1.46, thickness_nm = 120 }, { index = 2.2, thickness_nm = 250 }",
];
/// Parameters of the facets, and the number of layers on them.
const ROWS: [(&str, usize); 6] = [
    ("roughness = 0.05, distribution = 'beckmann'", 1),
    ("roughness = 0.3, distribution = 'ggx'", 2),
    ("roughness = 0.6, distribution = 'beckmann'", 2),
    ("roughness = 1, distribution = 'beckmann'", 0),
    ("roughness = 1, distribution = 'ggx'", 1),
    (
        "roughness = [0.05, 0.4], brushed = { along = [0, 1, 0] }, distribution = 'ggx'",
        1,
    ),
];
/// Side of a panel in pixels.
const PIXELS: usize = 8;

fn material(metal: &str, (facets, layers): (&str, usize)) -> String {
    if layers == 0 {
        return format!("type = 'conductor', index = {metal}, {facets}");
    }
    format!(
        "type = 'coated', substrate = {metal}, layers = [{}], {facets}",
        LAYERS[layers]
    )
}

/// A scene with a row of panels for each of [`ROWS`], from bottom to top, and a column for each angle. They are the faces of a convex
/// body, so that none sees another.
fn panels(metal: &str, samples: u32) -> Scene {
    let (mut materials, mut objects) = (String::from("[materials]\n"), String::new());
    for (row, surface) in ROWS.into_iter().enumerate() {
        materials += &format!("m{row} = {{ {} }}\n", material(metal, surface));
        let mut depth = 0.0;
        for (column, degrees) in DEGREES.into_iter().enumerate() {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let slope = sine / cosine;
            let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
            objects += &format!(
                "[[objects]]\ntype = 'rectangle'\nmaterial = 'm{row}'\ncenter = [{x}, {y}, {}]\n\
                 normal = [{sine}, 0, {cosine}]\nup = [0, 1, 0]\nsize = [{}, 1]\n",
                depth - 0.5 * slope,
                1.0 / cosine
            );
            depth -= slope;
        }
    }
    let [columns, rows] = [DEGREES.len(), ROWS.len()];
    let (x, y) = (0.5 * columns as f64, 0.5 * rows as f64);
    let view = format!(
        "[camera]\ntype = 'orthographic'\nposition = [{x}, {y}, 5]\nlook_at = [{x}, {y}, 0]\nheight = {rows}\n\
         [render]\nsize = [{}, {}]\nsamples = {samples}\nbands = 2\n\
         max_path_segments = 2\ndirect_light = 'bsdf'\n",
        columns * PIXELS,
        rows * PIXELS
    );
    scene(&[&view, &materials, &objects, WHITE])
}

/// Mean and standard error of the first band in each panel, with its name.
fn means(image: &SpectralImage) -> Vec<(String, f64, f64)> {
    let [columns, rows] = [DEGREES.len(), ROWS.len()];
    let of_panel = |panel: usize| {
        let (row, column) = (panel / columns, panel % columns);
        let sum = |values: &[f32]| -> f64 {
            let at = |i: usize| {
                let (x, y) = (column * PIXELS + i % PIXELS, row * PIXELS + i / PIXELS);
                f64::from(values[2 * (y * columns * PIXELS + x)])
            };
            (0..PIXELS * PIXELS).map(at).sum()
        };
        let count = (PIXELS * PIXELS) as f64;
        let (mean, error) = (
            sum(image.radiance()) / count,
            sum(image.variance()).sqrt() / count,
        );
        let (facets, layers) = ROWS[rows - 1 - row];
        let name = format!("{facets}, {layers} layers, {}°", DEGREES[column]);
        (name, mean, error)
    };
    (0..columns * rows).map(of_panel).collect()
}

/// A metal of n = 0.001, k = 1000 absorbs 4e-9: everything returns within 0.5 %, for α from 0.05 to 1 and up to 85°. The standard error is
/// that of independent samples; the means of Sobol points lie far closer.
#[test]
fn lossless_rough_surfaces_are_white() {
    for (who, image) in pictures(&lend(), &panels("[0.001, 1000]", 1024)) {
        for (panel, mean, error) in means(&image) {
            println!("{who}, {panel}: {mean:.5} ± {error:.5}");
            assert!(
                (mean - 1.0).abs() < FURNACE_ROUGH && error < PROVING_ERROR,
                "{who}, {panel}: {mean} ± {error}"
            );
        }
    }
}

/// Every panel is visible: a metal that absorbs is noticed, with or without a film.
#[test]
fn absorbing_rough_surfaces_are_noticed() {
    let image = &pictures(&lend(), &panels("[0.3, 1.5]", 32))[0].1;
    for (panel, mean, error) in means(image) {
        let noticed = mean + FURNACE_ROUGH + Z_MEAN * error < 1.0;
        assert!(noticed, "{panel}: {mean} ± {error}");
    }
}

/// A film without thickness reflects nothing, and no random number is used for it: every pixel is white, whatever the numbers.
#[test]
fn a_film_without_thickness_has_no_effect() {
    let film =
        |object: &str| format!("[[objects]]\nmaterial = 'film'\ntype = 'sphere'\n{object}\n");
    let camera =
        "[camera]\ntype = 'orthographic'\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nheight = 2\n";
    for samples in [1, 13] {
        let seen = scene(&[
            camera,
            WHITE,
            &format!(
                "[render]\nsize = [16, 16]\nsamples = {samples}\nbands = 4\nmax_path_segments = 32\n"
            ),
            "[materials.film]\ntype = 'film'\nindex = 1.33\nthickness_nm = 0\n",
            &film("center = [0, 0, 0]\nradius = 0.9"),
            &film("center = [0.1, 0, 0]\nradius = 0.7"),
            &film("center = [0, 0.1, 0]\nradius = 0.5"),
        ]);
        for (who, image) in pictures(&lend(), &seen) {
            let furthest = image.radiance().iter().map(|v| (v - 1.0).abs());
            let furthest = furthest.fold(0.0, f32::max);
            assert!(f64::from(furthest) < CLOSED_FORM_EXACT, "{who}: {furthest}");
        }
    }
}
