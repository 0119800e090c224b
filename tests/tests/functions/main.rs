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
mod polarized;
mod rays;
mod shapes;
mod spectra;
mod splits;
mod stacks;
mod surface_functions;
mod thicknesses;
mod world;

use gpu::modules::MODULES;
use libtest_mimic::Trial;
use pellicle_tests::agreement::{Tolerance, compare};
use pellicle_tests::device::lend;
use pellicle_tests::probe::Probe;
use pellicle_tests::scenes::{
    PROVED_ON_FRAMES, PROVED_ON_PATHS, PROVED_ON_POLARIZED, PROVED_ON_STACKS,
};
use pellicle_tests::{cases, cases::comparisons};
use std::collections::{BTreeMap, BTreeSet};
use std::process::ExitCode;
use std::sync::LazyLock;

/// Number of rows in a table of inputs.
const ROWS: usize = 100_000;

/// What a case makes when it runs, so that the cases are listed at once.
type Lazy<T> = LazyLock<T, Box<dyn FnOnce() -> T + Send>>;

fn lazy<T>(make: impl FnOnce() -> T + Send + 'static) -> Lazy<T> {
    LazyLock::new(Box::new(make))
}

/// A check of one function, or of a few related ones.
struct Check {
    probe: Lazy<Probe<'static>>,
    /// Functions that the check proves; the probe must really call them.
    proves: &'static [&'static str],
    inputs: Lazy<Vec<f32>>,
    twin: fn(&[f64]) -> Vec<f64>,
    tolerance: Tolerance,
}

/// A probe without a scene.
fn pure(shape: (usize, usize), body: &'static str) -> Lazy<Probe<'static>> {
    lazy(move || Probe {
        body,
        shape,
        scene: None,
    })
}

impl Check {
    /// Compares the functions with their twin on all inputs.
    fn run(&self) -> Result<String, String> {
        let found = self.probe.run(&lend(), &self.inputs);
        let actual: Vec<f64> = found.iter().map(|&x| f64::from(x)).collect();
        let rows = self.inputs.chunks(self.probe.shape.0);
        let expected: Vec<f64> = rows
            .flat_map(|row| (self.twin)(&row.iter().map(|&x| f64::from(x)).collect::<Vec<_>>()))
            .collect();
        compare(&actual, &expected, self.tolerance)
    }

    /// Requires that the probe calls all functions that the check proves.
    fn reaches(&self) -> Result<String, String> {
        let called = self.probe.reach();
        match self.proves.iter().find(|&&name| !called.contains(name)) {
            Some(name) => Err(format!("{name} is not called by the probe that proves it")),
            None => Ok(format!("{} functions are called", called.len())),
        }
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
        polarized::checks(),
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

/// The checks as cases, each with the names of its functions; those of several checks are numbered.
fn comparisons_of_checks() -> Vec<Trial> {
    let mut seen = BTreeMap::<String, u32>::new();
    let case = |check: Check| {
        let functions = check.proves.join(", ");
        let times = seen.entry(functions.clone()).or_default();
        *times += 1;
        let name = match times {
            1 => functions,
            _ => format!("{functions} ({times})"),
        };
        comparisons(name, move || vec![check.reaches(), check.run()])
    };
    checks().into_iter().map(case).collect()
}

fn main() -> ExitCode {
    let mut all = comparisons_of_checks();
    all.extend(cases![
        every_function_of_the_shaders_is_proved,
        a_wrong_twin_is_noticed,
        a_function_that_is_not_called_is_noticed,
        emitters::a_wrong_density_of_a_light_is_noticed,
        factors::every_factor_occurs,
        factors::a_pattern_with_exchanged_colors_is_noticed,
        many_emitters::the_choice_among_many_is_covered,
        rays::every_object_is_hit,
        stacks::a_wrong_twin_of_a_stack_is_noticed,
        surface_functions::surfaces_are_reciprocal,
        thicknesses::the_scene_has_every_kind_of_thickness_on_spheres_and_elsewhere,
        thicknesses::a_wrong_twin_of_a_thickness_is_noticed,
    ]);
    cases::run(all)
}

fn every_function_of_the_shaders_is_proved() {
    let checks = checks();
    let proved: BTreeSet<String> = checks
        .iter()
        .flat_map(|check| check.proves)
        .chain(PROVED_ON_PATHS)
        .chain(PROVED_ON_FRAMES)
        .chain(PROVED_ON_POLARIZED)
        .chain(PROVED_ON_STACKS)
        .map(|&name| name.to_owned())
        .collect();
    let declared: BTreeSet<String> = MODULES
        .iter()
        .flat_map(|m| pellicle_tests::wgsl::functions(m.source))
        .collect();
    assert!(declared.len() > 60, "few functions found");
    assert_eq!(declared, proved);
}

/// A check that claims to prove a function, without a call of it, proves nothing.
fn a_function_that_is_not_called_is_noticed() {
    let mut checks = splits::checks();
    checks[0].proves = &["reflected_at"];
    assert!(checks[0].reaches().is_ok());
    checks[0].proves = &["reflected_at", "pcg4d"];
    assert!(checks[0].reaches().is_err());
}

/// The comparison above can fail: an index one percent off, a sine instead of a cosine.
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
