//! Functions of the emitter tree in emitter_choice.wgsl: the choice among many emitters.

use crate::world::{World, rounded, rows, unit, vector, within};
use crate::{Check, lazy};
use glam::DVec3;
use gpu::PackedScene;
use pellicle_tests::tolerances::EMITTER_TREE;
use reference::PreparedScene;
use scene_file::SceneFile;
use std::fmt::Write as _;
use std::path::Path;
use std::sync::OnceLock;

/// A world with lamps of four kinds in the cells of a cube, with axes in all directions, and the sun.
fn world() -> &'static World {
    static WORLD: OnceLock<World> = OnceLock::new();
    WORLD.get_or_init(|| {
        let mut text = String::from(
            "camera = { type = 'orthographic', position = [0, 0, 9], look_at = [0, 0, 0], height = 9 }\n\
             render = { bands = 4 }\n\
             materials = { weak = { type = 'emitter', emission = { constant = 1 } }, strong = { type = 'emitter', emission = { constant = 20 } } }\n\
             [[lights]]\ntype = 'distant'\ndirection = [0, 1, 0]\nemission = { constant = 0.01 }\n",
        );
        for i in 0..125_u32 {
            let number = |k: u32| f64::from(i.wrapping_mul(k) >> 16 & 0xff) / 256.0 - 0.5;
            let cell = DVec3::new(f64::from(i % 5), f64::from(i / 5 % 5), f64::from(i / 25));
            let jitter = DVec3::new(number(0x9e37_79b9), number(0x85eb_ca6b), number(0xc2b2_ae35));
            let place = (2.0 * cell - 4.0 + jitter).to_array();
            let axis = unit(number(0x27d4_eb2f) + 0.5, number(0x1656_67b1)).to_array();
            let material = if i % 7 == 0 { "strong" } else { "weak" };
            let object = format!("[[objects]]\nmaterial = '{material}'\ncenter = {place:?}");
            let light = format!("[[lights]]\nemission = {{ constant = 0.1 }}\nposition = {place:?}");
            match i % 4 {
                0 => writeln!(text, "{object}\ntype = 'sphere'\nradius = 0.1"),
                1 => writeln!(text, "{object}\ntype = 'rectangle'\nnormal = {axis:?}\nsize = [0.3, 0.1]"),
                2 => writeln!(text, "{light}\ntype = 'point'"),
                _ => writeln!(text, "{light}\ntype = 'spot'\ndirection = {axis:?}\nangle_deg = 40"),
            }
            .expect("writing to a string succeeds");
        }
        let scene = SceneFile::parse("lamps", &text, Path::new(""))
            .and_then(|file| file.validate())
            .unwrap_or_else(|problems| panic!("{problems}"))
            .rounded_to_f32();
        let packed = PackedScene::new(&scene);
        World { scene, packed }
    })
}

/// The emitter that a number chooses at a point with a normal, and its probability; `None` where no light can arrive.
fn choice(a: &[f64]) -> Option<(usize, f64)> {
    static PREPARED: OnceLock<PreparedScene> = OnceLock::new();
    let prepared = PREPARED.get_or_init(|| PreparedScene::new(&world().scene));
    let choice = prepared.choose_emitter_at(vector(&a[1..]), vector(&a[4..]), a[0])?;
    Some((choice.emitter, choice.pmf))
}

/// Whether a row is away from values at which the choice changes, by its number or by the groups that the point is near.
fn is_clear(row: &[f64]) -> bool {
    let Some((emitter, pmf)) = choice(row) else {
        return false;
    };
    [(0, 1e-4), (0, -1e-4), (1, 1e-4), (2, -1e-4), (3, 1e-4)]
        .iter()
        .all(|&(column, step)| {
            let mut beside = row.to_vec();
            beside[column] += step;
            choice(&beside).is_some_and(|(other, beside)| {
                other == emitter && (beside / pmf - 1.0).abs() < 0.02
            })
        })
}

pub(crate) fn checks() -> Vec<Check> {
    vec![Check {
        probe: within(world, (7, 3),
            "let c = choose_emitter(a3(1u), a3(4u), a(0u));
             put(0u, f32(c.emitter)); put(1u, c.pmf); put(2u, emitter_pmf(c.emitter, a3(1u), a3(4u), c.weight_sum));",
        ),
        proves: &[
            "choose_in_tree",
            "group_weight",
            "is_near",
            "is_outside_cone",
            "load_emitternode",
            "mean_above",
            "node_weight",
            "rest_of",
            "tree_pmf",
            "weigh_tree",
            "trees_row",
        ],
        inputs: lazy(move || rows(6, |u| {
            let point = rounded(12.0 * (DVec3::new(u[1], u[2], u[3]) - 0.5));
            let normal = rounded(unit(u[4], u[5]));
            let random = f64::from((0.0001 + 0.9998 * u[0]) as f32);
            let row = [&[random][..], &point.to_array(), &normal.to_array()].concat();
            is_clear(&row).then_some(row)
        })),
        twin: |a| choice(a).map_or(vec![-1.0; 3], |(emitter, pmf)| vec![emitter as f64, pmf, pmf]),
        tolerance: EMITTER_TREE,
    }]
}

/// The tree is deep, most rows are clear, and many emitters are chosen.
pub(crate) fn the_choice_among_many_is_covered() {
    let nodes = world().scene.emitter_tree().nodes.len();
    assert!(nodes > 200, "{nodes}");
    let check = &checks()[0];
    let rows = check
        .inputs
        .chunks(7)
        .map(|row| row.iter().map(|&x| f64::from(x)).collect::<Vec<_>>());
    let chosen: std::collections::BTreeSet<_> = rows
        .filter_map(|row| choice(&row))
        .map(|(emitter, _)| emitter)
        .collect();
    assert!(
        check.inputs.len() > 7 * 50_000,
        "{}",
        check.inputs.len() / 7
    );
    assert!(chosen.len() > 120, "{}", chosen.len());
}
