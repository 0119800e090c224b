//! Renders each kind of thickness alone: a pipeline is specialized to its scene, so every kind must render without the others.

use pellicle_tests::frames::{Values, same_numbers};
use pellicle_tests::sources::root;
use pellicle_tests::tolerances::FRAMES;
use scene::Scene;
use scene_file::SceneFile;
use std::ops::ControlFlow;

const ALONG: &str = "from = [-0.5, 0.4, 0], to = [0.6, -0.5, 0.2]";

/// A bubble and a film beside it, both with this thickness; two bubbles if the thickness applies only to bubbles.
fn scene(thickness: &str) -> Scene {
    let is_for_spheres = thickness.contains("pole") || thickness.contains("radius_m");
    let beside = if is_for_spheres {
        "type = 'sphere'\nradius = 0.7"
    } else {
        "type = 'rectangle'\nnormal = [-0.2, 0, 1]\nsize = [1.4, 1.6]"
    };
    let text = format!(
        "camera = {{ type = 'perspective', position = [0, 0, 4], look_at = [0, 0, 0], fov_deg = 40 }}\n\
         render = {{ size = [64, 40], samples = 4, bands = 8, max_path_segments = 4, time_s = 12.3 }}\n\
         environment = {{ type = 'gradient', zenith = {{ constant = 2 }}, horizon = {{ constant = 1 }} }}\n\
         [materials]\nfilm = {{ type = 'film', index = 1.45, thickness_nm = {thickness} }}\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'film'\ncenter = [-0.9, 0, 0]\nradius = 0.8\n\
         [[objects]]\n{beside}\nmaterial = 'film'\ncenter = [0.9, 0, 0]\n"
    );
    SceneFile::parse("field.toml", &text, &root())
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems:#}"))
        .rounded_to_f32()
}

fn compared(actual: &Scene, expected: &Scene) -> Result<String, String> {
    let gpu = pellicle_tests::device::lend();
    let mut go_on = |_| ControlFlow::Continue(());
    let actual = gpu::render(&gpu, actual, &mut go_on).unwrap_or_else(|error| panic!("{error}"));
    let expected = reference::render(expected, &mut go_on).expect("nothing stops the render");
    same_numbers(Values::of(&actual), Values::of(&expected), &FRAMES)
}

fn renders_alone(thickness: &str) {
    let scene = scene(thickness);
    match compared(&scene, &scene) {
        Ok(report) => println!("{report}"),
        Err(report) => panic!("{thickness}: {report}"),
    }
}

/// A test for each thickness.
macro_rules! kinds {
    ($($kind:ident: $thickness:expr,)*) => {
        mod each_kind_of_thickness_renders_alone {
            use super::{ALONG, renders_alone};

            $(#[test] fn $kind() { renders_alone(&$thickness); })*
        }
    };
}

kinds! {
    constant: "420",
    polar: "{ pole = 200, equator = 500 }",
    linear: format!("{{ start = 100, end = 700, {ALONG} }}"),
    steps: format!("{{ steps = {{ values = [100, 300, 500], {ALONG} }} }}"),
    drainage_of_a_bubble: "{ drainage = { initial = 900, radius_m = 0.01, viscosity_pa_s = 1e-7 } }",
    drainage_of_a_film: format!(
            "{{ drainage = {{ initial = 900, height_m = 0.01, viscosity_pa_s = 1e-7, {ALONG} }} }}"
        ),
    swirls: "{ swirls = { mean = 400, amplitude = 150, scale = 0.6, rate = 1 } }",
    picture: "{ image = 'tests/data/thickness.png', min = 100, max = 500 }",
    sum_and_product: "{ sum = [100, { product = [2, 130] }] }",
    anodizing: format!(
            "{{ anodizing = {{ metal = 'titanium', volts = {{ start = 5, end = 120, {ALONG} }} }} }}"
        ),
    heat_tint: format!(
            "{{ heat_tint = {{ temperature_c = {{ start = 200, end = 350, {ALONG} }}, minutes = 9 }} }}"
        ),
}

/// The comparison can fail: swirls a tenth of their lifetime later are another picture.
#[test]
fn another_time_is_noticed() {
    let at = |rate: f64| {
        scene(&format!(
            "{{ swirls = {{ mean = 400, amplitude = 150, scale = 0.6, rate = {rate} }} }}"
        ))
    };
    assert!(compared(&at(1.0), &at(1.0)).is_ok());
    assert!(compared(&at(1.0), &at(1.008)).is_err());
}
