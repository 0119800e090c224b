//! Syntax of a one-line stack: definitions, media, layers and groups, before anything is looked up.

use super::{Fault, Misplaced, example};
use crate::stack::Stack;
use crate::thickness;
use document::suggestion::nearest;
use std::ops::Range;

/// A part of the line, and the byte at which it begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece<'a> {
    pub(super) text: &'a str,
    at: usize,
}

/// The parts of a line.
pub(super) struct Line<'a> {
    pub(super) definitions: Vec<Definition<'a>>,
    pub(super) incident: Piece<'a>,
    pub(super) layers: Vec<Node<'a>>,
    pub(super) substrate: Piece<'a>,
}

/// A definition, `H = TiO2 0.25@550`.
pub(super) struct Definition<'a> {
    pub(super) name: &'a str,
    pub(super) value: Piece<'a>,
}

/// A layer or a group of layers.
pub(super) enum Node<'a> {
    /// A medium and a thickness.
    Layer(Piece<'a>),
    /// A factor times the thickness of a definition, given by its index in the list.
    Defined(f64, usize, Piece<'a>),
    /// A group and how often it repeats.
    Group(Vec<Node<'a>>, usize),
}

/// Maximum nesting depth of groups.
const MAX_DEPTH: usize = 16;

impl Piece<'_> {
    /// Its bytes in the line; an empty piece is shown by the character behind it.
    pub(super) fn bytes(&self) -> Range<usize> {
        self.at..self.at + self.text.len().max(1)
    }

    pub(super) fn misplaced(
        &self,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Misplaced {
        Misplaced(Fault::new(message, help), self.bytes())
    }

    fn sub(&self, bytes: Range<usize>) -> Self {
        Self {
            text: self.text.get(bytes.clone()).unwrap_or_default(),
            at: self.at + bytes.start,
        }
    }

    fn trimmed(&self) -> Self {
        let text = self.text.trim_start();
        Self {
            text: text.trim_end(),
            at: self.at + (self.text.len() - text.len()),
        }
    }

    /// The parts between bars outside of brackets, without surrounding whitespace.
    fn parts(&self) -> Result<Vec<Self>, Misplaced> {
        let mut opened: Vec<usize> = Vec::new();
        let (mut parts, mut start) = (Vec::new(), 0);
        for (at, sign) in self.text.char_indices() {
            match sign {
                '(' => opened.push(at),
                ')' if opened.pop().is_none() => {
                    let here = self.sub(at..at + 1);
                    return Err(here.misplaced("no bracket is open here", GROUP));
                }
                '|' if opened.is_empty() => {
                    parts.push(self.sub(start..at).trimmed());
                    start = at + 1;
                }
                _ => {}
            }
        }
        if let Some(&at) = opened.last() {
            let here = self.sub(at..at + 1);
            return Err(here.misplaced("this bracket is not closed", GROUP));
        }
        parts.push(self.sub(start..self.text.len()).trimmed());
        Ok(parts)
    }
}

/// Help on how to write a group.
const GROUP: &str = "a group is written like (TiO2 60nm | SiO2 90nm)^8, or of definitions like \
                     \"H=TiO2 0.25@550; L=SiO2 0.25@550; air | (HL)^8 H | BK7\"";

/// Parses a line.
pub(super) fn line(text: &str) -> Result<Line<'_>, Misplaced> {
    let whole = Piece { text, at: 0 };
    let last = text.rfind(';').map_or(0, |at| at + 1);
    let mut definitions = Vec::new();
    if last > 0 {
        let mut start = 0;
        for written in text[..last - 1].split(';') {
            let piece = whole.sub(start..start + written.len()).trimmed();
            let found = definition(piece, &definitions)?;
            definitions.push(found);
            start += written.len() + 1;
        }
    }
    let parts = whole.sub(last..text.len()).parts()?;
    let [incident, layers @ .., substrate] = parts.as_slice() else {
        let message = "a stack needs at least an incident medium and a substrate";
        return Err(whole.misplaced(message, example()));
    };
    let mut nodes = Vec::new();
    for part in layers {
        nodes.extend(part_nodes(*part, &definitions, 0)?);
    }
    is_countable(&nodes, &whole)?;
    Ok(Line {
        definitions,
        incident: *incident,
        layers: nodes,
        substrate: *substrate,
    })
}

fn definition<'a>(
    piece: Piece<'a>,
    before: &[Definition<'_>],
) -> Result<Definition<'a>, Misplaced> {
    let help = "a definition comes before a ;, like \"H=TiO2 0.25@550\": a name of letters, digits and _, and a medium with or \
                without a thickness";
    let Some(equals) = piece.text.find('=') else {
        return Err(piece.misplaced(format!("{:?} is not a definition", piece.text), help));
    };
    let name = piece.sub(0..equals).trimmed();
    let is_name = name.text.starts_with(|c: char| c.is_ascii_alphabetic())
        && name
            .text
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || c == '_');
    if !is_name {
        return Err(name.misplaced(format!("{:?} is not a name", name.text), help));
    }
    if before.iter().any(|other| other.name == name.text) {
        let message = format!("{} is defined twice", name.text);
        return Err(name.misplaced(message, "each name stands for one medium or layer"));
    }
    let value = piece.sub(equals + 1..piece.text.len()).trimmed();
    if value.text.contains(['|', '(']) && !value.text.contains('.') {
        let message = format!("{:?} is more than a medium and its thickness", value.text);
        return Err(value.misplaced(message, help));
    }
    let name = name.text;
    Ok(Definition { name, value })
}

/// Parses the part between two bars: a layer, or a row of groups and definitions.
fn part_nodes<'a>(
    part: Piece<'a>,
    definitions: &[Definition<'a>],
    depth: usize,
) -> Result<Vec<Node<'a>>, Misplaced> {
    let is_layer = thickness::split(part.text).1.is_some();
    let is_row = !definitions.is_empty() || part.text.contains('^');
    if part.text.starts_with('(') || (!is_layer && is_row && !part.text.is_empty()) {
        row(part, definitions, depth)
    } else if depth > 0 && !is_layer && is_row_of_letters(part.text) {
        Err(undefined(part, part.text, definitions))
    } else {
        Ok(vec![Node::Layer(part)])
    }
}

/// Parses a row of groups and definitions, `(HL)^8 H`.
fn row<'a>(
    part: Piece<'a>,
    definitions: &[Definition<'a>],
    depth: usize,
) -> Result<Vec<Node<'a>>, Misplaced> {
    let mut nodes = Vec::new();
    let mut rest = part;
    while !rest.text.is_empty() {
        let length = if rest.text.starts_with('(') {
            let (group, length) = group(rest, definitions, depth)?;
            nodes.push(group);
            length
        } else {
            let ends = |c: char| c.is_whitespace() || c == '(' || c == '^';
            let length = rest.text.find(ends).unwrap_or(rest.text.len());
            if rest.text[length..].trim_start().starts_with('^') {
                let message = "a power belongs to a group in brackets";
                return Err(rest.sub(0..length.max(1)).misplaced(message, GROUP));
            }
            nodes.extend(word(rest.sub(0..length), definitions)?);
            length
        };
        rest = rest.sub(length..rest.text.len()).trimmed();
    }
    Ok(nodes)
}

/// Parses the group at the start of a text, and returns it with its length in bytes.
fn group<'a>(
    text: Piece<'a>,
    definitions: &[Definition<'a>],
    depth: usize,
) -> Result<(Node<'a>, usize), Misplaced> {
    if depth >= MAX_DEPTH {
        let message = format!("groups are nested more than {MAX_DEPTH} deep");
        return Err(text.sub(0..1).misplaced(message, GROUP));
    }
    let close = closing(text.text);
    let inner = text.sub(1..close);
    if inner.text.trim().is_empty() {
        return Err(text
            .sub(0..close + 1)
            .misplaced("there is nothing in this group", GROUP));
    }
    let mut nodes = Vec::new();
    for part in inner.parts()? {
        nodes.extend(part_nodes(part, definitions, depth + 1)?);
    }
    let behind = text.text.get(close + 1..).unwrap_or_default();
    let raised = behind.trim_start().strip_prefix('^').map(str::trim_start);
    let (times, length) = match raised {
        None => (1, close + 1),
        Some(power) => {
            let digits = power.len() - power.trim_start_matches(|c: char| c.is_ascii_digit()).len();
            let length = text.text.len() - power.len() + digits;
            let times = power[..digits].parse().ok();
            let times = times.filter(|times| (1..=Stack::MAX_LAYERS).contains(times));
            let Some(times) = times else {
                let message = format!("a group can repeat from 1 to {} times", Stack::MAX_LAYERS);
                return Err(text.sub(0..length).misplaced(message, GROUP));
            };
            (times, length)
        }
    };
    let group = Node::Group(nodes, times);
    is_countable(std::slice::from_ref(&group), &text.sub(0..length))?;
    Ok((group, length))
}

/// Returns where the opening bracket of a text closes; all brackets are known to close.
fn closing(text: &str) -> usize {
    let mut open = 0_usize;
    for (at, sign) in text.char_indices() {
        match sign {
            '(' => open += 1,
            ')' if open <= 1 => return at,
            ')' => open -= 1,
            _ => {}
        }
    }
    text.len()
}

/// Parses the name of a definition, or a row of one-letter definitions, each with or without a factor: `HL`, `2H`, `0.5HLH`.
fn word<'a>(word: Piece<'a>, definitions: &[Definition<'a>]) -> Result<Vec<Node<'a>>, Misplaced> {
    let by_name = |name: &str| definitions.iter().position(|defined| defined.name == name);
    let letters = letters(word, by_name)?;
    let (factor, name) = factor(word)?;
    match (by_name(name.text), letters) {
        (Some(_), Some(letters)) if letters.len() > 1 => {
            let message = format!(
                "{:?} is a defined name, and also a row of letters that are defined",
                name.text
            );
            Err(word.misplaced(
                message,
                "give the definition a name that cannot be read as a row of others",
            ))
        }
        (Some(place), _) => Ok(vec![Node::Defined(factor, place, word)]),
        (None, Some(letters)) => Ok(letters),
        (None, None) => Err(undefined(word, name.text, definitions)),
    }
}

fn undefined(word: Piece<'_>, name: &str, definitions: &[Definition<'_>]) -> Misplaced {
    let short: String = name.chars().take(64).collect();
    let names = || definitions.iter().map(|defined| defined.name);
    let known: Vec<&str> = names().take(20).collect();
    let letters = undefined_letters(name, &known);
    if let Some(letters) = letters.filter(|_| known.is_empty() || name.len() > 1) {
        let (named, verb) = match letters.as_slice() {
            [only] => (only.to_string(), "is"),
            [first @ .., last] => (format!("{} and {last}", listed(first)), "are"),
            [] => (String::new(), "is"),
        };
        let message = format!("{short:?}: {named} {verb} not defined");
        let definitions = letters
            .iter()
            .map(|letter| format!("{letter}=TiO2 0.25@550; "));
        let help = format!(
            "define each letter before the stack, like \"{}air | …\": a medium and its thickness, {}; or write each layer \
             like that, with | between them",
            definitions.collect::<String>(),
            thickness::FORMS
        );
        return word.misplaced(message, help);
    }
    let meant =
        nearest(name, names()).map_or(String::new(), |name| format!("; did you mean {name:?}?"));
    let help = if known.is_empty() {
        format!("nothing is defined; {GROUP}")
    } else {
        format!(
            "defined are {}; a layer that is not defined is written with its thickness, like \"silica 300nm\"",
            known.join(", ")
        )
    };
    word.misplaced(format!("{short:?} is not defined{meant}"), help)
}

fn listed(letters: &[char]) -> String {
    let letters: Vec<String> = letters.iter().map(char::to_string).collect();
    letters.join(", ")
}

/// Returns whether a text is a row of letters, each with or without a factor, rather than a medium: `HL`, `2HLH`.
fn is_row_of_letters(text: &str) -> bool {
    undefined_letters(text, &[]).is_some()
}

/// Returns the undefined letters of a row such as `2HLH`; `None` if the text looks more like the name of a material, or has more
/// undefined letters than a design has.
fn undefined_letters(text: &str, known: &[&str]) -> Option<Vec<char>> {
    /// More letters than designs of filters use.
    const MAX: usize = 4;
    let is_of_factor = |c: &char| c.is_ascii_digit() || *c == '.';
    let mut letters: Vec<char> = Vec::new();
    let mut has_known = false;
    for letter in text.chars().filter(|c| !is_of_factor(c)) {
        if known.iter().any(|name| name.chars().eq([letter])) {
            has_known = true;
        } else if !letter.is_ascii_alphabetic() {
            return None;
        } else if !letters.contains(&letter) {
            letters.push(letter);
        }
    }
    let are_capitals = letters.iter().all(char::is_ascii_uppercase);
    let is_row = has_known || (are_capitals && spectra::material_info(text).is_none());
    (is_row && (1..=MAX).contains(&letters.len())).then_some(letters)
}

/// Splits a word into its leading number, 1 if absent, and its name.
fn factor(word: Piece<'_>) -> Result<(f64, Piece<'_>), Misplaced> {
    let is_of_number = |c: char| c.is_ascii_digit() || c == '.';
    let digits = word.text.len() - word.text.trim_start_matches(is_of_number).len();
    let (number, name) = (word.sub(0..digits), word.sub(digits..word.text.len()));
    if digits == 0 {
        return Ok((1.0, name));
    }
    match number.text.parse::<f64>() {
        Ok(factor) if factor.is_finite() => Ok((factor, name)),
        _ => {
            let message = format!("{:?} is not a number", number.text);
            Err(number.misplaced(message, "2H is a layer of twice the thickness of H"))
        }
    }
}

/// Parses a row of one-letter definitions; `None` if one of them is not defined.
fn letters(
    word: Piece<'_>,
    by_name: impl Fn(&str) -> Option<usize>,
) -> Result<Option<Vec<Node<'_>>>, Misplaced> {
    let mut nodes = Vec::new();
    let mut rest = word;
    while !rest.text.is_empty() {
        let (factor, name) = factor(rest)?;
        let length = name.text.chars().next().map_or(0, char::len_utf8);
        let letter = name.sub(0..length);
        let Some(place) = by_name(letter.text) else {
            return Ok(None);
        };
        nodes.push(Node::Defined(factor, place, letter));
        rest = name.sub(length..name.text.len());
    }
    Ok(Some(nodes))
}

fn count(nodes: &[Node<'_>]) -> usize {
    let of_node = |node: &Node<'_>| match node {
        Node::Layer(_) | Node::Defined(..) => 1,
        Node::Group(nodes, times) => count(nodes).saturating_mul(*times),
    };
    nodes.iter().map(of_node).fold(0, usize::saturating_add)
}

/// Checks that there are not too many layers, before any is made.
fn is_countable(nodes: &[Node<'_>], piece: &Piece<'_>) -> Result<(), Misplaced> {
    let found = count(nodes);
    if found <= Stack::MAX_LAYERS {
        return Ok(());
    }
    let help = format!("at most {} are allowed", Stack::MAX_LAYERS);
    Err(piece.misplaced(format!("found {found} layers"), help))
}
