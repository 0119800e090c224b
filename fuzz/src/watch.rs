//! Cost of an execution: time, memory and panics.

use peak_alloc::PeakAlloc;
use std::panic::{self, AssertUnwindSafe};
use std::sync::{Mutex, Once, PoisonError};
use std::time::{Duration, Instant};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Position and message of the last panic.
static PANIC: Mutex<String> = Mutex::new(String::new());

/// Cost of an execution.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cost {
    pub(crate) time: Duration,
    /// The largest number of bytes that were held at once, in addition to those held before.
    pub(crate) bytes: usize,
}

impl Cost {
    /// Checks the cost for an input of `length` bytes with a result of `kept` bytes; `Err` says what is too much.
    pub(crate) fn check(&self, length: usize, kept: usize) -> Result<(), String> {
        let most_bytes = 20 * length + (64 << 20) + 4 * kept;
        if self.bytes > most_bytes {
            return Err(format!(
                "holds {} MB for an input of {length} bytes; at most {} MB are allowed",
                self.bytes >> 20,
                most_bytes >> 20
            ));
        }
        let most_time = Duration::from_secs_f64((length as f64 / 1e5).max(1.0) * slack());
        if self.time > most_time {
            return Err(format!(
                "takes {:?} for an input of {length} bytes; at most {most_time:?} are allowed",
                self.time
            ));
        }
        Ok(())
    }
}

/// Factor by which an execution may exceed its time limit. In an ordinary test run it waits for other tests and other users of the
/// machine; with `PELLICLE_FUZZ_SECONDS` it has the machine to itself.
fn slack() -> f64 {
    let is_campaign = std::env::var_os("PELLICLE_FUZZ_SECONDS").is_some();
    if is_campaign { 1.0 } else { 20.0 }
}

/// The result of `read` and its cost; a panic becomes an `Err`.
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

/// Stores panics instead of printing them, because a campaign reports each kind once.
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
