//! The device that the suites run on.

use gpu::{AdapterChoice, Gpu};

/// Whether suites that render whole scenes take the short form, as `PELLICLE_SHORT` asks: pictures of the same random numbers alone, no statistics. It is for a
/// second driver, after the first one has proved the numbers.
pub fn is_short() -> bool {
    std::env::var_os("PELLICLE_SHORT").is_some()
}

/// Opens the adapter named by `PELLICLE_ADAPTER`, or the best; prints which.
///
/// # Panics
/// Where there is none: a suite that needs a driver fails rather than skips.
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
