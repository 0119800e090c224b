//! The lists of a scene give the same bits in a storage buffer, a uniform buffer and a texture, and scenes with long lists or with
//! rare combinations agree with the reference.

use gpu::{Gpu, PackedScene};
use pellicle_tests::device::{lend, open};
use pellicle_tests::frames::{Values, same_numbers};
use pellicle_tests::scenes::small;
use pellicle_tests::tolerances::FRAMES;
use scene::Scene;
use scene_file::SceneFile;
use spectra::SpectralImage;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::Path;

fn on_gpu(gpu: &Gpu, scene: &Scene) -> SpectralImage {
    gpu::render(gpu, scene, &mut |_| ControlFlow::Continue(()))
        .unwrap_or_else(|error| panic!("{error}"))
}

fn on_cpu(scene: &Scene) -> SpectralImage {
    reference::render(scene, &mut |_| ControlFlow::Continue(())).expect("nothing stops the render")
}

fn parsed(text: &str) -> Scene {
    SceneFile::parse("lists", text, Path::new(""))
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems}"))
        .rounded_to_f32()
}

const HEAD: &str = "camera = { type = 'perspective', position = [0, 3, 12], look_at = [0, 0, 0], fov_deg = 45 }\n\
     render = { size = [48, 36], samples = 2, bands = 8, max_path_segments = 2 }\n";

/// A position in a cube, computed from a number.
fn place(i: u32) -> [f64; 3] {
    [0x9e37_79b9, 0x85eb_ca6b, 0xc2b2_ae35]
        .map(|k| f64::from(i.wrapping_mul(k) >> 8 & 0xffff) / 8192.0 - 4.0)
}

/// A scene with this many spheres, every third of them an emitter, and this many materials.
fn many(spheres: u32, materials: u32) -> Scene {
    let mut text =
        format!("{HEAD}[materials.lamp]\ntype = 'emitter'\nemission = {{ constant = 5 }}\n");
    for i in 0..materials {
        let reflectance = f64::from(i + 1) / f64::from(materials + 1);
        writeln!(
            text,
            "[materials.m{i}]\ntype = 'diffuse'\nreflectance = {reflectance}"
        )
        .expect("writing to a string succeeds");
    }
    for i in 0..spheres {
        let material = match i % 3 {
            0 => "lamp".to_owned(),
            _ => format!("m{}", i % materials),
        };
        writeln!(
            text,
            "[[objects]]\ntype = 'sphere'\nmaterial = '{material}'\ncenter = {:?}\nradius = 0.16",
            place(i)
        )
        .expect("writing to a string succeeds");
    }
    parsed(&text)
}

/// A mirror that reflects all but 4e-9, beside a rough metal: the color of light that was reflected by several facets has no value
/// for the mirror, and must not be read.
fn mirror_beside_a_rough_metal() -> Scene {
    parsed(&format!(
        "{HEAD}environment = {{ type = 'gradient', zenith = {{ constant = 2 }}, horizon = {{ constant = 1 }} }}\n\
         [materials.mirror]\ntype = 'conductor'\nindex = [0.001, 1000]\n\
         [materials.rough]\ntype = 'conductor'\nindex = 'gold'\nroughness = 0.4\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'mirror'\ncenter = [-2, 0, 0]\nradius = 1.6\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'rough'\ncenter = [2, 0, 0]\nradius = 1.6\n"
    ))
}

/// A coating of 64 layers on a ball, and a free stack with the same number.
fn layered() -> Scene {
    let layers: Vec<_> = (0..64)
        .map(|i| {
            format!(
                "{{ index = {}, thickness_nm = {} }}",
                1.4 + 0.01 * f64::from(i % 7),
                40 + i
            )
        })
        .collect();
    let layers = layers.join(", ");
    parsed(&format!(
        "{HEAD}environment = {{ type = 'gradient', zenith = {{ constant = 2 }}, horizon = {{ constant = 1 }} }}\n\
         [materials.coated]\ntype = 'coated'\nsubstrate = 'silver'\nroughness = 0.2\nlayers = [{layers}]\n\
         [materials.film]\ntype = 'film'\nlayers = [{layers}]\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'coated'\ncenter = [-2, 0, 0]\nradius = 1.6\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'film'\ncenter = [2, 0, 0]\nradius = 1.6\n"
    ))
}

fn forms(scene: &Scene, is_software: bool) -> BTreeSet<String> {
    let made_for = PackedScene::new(scene).specialization(is_software);
    made_for
        .forms
        .iter()
        .map(|(_, form)| format!("{form:?}"))
        .collect()
}

#[test]
fn lists_give_the_same_bits_in_all_forms() {
    let (few, many) = (small("bench/bubble", [48, 36], 2, 8, 3), many(1200, 320));
    assert_eq!(forms(&few, false), ["Storage".to_owned()].into());
    assert_eq!(forms(&few, true), ["Uniform".to_owned()].into());
    assert!(forms(&many, true).contains("Texture"));
    let software = open().taken_for_software(true);
    let hardware = open().taken_for_software(false);
    for scene in [few, many] {
        let (one, other) = (on_gpu(&software, &scene), on_gpu(&hardware, &scene));
        assert!(one.variance() == other.variance() && one.radiance() == other.radiance());
        let brightest = one.xyz().iter().map(|xyz| xyz[1]).fold(0.0, f32::max);
        assert!(brightest > 0.0);
    }
}

#[test]
fn long_lists_agree_with_the_reference() {
    let gpu = lend();
    for (what, scene) in [
        ("1200 spheres, 400 lamps, 320 spectra", many(1200, 320)),
        ("two stacks of 64 layers", layered()),
        (
            "a mirror beside a rough metal",
            mirror_beside_a_rough_metal(),
        ),
    ] {
        let (actual, expected) = (on_gpu(&gpu, &scene), on_cpu(&scene));
        let compared = same_numbers(Values::of(&actual), Values::of(&expected), &FRAMES);
        println!(
            "{what}: {}",
            compared.unwrap_or_else(|report| panic!("{what}: {report}"))
        );
    }
}
