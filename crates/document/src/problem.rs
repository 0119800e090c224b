//! Problems of a document and their locations.

use crate::wording::{number, shortened, visible};
use crate::{FieldPath, Snippet};
use miette::{Diagnostic, LabeledSpan, SourceCode};
use std::fmt;
use std::ops::Range;
use thiserror::Error;

/// The kind of a [`Problem`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ProblemKind {
    /// A file cannot be read, or has the wrong format.
    File,
    /// The file is not TOML.
    Syntax,
    /// A field does not exist at this position.
    UnknownField,
    /// A required field is missing.
    MissingField,
    /// A value has the wrong type.
    WrongType,
    /// A name is unknown: of a material, a spectrum, a `type`.
    UnknownName,
    /// A number is outside its allowed range.
    OutOfRange,
    /// Values contradict each other.
    Inconsistent,
    /// Something exceeds a limit of size or number.
    TooLarge,
}

/// The location of a problem in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Location {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// The byte range in the file.
    pub bytes: Range<usize>,
}

impl Location {
    pub(crate) fn new(text: &str, bytes: Range<usize>) -> Self {
        // A span of the parser is on character boundaries; one at the end of the text may go past it.
        let start = bytes.start.min(text.len());
        let before = text.get(..start).unwrap_or(text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Self {
            line: before.bytes().filter(|&b| b == b'\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            bytes: start..bytes.end.clamp(start, text.len()),
        }
    }
}

/// One mistake in a document.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub struct Problem {
    /// The kind of mistake.
    pub kind: ProblemKind,
    /// The field; the root for the file as a whole.
    pub field: FieldPath,
    /// What was found, and what would be right.
    pub message: String,
    /// Further advice.
    pub help: Option<String>,
    /// The location in the file; `None` if the value does not come from a file.
    pub location: Option<Location>,
    /// Other fields that the problem depends on.
    pub(crate) involves: Vec<FieldPath>,
}

impl Problem {
    /// Creates a problem of the value `field`; `message` says what was found, and what would be right.
    pub fn new(kind: ProblemKind, field: &FieldPath, message: impl Into<String>) -> Self {
        Self {
            kind,
            field: field.clone(),
            message: message.into(),
            help: None,
            location: None,
            involves: Vec::new(),
        }
    }

    /// Adds advice.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds another field that the problem depends on: if that one is broken, this problem is not shown.
    #[must_use]
    pub fn involving(mut self, field: FieldPath) -> Self {
        self.involves.push(field);
        self
    }

    /// Moves the problem to a field within `base`.
    #[must_use]
    pub fn within(mut self, base: &FieldPath) -> Self {
        self.field = base.join(&self.field);
        for field in &mut self.involves {
            *field = base.join(field);
        }
        self
    }

    pub(crate) fn located(mut self, location: Location) -> Self {
        self.location = Some(location);
        self
    }

    /// Replaces the number in the message by `written`, its form in the file such as `1e9`, if both are the same number.
    pub(crate) fn with_written(mut self, written: &str) -> Self {
        let Ok(value) = written.replace('_', "").parse::<f64>() else {
            return self;
        };
        let found = [value.to_string(), number(value)].map(|form| format!("found {form}"));
        let is_it = |rest: &str| !rest.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '.');
        if let Some(rest) = found.iter().find_map(|found| {
            let rest = self.message.strip_prefix(found)?;
            // A period at the end of a sentence does not make it another number.
            (is_it(rest) || rest == ".").then(|| rest.to_owned())
        }) {
            self.message = format!("found {written}{rest}");
        }
        self
    }
}

/// The maximum number of characters shown of a field and of a message: names in a file may have any length.
const MAX_OF_FIELD: usize = 200;
const MAX_OF_MESSAGE: usize = 2000;

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.field.steps().is_empty() {
            let field = self.field.to_string();
            write!(f, "{}: ", visible(&shortened(&field, MAX_OF_FIELD)))?;
        }
        let message = shortened(&self.message, MAX_OF_MESSAGE);
        write!(f, "{}", visible(&message))
    }
}

impl Diagnostic for Problem {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as _)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let bytes = self.location.as_ref()?.bytes.clone();
        Some(Box::new(std::iter::once(LabeledSpan::underline(bytes))))
    }
}

/// All problems of a document, in the order of the file.
///
/// As a [`miette::Diagnostic`] it is a heading with one related diagnostic per problem, each with its source line. For logs, `{:#}` gives
/// one line per problem, `file:line:column: field: message`; plain `{}` gives only the heading.
#[derive(Clone, Debug, Error)]
pub struct Problems(Box<Inner>);

#[derive(Clone, Debug)]
struct Inner {
    /// What has the problems, if there is no file.
    subject: &'static str,
    name: Option<String>,
    list: Vec<Placed>,
    omitted: usize,
}

/// A problem with the source lines that are shown with it.
#[derive(Clone, Debug, Error)]
#[error("{problem}")]
struct Placed {
    problem: Problem,
    snippet: Option<Snippet>,
}

impl Diagnostic for Placed {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Diagnostic::help(&self.problem)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.snippet.as_ref().map(|snippet| snippet as _)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let bytes = self.snippet.as_ref()?.fault();
        Some(Box::new(std::iter::once(LabeledSpan::underline(bytes))))
    }
}

impl Problems {
    /// The maximum number of problems that are kept; the others are only counted.
    pub const MAX_SHOWN: usize = 100;

    /// Problems of what a program filled in rather than read from a file; `subject`, such as "the scene", is its name in the heading.
    pub fn of_program(subject: &'static str, list: Vec<Problem>) -> Self {
        Self::new(subject, None, list, 0)
    }

    /// The problem of a file that cannot be read.
    pub(crate) fn of_unread_file(name: String, problem: Problem) -> Self {
        Self::new("", Some((name, "")), vec![problem], 0)
    }

    /// Problems of a file with this text; `omitted` more were found.
    pub(crate) fn of_file(name: &str, text: &str, mut list: Vec<Problem>, omitted: usize) -> Self {
        list.sort_by_key(|problem| problem.location.as_ref().map(|place| place.bytes.start));
        Self::new("", Some((name.to_owned(), text)), list, omitted)
    }

    fn new(
        subject: &'static str,
        file: Option<(String, &str)>,
        mut list: Vec<Problem>,
        omitted: usize,
    ) -> Self {
        let omitted = omitted + list.len().saturating_sub(Self::MAX_SHOWN);
        list.truncate(Self::MAX_SHOWN);
        let placed = |problem: Problem| {
            let place = problem.location.as_ref().zip(file.as_ref());
            let snippet =
                place.map(|(place, (name, text))| Snippet::new(name, text, place.bytes.clone()));
            Placed { problem, snippet }
        };
        let list = list.into_iter().map(placed).collect();
        Self(Box::new(Inner {
            subject,
            name: file.map(|(name, _)| visible(&name).into_owned()),
            list,
            omitted,
        }))
    }

    /// The problems, in the order of the file.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Problem> {
        self.0.list.iter().map(|placed| &placed.problem)
    }

    /// The number of problems found beyond those that [`Self::iter`] lists.
    pub fn omitted(&self) -> usize {
        self.0.omitted
    }

    /// The name of the file, if there is one.
    pub fn file_name(&self) -> Option<&str> {
        self.0.name.as_deref()
    }

    fn write_heading(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let subject = self.file_name().unwrap_or(self.0.subject);
        match self.0.list.len() + self.0.omitted {
            1 => write!(f, "{subject} has a problem"),
            count if self.0.omitted == 0 => write!(f, "{subject} has {count} problems"),
            count => write!(
                f,
                "{subject} has {count} problems; the first {} are shown",
                self.0.list.len()
            ),
        }
    }

    fn write_lines(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, problem) in self.iter().enumerate() {
            if position > 0 {
                writeln!(f)?;
            }
            if let Some(name) = self.file_name() {
                write!(f, "{name}:")?;
                if let Some(place) = &problem.location {
                    write!(f, "{}:{}:", place.line, place.column)?;
                }
                write!(f, " ")?;
            }
            write!(f, "{problem}")?;
        }
        match self.0.omitted {
            0 => Ok(()),
            more => write!(f, "\nand {more} more"),
        }
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if f.alternate() {
            self.write_lines(f)
        } else {
            self.write_heading(f)
        }
    }
}

impl Diagnostic for Problems {
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(
            self.0.list.iter().map(|placed| placed as &dyn Diagnostic),
        ))
    }
}
