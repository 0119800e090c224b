//! Divides work on many scenes among the cores, because a driver compiles a pipeline on one of them.

use crate::device::open;
use gpu::Gpu;
use std::num::NonZero;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Whether a case should run: all cases, or the one that `PELLICLE_ONLY` names.
pub fn is_asked_for(name: &str) -> bool {
    std::env::var("PELLICLE_ONLY").map_or(true, |only| only == name)
}

/// Does the work for each name that [`is_asked_for`], with one device per core, and returns the failures; successes are printed.
///
/// # Panics
/// When there is no driver, when no name is asked for, or when the work panics.
pub fn failures_of(
    names: &[&str],
    work: impl Fn(&Gpu, &str) -> Vec<Result<String, String>> + Sync,
) -> Vec<String> {
    let names: Vec<&str> = names
        .iter()
        .copied()
        .filter(|name| is_asked_for(name))
        .collect();
    assert!(
        !names.is_empty(),
        "PELLICLE_ONLY does not name any of the cases"
    );
    let next = AtomicUsize::new(0);
    let failures = Mutex::new(Vec::new());
    let workers = std::thread::available_parallelism().map_or(1, NonZero::get);
    std::thread::scope(|scope| {
        for _ in 0..workers.min(names.len()) {
            scope.spawn(|| {
                let gpu = open();
                while let Some(name) = names.get(next.fetch_add(1, Ordering::Relaxed)) {
                    for result in work(&gpu, name) {
                        match result {
                            Ok(report) => println!("{name}: {report}"),
                            Err(report) => failures
                                .lock()
                                .expect("no worker panicked")
                                .push(format!("{name}: {report}")),
                        }
                    }
                }
            });
        }
    });
    failures.into_inner().expect("no worker panicked")
}
