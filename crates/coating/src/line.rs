//! Stacks written in one line: `air | silica 300nm | silicon`.

use crate::file;
use crate::stack::{Layer, Medium, Stack};
use miette::{Diagnostic, NamedSource, SourceSpan};
use scene::description::{Extrapolate, Index};
use scene::limits::THICKNESS_NM;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use thiserror::Error;

/// What is wrong with a one-line stack, and where.
#[derive(Debug, Error, Diagnostic)]
#[error("{message}")]
pub struct LineError {
    message: String,
    #[help]
    help: Option<String>,
    #[source_code]
    line: Arc<NamedSource<String>>,
    #[label]
    at: SourceSpan,
}

/// A stack in one line.
pub(crate) const EXAMPLE: &str = "air | silica 300nm | silicon";
/// The units of a thickness, in nm. µ is a sign of its own beside the Greek letter.
const UNITS: [(&str, f64); 4] = [("nm", 1.0), ("um", 1e3), ("\u{b5}m", 1e3), ("μm", 1e3)];

fn example() -> String {
    format!("a stack is written like {EXAMPLE:?}")
}

/// A fault before it is placed in the line.
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

pub(crate) fn parse(line: &str) -> Result<Stack, LineError> {
    let parts = parts(line);
    let placed = |bytes: Range<usize>| {
        move |Fault { message, help }: Fault| LineError {
            message,
            help,
            line: Arc::new(NamedSource::new("stack", line.to_owned())),
            at: bytes.into(),
        }
    };
    let [(first, first_bytes), layers @ .., (last, last_bytes)] = parts.as_slice() else {
        let message = "a stack needs at least an incident medium and a substrate";
        return Err(placed(0..line.len())(Fault::new(message, example())));
    };
    if layers.len() > Stack::MAX_LAYERS {
        let message = format!("found {} layers", layers.len());
        let help = format!("at most {} are possible", Stack::MAX_LAYERS);
        return Err(placed(0..line.len())(Fault::new(message, help)));
    }
    let incident = incident(first).map_err(placed(first_bytes.clone()))?;
    let layers = layers
        .iter()
        .map(|(text, bytes)| layer(text).map_err(placed(bytes.clone())))
        .collect::<Result<Vec<_>, _>>()?;
    let substrate = half_space(last).map_err(placed(last_bytes.clone()))?;
    Ok(Stack::new(incident, layers, substrate))
}

/// The parts between the bars without the blanks around them, and where in the line they stand.
fn parts(line: &str) -> Vec<(&str, Range<usize>)> {
    let mut start = 0;
    let part = |part: &'_ str| {
        let trimmed = part.trim();
        let begin = start + (part.len() - part.trim_start().len());
        start += part.len() + 1;
        // An empty part is shown by the bar behind it.
        begin..begin + trimmed.len().max(1)
    };
    let places: Vec<_> = line.split('|').map(part).collect();
    line.split('|').map(str::trim).zip(places).collect()
}

fn incident(text: &str) -> Result<Medium, Fault> {
    let medium = half_space(text)?;
    match Stack::fault_of_incident(&medium) {
        Some(fault) => Err(Fault::new(
            fault,
            "write the stack from the side of the light, transparent medium first",
        )),
        None => Ok(medium),
    }
}

fn half_space(text: &str) -> Result<Medium, Fault> {
    if let Some((_, Some(_))) = split_thickness(text) {
        return Err(Fault::new(
            format!(
                "{text:?} has a thickness, but the first and the last medium go on without end"
            ),
            format!(
                "leave the thickness out, or add the medium behind it; {}",
                example()
            ),
        ));
    }
    medium(text)
}

fn layer(text: &str) -> Result<Layer, Fault> {
    let Some((written, Some(thickness))) = split_thickness(text) else {
        let what = if text.is_empty() {
            "there is nothing between two bars".to_owned()
        } else {
            format!("{text:?} has no thickness")
        };
        return Err(Fault::new(
            what,
            "a layer is a medium, a blank and a thickness in nm or µm, like \"silica 300nm\" or \"1.38 0.1um\"",
        ));
    };
    let (digits, factor) = thickness;
    let thickness_nm = digits.parse().map(|value: f64| value * factor);
    match thickness_nm {
        Ok(thickness_nm) if THICKNESS_NM.contains(thickness_nm) => Ok(Layer {
            medium: medium(written)?,
            thickness_nm: thickness_nm + 0.0,
        }),
        Ok(thickness_nm) => Err(Fault::new(
            format!("a thickness of {thickness_nm} nm"),
            format!("it must be from {THICKNESS_NM}"),
        )),
        Err(_) => Err(Fault::new(
            format!("{digits:?} is not a number"),
            "a thickness is written like 300nm or 0.3um",
        )),
    }
}

/// What stands before a thickness, and the thickness: its digits and its unit in nm.
type Split<'a> = (&'a str, Option<(&'a str, f64)>);

/// Splits `silica 300 nm` into medium and thickness; without a unit at its end it is all medium. `None` when there is nothing.
fn split_thickness(text: &str) -> Option<Split<'_>> {
    if text.is_empty() {
        return None;
    }
    for (unit, factor) in UNITS {
        let Some(rest) = text.strip_suffix(unit) else {
            continue;
        };
        let rest = rest.trim_end();
        let (medium, digits) = rest.rsplit_once(char::is_whitespace).unwrap_or(("", rest));
        // A name that happens to end like a unit has no digit before it.
        if digits.ends_with(|c: char| c.is_ascii_digit() || c == '.') {
            return Some((medium.trim_end(), Some((digits, factor))));
        }
    }
    Some((text, None))
}

fn medium(text: &str) -> Result<Medium, Fault> {
    let index = index(text)?;
    match file::medium(&index, Path::new("")) {
        Ok(medium) => Ok(medium),
        Err(problems) => {
            let first = problems.into_iter().next();
            let (message, help) = first.map_or_else(Default::default, |p| (p.message, p.help));
            Err(Fault { message, help })
        }
    }
}

/// A number, a complex number, a file of one of the two kinds that there are, or else a name.
fn index(text: &str) -> Result<Index, Fault> {
    if text.is_empty() {
        return Err(Fault::new("there is no medium here", example()));
    }
    if let Ok(n) = text.parse::<f64>() {
        return Ok(Index::Real(n));
    }
    if let Some(index) = complex(text) {
        return Ok(index);
    }
    if text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) {
        return Err(Fault::new(
            format!("{text:?} is not an index"),
            "an index is a number like 1.5, or n + ik like 1.5+0.1i with k ≥ 0 for absorption, or a material's name; a thickness \
             has its unit behind it",
        ));
    }
    let ending = Path::new(text)
        .extension()
        .and_then(|ending| ending.to_str());
    let (path, extrapolate) = (text.into(), Extrapolate::Error);
    Ok(match ending {
        Some("csv") => Index::File {
            csv: path,
            column: None,
            unit: None,
            extrapolate,
        },
        Some("yml" | "yaml") => Index::Database {
            yaml: path,
            extrapolate,
        },
        _ => Index::Name(text.to_owned()),
    })
}

/// `1.5+0.1i`, with or without blanks; the last sign that is not an exponent's parts n from k.
fn complex(text: &str) -> Option<Index> {
    let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let body = text.strip_suffix(['i', 'j'])?;
    let is_exponent = |at: usize| body[..at].ends_with(['e', 'E']);
    let split = body
        .rmatch_indices(['+', '-'])
        .map(|(at, _)| at)
        .find(|&at| at > 0 && !is_exponent(at))?;
    let (n, k) = body.split_at(split);
    let k: f64 = k.parse().ok()?;
    // 1.5-0i is transparent, and +0 makes its k a 0 without a sign.
    Some(Index::Complex([n.parse().ok()?, k + 0.0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(line: &str) -> (String, Range<usize>) {
        let error = parse(line).unwrap_err();
        let help = error.help.unwrap_or_default();
        let at = error.at.offset()..error.at.offset() + error.at.len();
        (format!("{}; {help}", error.message), at)
    }

    #[test]
    fn media_are_names_and_numbers_and_thicknesses_have_units() {
        let stack =
            parse(" 1.0|silica 300nm | 1.5+0.1i 0.25 um|2.3e0-0i 1.5µm|gold 2 μm|1.5 + 2e-1i ")
                .unwrap();
        assert_eq!(stack.thicknesses_nm(), [300.0, 250.0, 1500.0, 2000.0]);
        let media: Vec<_> = stack
            .layers()
            .iter()
            .map(|l| l.medium.written().clone())
            .collect();
        let named = |name: &str| Index::Name(name.to_owned());
        assert_eq!(
            media,
            [
                named("silica"),
                Index::Complex([1.5, 0.1]),
                Index::Complex([2.3, 0.0]),
                named("gold")
            ]
        );
        assert_eq!(stack.substrate().written(), &Index::Complex([1.5, 0.2]));
        assert_eq!(
            stack.label(),
            "1 | silica 300 nm | 1.5+0.1i 250 nm | 2.3+0i 1500 nm | gold 2000 nm | 1.5+0.2i"
        );
    }

    #[test]
    fn vacuum_is_one_and_air_is_a_little_more() {
        let index = |line| parse(line).unwrap().sampled(&[550.0]).unwrap().incident()[0];
        assert_eq!(index("vacuum | 1.5"), 1.0);
        assert_eq!(index("1 | 1.5"), 1.0);
        // Ciddor (1996): 1.000278 at 550 nm.
        assert!((index("air | 1.5") - 1.000_278).abs() < 1e-6);
    }

    #[test]
    fn files_have_their_endings() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.csv");
        std::fs::write(&path, "nm,n,k\n300,1.5,0\n800,1.6,0.1\n").unwrap();
        let stack = parse(&format!("1 | {} 3nm | 1.5", path.display())).unwrap();
        let index = stack.sampled(&[550.0]).unwrap().layers()[0][0];
        assert!((index.re - 1.55).abs() < 1e-14 && (index.im - 0.05).abs() < 1e-14);
        assert!(said("1 | none.csv 3nm | 1").0.contains("none.csv"));
        assert!(said("1 | none.yml 3nm | 1").0.contains("none.yml"));
    }

    #[test]
    fn mistakes_are_told_with_their_place_and_what_would_be_right() {
        for (line, words, place) in [
            ("1.5", "at least an incident medium", "1.5"),
            ("1 | silca 3nm | 2", "did you mean \"silica\"", "silca 3nm"),
            ("1 | silica | 2", "has no thickness", "silica"),
            ("1 | silica 300 | 2", "nm or µm", "silica 300"),
            ("1 | silica -3nm | 2", "from 0 to 100000 nm", "silica -3nm"),
            ("1 | silica nannm | 2", "no thickness", "silica nannm"),
            (
                "1 | silica 3.4.5nm | 2",
                "\"3.4.5\" is not a number",
                "silica 3.4.5nm",
            ),
            ("1 | 300nm | 2", "no medium", "300nm"),
            ("1 | silica 3nm", "go on without end", "silica 3nm"),
            ("3nm | silica", "go on without end", "3nm"),
            ("1 || 2", "nothing between two bars", "|"),
            ("| 2", "no medium", "|"),
            ("gold | 1", "gold absorbs", "gold"),
            ("1+0.1i | 2", "must be transparent", "1+0.1i"),
            ("1 | 1.5-0.1i 3nm | 2", "from 0 to 1000", "1.5-0.1i 3nm"),
            ("1 | 1.5x 3nm | 2", "is not an index", "1.5x 3nm"),
            ("1 | 0 3nm | 2", "from 0.001", "0 3nm"),
        ] {
            let (message, at) = said(line);
            assert!(message.contains(words), "{line}: {message}");
            assert_eq!(&line[at], place, "{line}: {message}");
        }
        let many = "1 |".to_owned() + &" 1.5 1nm |".repeat(1001) + " 1";
        assert!(said(&many).0.contains("1000"));
    }

    proptest::proptest! {
        #[test]
        fn no_text_panics(line in "[ |0-9a-z.+µ-]{0,40}") {
            let _ = parse(&line);
        }

        #[test]
        fn no_text_of_any_signs_panics(line in "\\PC*\\|\\PC*") {
            let _ = parse(&line);
        }
    }
}
