//! Compares every WGSL function with its Rust twin, on many inputs that include the edge cases.

mod bodies;
mod cameras;
mod emitter_choices;
mod emitters;
mod environments;
mod facet_edges;
mod facets;
mod factors;
mod many_emitters;
mod numbers;
mod optics_functions;
mod rays;
mod shapes;
mod spectra;
mod splits;
mod stacks;
mod surface_functions;
mod thicknesses;
mod world;

use gpu::Gpu;
use gpu::modules::MODULES;
use pellicle_tests::agreement::{Tolerance, compare};
use pellicle_tests::probe::Probe;
use pellicle_tests::scenes::{PROVED_ON_FRAMES, PROVED_ON_PATHS, PROVED_ON_STACKS};
use pellicle_tests::workers::is_asked_for;
use std::collections::BTreeSet;
use std::sync::OnceLock;

/// Number of rows in a table of inputs.
const ROWS: usize = 100_000;

fn device() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(pellicle_tests::device::open)
}

/// A check of one function, or of a few related ones.
struct Check {
    probe: Probe<'static>,
    /// Functions that the check proves; the probe must really call them.
    proves: &'static [&'static str],
    inputs: Vec<f32>,
    twin: fn(&[f64]) -> Vec<f64>,
    tolerance: Tolerance,
}

/// A probe without a scene.
const fn pure(shape: (usize, usize), body: &'static str) -> Probe<'static> {
    Probe {
        body,
        shape,
        scene: None,
    }
}

impl Check {
    fn run(&self) -> Result<String, String> {
        let found = self.probe.run(device(), &self.inputs);
        let actual: Vec<f64> = found.iter().map(|&x| f64::from(x)).collect();
        let rows = self.inputs.chunks(self.probe.shape.0);
        let expected: Vec<f64> = rows
            .flat_map(|row| (self.twin)(&row.iter().map(|&x| f64::from(x)).collect::<Vec<_>>()))
            .collect();
        compare(&actual, &expected, self.tolerance)
            .map(|report| format!("{:?}: {report}", self.proves))
            .map_err(|report| format!("{:?}: {report}", self.proves))
    }
}

/// Rows of numbers, after the given edge cases; each column is uniform in its range.
fn table(ranges: &[(f32, f32)], edges: &[&[f32]]) -> Vec<f32> {
    let mut numbers: Vec<f32> = edges.iter().flat_map(|row| row.to_vec()).collect();
    assert!(
        edges.iter().all(|row| row.len() == ranges.len()),
        "an edge case has another number of columns"
    );
    for row in 0..ROWS as u32 {
        for (column, &(low, high)) in ranges.iter().enumerate() {
            let u = reference::random4([row & 0xffff, row >> 16], column as u32, 99, 1)[0] as f32;
            numbers.push(low + (high - low) * u);
        }
    }
    numbers
}

fn checks() -> Vec<Check> {
    [
        bodies::checks(),
        cameras::checks(),
        environments::checks(),
        facet_edges::checks(),
        facets::checks(),
        factors::checks(),
        emitter_choices::checks(),
        emitters::checks(),
        many_emitters::checks(),
        numbers::checks(),
        optics_functions::checks(),
        rays::checks(),
        shapes::checks(),
        spectra::checks(),
        splits::checks(),
        stacks::checks(),
        surface_functions::checks(),
        thicknesses::checks(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

#[test]
fn every_function_agrees_with_its_twin() {
    let is_asked_for = |check: &&Check| check.proves.iter().any(|name| is_asked_for(name));
    let checks = checks();
    let results: Vec<_> = checks.iter().filter(is_asked_for).map(Check::run).collect();
    assert!(
        !results.is_empty(),
        "PELLICLE_ONLY does not name a function that a probe proves"
    );
    for report in results.iter().flatten() {
        println!("{report}");
    }
    let wrong: Vec<_> = results.into_iter().filter_map(Result::err).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_function_of_the_shaders_is_proved() {
    let mut proved: BTreeSet<String> = PROVED_ON_PATHS
        .iter()
        .chain(PROVED_ON_FRAMES)
        .chain(PROVED_ON_STACKS)
        .map(|&name| name.to_owned())
        .collect();
    for check in checks() {
        let called = check.probe.reach();
        for &name in check.proves {
            assert!(
                called.contains(name),
                "{name} is not called by the probe that proves it"
            );
            proved.insert(name.to_owned());
        }
    }
    let declared: BTreeSet<String> = MODULES
        .iter()
        .flat_map(|m| pellicle_tests::wgsl::functions(m.source))
        .collect();
    assert!(declared.len() > 60, "few functions found");
    assert_eq!(declared, proved);
}

/// The comparison above can fail: an index one percent off, a sine instead of a cosine.
#[test]
fn a_wrong_twin_is_noticed() {
    let mut checks = optics_functions::checks();
    let check = checks
        .iter_mut()
        .find(|c| c.proves.contains(&"clear_film_reflectance"))
        .expect("exists");
    check.twin = |a| {
        let wrong = optics::film((1.01 * a[0]).into(), a[1], a[2], a[3].max(1e-6));
        vec![wrong.reflectance.unpolarized()]
    };
    assert!(check.run().is_err());
    let mut checks = numbers::checks();
    let check = checks
        .iter_mut()
        .find(|c| c.proves.contains(&"direction_of_turn"))
        .expect("exists");
    check.twin = |a| {
        let (sine, cosine) = (std::f64::consts::TAU * a[0]).sin_cos();
        vec![sine, cosine]
    };
    assert!(check.run().is_err());
}
