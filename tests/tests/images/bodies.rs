//! Renders bare metals, Cook's model and bases below a coat, and compares them with what is known of them.

use colorimetry::lab::Lab;
use pellicle_tests::tolerances::{FURNACE_ERROR, FURNACE_ROUGH, Z_FURNACE};
use scene::Scene;
use scene_file::SceneFile;
use spectra::SpectralImage;
use std::ops::ControlFlow;
use std::path::Path;

fn rendered(scene: &Scene) -> [(&'static str, SpectralImage); 2] {
    let gpu = pellicle_tests::device::lend();
    let on_gpu = gpu::render(&gpu, scene, &mut |_| ControlFlow::Continue(()));
    let on_cpu = reference::render(scene, &mut |_| ControlFlow::Continue(()));
    [
        ("gpu", on_gpu.unwrap_or_else(|error| panic!("{error}"))),
        ("cpu", on_cpu.expect("nothing stops the render")),
    ]
}

/// A plane of a material, seen `degrees` off its normal under uniform illumination.
fn plane(material: &str, degrees: f64, light: &str, render: &str) -> Scene {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let text = format!(
        "camera = {{ type = 'orthographic', position = [{}, 0, {}], look_at = [0, 0, 0], height = 1 }}\n\
         environment = {{ type = 'constant', emission = {light} }}\n\
         render = {{ max_path_segments = 4, {render} }}\n\
         materials = {{ a = {material} }}\n\
         [[objects]]\ntype = 'plane'\nmaterial = 'a'\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n",
        5.0 * sine,
        5.0 * cosine
    );
    SceneFile::parse("plane.toml", &text, Path::new(""))
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems:#}"))
        .rounded_to_f32()
}

const NANOMETERS: &str = "size = [1, 1], samples = 1, bands = 400, sampling = 'center'";

/// XYZ of the only pixel of the picture.
fn seen(material: &str, who: usize) -> [f64; 3] {
    let scene = plane(material, 0.0, "{ illuminant = 'D65' }", NANOMETERS);
    rendered(&scene)[who].1.xyz()[0].map(f64::from)
}

fn lab_of(material: &str, who: usize) -> [f64; 3] {
    let white = seen("{ type = 'diffuse', reflectance = 1 }", who);
    let lab = Lab::from_xyz(seen(material, who), white);
    [lab.l, lab.a, lab.b]
}

/// L*, a*, b* of bare metals at normal incidence under D65, CIE 1931 observer, steps of 1 nm, computed independently in
/// double precision (tmm 0.2.0 after S. J. Byrne, arXiv:1603.02720, and numpy) from the same indices: Johnson and Christy (1972) for
/// gold, silver and copper, Rakić (1995) for aluminum.
const METALS: [(&str, [f64; 3]); 4] = [
    ("gold", [90.223_026, 5.039_866, 33.798_897]),
    ("silver", [99.403_737, 0.080_163, 0.402_288]),
    ("copper", [86.063_462, 11.861_556, 13.047_770]),
    ("aluminum", [96.595_598, -0.198_880, -0.483_298]),
];

fn difference(found: [f64; 3], expected: [f64; 3]) -> f64 {
    let squares = found.iter().zip(expected).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>().sqrt()
}

/// Tests the whole chain from scene file to CIELAB. The wavelengths of the render are half a nanometer off those of the figures.
#[test]
fn bare_metals_have_their_colors() {
    for (name, expected) in METALS {
        for who in 0..2 {
            let found = lab_of(&format!("{{ type = 'conductor', index = '{name}' }}"), who);
            let off = difference(found, expected);
            println!("{name}: {found:.4?}, ΔE*ab {off:.4}");
            assert!(off < 0.05, "{name}: {found:?} {expected:?}");
        }
    }
    // Another data set for copper gives another color.
    let other = lab_of("{ type = 'conductor', index = 'copper_mcpeak' }", 1);
    assert!(difference(other, METALS[2].1) > 1.0, "{other:?}");
}

/// Mean radiance and its standard error.
fn mean(image: &SpectralImage) -> (f64, f64) {
    let count = image.radiance().len() as f64;
    let sum: f64 = image.radiance().iter().map(|&x| f64::from(x)).sum();
    let variance: f64 = image.variance().iter().map(|&x| f64::from(x)).sum();
    (sum / count, variance.sqrt() / count)
}

/// White furnace: a white base below a clear coat returns everything, whatever the index, roughness and grain of the coat, up to 85°.
/// The standard error is that of independent samples; the means of Sobol points lie far closer.
fn returns_everything(coat: &str) {
    const RENDER: &str = "size = [24, 24], samples = 256, bands = 1";
    let material = format!("{{ type = 'dielectric', {coat}, base = 1 }}");
    for degrees in [0.0, 50.0, 75.0, 85.0] {
        let scene = plane(&material, degrees, "{ constant = 1 }", RENDER);
        for (who, image) in rendered(&scene) {
            let (mean, error) = mean(&image);
            println!("{who}, {degrees}°: {mean:.5} ± {error:.5}");
            assert!(
                (mean - 1.0).abs() < FURNACE_ROUGH && error < FURNACE_ERROR,
                "{who}, {coat}, {degrees}°: {mean} ± {error}"
            );
        }
    }
}

/// A test for each coat.
macro_rules! coats {
    ($($name:ident: $coat:literal,)*) => {
        mod a_white_base_below_a_coat_returns_everything {
            $(#[test] fn $name() { super::returns_everything($coat); })*
        }
    };
}

coats! {
    clear: "index = 1.5",
    dense: "index = 2.4",
    smooth: "index = 1.5, roughness = 0.1",
    rough: "index = 1.5, roughness = 0.5",
    ggx: "index = 2.0, roughness = 0.8, distribution = 'ggx'",
    brushed_along: "index = 1.5, roughness = [0.02, 0.3], brushed = { along = [1, 0, 0] }",
    brushed_across: "index = 1.5, roughness = [0.02, 0.3], brushed = { along = [0, 1, 0] }",
    ggx_brushed_askew: "index = 1.5, roughness = [0.05, 0.4], distribution = 'ggx', brushed = { along = [5, 1, 0] }",
    dense_brushed: "index = 2.4, roughness = [0.05, 1.0], brushed = { along = [1, 0, 0] }",
}

/// The furnace test can fail: it detects a base that absorbs three percent.
#[test]
fn a_base_that_absorbs_is_noticed() {
    let material = "{ type = 'dielectric', index = 1.5, base = 0.97 }";
    let render = "size = [24, 24], samples = 256, bands = 1";
    let scene = plane(material, 0.0, "{ constant = 1 }", render);
    let (mean, error) = mean(&rendered(&scene)[1].1);
    assert!(mean < 0.99 - Z_FURNACE * error, "{mean} ± {error}");
}

/// With D2 and the printed π, the model returns four times what it returns with D2/π and 4, path by path.
#[test]
fn the_printed_constant_is_four_times_the_normalized() {
    let of = |normalization: &str| {
        let material = format!(
            "{{ type = 'conductor', index = 'gold', roughness = 0.3, model = {{ cook1981 = {{ normalization = '{normalization}' }} }} }}"
        );
        let render = "size = [16, 16], samples = 4, bands = 4";
        rendered(&plane(&material, 50.0, "{ constant = 1 }", render))
    };
    for ((who, printed), (_, normalized)) in of("printed").iter().zip(&of("normalized")) {
        let pairs = printed.radiance().iter().zip(normalized.radiance());
        assert!(
            pairs
                .clone()
                .all(|(a, b)| (a - 4.0 * b).abs() <= 1e-4 * a.abs())
        );
        let (mean, _) = mean(printed);
        println!("{who}: {mean}");
        assert!(
            mean > 1.5,
            "the printed constant should reflect more than arrives: {mean}"
        );
    }
}
