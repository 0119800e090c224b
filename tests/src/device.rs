//! The devices that the suites run on: a pool that every test borrows from.

use gpu::{AdapterChoice, Gpu};
use std::ops::Deref;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Devices that nobody uses at the moment, the one that was used last at the end.
static IDLE: Mutex<Vec<Gpu>> = Mutex::new(Vec::new());

fn idle() -> MutexGuard<'static, Vec<Gpu>> {
    IDLE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A device of the pool, for as long as this value lives.
#[derive(Debug)]
pub struct Lent(Option<Gpu>);

impl Deref for Lent {
    type Target = Gpu;

    fn deref(&self) -> &Gpu {
        self.0.as_ref().expect("the device is there until the drop")
    }
}

impl Drop for Lent {
    /// Gives the device back, unless the test failed: the device may be the reason.
    fn drop(&mut self) {
        if !std::thread::panicking() {
            idle().extend(self.0.take());
        }
    }
}

/// Lends a device that is idle, or opens another one. So there are as many as tests that run at once, and a test may find pipelines
/// that one before it compiled.
///
/// # Panics
/// As [`open`] does.
pub fn lend() -> Lent {
    let found = idle().pop();
    Lent(Some(found.unwrap_or_else(open)))
}

/// Opens the adapter named by `PELLICLE_ADAPTER`, or else the best one, and prints which. Most tests call [`lend`] instead; this is for
/// those that need a device of their own.
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

/// Whether suites that render whole scenes run in their short form, as `PELLICLE_SHORT` requests: only pictures with the same random
/// numbers, no statistics. It is for a second driver, after the numbers have been proved on the first.
pub fn is_short() -> bool {
    std::env::var_os("PELLICLE_SHORT").is_some()
}
