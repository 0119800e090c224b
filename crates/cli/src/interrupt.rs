//! Ctrl-C and SIGTERM.
//!
//! The first signal asks a render to end with its round and to write what it has; at any other time it ends the program at once, as a
//! second signal always does. Temporary files are removed in any case.

use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
#[cfg(unix)]
use std::time::{Duration, Instant};

/// The signal that came, or 0.
static SIGNAL: AtomicI32 = AtomicI32::new(0);
/// Whether something will see to it that what was done is kept.
static IS_AWAITED: AtomicBool = AtomicBool::new(false);

/// While it lives, the first signal is only recorded.
pub(crate) struct Awaited(());

impl Awaited {
    pub(crate) fn new() -> Self {
        IS_AWAITED.store(true, Ordering::SeqCst);
        Self(())
    }
}

impl Drop for Awaited {
    fn drop(&mut self) {
        IS_AWAITED.store(false, Ordering::SeqCst);
    }
}

/// The signal that was recorded, if any.
pub(crate) fn signal() -> Option<i32> {
    Some(SIGNAL.load(Ordering::SeqCst)).filter(|&signal| signal != 0)
}

/// The exit code of a program that a signal has ended, by the convention of shells: 130 for Ctrl-C, 143 for SIGTERM.
pub(crate) fn exit_code(signal: i32) -> u8 {
    128 + signal.clamp(0, 127) as u8
}

/// Signals within this time are one: a terminal or a scheduler sends it to a program and to its parent, which may pass it on.
#[cfg(unix)]
const SAME: Duration = Duration::from_millis(500);

/// Starts to listen for signals.
#[cfg(unix)]
pub(crate) fn listen() {
    use pellicle::picture_file::abandon_all;
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    // Without this the system ends the program, and may leave a temporary file.
    let Ok(mut signals) = Signals::new([SIGHUP, SIGINT, SIGTERM]) else {
        return;
    };
    std::thread::spawn(move || {
        let mut first = None;
        for signal in signals.forever() {
            if IS_AWAITED.load(Ordering::SeqCst) {
                let since = *first.get_or_insert_with(Instant::now);
                if SIGNAL.swap(signal, Ordering::SeqCst) == 0 {
                    crate::print::note("stopping after this round; once more stops at once");
                    continue;
                }
                if since.elapsed() < SAME {
                    continue;
                }
            }
            // Until the end no other thread can create or rename a file.
            let _all = abandon_all();
            signal_hook::low_level::exit(i32::from(exit_code(signal)));
        }
    });
}

/// Other systems end the program themselves.
#[cfg(not(unix))]
pub(crate) fn listen() {}
