//! Checkpoints, which are written between the rounds of a render.

use crate::print;
use miette::IntoDiagnostic;
use pellicle::progressive::{CheckpointError, Identity, Render};
use std::path::PathBuf;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Writes checkpoints beside the render, from a copy of its state.
pub(super) struct Keeper {
    path: PathBuf,
    every: Duration,
    identity: Identity,
    last: Instant,
    writing: Option<JoinHandle<Result<(), CheckpointError>>>,
}

impl Keeper {
    pub(super) fn new(path: PathBuf, every: Duration, identity: Identity) -> Self {
        Self {
            path,
            every,
            identity,
            last: Instant::now(),
            writing: None,
        }
    }

    /// Begins with a checkpoint if it is time. One that fails is reported; the one before it is still there.
    pub(super) fn after_round(&mut self, render: &Render) {
        if self
            .writing
            .as_ref()
            .is_some_and(|writing| !writing.is_finished())
        {
            return;
        }
        self.report();
        if self.last.elapsed() >= self.every {
            self.last = Instant::now();
            let (render, path, identity) =
                (render.clone(), self.path.clone(), self.identity.clone());
            let write = move || render.write_checkpoint(&path, &identity);
            self.writing = Some(std::thread::spawn(write));
        }
    }

    /// Waits for a checkpoint that is being written, and reports its failure.
    fn report(&mut self) {
        if let Some(writing) = self.writing.take()
            && let Ok(Err(error)) = writing.join()
        {
            let error = miette::Report::from_err(error);
            print::note(format_args!(
                "warning: {}; the render goes on",
                print::in_a_line(&error)
            ));
        }
    }

    /// Writes the last checkpoint.
    pub(super) fn finish(mut self, render: &Render) -> miette::Result<()> {
        self.report();
        render
            .write_checkpoint(&self.path, &self.identity)
            .into_diagnostic()?;
        print::note(format_args!("wrote {}", self.path.display()));
        Ok(())
    }
}
