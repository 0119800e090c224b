//! Output of the command. A reader that closes the pipe (`pellicle schema | head`) does not cause a crash.
//!
//! Names of files, keys and arguments may contain anything, so control characters are escaped before they reach a terminal.

use crate::swatch;
use miette::{
    Diagnostic, IntoDiagnostic, LabeledSpan, MietteHandler, ReportHandler, Severity, SourceCode,
    WrapErr,
};
use pellicle::document::text_file::STANDARD_INPUT;
use pellicle::document::wording::{shortened, visible};
use pellicle::picture_file::STANDARD_OUTPUT;
use std::error::Error;
use std::fmt::{self, Display};
use std::io::{ErrorKind, Write};
use std::path::Path;

/// Prints a result as a line on standard output. Swatches keep their color.
pub(crate) fn result(line: impl Display) -> miette::Result<()> {
    let line = line.to_string();
    let safe: String = swatch::parts(&line)
        .map(|part| match part {
            swatch::Part::Swatch(text) => text.into(),
            swatch::Part::Text(text) => visible(text),
        })
        .collect();
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{safe}").and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written
            .into_diagnostic()
            .wrap_err("standard output cannot be written"),
    }
}

/// Prints a note as a line on standard error. There is nowhere to report that it could not be written.
pub(crate) fn note(line: impl Display) {
    let line = line.to_string();
    let _ = writeln!(std::io::stderr().lock(), "{}", visible(&line));
}

/// The name of a file in messages; standard input has its own.
pub(crate) fn name(path: &Path) -> String {
    if path.as_os_str() == STANDARD_INPUT {
        "<standard input>".to_owned()
    } else {
        path.display().to_string()
    }
}

/// The name of an output in messages.
pub(crate) fn output(path: &Path) -> String {
    if path.as_os_str() == STANDARD_OUTPUT {
        "<standard output>".to_owned()
    } else {
        path.display().to_string()
    }
}

/// A fraction as a percentage with two digits that mean something.
pub(crate) fn percent(fraction: f64) -> String {
    let percent = 100.0 * fraction;
    let decimals = (1.0 - percent.log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{percent:.decimals$} %")
}

/// Prints what was assumed about the input, one line each, on standard error.
pub(crate) fn notes<N: Display>(notes: impl IntoIterator<Item = N>) {
    for said in notes {
        note(format_args!("note: {said}"));
    }
}

/// The last of some failures, after the others are printed.
pub(crate) fn all_but_last(
    results: impl IntoIterator<Item = miette::Result<()>>,
) -> miette::Result<()> {
    let mut failures: Vec<miette::Report> = results.into_iter().filter_map(Result::err).collect();
    let last = failures.pop();
    for failure in &failures {
        error(failure);
    }
    last.map_or(Ok(()), Err)
}

/// A failure and its causes in one line.
pub(crate) fn in_a_line(report: &miette::Report) -> String {
    let causes: Vec<String> = report.chain().map(ToString::to_string).collect();
    causes.join(": ")
}

/// Prints what failed, with all its causes.
pub(crate) fn error(report: &miette::Report) {
    let _ = writeln!(std::io::stderr().lock(), "{report:?}");
}

/// Prints the help of `P`, or what is wrong with its arguments, and exits. Control characters in the arguments are escaped first.
pub(crate) fn exit_with<P: clap::Parser>(error: &clap::Error) -> ! {
    let arguments = std::env::args_os().map(|argument| argument.to_string_lossy().into_owned());
    let arguments: Vec<String> = arguments.collect();
    let is_safe = |argument: &String| visible(argument) == argument.as_str();
    if arguments.iter().all(is_safe) {
        error.exit();
    }
    let safe = arguments
        .iter()
        .map(|argument| visible(argument).into_owned());
    if let Err(error) = P::try_parse_from(safe) {
        error.exit();
    }
    note(error.to_string().trim_end());
    std::process::exit(error.exit_code())
}

/// Prints errors of the library without wrapping their lines: text to type or to search for stays in one piece, and a
/// terminal wraps lines itself.
pub(crate) fn keep_lines_whole() {
    // This fails if it was done before, which does not matter.
    let _ = miette::set_hook(Box::new(|_| {
        let options = miette::MietteHandlerOpts::new();
        Box::new(Safely(options.wrap_lines(false).break_words(false).build()))
    }));
}

/// Shows diagnostics with control characters escaped.
struct Safely(MietteHandler);

impl ReportHandler for Safely {
    fn debug(&self, diagnostic: &dyn Diagnostic, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.debug(&Safe::new(diagnostic), f)
    }
}

/// The largest number of characters of a message.
const MAX: usize = 4000;

fn safe(text: impl Display) -> String {
    let text = text.to_string();
    visible(&shortened(&text, MAX)).into_owned()
}

/// A message and its causes.
#[derive(Debug)]
struct Message(String, Option<Box<Message>>);

impl Message {
    fn new(error: &dyn Error) -> Self {
        let cause = error.source().map(|cause| Box::new(Self::new(cause)));
        Self(safe(error), cause)
    }
}

impl Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

impl Error for Message {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.1.as_deref().map(|cause| cause as _)
    }
}

/// A diagnostic whose texts are safe for a terminal. Source code is left unchanged: `Snippet` has already escaped it.
struct Safe<'a> {
    of: &'a dyn Diagnostic,
    message: Message,
    related: Vec<Safe<'a>>,
    cause: Option<Box<Safe<'a>>>,
}

impl<'a> Safe<'a> {
    fn new(of: &'a dyn Diagnostic) -> Self {
        let cause = of.source().map(|cause| Box::new(Message::new(cause)));
        Self {
            of,
            message: Message(safe(of), cause),
            related: of.related().into_iter().flatten().map(Self::new).collect(),
            cause: of
                .diagnostic_source()
                .map(|cause| Box::new(Self::new(cause))),
        }
    }
}

impl fmt::Debug for Safe<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.message, f)
    }
}

impl Display for Safe<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.message)
    }
}

impl Error for Safe<'_> {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.message.source()
    }
}

impl Diagnostic for Safe<'_> {
    fn code<'b>(&'b self) -> Option<Box<dyn Display + 'b>> {
        self.of.code()
    }

    fn severity(&self) -> Option<Severity> {
        self.of.severity()
    }

    fn help<'b>(&'b self) -> Option<Box<dyn Display + 'b>> {
        self.of.help().map(|help| Box::new(safe(help)) as _)
    }

    fn url<'b>(&'b self) -> Option<Box<dyn Display + 'b>> {
        self.of.url()
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.of.source_code()
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.of.labels()
    }

    fn related<'b>(&'b self) -> Option<Box<dyn Iterator<Item = &'b dyn Diagnostic> + 'b>> {
        let related = self.related.iter().map(|safe| safe as &dyn Diagnostic);
        (!self.related.is_empty()).then(|| Box::new(related) as _)
    }

    fn diagnostic_source(&self) -> Option<&dyn Diagnostic> {
        self.cause.as_deref().map(|cause| cause as _)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use miette::miette;

    /// Messages, help, causes and related problems, each with control characters.
    #[test]
    fn nothing_that_a_terminal_obeys_is_shown() {
        let cause = miette!(help = "h\x07", "inner\x1b[2J");
        let report: miette::Report = cause.wrap_err("outer\u{202e}");
        let handler = miette::MietteHandlerOpts::new().color(false).build();
        let shown = Whole(Safely(handler), report).to_string();
        for words in ["outer\\u202e", "inner\\u001b[2J"] {
            assert!(shown.contains(words), "{shown}");
        }
        assert!(!shown.contains(['\x1b', '\x07', '\u{202e}']), "{shown}");
    }

    struct Whole(Safely, miette::Report);

    impl Display for Whole {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            self.0.debug(&*self.1, f)
        }
    }
}
