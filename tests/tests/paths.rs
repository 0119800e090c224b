//! Single paths: the recorded and evaluated path of the shader against the reference, band by band, with the same random numbers.

use gpu::PackedScene;
use pellicle_tests::frames::{Values, same_numbers};
use pellicle_tests::probe::Probe;
use pellicle_tests::scenes::{MADE, SHIPPED, small};
use pellicle_tests::tolerances::PATHS;
use rayon::prelude::*;
use std::collections::BTreeSet;

const SIDE: u32 = 96;
/// Eight bands: two groups, the second one half empty when there are six.
const BANDS: u32 = 6;

/// One sample of every pixel: offset of its wavelengths and the radiance of two groups of bands of each light group.
const BODY: &str = "let at = trace_path(Sample(vec2u(u32(a(0u)), u32(a(1u))), u32(a(2u))));
    put(0u, at.offset);
    let low = path_radiance(0u, at);
    let high = path_radiance(1u, at);
    let d = dimming(at);
    for (var i = 0u; i < LIGHT_GROUPS; i++) { put4(8u * i + 1u, d * low[i]); put4(8u * i + 5u, d * high[i]); }";

fn rows() -> Vec<[u32; 3]> {
    (0..SIDE * SIDE)
        .map(|i| [i % SIDE, i / SIDE, (i * 7) % 1000])
        .collect()
}

fn probe(packed: &PackedScene) -> Probe<'_> {
    Probe {
        roots: &["path", "evaluate"],
        body: BODY,
        shape: (3, 1 + 8 * packed.limits.light_groups as usize),
        scene: Some(packed),
    }
}

#[test]
fn every_path_agrees_with_the_reference() {
    let gpu = pellicle_tests::device::open();
    let mut wrong = Vec::new();
    for name in SHIPPED.iter().chain(MADE) {
        let scene = small(name, [SIDE, SIDE], 1, BANDS, 3);
        let packed = PackedScene::new(&scene);
        let table: Vec<f32> = rows().iter().flatten().map(|&x| x as f32).collect();
        let probe = probe(&packed);
        let (found, results) = (probe.run(&gpu, &table), probe.shape.1);
        let actual: Vec<f32> = found
            .chunks(results)
            .flat_map(|row| {
                row[1..]
                    .chunks(8)
                    .flat_map(|group| &group[..BANDS as usize])
            })
            .copied()
            .collect();
        let lights = scene.light_sources();
        let expected: Vec<_> = rows()
            .par_iter()
            .map(|&[x, y, sample]| reference::radiance(&scene, &lights, [x, y], sample))
            .collect();
        for (row, path) in found.chunks(results).zip(&expected) {
            assert_eq!(
                f64::from(row[0]),
                path.offset,
                "{name}: the wavelengths differ"
            );
        }
        let expected: Vec<f32> = expected
            .iter()
            .flat_map(|path| path.radiance.iter().flatten().map(|&x| x as f32))
            .collect();
        let of = |values| Values {
            bands: scene.light_groups().len() * BANDS as usize,
            values,
        };
        match same_numbers(of(&actual), of(&expected), &PATHS) {
            Ok(report) => println!("{name}: {report}"),
            Err(report) => wrong.push(format!("{name}: {report}")),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The probe really runs what it is said to prove.
#[test]
fn the_probe_reaches_the_whole_path_tracer() {
    let called: BTreeSet<String> = MADE
        .iter()
        .flat_map(|name| {
            let scene = small(name, [SIDE, SIDE], 1, BANDS, 3);
            probe(&PackedScene::new(&scene)).reach().0
        })
        .collect();
    for name in PROVED {
        assert!(called.contains(*name), "{name} is not called");
    }
}

/// Functions that this suite proves; the suite `functions` counts on it.
const PROVED: &[&str] = pellicle_tests::scenes::PROVED_ON_PATHS;
