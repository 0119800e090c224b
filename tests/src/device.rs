//! The device that the suites run on.

use gpu::{AdapterChoice, Gpu};

/// Whether suites that render whole scenes run in their short form, as `PELLICLE_SHORT` requests: only pictures with the same random
/// numbers, no statistics. It is for a second driver, after the numbers have been proved on the first.
pub fn is_short() -> bool {
    std::env::var_os("PELLICLE_SHORT").is_some()
}

/// Opens the adapter named by `PELLICLE_ADAPTER`, or else the best one, and prints which.
///
/// # Panics
/// When there is none: a suite that needs a driver fails and does not skip.
pub fn open() -> Gpu {
    let choice = match std::env::var("PELLICLE_ADAPTER") {
        Ok(name) => AdapterChoice::Named(name),
        Err(_) => AdapterChoice::Best,
    };
    match Gpu::open(&choice) {
        Ok(gpu) => {
            println!("adapter: {}", gpu.description());
            gpu
        }
        Err(error) => panic!("this suite needs a driver: {error}"),
    }
}
