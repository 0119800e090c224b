//! Single paths: the recorded and evaluated path of the shader against the reference, band by band, with the same random numbers.

use crate::{on_cpu, on_gpu};
use gpu::modules::Shader;
use gpu::{Gpu, PackedScene};
use pellicle_tests::frames::{Values, same_numbers};
use pellicle_tests::probe::Probe;
use pellicle_tests::scenes::{
    BANDS, MADE, PROVED_ON_PATHS, PROVED_ON_POLARIZED, made_polarized, small,
};
use pellicle_tests::tolerances::PATHS;
use std::collections::BTreeSet;

const SIDE: u32 = 96;

/// Compares one sample of every pixel, by the renderer itself: the radiance of each light group.
pub(crate) fn compared(gpu: &Gpu, name: &str) -> Vec<Result<String, String>> {
    let scene = small(name, [SIDE, SIDE], 1, BANDS, 3);
    let (actual, expected) = (on_gpu(gpu, &scene), on_cpu(&scene));
    let groups = scene.light_groups().iter().enumerate();
    let compared = groups.map(|(index, group)| {
        let of = |image| Values::of_light(image, index);
        let named = |report| format!("single paths, light group {}: {report}", group.name);
        let compared = same_numbers(of(&actual), of(&expected), &PATHS);
        compared.map(named).map_err(named)
    });
    compared.collect()
}

/// The work of the renderer for each sample.
fn probe(packed: &PackedScene) -> Probe<'_> {
    Probe {
        body: "let at = trace_path(Sample(vec2u(u32(a(0u)), u32(a(1u))), u32(a(2u))));
            let dimmed = dimming(at);
            let radiance = path_radiance(0u, at);
            put4(0u, dimmed * radiance[0]);",
        shape: (3, 4),
        scene: Some(packed),
    }
}

/// The renderer's work for each sample reaches all functions that single paths are claimed to prove.
pub(crate) fn the_probe_reaches_the_whole_path_tracer() {
    let called: BTreeSet<String> = MADE
        .iter()
        .flat_map(|name| {
            let scene = small(name, [SIDE, SIDE], 1, BANDS, 3);
            probe(&PackedScene::new(&scene)).reach()
        })
        .collect();
    for name in PROVED_ON_PATHS {
        assert!(called.contains(*name), "{name} is not called");
    }
}

/// The renderer reaches all functions that pictures of polarized light are claimed to prove.
pub(crate) fn the_renderer_reaches_all_of_polarized_light() {
    let mut left = BTreeSet::new();
    for name in made_polarized() {
        let packed = PackedScene::new(&small(name, [SIDE, SIDE], 1, BANDS, 3));
        let shader = Shader::assemble(&packed.specialization(false), "");
        let module = shader.specialized("render").expect("valid");
        left.extend(module.functions.iter().filter_map(|(_, f)| f.name.clone()));
    }
    for name in PROVED_ON_POLARIZED {
        assert!(left.contains(*name), "{name} is not called");
    }
}
