//! Pictures whose truth has a closed form: both renderers against formulas and optics, scene by scene.

mod layers;
mod sky;

use gpu::Gpu;
use optics::Complex64;
use pellicle_tests::device::open;
use pellicle_tests::tolerances::{
    CLOSED_FORM, CLOSED_FORM_EXACT, CLOSED_FORM_FILM, FURNACE_ROUGH, NEARLY_NORMAL, PROVING_ERROR,
    ROUGH_FORM, Z_MEAN,
};
use scene::{Scene, SceneFile};
use spectra::SpectralImage;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::ControlFlow;
use std::path::Path;

const BANDS: u32 = 4;
const ALBEDO: f64 = 0.7;

/// Looks straight down at a square of 0.01 around the foot point.
const DOWN: &str = r#"
[camera]
type = "orthographic"
position = [0, 1, 0]
look_at = [0, 0, 0]
up = [0, 0, -1]
height = 0.01
"#;

const LAMBERT: &str = r#"
[materials.lambert]
type = "diffuse"
reflectance = 0.7

[materials.lamp]
type = "emitter"
emission = { constant = 1 }
"#;

const FLOOR: &str = r#"
[[objects]]
type = "plane"
material = "lambert"
point = [0, 0, 0]
normal = [0, 1, 0]
"#;

const WHITE: &str = r#"
[environment]
type = "constant"
emission = { constant = 1 }
"#;

fn render(samples: u32, segments: u32, sampling: &str) -> String {
    format!(
        "[render]\nsize = [32, 32]\nsamples = {samples}\nbands = {BANDS}\nsampling = \"{sampling}\"\nseed = 7\n\
         max_path_segments = {segments}\n"
    )
}

fn lamp(height: f64, radius: f64) -> String {
    format!(
        "[[objects]]\ntype = \"sphere\"\nmaterial = \"lamp\"\ncenter = [0, {height:?}, 0]\nradius = {radius:?}\n"
    )
}

fn film(index: &str, thickness_nm: f64, object: &str) -> String {
    format!(
        "[materials.film]\ntype = \"film\"\nindex = {index}\nthickness_nm = {thickness_nm:?}\n\
         [[objects]]\nmaterial = \"film\"\n{object}\n"
    )
}

fn scene(parts: &[&str]) -> Scene {
    SceneFile::parse("closed form", &parts.join("\n"), Path::new(""))
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems}"))
        .rounded_to_f32()
}

/// Pictures of both renderers.
fn pictures(gpu: &Gpu, scene: &Scene) -> [(&'static str, SpectralImage); 2] {
    let on = &mut |_| ControlFlow::Continue(());
    let on_gpu = gpu::render(gpu, scene, on).unwrap_or_else(|error| panic!("{error}"));
    let on_cpu = reference::render(scene, on).expect("nobody stops it");
    [("gpu", on_gpu), ("cpu", on_cpu)]
}

/// A mean and its standard error.
#[derive(Clone, Copy, Debug)]
struct Estimate {
    mean: f64,
    error: f64,
}

impl Estimate {
    /// Of a band of a picture, from the picture's own variance.
    fn of(image: &SpectralImage, band: u32) -> Self {
        let bands = image.bands().count() as usize;
        let sum = |values: &[f32]| -> f64 {
            let of_band = values.iter().skip(band as usize).step_by(bands);
            of_band.map(|&x| f64::from(x)).sum()
        };
        let pixels = image.samples().len() as f64;
        Self {
            mean: sum(image.radiance()) / pixels,
            error: sum(image.variance()).sqrt() / pixels,
        }
    }

    /// Whether it is `expected` to within its noise and a relative allowance, and its noise small enough to say so.
    fn agrees(self, expected: f64, allowance: f64) -> Result<String, String> {
        let off = (self.mean - expected).abs();
        let report = format!(
            "{:.7} ± {:.1e}, expected {expected:.7}: {:+.1e} of it",
            self.mean,
            self.error,
            self.mean / expected - 1.0
        );
        let proves = self.error <= PROVING_ERROR * expected.abs();
        if proves && off <= Z_MEAN * self.error + allowance * expected.abs() {
            Ok(report)
        } else {
            Err(report)
        }
    }
}

/// Renders with both renderers and compares every band.
fn check(gpu: &Gpu, what: &str, scene: &Scene, allowance: f64, expected: impl Fn(u32) -> f64) {
    let mut wrong = Vec::new();
    for (who, image) in pictures(gpu, scene) {
        for band in 0..BANDS {
            match Estimate::of(&image, band).agrees(expected(band), allowance) {
                Ok(report) => println!("{what}, {who}, band {band}: {report}"),
                Err(report) => wrong.push(format!("{what}, {who}, band {band}: {report}")),
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Mean over a band of a function of the wavelength.
fn band_mean(scene: &Scene, band: u32, f: impl Fn(f64) -> f64) -> f64 {
    let grid = scene.settings().bands;
    let steps = 400;
    let at = |i| f(grid.wavelength_nm(band, (f64::from(i) + 0.5) / f64::from(steps)));
    (0..steps).map(at).sum::<f64>() / f64::from(steps)
}

/// A sphere of radiance 1 seen whole: ρ r² / h² (Lambert).
#[test]
fn a_sphere_light_over_a_floor() {
    let gpu = open();
    for (height, radius) in [(3.0, 1.0), (2.5, 0.2), (4.0, 0.01)] {
        let scene = scene(&[
            DOWN,
            &render(64, 2, "random"),
            LAMBERT,
            FLOOR,
            &lamp(height, radius),
        ]);
        let expected = ALBEDO * (radius / height).powi(2);
        let what = format!("sphere of {radius} at {height}");
        check(&gpu, &what, &scene, CLOSED_FORM, |_| expected);
    }
}

/// Form factor of a differential element to a parallel rectangle whose near corner lies straight over it, sides `x` and `z`
/// at height 1; odd in both (Siegel and Howell; Howell's catalogue, B-3).
fn corner_factor(x: f64, z: f64) -> f64 {
    let part = |a: f64, b: f64| {
        let root = (1.0 + a * a).sqrt();
        a / root * (b / root).atan()
    };
    (part(x, z) + part(z, x)) / TAU
}

#[test]
fn a_rectangle_light_over_a_floor() {
    const LIGHT: &str = r#"
[[objects]]
type = "rectangle"
material = "lamp"
normal = [0, -1, 0]
"#;
    let gpu = open();
    // Width is along x and height along z; the light straight above or aside.
    for ([width, depth], height, [x, z]) in [
        ([2.0, 0.6], 1.5, [0.0, 0.0]),
        ([2.0, 0.6], 1.5, [0.8, 0.5]),
        ([0.4, 3.0], 2.0, [-0.3, 1.2]),
    ] {
        let place = format!(
            "center = [{x:?}, {height:?}, {z:?}]\nsize = [{width:?}, {depth:?}]\nup = [0, 0, -1]\n"
        );
        let scene = scene(&[
            DOWN,
            &render(128, 2, "random"),
            LAMBERT,
            FLOOR,
            LIGHT,
            &place,
        ]);
        let factor = |sx: f64, sz: f64| {
            let corner = corner_factor(
                (x + sx * width / 2.0) / height,
                (z + sz * depth / 2.0) / height,
            );
            sx * sz * corner
        };
        let all = factor(1.0, 1.0) + factor(1.0, -1.0) + factor(-1.0, 1.0) + factor(-1.0, -1.0);
        let what = format!("rectangle of {width} × {depth} at ({x}, {height}, {z})");
        check(&gpu, &what, &scene, CLOSED_FORM, |_| ALBEDO * all);
    }
}

/// Films that are no films: index 1, and thickness 0. What lies behind keeps its light.
#[test]
fn light_through_an_absent_film_keeps_its_strength() {
    const BETWEEN: &str = "type = \"sphere\"\ncenter = [0, 2, 0]\nradius = 0.5";
    const AROUND: &str = "type = \"sphere\"\ncenter = [0, 4, 0]\nradius = 1.5";
    const SHEET: &str =
        "type = \"rectangle\"\ncenter = [0, 2, 0]\nnormal = [0, 1, 0]\nsize = [5, 5]";
    let gpu = open();
    let expected = ALBEDO * (0.5_f64 / 4.0).powi(2);
    for (what, film, segments) in [
        (
            "a sphere of index 1 between",
            film("1.0", 700.0, BETWEEN),
            4,
        ),
        ("a sphere of index 1 around", film("1.0", 700.0, AROUND), 3),
        ("a sheet of index 1", film("1.0", 500.0, SHEET), 3),
        ("a sheet of no thickness", film("1.5", 0.0, SHEET), 3),
        (
            "a gold sheet of no thickness",
            film("\"gold\"", 0.0, SHEET),
            3,
        ),
    ] {
        let lit = scene(&[
            DOWN,
            &render(128, segments, "random"),
            LAMBERT,
            FLOOR,
            &lamp(4.0, 0.5),
            &film,
        ]);
        check(&gpu, what, &lit, CLOSED_FORM, |_| expected);
    }
}

/// A small lamp through real films: T at normal incidence, once or twice.
#[test]
fn light_through_a_film_loses_what_it_reflects_and_absorbs() {
    const BETWEEN: &str = "type = \"sphere\"\ncenter = [0, 2, 0]\nradius = 0.5";
    const SHEET: &str =
        "type = \"rectangle\"\ncenter = [0, 2, 0]\nnormal = [0, 1, 0]\nsize = [5, 5]";
    // So small that what the films send back hardly meets it.
    const SMALL_FLOOR: &str = r#"
[[objects]]
type = "rectangle"
material = "lambert"
center = [0, 0, 0]
normal = [0, 1, 0]
size = [0.02, 0.02]
"#;
    let gpu = open();
    let bare = ALBEDO * (0.02_f64 / 4.0).powi(2);
    let glass = Complex64::new(1.5, 0.0);
    let smoke = Complex64::new(1.7, 0.2);
    for (what, index, thickness_nm, object, crossings) in [
        ("a glass sheet", glass, 400.0, SHEET, 1),
        ("a smoked sheet", smoke, 250.0, SHEET, 1),
        ("a glass sphere", glass, 400.0, BETWEEN, 2),
    ] {
        let written = format!("[{:?}, {:?}]", index.re, index.im);
        let lit = scene(&[
            DOWN,
            &render(64, 2 + crossings as u32, "random"),
            LAMBERT,
            SMALL_FLOOR,
            &lamp(4.0, 0.02),
            &film(&written, thickness_nm, object),
        ]);
        check(&gpu, what, &lit, NEARLY_NORMAL, |band| {
            let through = |nm| {
                let film = optics::film(index, thickness_nm, nm, 1.0);
                film.transmittance.unpolarised().powi(crossings)
            };
            bare * band_mean(&lit, band, through)
        });
    }
}

const GOLD: &str = r#"
[materials.metal]
type = "conductor"
index = "gold"
"#;

const METAL_FLOOR: &str = r#"
[[objects]]
type = "rectangle"
material = "metal"
center = [0, 0, 0]
normal = [0, 1, 0]
size = [2, 2]
"#;

/// Index of the one conductor at a wavelength, as the scene has it.
fn metal(scene: &Scene, band: u32, offset: f64) -> Complex64 {
    let found = scene.materials().iter().find_map(|m| match *m {
        scene::Material::Conductor { n, k, .. } => Some((n, k)),
        _ => None,
    });
    let (n, k) = found.expect("there is a conductor");
    Complex64::new(
        scene.spectrum(n).at(band, offset),
        scene.spectrum(k).at(band, offset),
    )
}

fn metal_mean(scene: &Scene, band: u32, f: impl Fn(Complex64) -> f64) -> f64 {
    let steps = 200;
    let at = |i| f(metal(scene, band, (f64::from(i) + 0.5) / f64::from(steps)));
    (0..steps).map(at).sum::<f64>() / f64::from(steps)
}

#[test]
fn a_mirror_reflects_its_reflectance() {
    // Looks down at 60° from the normal.
    const ASLANT: &str = r#"
[camera]
type = "orthographic"
position = [1.7320508075688772, 1, 0]
look_at = [0, 0, 0]
height = 0.01
"#;
    let gpu = open();
    for (what, camera, cosine) in [("from above", DOWN, 1.0), ("aslant", ASLANT, 0.5)] {
        let reflectance = |index| optics::reflectance_unpolarised(index, cosine);
        let drawn = scene(&[camera, &render(64, 2, "random"), GOLD, METAL_FLOOR, WHITE]);
        check(&gpu, what, &drawn, CLOSED_FORM, |band| {
            metal_mean(&drawn, band, reflectance)
        });
        let fixed = scene(&[camera, &render(4, 2, "centre"), GOLD, METAL_FLOOR, WHITE]);
        check(&gpu, what, &fixed, CLOSED_FORM_EXACT, |band| {
            reflectance(metal(&fixed, band, 0.5))
        });
    }
}

/// Directional albedo of a rough conductor seen along its normal: ∫ f R cos θ dω by quadrature, and of what is left the colour of
/// light that met several facets. Under the environment the light comes by scattering alone, in a luminous sphere by
/// connections too.
#[test]
fn a_rough_metal_reflects_its_albedo() {
    const SHELL: &str = r#"
[materials.lamp]
type = "emitter"
emission = { constant = 1 }

[[objects]]
type = "sphere"
material = "lamp"
center = [0, 0.5, 0]
radius = 10
"#;
    let gpu = open();
    for roughness in [0.1, 0.3, 0.8] {
        let rough = format!("{GOLD}roughness = {roughness}\n");
        let surface = optics::Microsurface {
            distribution: optics::Distribution::Beckmann,
            alpha: [roughness; 2],
        };
        let mean_energy = mean_energy(&surface);
        let lost = 1.0 - surface.albedo([0.0, 0.0, 1.0], 200);
        let albedo = |index| {
            let steps = 2000;
            let at = |i| {
                let angle = (f64::from(i) + 0.5) / f64::from(steps) * FRAC_PI_2;
                let light = [angle.sin(), 0.0, angle.cos()];
                let facet = surface.reflection([0.0, 0.0, 1.0], light);
                let fresnel = optics::reflectance_unpolarised(index, (angle / 2.0).cos());
                facet * fresnel * angle.cos() * angle.sin()
            };
            let once = TAU * (0..steps).map(at).sum::<f64>() * FRAC_PI_2 / f64::from(steps);
            let mean = optics::mean_reflectance(|c| optics::reflectance_unpolarised(index, c));
            once + lost * optics::multiple_colour(mean, mean_energy)
        };
        for (where_, light) in [("environment", WHITE), ("shell", SHELL)] {
            let lit = scene(&[DOWN, &render(64, 2, "random"), &rough, METAL_FLOOR, light]);
            let what = format!("roughness {roughness}, {where_}");
            check(&gpu, &what, &lit, ROUGH_FORM, |band| {
                metal_mean(&lit, band, albedo)
            });
        }
    }
}

/// The albedo of facets averaged over a hemisphere, ∫ E d(cos²θ).
fn mean_energy(surface: &optics::Microsurface) -> f64 {
    let steps = 100;
    let at = |i| {
        let cos2 = (f64::from(i) + 0.5) / f64::from(steps);
        surface.albedo([(1.0 - cos2).sqrt(), 0.0, cos2.sqrt()], 64)
    };
    (0..steps).map(at).sum::<f64>() / f64::from(steps)
}

/// Spheres of a metal that absorbs next to nothing (n = 0.001, k = 1000: 4e-9), bare and under a film, smooth to rough, brushed or
/// not, before a white environment: nothing of them is to be seen.
#[test]
fn lossless_rough_surfaces_are_white() {
    const TILES: [u32; 2] = [4, 2];
    let rough = [
        "roughness = 0.05",
        "roughness = 0.3",
        "roughness = 1",
        "roughness = [0.05, 0.4]\nbrushed = { along = [1, 1, 0] }",
    ];
    let lossless = "index = [0.001, 1000]\ntype = \"conductor\"";
    let under_a_film =
        "substrate = [0.001, 1000]\nindex = 2.2\nthickness_nm = 300\ntype = \"coated\"";
    let mut text = String::from(
        "[camera]\ntype = \"orthographic\"\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nheight = 2\n\
         [render]\nsize = [64, 32]\nsamples = 256\nbands = 2\nmax_path_segments = 24\n",
    );
    for tile in 0..TILES[0] * TILES[1] {
        let (column, row) = (tile % TILES[0], tile / TILES[0]);
        let body = if column % 2 == row {
            lossless
        } else {
            under_a_film
        };
        let distribution = if row == 0 { "beckmann" } else { "ggx" };
        text += &format!(
            "[materials.m{tile}]\n{body}\ndistribution = \"{distribution}\"\n{}\n\
             [[objects]]\ntype = \"sphere\"\nmaterial = \"m{tile}\"\ncenter = [{}, {}, 0]\nradius = 0.45\n",
            rough[column as usize],
            f64::from(column) - 1.5,
            0.5 - f64::from(row),
        );
    }
    let gpu = open();
    let white = scene(&[&text, WHITE]);
    for (who, image) in pictures(&gpu, &white) {
        for tile in 0..TILES[0] * TILES[1] {
            let (left, top) = (16 * (tile % TILES[0]), 16 * (tile / TILES[0]));
            let first_bands = (0..256).map(|i| 2 * (64 * (top + i / 16) + left + i % 16) as usize);
            let sum =
                |values: &[f32]| -> f64 { first_bands.clone().map(|i| f64::from(values[i])).sum() };
            let mean = sum(image.radiance()) / 256.0;
            let error = sum(image.variance()).sqrt() / 256.0;
            println!("{who}, tile {tile}: {mean:.5} ± {error:.5}");
            let off = (mean - 1.0).abs();
            assert!(
                off < FURNACE_ROUGH + Z_MEAN * error,
                "{who}, tile {tile}: {mean}"
            );
            assert!(error < FURNACE_ROUGH, "{who}, tile {tile}: {error}");
        }
    }
}

/// A lamp as large as half a pixel lights the pixel that it should, and no other.
#[test]
fn the_picture_is_neither_mirrored_nor_turned() {
    const PIXEL: f64 = 0.05;
    const RADIUS: f64 = 0.02;
    let gpu = open();
    let (right, up) = (15.5 * PIXEL, 11.5 * PIXEL); // pixel (45, 8) of 60 × 40
    let looks = [
        ("along −z", "[0, 0, 5]", "[0, 1, 0]", [right, up, 0.0]),
        ("along −x", "[5, 0, 0]", "[0, 1, 0]", [0.0, up, -right]),
        ("lying down", "[0, 0, 5]", "[1, 0, 0]", [up, -right, 0.0]),
        ("from below", "[0, -5, 0]", "[0, 0, 1]", [right, 0.0, up]),
    ];
    let fov = 2.0 * 0.2_f64.atan().to_degrees();
    let lenses = [
        "type = \"orthographic\"\nheight = 2".to_owned(),
        format!("type = \"perspective\"\nfov_deg = {fov}"),
    ];
    for (what, position, upwards, center) in looks {
        // From below, right is forward × up = y × z = x.
        for lens in &lenses {
            let text = format!(
                "[camera]\n{lens}\nposition = {position}\nlook_at = [0, 0, 0]\nup = {upwards}\n\
                 [render]\nsize = [60, 40]\nsamples = 4096\nbands = 1\nmax_path_segments = 1\n\
                 [[objects]]\ntype = \"sphere\"\nmaterial = \"lamp\"\ncenter = {center:?}\nradius = {RADIUS}\n"
            );
            let seen = scene(&[&text, LAMBERT]);
            for (who, image) in pictures(&gpu, &seen) {
                let lit = (0..60 * 40).filter(|i| image.pixel(i % 60, i / 60)[0] != 0.0);
                let lit: Vec<_> = lit.map(|i| (i % 60, i / 60)).collect();
                assert_eq!(lit, [(45, 8)], "{what}, {who}: {lens}");
                // Covers half of it; the perspective widens it by some ten-thousandths, off the axis by 2 %.
                let covered = f64::from(image.pixel(45, 8)[0]);
                let expected = PI * RADIUS * RADIUS / (PIXEL * PIXEL);
                assert!(
                    (covered - expected).abs() < 0.05,
                    "{what}, {who}: {covered}"
                );
            }
        }
    }
}

#[test]
fn a_gradient_is_what_it_says_in_each_direction() {
    const SKY: &str = r#"
[environment]
type = "gradient"
zenith = { constant = 3 }
horizon = { constant = 1 }
ground = { constant = 0.25 }
"#;
    let gpu = open();
    for (towards, up, expected) in [
        ("[0, 1, 0]", "[0, 0, 1]", 3.0),
        ("[0, 0, -1]", "[0, 1, 0]", 1.0),
        ("[1, 0, 0]", "[0, 1, 0]", 1.0),
        ("[0, -1, 0]", "[0, 0, 1]", 0.25),
        ("[0.8, 0.6, 0]", "[0, 1, 0]", 0.6 * 3.0 + 0.4),
        ("[0.8, -0.6, 0]", "[0, 1, 0]", 0.6 * 0.25 + 0.4),
    ] {
        let camera = format!(
            "[camera]\ntype = \"orthographic\"\nposition = [0, 0, 0]\nlook_at = {towards}\nup = {up}\nheight = 1\n"
        );
        let sky = scene(&[&camera, &render(4, 1, "random"), SKY]);
        check(&gpu, towards, &sky, CLOSED_FORM_EXACT, |_| expected);
    }
}

const FRINGES: (f64, f64) = (1.4, 3000.0);

/// A film of many fringes a band before black, under constant light.
fn fringes(sampling: &str) -> Scene {
    const BLACK: &str = r#"
[materials.black]
type = "diffuse"
reflectance = 0

[[objects]]
type = "plane"
material = "black"
point = [0, -1, 0]
normal = [0, 1, 0]
"#;
    let (index, thickness_nm) = FRINGES;
    let sheet = "type = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 1, 0]";
    let film = film(&format!("{index:?}"), thickness_nm, sheet);
    scene(&[DOWN, &render(256, 2, sampling), BLACK, &film, WHITE])
}

fn fringe(wavelength_nm: f64) -> f64 {
    let (index, thickness_nm) = FRINGES;
    let film = optics::film(index.into(), thickness_nm, wavelength_nm, 1.0);
    film.reflectance.unpolarised()
}

/// The choice between reflection and transmission is the same in all bands, so the bands' ratios have no noise at all.
fn has_ratios_of_centres(image: &SpectralImage) -> bool {
    let found: Vec<f64> = (0..BANDS).map(|b| Estimate::of(image, b).mean).collect();
    let sought: Vec<f64> = (0..BANDS)
        .map(|b| fringe(image.bands().centre_nm(b)))
        .collect();
    let (total, of) = (found.iter().sum::<f64>(), sought.iter().sum::<f64>());
    let error = |(f, s): (&f64, &f64)| (f / total / (s / of) - 1.0).abs();
    let worst = found.iter().zip(&sought).map(error).fold(0.0, f64::max);
    println!("ratios of bands off by {worst:.1e}");
    worst <= CLOSED_FORM_FILM
}

#[test]
fn fixed_wavelengths_are_the_centres_of_the_bands() {
    let gpu = open();
    let fixed = fringes("centre");
    check(&gpu, "centres", &fixed, CLOSED_FORM_FILM, |band| {
        fringe(fixed.settings().bands.centre_nm(band))
    });
    let drawn = fringes("random");
    check(&gpu, "bands", &drawn, CLOSED_FORM_FILM, |band| {
        band_mean(&drawn, band, fringe)
    });
    for (who, image) in pictures(&gpu, &fixed) {
        assert!(has_ratios_of_centres(&image), "{who}");
    }
    for (who, image) in pictures(&gpu, &drawn) {
        assert!(
            !has_ratios_of_centres(&image),
            "{who}: means pass for centres"
        );
    }
}

/// Two per cent off, the cosine forgotten, or too much noise: refused.
#[test]
fn a_wrong_formula_is_noticed() {
    let gpu = open();
    let (height, radius) = (3.0_f64, 1.0_f64);
    let lit = |samples| {
        let lamp = lamp(height, radius);
        scene(&[DOWN, &render(samples, 2, "random"), LAMBERT, FLOOR, &lamp])
    };
    let right = ALBEDO * (radius / height).powi(2);
    // Without the cosine: the solid angle over π.
    let solid = 2.0 * (1.0 - (1.0 - (radius / height).powi(2)).sqrt());
    for (who, image) in pictures(&gpu, &lit(64)) {
        let found = Estimate::of(&image, 0);
        assert!(found.agrees(right, CLOSED_FORM).is_ok(), "{who}");
        for wrong in [
            right * 1.02,
            right * 0.98,
            ALBEDO * solid,
            right * PI,
            f64::NAN,
        ] {
            assert!(found.agrees(wrong, CLOSED_FORM).is_err(), "{who}: {wrong}");
        }
    }
    let noisy = Estimate {
        mean: right,
        error: 0.01 * right,
    };
    assert!(noisy.agrees(right, CLOSED_FORM).is_err());
}
