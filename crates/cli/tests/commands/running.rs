//! A command while it runs: waiting for what it writes, and sending it signals.

use crate::place::{Place, Ran};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// How long anything may take that a test waits for: a driver's compiler on a machine with much else to do.
const PATIENCE: Duration = Duration::from_mins(2);
/// How often a folder is looked at: files are written within milliseconds.
const GLANCE: Duration = Duration::from_micros(200);

/// A command that runs in a place. It is ended with the test.
#[derive(Debug)]
pub(crate) struct Running(Option<Child>);

impl Running {
    pub(crate) fn start(place: &Place, arguments: &str) -> Self {
        Self::of(&mut place.command(arguments))
    }

    pub(crate) fn of(command: &mut Command) -> Self {
        command.stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        Self(Some(command.spawn().unwrap()))
    }

    fn child(&mut self) -> &mut Child {
        self.0.as_mut().unwrap()
    }

    /// Whether it has not ended.
    pub(crate) fn is_running(&mut self) -> bool {
        self.child().try_wait().unwrap().is_none()
    }

    /// Waits until something is true, or the command has ended. Returns whether it still runs.
    pub(crate) fn wait_for(&mut self, mut is_true: impl FnMut() -> bool) -> bool {
        let started = Instant::now();
        while self.is_running() {
            if is_true() {
                return true;
            }
            assert!(started.elapsed() < PATIENCE, "waited in vain");
            std::thread::sleep(GLANCE);
        }
        false
    }

    /// Sends a signal, such as `INT`. The command may have ended meanwhile.
    pub(crate) fn signal(&mut self, name: &str) {
        let id = self.child().id().to_string();
        let sent = Command::new("kill").args(["-s", name, &id]).output();
        drop(sent.unwrap());
    }

    /// Ends it with SIGKILL. Returns whether that came before its own end.
    pub(crate) fn kill(mut self) -> bool {
        self.child().kill().unwrap();
        let output = self.output();
        if output.status.code().is_some() {
            let _ = Ran::of(&output).succeeded();
            return false;
        }
        true
    }

    /// Waits for its end.
    pub(crate) fn output(mut self) -> Output {
        self.0.take().unwrap().wait_with_output().unwrap()
    }

    /// Waits for its end, which is no signal's.
    pub(crate) fn ran(self) -> Ran {
        Ran::of(&self.output())
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if let Some(mut child) = self.0.take() {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

/// Random numbers that are the same each time: those of Knuth's MMIX.
#[derive(Debug)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// A number below another.
    pub(crate) fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % end
    }
}

/// The number of tries of a test that looks for rare moments: the environment variable `PELLICLE_KILLS`, if it is there.
pub(crate) fn tries(usual: u32) -> u32 {
    let asked = std::env::var("PELLICLE_KILLS").ok();
    asked.map_or(usual, |number| number.parse().unwrap())
}

/// Whether a name is that of a temporary file.
pub(crate) fn is_temporary(name: &str) -> bool {
    name.strip_suffix(".tmp")
        .is_some_and(|rest| rest.starts_with('.'))
}

/// The names of temporary files for a target, or for any.
pub(crate) fn temporary(place: &Place, target: &str) -> Vec<String> {
    let mut names = place.names();
    let start = format!(".{target}");
    names.retain(|name| name.starts_with(&start) && is_temporary(name));
    names
}

/// Whether there is a file of this name.
pub(crate) fn exists(place: &Place, name: &str) -> bool {
    place.path(name).exists()
}
