//! What the command says. A reader that has gone away (`pellicle schema | head`) is no reason to crash.

use miette::{IntoDiagnostic, WrapErr};
use std::fmt::Display;
use std::io::{ErrorKind, Write};

/// A result, as a line on standard output.
pub(crate) fn result(line: impl Display) -> miette::Result<()> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{line}").and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written
            .into_diagnostic()
            .wrap_err("standard output cannot be written"),
    }
}

/// A note, as a line on standard error. There is nowhere to tell that it could not be written.
pub(crate) fn note(line: impl Display) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// What was assumed of what was read, a line each on standard error.
pub(crate) fn notes<N: Display>(notes: impl IntoIterator<Item = N>) {
    for said in notes {
        note(format_args!("note: {said}"));
    }
}

/// Errors as they come from the library, with lines as long as they are: what is to be typed or searched for stays in one
/// piece, and a terminal wraps by itself.
pub(crate) fn keep_lines_whole() {
    // It fails where it was done before, which changes nothing.
    let _ = miette::set_hook(Box::new(|_| {
        let options = miette::MietteHandlerOpts::new();
        Box::new(options.wrap_lines(false).break_words(false).build())
    }));
}
