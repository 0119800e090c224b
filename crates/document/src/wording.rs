//! Formatting for messages: foreign text made safe for a terminal, and numbers.

use std::borrow::Cow;

/// Whether a terminal obeys a character instead of showing it: a control character, or one that changes the direction of writing.
pub fn is_obeyed(sign: char) -> bool {
    sign.is_control()
        || matches!(sign, '\u{61c}' | '\u{200e}' | '\u{200f}')
        || matches!(sign, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Escapes every character that a terminal would obey, as in TOML and JSON (`\u001b`); tabs and line ends are kept.
pub fn visible(text: &str) -> Cow<'_, str> {
    let is_bad = |sign: char| is_obeyed(sign) && sign != '\n' && sign != '\t';
    if !text.contains(is_bad) {
        return Cow::Borrowed(text);
    }
    let mut safe = String::with_capacity(text.len() + 16);
    for sign in text.chars() {
        if is_bad(sign) {
            safe.push_str(&format!("\\u{:04x}", u32::from(sign)));
        } else {
            safe.push(sign);
        }
    }
    Cow::Owned(safe)
}

/// Shortens a text to about `most` characters: the first two thirds and the end, with … between them.
pub fn shortened(text: &str, most: usize) -> Cow<'_, str> {
    if text.len() <= most || text.char_indices().nth(most).is_none() {
        return Cow::Borrowed(text);
    }
    let head = text.char_indices().nth(2 * most / 3);
    let tail = text.char_indices().rev().nth(most / 3);
    let at = |place: Option<(usize, char)>| place.map_or(0, |(at, _)| at);
    let (head, tail) = text
        .split_at_checked(at(head))
        .map_or(("", ""), |(head, _)| {
            (head, text.get(at(tail)..).unwrap_or_default())
        });
    Cow::Owned(format!("{head}…{tail}"))
}

/// Formats a number in its shortest form: `0.25`, `1e9`.
pub fn number(value: f64) -> String {
    /// A number of up to this many characters is easy to read in full.
    const READABLE: usize = 9;
    let plain = value.to_string();
    if plain.len() <= READABLE {
        return plain;
    }
    let scientific = format!("{value:e}");
    if scientific.len() < plain.len() {
        scientific
    } else {
        plain
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_escaped() {
        for (text, safe) in [
            ("silica µ 膜", "silica µ 膜"),
            ("a\tb\nc", "a\tb\nc"),
            ("\x1b[31mx", "\\u001b[31mx"),
            ("a\rb\x07\x7f", "a\\u000db\\u0007\\u007f"),
            ("\u{9b}2J", "\\u009b2J"),
            ("a\u{202e}b\u{2066}", "a\\u202eb\\u2066"),
        ] {
            assert_eq!(visible(text), safe);
        }
    }

    #[test]
    fn what_is_long_loses_its_middle() {
        assert_eq!(shortened("abc", 3), "abc");
        assert_eq!(shortened("µµµ", 3), "µµµ");
        assert_eq!(shortened("0123456789", 6), "0123…789");
        let long = "µ".repeat(1 << 20);
        assert!(shortened(&long, 90).chars().count() <= 92);
    }

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.25, "0.25"),
            (100_000.0, "100000"),
            (1e9, "1e9"),
            (-1e-12, "-1e-12"),
            (1e300, "1e300"),
            (56.452_345_678_9, "56.4523456789"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}
