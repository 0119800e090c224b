//! Colors in a terminal.

use std::io::IsTerminal;

/// A swatch in the color itself if the terminal shows colors, else nothing. Follows <https://no-color.org>.
pub(crate) fn swatch([r, g, b]: [u8; 3]) -> String {
    if shows_colors() {
        format!("\x1b[48;2;{r};{g};{b}m      \x1b[0m ")
    } else {
        String::new()
    }
}

fn shows_colors() -> bool {
    let asks_for_none = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let cannot = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    std::io::stdout().is_terminal() && !asks_for_none && !cannot
}

/// A part of a line: text, or a swatch as [`swatch`] writes it.
#[derive(Debug, PartialEq)]
pub(crate) enum Part<'a> {
    Text(&'a str),
    Swatch(&'a str),
}

/// Splits a line into text and swatches.
pub(crate) fn parts(line: &str) -> impl Iterator<Item = Part<'_>> {
    line.split_inclusive(END).flat_map(|part| {
        let start = part.rfind(START).filter(|&start| is_swatch(&part[start..]));
        let (text, swatch) = part.split_at(start.unwrap_or(part.len()));
        [Part::Text(text), Part::Swatch(swatch)]
    })
}

const START: &str = "\x1b[48;2;";
const END: &str = "\x1b[0m";

/// Whether a text is a swatch: three numbers and blanks between the escape codes that start and end the color.
fn is_swatch(text: &str) -> bool {
    let inner = text
        .strip_prefix(START)
        .and_then(|rest| rest.strip_suffix(END));
    let codes = inner.and_then(|inner| inner.trim_end_matches(' ').strip_suffix('m'));
    codes.is_some_and(|codes| {
        codes.split(';').count() == 3 && codes.split(';').all(|code| code.parse::<u8>().is_ok())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn swatches_are_reported_from_other_escapes() {
        let own = "\x1b[48;2;1;20;255m      \x1b[0m";
        let line = format!("a {own} b\x1b[31m{own}");
        let found: Vec<_> = parts(&line)
            .filter(|part| *part != Part::Text(""))
            .collect();
        assert_eq!(
            found,
            [
                Part::Text("a "),
                Part::Swatch(own),
                Part::Text(" b\x1b[31m"),
                Part::Swatch(own),
            ]
        );
        for bad in [
            "\x1b[0m",
            "\x1b[48;2;1;2m \x1b[0m",
            "\x1b[48;2;1;2;3m x\x1b[0m",
        ] {
            assert!(parts(bad).all(|part| !matches!(part, Part::Swatch(text) if !text.is_empty())));
        }
    }
}
