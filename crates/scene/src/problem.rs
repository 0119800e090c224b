//! What is wrong with a scene, and where.

use crate::{FieldPath, Snippet};
use miette::{Diagnostic, LabeledSpan, SourceCode};
use spectra::wording::{number, shortened, visible};
use std::fmt;
use std::ops::Range;
use thiserror::Error;

/// What sort of mistake a [`Problem`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ProblemKind {
    /// A file cannot be read, or is not what it should be.
    File,
    /// The file is not TOML.
    Syntax,
    /// A field that does not exist here.
    UnknownField,
    /// A field that must be there is not.
    MissingField,
    /// A value of another type than the field has.
    WrongType,
    /// A name that nothing has: a material, a spectrum, a `type`.
    UnknownName,
    /// A number outside the range that makes sense.
    OutOfRange,
    /// Values that do not go together.
    Inconsistent,
    /// More than can be held.
    TooLarge,
}

/// Where in a scene file a problem lies.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Location {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// The bytes of the file that are meant.
    pub bytes: Range<usize>,
}

impl Location {
    pub(crate) fn new(text: &str, bytes: Range<usize>) -> Self {
        // A span of the parser lies on character boundaries; one at the end of the text may lie past it.
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

/// One mistake in a scene.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub struct Problem {
    /// What sort of mistake.
    pub kind: ProblemKind,
    /// Which value; the root for the file as a whole.
    pub field: FieldPath,
    /// What was found, and what would be right.
    pub message: String,
    /// Further advice.
    pub help: Option<String>,
    /// Where in the file; `None` when the value does not come from a file.
    pub location: Option<Location>,
    /// Other values that the judgment rests on.
    pub(crate) involves: Vec<FieldPath>,
}

impl Problem {
    /// A mistake in the value `field`: `message` says what was found, and what would be right.
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

    /// Names another value that the judgment rests on: where that one is broken, this problem is not shown.
    pub(crate) fn involving(mut self, field: FieldPath) -> Self {
        self.involves.push(field);
        self
    }

    /// The same mistake, told of a value that lies within `base`.
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

    /// Tells a number in the form that the file has it in, `1e9`, where `written` is the message's number in another one.
    pub(crate) fn with_written(mut self, written: &str) -> Self {
        let Ok(value) = written.replace('_', "").parse::<f64>() else {
            return self;
        };
        let found = [value.to_string(), number(value)].map(|form| format!("found {form}"));
        let is_it = |rest: &str| !rest.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '.');
        if let Some(rest) = found.iter().find_map(|found| {
            let rest = self.message.strip_prefix(found)?;
            // A number at the end of a sentence is no other number.
            (is_it(rest) || rest == ".").then(|| rest.to_owned())
        }) {
            self.message = format!("found {written}{rest}");
        }
        self
    }
}

/// The most characters of a field and of a message that are shown: names in a file may be of any length.
const MOST_OF_FIELD: usize = 200;
const MOST_OF_MESSAGE: usize = 2000;

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.field.steps().is_empty() {
            let field = self.field.to_string();
            write!(f, "{}: ", visible(&shortened(&field, MOST_OF_FIELD)))?;
        }
        let message = shortened(&self.message, MOST_OF_MESSAGE);
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

/// Everything that is wrong with a scene, in the order of the file.
///
/// As a [`miette::Diagnostic`] it is a heading with one related diagnostic per problem, each with its source
/// line. For logs `{:#}` gives one line per problem, `file:line:column: field: message`; plain `{}` gives the
/// heading alone.
#[derive(Clone, Debug, Error)]
pub struct Problems(Box<Inner>);

#[derive(Clone, Debug)]
struct Inner {
    /// What has the problems, where there is no file.
    subject: &'static str,
    name: Option<String>,
    list: Vec<Placed>,
    omitted: usize,
}

/// A problem with the lines of the file that it is shown in.
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
    /// The most problems that are kept; the others are only counted.
    pub const MAX_SHOWN: usize = 100;

    /// Problems of a scene that a program has filled in.
    pub(crate) fn of_program(list: Vec<Problem>) -> Self {
        Self::new("the scene", None, list, 0)
    }

    /// Problems of an index of refraction that is part of no scene.
    pub(crate) fn of_index(list: Vec<Problem>) -> Self {
        Self::new("the index", None, list, 0)
    }

    /// A file that cannot be read.
    pub(crate) fn of_unread_file(name: String, problem: Problem) -> Self {
        Self::new("the scene", Some((name, "")), vec![problem], 0)
    }

    /// Problems of a file with this text; `omitted` more were found.
    pub(crate) fn of_file(name: &str, text: &str, mut list: Vec<Problem>, omitted: usize) -> Self {
        list.sort_by_key(|problem| problem.location.as_ref().map(|place| place.bytes.start));
        Self::new("the scene", Some((name.to_owned(), text)), list, omitted)
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

    /// How many more were found than [`Self::iter`] lists.
    pub fn omitted(&self) -> usize {
        self.0.omitted
    }

    /// The file as it was named, where there is one.
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
                "{subject} has {count} problems, of which the first {} are shown",
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
