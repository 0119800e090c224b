//! What an execution costs: time, memory and panics.

use peak_alloc::PeakAlloc;
use std::panic::{self, AssertUnwindSafe};
use std::sync::{Mutex, Once, PoisonError};
use std::time::{Duration, Instant};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Where and why the last thread panicked.
static PANIC: Mutex<String> = Mutex::new(String::new());

/// What an execution cost.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cost {
    pub(crate) time: Duration,
    /// The most bytes that were held at once, beside those held before.
    pub(crate) bytes: usize,
}

impl Cost {
    /// What a reader may cost for an input of `length` bytes from which it made `kept` bytes; `Err` says what is too much.
    pub(crate) fn check(&self, length: usize, kept: usize) -> Result<(), String> {
        let most_bytes = 20 * length + (64 << 20) + 4 * kept;
        if self.bytes > most_bytes {
            return Err(format!(
                "holds {} MB for an input of {length} bytes; at most {} MB are right",
                self.bytes >> 20,
                most_bytes >> 20
            ));
        }
        let most_time = Duration::from_secs_f64((length as f64 / 1e5).max(1.0) * slack());
        if self.time > most_time {
            return Err(format!(
                "takes {:?} for an input of {length} bytes; at most {most_time:?} are right",
                self.time
            ));
        }
        Ok(())
    }
}

/// By how much an execution may take longer than it should. As a test among others it waits for their work and for other users of the
/// machine; with `PELLICLE_FUZZ_SECONDS` it has the machine to itself.
fn slack() -> f64 {
    let is_campaign = std::env::var_os("PELLICLE_FUZZ_SECONDS").is_some();
    if is_campaign { 1.0 } else { 20.0 }
}

/// What `read` returns and costs; a panic becomes an `Err`.
pub(crate) fn measured<T>(read: impl FnOnce() -> T) -> (Result<T, String>, Cost) {
    keep_panics();
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let start = Instant::now();
    let result = panic::catch_unwind(AssertUnwindSafe(read));
    let cost = Cost {
        time: start.elapsed(),
        bytes: MEMORY.peak_usage().saturating_sub(before),
    };
    let said = |_| format!("panics: {}", last_panic());
    (result.map_err(said), cost)
}

fn last_panic() -> String {
    PANIC.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

/// Has panics written down rather than printed: a campaign tells each kind once.
fn keep_panics() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let print = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let is_test = |file: &str| file.contains("fuzz/src") || file.contains("fuzz\\src");
            if info.location().is_some_and(|place| is_test(place.file())) {
                print(info);
            }
            *PANIC.lock().unwrap_or_else(PoisonError::into_inner) = info.to_string();
        }));
    });
}
