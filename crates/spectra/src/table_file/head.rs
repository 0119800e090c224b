//! Headers of tables: the names of columns and their units.

use super::axis::{axis_word, is_axis, words};
use super::block::{Block, HeadLine};
use super::error::{TableFileError, cell_text};
use super::line::{Separator, number, split};
use super::options::Unit;

/// The header above the rows of a table.
#[derive(Debug, Default)]
pub(super) struct Head {
    /// The line of the header, from 1; 0 if there is none.
    pub(super) line: usize,
    /// A name for each column, or empty.
    pub(super) names: Vec<String>,
    /// Whether one of the names means the wavelength.
    pub(super) names_axis: bool,
    /// Number of columns of a header that does not match the rows.
    pub(super) other_width: Option<usize>,
    /// The text of a header that cannot be split into columns.
    pub(super) prose: Option<String>,
}

/// Axes and units that are not supported.
const OTHER_UNITS: [&str; 10] = [
    "wavenumber",
    "wavenumbers",
    "frequency",
    "energy",
    "thz",
    "hz",
    "cm",
    "mm",
    "m",
    "pm",
];

/// Returns the unit of wavelength that a cell names.
fn unit(cell: &str) -> Option<Unit> {
    if cell.contains("(A)") || cell.contains("[A]") {
        return Some(Unit::Angstrom);
    }
    words(cell).find_map(|word| Unit::from_word(&word))
}

/// Whether a cell states that its column is in percent.
pub(super) fn is_percent(cell: &str) -> bool {
    cell.contains('%')
        || words(cell).any(|word| ["percent", "pct", "prozent"].contains(&word.as_str()))
}

/// Whether a cell is a unit of any kind: in brackets, empty or a symbol.
fn is_unit_cell(cell: &str) -> bool {
    let is_bracketed = cell.starts_with(['(', '[']) && cell.ends_with([')', ']']);
    cell.is_empty() || cell == "%" || cell == "-" || cell == "1" || is_bracketed || is_axis(cell)
}

impl Head {
    /// Finds the header of a block whose rows have `width` columns.
    pub(super) fn of(block: &Block, separator: Separator, width: usize) -> Self {
        let mut head = Self::default();
        let last = block.head.last().map(|last| last.line.number);
        for candidate in &block.head {
            let is_last = Some(candidate.line.number) == last;
            head.take(candidate, (separator, width), is_last);
        }
        head
    }

    fn take(
        &mut self,
        candidate: &HeadLine,
        (separator, width): (Separator, usize),
        is_last: bool,
    ) {
        let line = candidate.line;
        let cells = head_cells(line.content, separator, width);
        let is_named = cells.iter().any(|cell| axis_word(cell) || is_axis(cell));
        if cells.len() == width {
            let units = self.names.len() == width && cells.iter().all(|cell| is_unit_cell(cell));
            if units && self.names_axis {
                for (name, unit) in self.names.iter_mut().zip(&cells) {
                    if !unit.is_empty() {
                        *name = format!("{name} {unit}");
                    }
                }
                return;
            }
            let is_figure = cells.iter().skip(1).any(|cell| number(cell).is_some());
            if is_last && !candidate.is_comment || is_named && (is_last || !is_figure) {
                *self = Self {
                    line: line.number,
                    names: cells.iter().map(|&cell| cell.to_owned()).collect(),
                    names_axis: is_named,
                    ..Self::default()
                };
            }
        } else if is_named && is_last && separator == Separator::Blanks {
            self.prose = Some(line.content.to_owned());
            self.line = line.number;
        } else if is_named && is_last && !candidate.is_comment && cells.len() > 1 {
            self.other_width = Some(cells.len());
            self.line = line.number;
        }
    }

    /// Returns the column of the wavelengths; the first one if the header names none.
    pub(super) fn axis(&self) -> usize {
        let find = |is: fn(&str) -> bool| self.names.iter().position(|name| is(name));
        find(axis_word).or_else(|| find(is_axis)).unwrap_or(0)
    }

    /// Returns the unit of the wavelengths, if it is named.
    pub(super) fn unit(&self) -> Result<Option<Unit>, TableFileError> {
        let named = self
            .names_axis
            .then(|| self.names.get(self.axis()))
            .flatten();
        let Some(text) = named.or(self.prose.as_ref()) else {
            return Ok(None);
        };
        if let Some(unit) = unit(text) {
            return Ok(Some(unit));
        }
        if named.is_some() && words(text).any(|word| OTHER_UNITS.contains(&word.as_str())) {
            let (line, text) = (self.line, text.clone());
            return Err(TableFileError::Unit { line, text });
        }
        Ok(None)
    }

    /// Refuses a column whose name means an absorbance.
    pub(super) fn check_logarithm(&self, column: usize) -> Result<(), TableFileError> {
        const NAMES: [&str; 6] = [
            "absorbance",
            "abs",
            "od",
            "optical density",
            "extinktion",
            "log",
        ];
        let Some(name) = self.names.get(column) else {
            return Ok(());
        };
        let bare = words(name).collect::<Vec<_>>().join(" ");
        if NAMES.iter().any(|known| {
            bare.starts_with(known) && !bare[known.len()..].starts_with(char::is_alphanumeric)
        }) {
            let (line, text) = (self.line, name.clone());
            return Err(TableFileError::Logarithm { line, text });
        }
        Ok(())
    }

    /// Whether the header states that a column is in percent.
    pub(super) fn is_percent(&self, column: usize) -> bool {
        let name = self.names.get(column).or(self.prose.as_ref());
        name.is_some_and(|name| is_percent(name))
    }

    /// Lists the columns for a message.
    pub(super) fn known(&self, width: usize) -> String {
        const MAX: usize = 24;
        let column = |at: usize| match self.names.get(at) {
            Some(name) => format!("{} {}", at + 1, cell_text(name)),
            None => (at + 1).to_string(),
        };
        let shown: Vec<_> = (0..width.min(MAX)).map(column).collect();
        let more = width.saturating_sub(MAX);
        let rest = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        shown.join(", ") + &rest
    }
}

/// Returns the name of a column without its unit: the text before a bracket.
pub(super) fn base(name: &str) -> &str {
    name.split(['(', '[']).next().unwrap_or(name).trim()
}

/// Splits a header into cells, separated as the rows are, or else in its own way.
fn head_cells(content: &str, separator: Separator, width: usize) -> Vec<&str> {
    let trimmed = |separator| {
        let mut cells = split(content, separator);
        while cells.len() > 1 && cells.last().is_some_and(|cell| cell.is_empty()) {
            cells.pop();
        }
        cells
    };
    let own = trimmed(separator);
    if own.len() == width {
        return own;
    }
    let others = [Separator::Semicolon, Separator::Tab, Separator::Comma];
    let fitting = others
        .into_iter()
        .map(trimmed)
        .find(|cells| cells.len() == width);
    let by_gaps = || {
        let is_gap = |cells: &Vec<&str>| cells.len() == width;
        let cells = content
            .split("  ")
            .map(str::trim)
            .filter(|cell| !cell.is_empty());
        Some(cells.collect()).filter(is_gap)
    };
    fitting
        .or_else(|| (separator == Separator::Blanks).then(by_gaps).flatten())
        .or_else(|| {
            let cells = words_with_units(content);
            (separator == Separator::Blanks && cells.len() == width).then_some(cells)
        })
        .unwrap_or(own)
}

/// Splits at blanks, and keeps each word together with the brackets after it: `Wavelength (nm)`.
fn words_with_units(content: &str) -> Vec<&str> {
    let mut cells: Vec<&str> = Vec::new();
    let mut start = None;
    let mut depth = 0_usize;
    for (at, c) in content.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        let is_before_unit = content[at..].trim_start().starts_with(['(', '[']);
        if c.is_whitespace() && depth == 0 && !is_before_unit {
            if let Some(start) = start.take() {
                cells.push(content[start..at].trim());
            }
        } else if start.is_none() && !c.is_whitespace() {
            start = Some(at);
        }
    }
    cells.extend(start.map(|start| content[start..].trim()));
    cells
}
