//! Stacks written in one line: `air | silica 300nm | silicon`.
//!
//! ```text
//! line        = (name "=" medium [thickness] ";")* medium "|" (part "|")* medium
//! part        = medium thickness | (group | names)+
//! group       = "(" part ("|" part)* ")" ["^" times]
//! names       = a defined name, or a row of one-letter names, each with or without a factor: HL, 2H
//! thickness   = 300nm, 0.3um, 0.3µm, 0.001mm, 3000Å, 3000angstrom, 0.25@550
//! ```

mod syntax;
#[cfg(test)]
mod tests;

use crate::file;
use crate::label;
use crate::medium::{Layer, Medium};
use crate::stack::Stack;
use crate::thickness;
use document::wording::{shortened, visible};
use document::{Folder, Snippet};
use media::{Extrapolate, Index};
use miette::{Diagnostic, SourceSpan};
use std::collections::HashMap;
use std::ffi::OsStr;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use syntax::{Definition, Node, Piece};
use thiserror::Error;

/// An error in a one-line stack, and where it is.
#[derive(Debug, Error, Diagnostic)]
#[error("{message}")]
pub struct LineError {
    message: String,
    #[help]
    help: Option<String>,
    #[source_code]
    line: Arc<Snippet>,
    #[label]
    at: SourceSpan,
}

/// Maximum number of characters of a message, since the text between two bars may have any length.
const MAX_OF_MESSAGE: usize = 400;

/// An example of a one-line stack.
pub(crate) const EXAMPLE: &str = "air | silica 300nm | silicon";

fn example() -> String {
    format!("a stack is written like {EXAMPLE:?}")
}

/// A fault without its position in the line.
struct Fault {
    message: String,
    help: Option<String>,
}

impl Fault {
    fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            help: Some(help.into()),
        }
    }
}

/// A fault and its bytes in the line.
struct Misplaced(Fault, Range<usize>);

pub(crate) fn parse(line: &str) -> Result<Stack, LineError> {
    read(line).map_err(|Misplaced(Fault { message, help }, bytes)| {
        let snippet = Snippet::new("stack", line, bytes);
        LineError {
            message: visible(&shortened(&message, MAX_OF_MESSAGE)).into_owned(),
            help: help.map(|help| visible(&help).into_owned()),
            at: snippet.fault().into(),
            line: Arc::new(snippet),
        }
    })
}

fn read(text: &str) -> Result<Stack, Misplaced> {
    let line = syntax::line(text)?;
    let mut media = Media::default();
    for definition in &line.definitions {
        media.define(definition)?;
    }
    let incident = media.half_space(&line.incident)?;
    if let Some(fault) = Stack::fault_of_incident(&incident) {
        let help = "write the stack from the side of the light, with the transparent medium first";
        return Err(line.incident.misplaced(fault, help));
    }
    let mut layers = Vec::new();
    for node in &line.layers {
        media.extend(&mut layers, node)?;
    }
    let substrate = media.half_space(&line.substrate)?;
    Ok(Stack::new(incident, layers, substrate).written_in_a_line())
}

/// The media of a line, each of which is read once.
#[derive(Default)]
struct Media<'a> {
    read: HashMap<&'a str, Medium>,
    defined: Vec<Defined<'a>>,
}

struct Defined<'a> {
    name: &'a str,
    medium: Medium,
    thickness_nm: Option<f64>,
}

impl<'a> Media<'a> {
    fn define(&mut self, definition: &Definition<'a>) -> Result<(), Misplaced> {
        let value = definition.value;
        let (text, thickness) = thickness::split(value.text);
        let medium = self.named_or_read(text, &value)?;
        let thickness = thickness.map(|written| placed_nm(written, &medium, &value));
        self.defined.push(Defined {
            name: definition.name,
            medium,
            thickness_nm: thickness.transpose()?,
        });
        Ok(())
    }

    /// Returns the medium of a text in `piece`: the medium of a definition without thickness, or else one that is read.
    fn named_or_read(&mut self, text: &'a str, piece: &Piece<'_>) -> Result<Medium, Misplaced> {
        if let Some(defined) = self.defined.iter().find(|defined| defined.name == text) {
            if let Some(nm) = defined.thickness_nm {
                let nm = label::rounded(nm);
                let message = format!("{text} is defined as a layer of {nm} nm");
                let help = "a medium without thickness is needed here: leave the thickness out of the definition";
                return Err(piece.misplaced(message, help));
            }
            return Ok(defined.medium.clone());
        }
        if let Some(medium) = self.read.get(text) {
            return Ok(medium.clone());
        }
        let medium = medium(text).map_err(|fault| Misplaced(fault, piece.bytes()))?;
        self.read.insert(text, medium.clone());
        Ok(medium)
    }

    fn half_space(&mut self, piece: &Piece<'a>) -> Result<Medium, Misplaced> {
        let text = piece.text;
        if text.starts_with('(') {
            let message = format!(
                "{text:?} is a group of layers, but the first and the last medium are half spaces"
            );
            let help = format!(
                "put the group between bars and add the medium behind it; {}",
                example()
            );
            return Err(piece.misplaced(message, help));
        }
        if thickness::split(text).1.is_some() {
            let message = format!(
                "{text:?} has a thickness, but the first and the last medium are half spaces"
            );
            let help = format!(
                "leave the thickness out, or add the medium behind it; {}",
                example()
            );
            return Err(piece.misplaced(message, help));
        }
        self.named_or_read(text, piece)
    }

    /// Adds the layers of a node. They were counted before and are at most [`Stack::MAX_LAYERS`].
    fn extend(&mut self, layers: &mut Vec<Layer>, node: &Node<'a>) -> Result<(), Misplaced> {
        match node {
            Node::Layer(piece) => layers.push(self.layer(piece)?),
            Node::Defined(factor, place, piece) => {
                layers.push(self.scaled(*factor, *place, piece)?);
            }
            Node::Group(nodes, times) => {
                let start = layers.len();
                for node in nodes {
                    self.extend(layers, node)?;
                }
                let once = layers.get(start..).unwrap_or_default().to_vec();
                for _ in 1..*times {
                    layers.extend_from_slice(&once);
                }
            }
        }
        Ok(())
    }

    fn layer(&mut self, piece: &Piece<'a>) -> Result<Layer, Misplaced> {
        let text = piece.text;
        let (written, Some(thickness)) = thickness::split(text) else {
            let what = if text.is_empty() {
                "there is nothing between two bars".to_owned()
            } else {
                format!("{text:?} has no thickness")
            };
            let unit = match text.strip_suffix('A') {
                Some(number) if number.trim_end().ends_with(|c: char| c.is_ascii_digit()) => {
                    "angstroms are written 3000Å or 3000angstrom; "
                }
                _ => "",
            };
            let forms = thickness::FORMS;
            let help = format!("{unit}a layer is a medium, a space and a thickness: {forms}");
            return Err(piece.misplaced(what, help));
        };
        let medium = self.named_or_read(written, piece)?;
        let thickness_nm = placed_nm(thickness, &medium, piece)?;
        Ok(Layer {
            medium,
            thickness_nm,
        })
    }

    /// Returns a layer with `factor` times the thickness of a definition.
    fn scaled(&self, factor: f64, place: usize, piece: &Piece<'_>) -> Result<Layer, Misplaced> {
        let Some(defined) = self.defined.get(place) else {
            return Err(piece.misplaced("is not defined", example()));
        };
        let Some(nm) = defined.thickness_nm else {
            let name = defined.name;
            let message = format!("{name} is defined without a thickness");
            let help =
                format!("write it after the name, like \"{name} 300nm\", or in the definition");
            return Err(piece.misplaced(message, help));
        };
        let thickness_nm = thickness::within(factor * nm, |nm| format!("{nm} nm"));
        Ok(Layer {
            medium: defined.medium.clone(),
            thickness_nm: thickness_nm.map_err(|(message, help)| piece.misplaced(message, help))?,
        })
    }
}

fn placed_nm(
    written: thickness::Written<'_>,
    medium: &Medium,
    piece: &Piece<'_>,
) -> Result<f64, Misplaced> {
    let nm = written.nm(medium.constants());
    nm.map_err(|(message, help)| piece.misplaced(message, help))
}

fn medium(text: &str) -> Result<Medium, Fault> {
    let index = index(text)?;
    // The user who writes a line chooses its files.
    let folder = Folder::from("").allow_outside(true);
    file::medium(&index, &folder).map_err(|problems| {
        let first = problems.into_iter().next();
        let (message, help) = first.map_or_else(Default::default, |p| (p.message, p.help));
        // The fields of a table can be written only in a file.
        let help = help.map(|help| {
            if help.contains(" = ") {
                format!("in a stack file: {help}")
            } else {
                help
            }
        });
        Fault { message, help }
    })
}

/// Reads an index: a number, a complex number, a file of one of the two kinds, or else a name.
fn index(text: &str) -> Result<Index, Fault> {
    if text.is_empty() {
        return Err(Fault::new("there is no medium here", example()));
    }
    if let Ok(n) = text.parse::<f64>() {
        return Ok(Index::Real(n));
    }
    if let Some([n, k]) = complex(text) {
        if k < 0.0 {
            return Err(Fault::new(
                format!("{text:?} has k = {k}"),
                format!(
                    "an index is n + ik here, and k > 0 absorbs: write n - ik from other programs as {n}+{}i",
                    -k
                ),
            ));
        }
        // 1.5-0i is transparent, and adding 0 removes the sign of its k.
        return Ok(Index::Complex([n, k + 0.0]));
    }
    if let Some(file) = file_index(text) {
        return Ok(file);
    }
    if text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) {
        return Err(Fault::new(
            format!("{text:?} is not an index"),
            "an index is a number like 1.5, or n + ik like 1.5+0.1i with k ≥ 0 for absorption, or a material's name; a thickness \
             is followed by its unit",
        ));
    }
    Ok(Index::Name(text.to_owned()))
}

/// Recognizes a file of the database by its extension, and a table by its extension or because the file exists.
fn file_index(text: &str) -> Option<Index> {
    let (path, extrapolate) = (Path::new(text), Extrapolate::Error);
    let ending = path.extension().map(OsStr::to_ascii_lowercase);
    match ending.as_deref().and_then(OsStr::to_str) {
        Some("yml" | "yaml") => Some(Index::Database {
            yaml: path.to_owned(),
            extrapolate,
        }),
        Some(ending) if ending == "csv" || path.is_file() => Some(Index::File {
            csv: path.to_owned(),
            column: None,
            unit: None,
            extrapolate,
        }),
        _ => None,
    }
}

/// Reads `1.5+0.1i`, with or without spaces. The last sign that does not belong to an exponent separates n and k.
fn complex(text: &str) -> Option<[f64; 2]> {
    let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let body = text.strip_suffix(['i', 'j'])?;
    let is_exponent = |at: usize| body[..at].ends_with(['e', 'E']);
    let split = body
        .rmatch_indices(['+', '-'])
        .map(|(at, _)| at)
        .find(|&at| at > 0 && !is_exponent(at))?;
    let (n, k) = body.split_at(split);
    Some([n.parse().ok()?, k.parse().ok()?])
}
