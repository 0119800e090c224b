//! Single paths: the recorded and evaluated path of the shader against the reference, band by band, with the same random numbers.

use gpu::PackedScene;
use pellicle_tests::frames::{Values, same_numbers};
use pellicle_tests::probe::Probe;
use pellicle_tests::scenes::{BANDS, MADE, all, small};
use pellicle_tests::tolerances::PATHS;
use pellicle_tests::workers::failures_of;
use std::collections::BTreeSet;
use std::ops::ControlFlow;

const SIDE: u32 = 96;

/// Compares one sample of every pixel, by the renderer itself: the radiance of each light group.
#[test]
fn every_path_agrees_with_the_reference() {
    let wrong = failures_of(&all(), |gpu, name| {
        let scene = small(name, [SIDE, SIDE], 1, BANDS, 3);
        let actual = gpu::render(gpu, &scene, &mut |_| ControlFlow::Continue(()))
            .unwrap_or_else(|error| panic!("{error}"));
        let expected = reference::render(&scene, &mut |_| ControlFlow::Continue(()))
            .expect("nothing stops the render");
        let compared = |light_group| {
            let of = |image| Values::of_light(image, light_group);
            same_numbers(of(&actual), of(&expected), &PATHS)
        };
        (0..scene.light_groups().len()).map(compared).collect()
    });
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
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

/// The renderer's work for each sample reaches all functions that this suite claims to prove.
#[test]
fn the_probe_reaches_the_whole_path_tracer() {
    let called: BTreeSet<String> = MADE
        .iter()
        .flat_map(|name| {
            let scene = small(name, [SIDE, SIDE], 1, BANDS, 3);
            probe(&PackedScene::new(&scene)).reach()
        })
        .collect();
    for name in PROVED {
        assert!(called.contains(*name), "{name} is not called");
    }
}

/// Functions that this suite proves; the suite `functions` relies on it.
const PROVED: &[&str] = pellicle_tests::scenes::PROVED_ON_PATHS;
