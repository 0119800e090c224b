//! What is wrong with a scene, and where.

use crate::FieldPath;
use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;
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
    /// Other values that the judgement rests on.
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

    /// Names another value that the judgement rests on: where that one is broken, this problem is not shown.
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
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.field.steps().is_empty() {
            write!(f, "{}: ", self.field)?;
        }
        write!(f, "{}", self.message)
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
    source: Option<NamedSource<Arc<str>>>,
    list: Vec<Problem>,
    omitted: usize,
}

impl Problems {
    /// The most problems that are kept; the others are only counted.
    pub const MAX_SHOWN: usize = 100;

    /// Problems of a scene that a program has filled in.
    pub(crate) fn of_program(list: Vec<Problem>) -> Self {
        Self::new("the scene", None, None, list, 0)
    }

    /// Problems of an index of refraction that is part of no scene.
    pub(crate) fn of_index(list: Vec<Problem>) -> Self {
        Self::new("the index", None, None, list, 0)
    }

    /// A file that cannot be read.
    pub(crate) fn of_unread_file(name: String, problem: Problem) -> Self {
        Self::new("the scene", Some(name), None, vec![problem], 0)
    }

    /// Problems of a file with this text; `omitted` more were found.
    pub(crate) fn of_file(
        name: &str,
        text: &Arc<str>,
        mut list: Vec<Problem>,
        omitted: usize,
    ) -> Self {
        list.sort_by_key(|problem| problem.location.as_ref().map(|place| place.bytes.start));
        let source = NamedSource::new(name, Arc::clone(text)).with_language("TOML");
        Self::new(
            "the scene",
            Some(name.to_owned()),
            Some(source),
            list,
            omitted,
        )
    }

    fn new(
        subject: &'static str,
        name: Option<String>,
        source: Option<NamedSource<Arc<str>>>,
        mut list: Vec<Problem>,
        omitted: usize,
    ) -> Self {
        let omitted = omitted + list.len().saturating_sub(Self::MAX_SHOWN);
        list.truncate(Self::MAX_SHOWN);
        Self(Box::new(Inner {
            subject,
            name,
            source,
            list,
            omitted,
        }))
    }

    /// The problems, in the order of the file.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Problem> {
        self.0.list.iter()
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
    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.0.source.as_ref().map(|source| source as _)
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(
            self.0.list.iter().map(|problem| problem as &dyn Diagnostic),
        ))
    }
}
