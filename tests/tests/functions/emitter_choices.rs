//! Functions of emitter_choice.wgsl, and those of emitter.wgsl for emitters that are not objects.

use crate::world::{everything, pictured, rounded, rows, unit, vector, within};
use crate::{Check, lazy, pure, table};
use pellicle_tests::tolerances::{ARITHMETIC, EMITTER_WEIGHT};
use reference::{Emitter, PreparedScene, choose_emitter, mis_weight_bsdf, mis_weight_emitter};
use scene::EmitterSource;
use std::sync::OnceLock;

fn sources() -> &'static [EmitterSource] {
    static SOURCES: OnceLock<Vec<EmitterSource>> = OnceLock::new();
    SOURCES.get_or_init(|| everything().scene.emitters())
}

fn emitter_of(number: f64) -> Emitter<'static> {
    Emitter::of(&everything().scene, sources()[number as usize].kind)
}

/// Rows of an emitter's number, which is the same in the shader, a point and a unit vector.
fn places() -> Vec<f32> {
    let count = sources().len() as f64;
    rows(6, |u| {
        let number = (u[0] * count).floor();
        let point = rounded(12.0 * (glam::DVec3::new(u[1], u[2], u[3]) - 0.5));
        let normal = rounded(unit(u[4], u[5]));
        Some([&[number][..], &point.to_array(), &normal.to_array()].concat())
    })
}

pub(crate) fn checks() -> Vec<Check> {
    vec![
        Check {
            probe: within(
                everything,
                (7, 1),
                "put(0u, emitter_strength(u32(a(0u)), a3(1u), a3(4u)));",
            ),
            proves: &[
                "emitter_at",
                "emitters_row",
                "is_delta",
                "is_environment",
                "emitter_strength",
                "load_emitter",
                "spot_falloff",
            ],
            inputs: lazy(places),
            twin: |a| vec![emitter_of(a[0]).strength(vector(&a[1..]), vector(&a[4..]))],
            tolerance: EMITTER_WEIGHT,
        },
        Check {
            probe: within(
                everything,
                (7, 1),
                "let l = u32(a(0u)); put(0u, emitter_weight(l, a3(1u), a3(4u)) / emitter_at(l).brightness);",
            ),
            proves: &[
                "emitter_weight",
                "plane_weight",
                "plane_area",
                "environment_weight",
                "most_cosine",
            ],
            inputs: lazy(places),
            twin: |a| vec![emitter_of(a[0]).weight(vector(&a[1..]), vector(&a[4..]))],
            tolerance: EMITTER_WEIGHT,
        },
        Check {
            probe: within(
                everything,
                (7, 1),
                "put(0u, emitter_pmf(u32(a(0u)), a3(1u), a3(4u), weigh_emitters(a3(1u), a3(4u))));",
            ),
            proves: &["emitter_pmf", "weigh_emitters"],
            inputs: lazy(places),
            twin: |a| vec![chances(a)[a[0] as usize]],
            tolerance: EMITTER_WEIGHT,
        },
        Check {
            probe: within(
                everything,
                (7, 2),
                "let c = choose_emitter(a3(1u), a3(4u), a(0u)); put(0u, f32(c.emitter)); put(1u, c.pmf);",
            ),
            proves: &["choose_emitter"],
            inputs: lazy(choices),
            twin: |a| {
                let chosen =
                    choose_emitter(chances(a).into_iter(), a[0]).expect("one of them emits");
                vec![chosen.emitter as f64, chosen.pmf]
            },
            tolerance: EMITTER_WEIGHT,
        },
        Check {
            probe: pure((2, 1), "put(0u, mis_weight_bsdf(a(0u), a(1u)));"),
            proves: &["mis_weight_bsdf"],
            inputs: lazy(move || table(&[(0.01, 10.0), (0.0, 10.0)], &[&[1e-3, 1e3], &[5.0, 0.0]])),
            twin: |a| vec![mis_weight_bsdf(a[0], a[1])],
            tolerance: ARITHMETIC,
        },
        Check {
            probe: within(
                pictured,
                (4, 1),
                "put(0u, mis_weight_emitter(u32(a(0u)), a(1u), a(2u), a(3u)));",
            ),
            proves: &["mis_weight_emitter"],
            inputs: lazy(move || {
                rows(4, |u| {
                    let number = (u[0] * pictured().scene.emitters().len() as f64).floor();
                    let [scattered, density] = [u[1], u[3]].map(|u| 10.0_f64.powf(6.0 * u - 3.0));
                    Some(vec![number, scattered, u[2], density])
                })
            }),
            twin: |a| {
                let scene = &pictured().scene;
                let emitter = Emitter::of(scene, scene.emitters()[a[0] as usize].kind);
                vec![mis_weight_emitter(emitter, a[1], a[2], a[3])]
            },
            tolerance: ARITHMETIC,
        },
    ]
}

fn chances(a: &[f64]) -> Vec<f64> {
    static PREPARED: OnceLock<PreparedScene> = OnceLock::new();
    let prepared = PREPARED.get_or_init(|| PreparedScene::new(&everything().scene));
    prepared.emitter_pmfs(vector(&a[1..]), vector(&a[4..]))
}

/// Rows of a number, a point and a normal, without those within a rounding of the border between two emitters.
fn choices() -> Vec<f32> {
    let is_clear = |row: &&[f32]| {
        let row: Vec<f64> = row.iter().map(|&x| f64::from(x)).collect();
        let mut sum = 0.0;
        let is_off = chances(&row).iter().all(|chance| {
            sum += chance;
            (sum - row[0]).abs() > 1e-4
        });
        // Nothing is chosen where no light can arrive.
        is_off && sum > 0.0
    };
    let numbers = table(&[(0.0, 0.999)], &[]);
    let places = places();
    let rows = places.chunks(7).zip(numbers);
    let rows = rows.map(|(place, number)| [&[number], &place[1..]].concat());
    rows.filter(|row| is_clear(&row.as_slice()))
        .flatten()
        .collect()
}
