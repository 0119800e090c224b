//! From the text of a database file to its blocks as written.

use super::error::DatabaseFileError;
use saphyr_parser::{Event, Parser, ScalarStyle, ScanError, Span};
use std::collections::HashMap;

/// The contents of a file as written.
#[derive(Default)]
pub(super) struct Document {
    /// The mappings in the list under `DATA`.
    pub(super) blocks: Vec<Written>,
    /// The values under `SPECS`.
    pub(super) specs: Vec<(String, Text)>,
}

/// A block as written.
pub(super) struct Written {
    pub(super) line: usize,
    fields: Vec<(String, Text)>,
}

/// A value and the number of its first line.
pub(super) struct Text {
    pub(super) content: String,
    pub(super) line: usize,
    /// Whether the value is a literal block, each line of which is a line of the file.
    pub(super) is_literal: bool,
}

/// A collection that is being read.
enum Open {
    List,
    Mapping(Mapping),
}

/// A mapping, with the key whose value comes next, and the line numbers of the keys so far.
#[derive(Default)]
struct Mapping {
    key: Option<String>,
    lines: HashMap<String, usize>,
}

impl Written {
    pub(super) fn field(&self, field: &'static str) -> Result<&Text, DatabaseFileError> {
        let named = self.fields.iter().find(|(name, _)| name == field);
        let missing = DatabaseFileError::Missing {
            line: self.line,
            field,
        };
        named.map(|(_, value)| value).ok_or(missing)
    }
}

/// Reads the blocks in the list under the key `DATA` of the file's mapping, and the values under `SPECS`.
pub(super) fn document(text: &str) -> Result<Document, DatabaseFileError> {
    let mut parser = Parser::new_from_str(text);
    let mut open: Vec<Open> = Vec::new();
    let mut document = Document::default();
    let mut documents = 0;
    while let Some(event) = parser.next_event() {
        let (event, span) = event.map_err(|error| not_yaml(&error))?;
        let line = span.start.line();
        match event {
            Event::Alias(_) => return Err(DatabaseFileError::Alias { line }),
            Event::Scalar(text, style, ..) => {
                scalar(&mut open, &mut document, text.into_owned(), style, span)?;
            }
            Event::SequenceStart(..) => open.push(Open::List),
            Event::MappingStart(..) => {
                if is_list_of_data(&open) {
                    let fields = Vec::new();
                    document.blocks.push(Written { line, fields });
                }
                open.push(Open::Mapping(Mapping::default()));
            }
            Event::SequenceEnd | Event::MappingEnd => {
                open.pop();
                value_is_over(&mut open);
            }
            Event::DocumentStart(_) if documents > 0 => {
                return Err(DatabaseFileError::Documents { line });
            }
            Event::DocumentStart(_) => documents += 1,
            Event::Nothing | Event::StreamStart | Event::StreamEnd | Event::DocumentEnd => {}
        }
    }
    Ok(document)
}

fn not_yaml(error: &ScanError) -> DatabaseFileError {
    DatabaseFileError::Yaml {
        line: error.marker().line(),
        message: error.info().to_owned(),
    }
}

/// The key of a mapping whose value is being read.
fn key_of(open: &Open) -> Option<&str> {
    match open {
        Open::Mapping(mapping) => mapping.key.as_deref(),
        Open::List => None,
    }
}

fn is_list_of_data(open: &[Open]) -> bool {
    matches!(open, [file, Open::List] if key_of(file) == Some("DATA"))
}

/// Handles a key or a value. A value is kept if it belongs to a block or to `SPECS`.
fn scalar(
    open: &mut [Open],
    document: &mut Document,
    text: String,
    style: ScalarStyle,
    span: Span,
) -> Result<(), DatabaseFileError> {
    let line = span.start.line();
    if let Some(Open::Mapping(Mapping {
        key: key @ None,
        lines,
    })) = open.last_mut()
    {
        if let Some(first) = lines.insert(text.clone(), line) {
            let key = text.chars().take(40).collect();
            return Err(DatabaseFileError::Twice { line, first, key });
        }
        *key = Some(text);
        return Ok(());
    }
    if let [around @ .., mapping] = &*open
        && let Some(key) = key_of(mapping)
    {
        let value = || value(text, style, line);
        if is_list_of_data(around)
            && let Some(block) = document.blocks.last_mut()
        {
            block.fields.push((key.to_owned(), value()));
        } else if matches!(around, [file] if key_of(file) == Some("SPECS")) {
            document.specs.push((key.to_owned(), value()));
        }
    }
    value_is_over(open);
    Ok(())
}

fn value(content: String, style: ScalarStyle, line: usize) -> Text {
    let is_literal = style == ScalarStyle::Literal;
    // The parser reports the first nonempty line of a literal.
    let empty = content.lines().take_while(|line| line.is_empty()).count();
    Text {
        line: line.saturating_sub(if is_literal { empty } else { 0 }),
        content,
        is_literal,
    }
}

/// Ends a value: its mapping then expects a key. A collection may itself be a key; its mapping then expects a value.
fn value_is_over(open: &mut [Open]) {
    if let Some(Open::Mapping(Mapping { key, .. })) = open.last_mut() {
        *key = match key {
            Some(_) => None,
            None => Some(String::new()),
        };
    }
}
