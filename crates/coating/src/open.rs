//! Stacks from files and from lines.

use crate::file::{self, StackDescription};
use crate::line::{self, EXAMPLE, LineError};
use crate::stack::Stack;
use document::text_file::STANDARD_INPUT;
use document::{Folder, Problems};
use miette::Diagnostic;
use std::path::Path;
use thiserror::Error;

/// Why a stack cannot be read.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum StackError {
    /// A stack file is invalid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    File(#[from] Problems),
    /// The text is neither the name of a file nor a one-line stack.
    #[error("there is no stack file {0:?}")]
    #[diagnostic(help("a stack in one line has | between its media, like {EXAMPLE:?}"))]
    Nothing(String),
    /// A one-line stack is invalid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Line(#[from] LineError),
}

impl Stack {
    /// Opens a stack file if `text` is a path, reads one from standard input if it is `-`, or parses a one-line stack if it contains `|`.
    ///
    /// # Errors
    /// Reports everything that is wrong, and where.
    pub fn open(text: &str) -> Result<Self, StackError> {
        if text.contains('|') {
            Ok(Self::parse(text)?)
        } else if text != STANDARD_INPUT && !Path::new(text).exists() {
            Err(StackError::Nothing(text.chars().take(200).collect()))
        } else {
            Ok(Self::read(text)?)
        }
    }

    /// Like [`Self::open`], for a trusted stack file: the files that it names may be outside of its folder.
    ///
    /// # Errors
    /// Reports everything that is wrong, and where.
    pub fn open_trusted(text: &str) -> Result<Self, StackError> {
        if text.contains('|') || !Path::new(text).exists() {
            return Self::open(text);
        }
        Ok(file::read(text.as_ref(), true)?)
    }

    /// Parses a one-line stack: `air | silica 300nm | silicon`.
    ///
    /// The first medium is the incident medium and the last is the substrate. Between them are layers with their thickness in nm,
    /// µm (um), mm or Å (angstrom), or in waves at a wavelength in nm: `TiO2 0.25@550` is a quarter-wave layer at normal incidence.
    /// A power repeats layers in brackets: `air | (TiO2 60nm | SiO2 90nm)^8 | BK7`. Definitions before the stack name media and
    /// layers: `H=TiO2 0.25@550; L=SiO2 0.25@550; air | (HL)^8 2H | BK7`, where `2H` is twice as thick as `H`.
    ///
    /// A medium is a material's name, a number `1.5` or `1.5+0.1i`, or a file `.csv` or `.yml`. `air` is the material of the library,
    /// n = 1.0003; `vacuum` is n = 1.
    ///
    /// # Errors
    /// Reports the first part that is wrong.
    pub fn parse(line: &str) -> Result<Self, LineError> {
        line::parse(line)
    }

    /// Reads a stack file: see [`StackDescription`]. The files that it names must be in its folder.
    ///
    /// # Errors
    /// Reports everything that is wrong.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Problems> {
        file::read(path.as_ref(), false)
    }

    /// Reads the text of a stack file. Errors call it `name`; files are relative to `folder` and must be inside it.
    ///
    /// # Errors
    /// Reports everything that is wrong.
    pub fn from_toml(name: &str, text: &str, folder: impl Into<Folder>) -> Result<Self, Problems> {
        file::parse(name, text, &folder.into())
    }

    /// Returns the stack as a stack file describes it.
    pub fn description(&self) -> StackDescription {
        StackDescription::of(self)
    }
}
