//! Source lines that show a fault.

use crate::wording::{is_obeyed, visible};
use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};
use std::ops::Range;

/// The line of a text with a fault, and its neighbors, as an error shows them: long lines are cut to a window, marked with …, and control
/// characters are replaced by symbols. Line and column numbers refer to the whole text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Snippet {
    name: String,
    text: String,
    /// The number of its first line, from 0.
    line: usize,
    /// Column of the fault in its line, in characters from 0.
    column: usize,
    fault: Range<usize>,
}

/// The maximum number of characters of a line that are shown.
const MAX: usize = 120;
/// How many of them are before the fault.
const BEFORE: usize = 40;

impl Snippet {
    /// Creates the snippet for `bytes` in a text named `name`. Of a fault of several lines, the first is shown.
    pub fn new(name: &str, text: &str, bytes: Range<usize>) -> Self {
        let start = floor(text, bytes.start);
        let (before, after) = text.split_at(start);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line_end = after.find('\n').map_or(text.len(), |length| start + length);
        let end = floor(text, bytes.end).clamp(start, line_end);
        let mut snippet = Self {
            name: visible(name).into_owned(),
            text: String::new(),
            line: before.bytes().filter(|&b| b == b'\n').count(),
            column: text[line_start..start].chars().count(),
            fault: 0..0,
        };
        if let Some(previous_end) = line_start.checked_sub(1) {
            let previous = &text[..previous_end];
            let previous_start = previous.rfind('\n').map_or(0, |newline| newline + 1);
            snippet.push_line(&previous[previous_start..], None);
            snippet.line -= 1;
        }
        let fault = start - line_start..end - line_start;
        snippet.push_line(&text[line_start..line_end], Some(&fault));
        if let Some(rest) = text.get(line_end + 1..).filter(|rest| !rest.is_empty()) {
            snippet.push_line(rest.split('\n').next().unwrap_or_default(), None);
        }
        snippet
    }

    /// The byte range of the fault within the snippet.
    pub fn fault(&self) -> Range<usize> {
        self.fault.clone()
    }

    fn push_line(&mut self, line: &str, fault: Option<&Range<usize>>) {
        let line = line.strip_suffix('\r').unwrap_or(line);
        let shown = window(line, fault.map_or(0, |fault| fault.start));
        if shown.start > 0 {
            self.text.push('…');
        }
        let mut place = shown.start;
        let within = |place: usize| fault.is_some_and(|fault| place == fault.start);
        for sign in line[shown.clone()].chars() {
            if within(place) {
                self.fault = self.text.len()..self.text.len();
            }
            self.text.push(shown_as(sign));
            place += sign.len_utf8();
            if fault
                .as_ref()
                .is_some_and(|f| f.start < place && place <= f.end)
            {
                self.fault.end = self.text.len();
            }
        }
        // A fault at the end of the line.
        if within(place) {
            self.fault = self.text.len()..self.text.len();
        }
        if shown.end < line.len() {
            self.text.push('…');
        }
        self.text.push('\n');
    }
}

/// The bytes of a line that are shown if the fault is at `place`.
fn window(line: &str, place: usize) -> Range<usize> {
    let last = |text: &str| text.char_indices().nth(MAX).map(|(at, _)| at);
    if last(line).is_none() {
        return 0..line.len();
    }
    let place = floor(line, place);
    let back = |text: &str, count: usize| text.char_indices().rev().nth(count - 1);
    let mut start = back(&line[..place], BEFORE).map_or(0, |(at, _)| at);
    let end = last(&line[start..]).map_or(line.len(), |length| start + length);
    if end == line.len() {
        start = back(line, MAX).map_or(0, |(at, _)| at);
    }
    start..end
}

fn floor(text: &str, at: usize) -> usize {
    let at = at.min(text.len());
    (0..=at)
        .rev()
        .find(|&at| text.is_char_boundary(at))
        .unwrap_or(0)
}

/// Replaces a character that a terminal would interpret by a symbol of one column.
fn shown_as(sign: char) -> char {
    match sign {
        '\t' => sign,
        '\0'..='\x1f' => char::from_u32(0x2400 + u32::from(sign)).unwrap_or('\u{fffd}'),
        '\x7f' => '\u{2421}',
        _ if is_obeyed(sign) => '\u{fffd}',
        _ => sign,
    }
}

impl SourceCode for Snippet {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let found = self
            .text
            .as_str()
            .read_span(span, lines_before, lines_after)?;
        // A span without lines before it is requested to get its column.
        let column = if lines_before == 0 { self.column } else { 0 };
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.clone(),
            found.data(),
            *found.span(),
            found.line() + self.line,
            column,
            found.line_count(),
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(snippet: &Snippet) -> &str {
        &snippet.text[snippet.fault()]
    }

    #[test]
    fn short_lines_are_whole() {
        let text = "a = 1\r\nb = µµ2\r\nc = 3\n";
        let start = text.find("µµ2").unwrap();
        let snippet = Snippet::new("x", text, start..start + 5);
        assert_eq!(snippet.text, "a = 1\nb = µµ2\nc = 3\n");
        assert_eq!(fault(&snippet), "µµ2");
        assert_eq!((snippet.line, snippet.column), (0, 4));
    }

    #[test]
    fn of_long_lines_there_is_a_window() {
        let line = format!("{}FAULT{}", "a".repeat(1 << 20), "b".repeat(1 << 20));
        let text = format!("{}\n{line}\n{}", "x".repeat(500), "y".repeat(500));
        let start = text.find("FAULT").unwrap();
        let snippet = Snippet::new("x", &text, start..start + 5);
        let lines: Vec<&str> = snippet.text.lines().collect();
        assert_eq!(lines[0], format!("{}…", "x".repeat(120)));
        assert_eq!(
            lines[1],
            format!("…{}FAULT{}…", "a".repeat(40), "b".repeat(75))
        );
        assert_eq!(fault(&snippet), "FAULT");
        assert_eq!(snippet.column, 1 << 20);
        // At both ends, and with a long fault.
        for (bytes, shown) in [
            (0..3, format!("{}…", "c".repeat(120))),
            (497..500, format!("…{}", "c".repeat(120))),
            (500..500, format!("…{}", "c".repeat(120))),
            (100..400, format!("…{}…", "c".repeat(120))),
        ] {
            let snippet = Snippet::new("x", &"c".repeat(500), bytes.clone());
            assert_eq!(snippet.text.trim_end(), shown);
            assert_eq!(fault(&snippet).len(), bytes.len().min(80), "{bytes:?}");
        }
    }

    #[test]
    fn odd_places_and_texts_are_shown() {
        for text in ["", "\n", "\r\n", "ä", "\n\nä\n"] {
            for start in 0..6 {
                for end in 0..8 {
                    let snippet = Snippet::new("x", text, start..end);
                    assert!(snippet.fault().end <= snippet.text.len());
                    let span = snippet.fault().into();
                    assert!(snippet.read_span(&span, 1, 1).is_ok(), "{text:?} {start}");
                }
            }
        }
    }

    #[test]
    fn control_characters_are_signs() {
        let text = "k = \"\x1b[31m\u{202e}\x7f\" # \x07";
        let snippet = Snippet::new("\x1bx", text, 4..10);
        assert_eq!(snippet.text, "k = \"␛[31m\u{fffd}␡\" # ␇\n");
        assert_eq!(fault(&snippet), "\"␛[31m");
        assert_eq!(snippet.name, "\\u001bx");
    }
}
