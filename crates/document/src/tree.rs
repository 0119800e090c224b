//! A TOML document in which every value has its source position.

use crate::{FieldPath, Step};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A TOML document in which every value has its source position.
pub(crate) struct Tree<'text>(Spanned<DeTable<'text>>);

/// The reason why a text is not a [`Tree`].
pub(crate) struct TreeError {
    pub(crate) message: String,
    pub(crate) bytes: Range<usize>,
}

/// Deeper nesting than any scene has.
const MAX_DEPTH: usize = 32;
/// The parser limits the nesting of brackets and the length of dotted keys to 80 each, but not their product, and its trees are dropped
/// recursively: 6400 levels need about 1 MiB.
const PARSER_STACK_BYTES: usize = 16 << 20;

impl<'text> Tree<'text> {
    /// Parses `text` on a separate stack, so that no nesting can exhaust the caller's stack.
    pub(crate) fn parse(text: &'text str) -> Result<Self, TreeError> {
        let failed = |message: &str| TreeError {
            message: message.to_owned(),
            bytes: 0..0,
        };
        std::thread::scope(|scope| {
            std::thread::Builder::new()
                .stack_size(PARSER_STACK_BYTES)
                .spawn_scoped(scope, || parse_here(text))
                .map_err(|error| failed(&format!("cannot start a thread to parse it: {error}")))?
                .join()
                .unwrap_or_else(|_| Err(failed("the TOML parser failed on this text")))
        })
    }

    /// The top-level table.
    pub(crate) fn table(&self) -> &DeTable<'text> {
        self.0.get_ref()
    }

    /// The bytes of the value at `field`, or else of the innermost table in the file that would contain it.
    pub(crate) fn bytes_of(&self, field: &FieldPath) -> Range<usize> {
        let mut bytes = self.0.span();
        let Some((Step::Key(first), rest)) = field.steps().split_first() else {
            return bytes;
        };
        let mut value = self.table().get(first.as_str());
        let mut rest = rest.iter();
        while let Some(found) = value {
            bytes = found.span();
            value = match rest.next() {
                Some(Step::Key(key)) => found.get_ref().get(key.as_str()),
                Some(Step::Index(index)) => found.get_ref().get(*index),
                None => None,
            };
        }
        bytes
    }
}

fn parse_here(text: &str) -> Result<Tree<'_>, TreeError> {
    let table = DeTable::parse(text).map_err(|error| TreeError {
        message: error.message().to_owned(),
        bytes: error.span().unwrap_or(0..0),
    })?;
    for (key, value) in table.get_ref() {
        if depth(value.get_ref()) > MAX_DEPTH {
            return Err(TreeError {
                message: format!(
                    "found tables and arrays nested more than {MAX_DEPTH} deep; at most {MAX_DEPTH} levels are possible"
                ),
                bytes: key.span(),
            });
        }
    }
    Ok(Tree(table))
}

fn depth(value: &DeValue<'_>) -> usize {
    1 + match value {
        DeValue::Array(items) => items.iter().map(|v| depth(v.get_ref())).max().unwrap_or(0),
        DeValue::Table(table) => table
            .iter()
            .map(|(_, v)| depth(v.get_ref()))
            .max()
            .unwrap_or(0),
        _ => 0,
    }
}
