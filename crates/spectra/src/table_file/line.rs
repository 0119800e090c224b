//! The lines of a text, their cells and numbers.

use std::borrow::Cow;

use super::error::TableFileError;

/// A line that is not empty.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    /// The number of the line, from 1.
    pub(super) number: usize,
    pub(super) content: &'a str,
}

/// What separates the cells of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separator {
    Comma,
    Semicolon,
    Tab,
    Blanks,
}

impl Separator {
    /// The text for a note; `None` for the plain comma.
    pub(super) fn note(self) -> Option<&'static str> {
        match self {
            Self::Comma => None,
            Self::Semicolon => Some("semicolons between columns"),
            Self::Tab => Some("tabs between columns"),
            Self::Blanks => Some("blanks between columns"),
        }
    }
}

/// The lines of a text that are not empty; they end with LF, CR LF or CR.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    let ends = |line| str::strip_suffix(line, '\r').unwrap_or(line).split('\r');
    let numbered = text.split('\n').flat_map(ends).zip(1..);
    numbered
        .map(|(content, number)| Line {
            number,
            content: content.trim_matches(|c: char| c.is_whitespace() || c == '\0'),
        })
        .filter(|line| !line.content.is_empty())
}

impl<'a> Line<'a> {
    /// Returns the text after the comment sign; `None` if the line is not a comment.
    pub(super) fn comment(&self) -> Option<&'a str> {
        let content = self.content;
        let behind = content
            .strip_prefix("//")
            .or_else(|| content.strip_prefix(['#', ';', '!', '%']))?;
        let behind = behind.trim_start_matches(['#', ';', '!', '%', '/']).trim();
        // A row whose first cell is empty is not a comment.
        let is_row =
            content.starts_with(';') && behind.split(';').all(|cell| number(cell).is_some());
        (!is_row || behind.is_empty()).then_some(behind)
    }

    /// Returns what separates the cells of the line.
    pub(super) fn separator(&self) -> Separator {
        let mut is_quoted = false;
        let (mut has_comma, mut has_tab) = (false, false);
        for c in self.content.chars() {
            match c {
                '"' => is_quoted = !is_quoted,
                _ if is_quoted => {}
                ';' => return Separator::Semicolon,
                '\t' => has_tab = true,
                ',' => has_comma = true,
                _ => {}
            }
        }
        match (has_tab, has_comma) {
            (true, _) => Separator::Tab,
            (false, true) if !self.has_blanks_between() => Separator::Comma,
            (false, _) => Separator::Blanks,
        }
    }

    /// Whether the words are separated only by blanks: `400 1,5`, but not `400, 1`.
    fn has_blanks_between(&self) -> bool {
        let mut words = self.content.split_whitespace();
        let is_apart = |word: &str| !word.starts_with(',') && !word.ends_with(',');
        let count = words.clone().count();
        count > 1 && words.all(is_apart)
    }

    /// Returns the cells without surrounding blanks and quotes; empty cells at the end are dropped.
    pub(super) fn cells(&self, separator: Separator) -> Vec<&'a str> {
        let mut cells = split(self.content, separator);
        while cells.len() > 1 && cells.last().is_some_and(|cell| cell.is_empty()) {
            cells.pop();
        }
        cells
    }
}

/// Splits a text into cells.
pub(super) fn split(content: &str, separator: Separator) -> Vec<&str> {
    let mut is_quoted = false;
    let is_between = |c: char| {
        if c == '"' {
            is_quoted = !is_quoted;
        }
        !is_quoted
            && match separator {
                Separator::Comma => c == ',',
                Separator::Semicolon => c == ';',
                Separator::Tab => c == '\t',
                Separator::Blanks => c.is_whitespace(),
            }
    };
    let cells = content.split(is_between).map(unquoted);
    if separator == Separator::Blanks {
        return cells.filter(|cell| !cell.is_empty()).collect();
    }
    cells.collect()
}

fn unquoted(cell: &str) -> &str {
    let cell = cell.trim();
    let inner = |sign| cell.strip_prefix(sign)?.strip_suffix(sign);
    inner('"').or_else(|| inner('\'')).map_or(cell, str::trim)
}

/// Parses a finite number with a decimal point or comma: `1.5`, `1,5`, `.5`, `+1e-3`, but neither `inf` nor `1.234,5`.
pub(super) fn number(cell: &str) -> Option<f64> {
    let is_possible = |c: char| c.is_ascii_digit() || "+-.,eE".contains(c);
    let cell = cell.trim();
    if cell.is_empty() || cell.len() > 400 || !cell.chars().all(is_possible) {
        return None;
    }
    let plain: Cow<str> = if cell.contains(',') {
        if cell.contains('.') || cell.matches(',').count() > 1 {
            return None;
        }
        cell.replace(',', ".").into()
    } else {
        cell.into()
    };
    plain.parse().ok().filter(|number: &f64| number.is_finite())
}

/// The decimal signs found in the numbers of a file.
#[derive(Debug, Default)]
pub(super) struct DecimalSigns<'a> {
    point: Option<(usize, &'a str)>,
    comma: Option<(usize, &'a str)>,
}

impl<'a> DecimalSigns<'a> {
    /// Parses the number in a cell.
    pub(super) fn number(
        &mut self,
        line: usize,
        column: usize,
        cell: &'a str,
    ) -> Result<f64, TableFileError> {
        if cell.is_empty() {
            return Err(TableFileError::EmptyCell { line, column });
        }
        let found = number(cell).ok_or_else(|| TableFileError::Number {
            line,
            text: cell.to_owned(),
        })?;
        if cell.contains(',') {
            self.comma.get_or_insert((line, cell));
        } else if cell.contains('.') {
            self.point.get_or_insert((line, cell));
        }
        match (self.comma, self.point) {
            (Some(comma), Some(point)) => Err(TableFileError::TwoDecimalSigns {
                comma: (comma.0, comma.1.to_owned()),
                point: (point.0, point.1.to_owned()),
            }),
            _ => Ok(found),
        }
    }

    /// Whether decimal commas were found.
    pub(super) fn is_comma(&self) -> bool {
        self.comma.is_some()
    }
}
