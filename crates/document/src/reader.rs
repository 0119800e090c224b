//! From a TOML tree to a document, collecting everything that does not fit.

use crate::shape::{Field, Fields, Forms, Shape, TAG, listed, quoted_choice};
use crate::suggestion::nearest;
use crate::tree::Tree;
use crate::{Document, FieldPath, Location, Problem, ProblemKind, Problems};
use std::collections::{BTreeMap, HashSet};
use std::ops::Range;
use toml::de::{DeArray, DeInteger, DeTable, DeValue};
use toml::{Spanned, Value};

/// The problems found while reading a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Findings {
    pub(crate) problems: Vec<Problem>,
    /// The number of problems beyond those that are kept.
    pub(crate) omitted: usize,
    /// Values that were missing or unusable and have stand-ins.
    broken: HashSet<FieldPath>,
    around_broken: HashSet<FieldPath>,
}

impl Findings {
    const MAX_MARKS: usize = 10 * Problems::MAX_SHOWN;

    /// Whether a value, a part of it or something that contains it has a stand-in.
    pub(crate) fn is_broken(&self, field: &FieldPath) -> bool {
        self.around_broken.contains(field)
            || field.and_around().any(|part| self.broken.contains(&part))
    }

    fn add(&mut self, problem: Problem) {
        if self.problems.len() < Problems::MAX_SHOWN {
            self.problems.push(problem);
        } else {
            self.omitted += 1;
        }
    }

    /// Marks a value as broken; in a file with very many broken values, its whole section, to bound the number of marks.
    fn mark_broken(&mut self, field: &FieldPath) {
        let section = || {
            field
                .and_around()
                .nth(field.steps().len().saturating_sub(1))
        };
        let marked = match self.broken.len() {
            0..Self::MAX_MARKS => field.clone(),
            _ => section().unwrap_or_default(),
        };
        self.around_broken.extend(marked.and_around());
        self.broken.insert(marked);
    }
}

/// Converts `tree` to a document, with stand-ins where it is broken. It is `None` only if the types reject what the schema accepts,
/// which is then among the findings.
pub(crate) fn read<T: Document>(text: &str, tree: &Tree<'_>) -> (Option<T>, Findings) {
    let mut reader = Reader {
        text,
        advice: Advice::of::<T>(),
        findings: Findings::default(),
    };
    let shape = Shape::of::<T>();
    let Shape::Table(fields) = &*shape else {
        unreachable!("a file is a table");
    };
    let place = Place::root();
    let table = reader.fields(fields, tree.table(), &place, &Context::PLAIN);
    let document = Value::Table(table).try_into::<T>();
    let document = document
        .map_err(|error| {
            reader.report(ProblemKind::WrongType, &place, error.message().to_owned());
        })
        .ok();
    (document, reader.findings)
}

/// A value's name and its bytes in the file.
#[derive(Clone)]
struct Place {
    field: FieldPath,
    bytes: Range<usize>,
}

impl Place {
    fn root() -> Self {
        Self {
            field: FieldPath::root(),
            bytes: 0..0,
        }
    }
}

/// What is known about a table besides its own fields.
struct Context<'a> {
    /// Whether the field [`TAG`] has been read already.
    is_tagged: bool,
    /// Says where else an unknown field would be valid.
    elsewhere: &'a dyn Fn(&str) -> Option<String>,
    /// All forms that the table may have, if there are several.
    forms: &'a [&'a Fields],
}

impl Context<'_> {
    const PLAIN: Self = Self {
        is_tagged: false,
        elsewhere: &|_| None,
        forms: &[],
    };
}

/// The advice of the type that is read.
struct Advice {
    renamed: &'static [(&'static str, &'static str)],
    on_type: fn(&FieldPath, &str) -> Option<&'static str>,
    on_field: fn(&FieldPath, &str) -> Option<&'static str>,
}

impl Advice {
    fn of<T: Document>() -> Self {
        Self {
            renamed: T::RENAMED,
            on_type: T::advice_on_type,
            on_field: T::advice_on_field,
        }
    }

    /// The new name of a renamed field or word, if it is one of `possible`.
    fn renamed<'a>(
        &self,
        name: &str,
        mut possible: impl Iterator<Item = &'a str>,
    ) -> Option<&'a str> {
        let (_, now) = self.renamed.iter().find(|(old, _)| *old == name)?;
        possible.find(|known| known == now)
    }
}

struct Reader<'a> {
    text: &'a str,
    advice: Advice,
    findings: Findings,
}

impl Reader<'_> {
    fn value(&mut self, shape: &Shape, value: &Spanned<DeValue<'_>>, place: &Place) -> Value {
        let shape = shape.resolved();
        match (shape, value.get_ref()) {
            (Shape::Number, DeValue::Integer(integer)) => Value::Float(float_of(integer)),
            (Shape::Number, DeValue::Float(float)) => {
                // Rust can parse everything that the TOML parser accepts as a number.
                Value::Float(float.as_str().parse().unwrap_or(f64::NAN))
            }
            (Shape::Integer { low, high }, DeValue::Integer(integer)) => {
                self.integer(integer, (*low, *high), shape, place)
            }
            (Shape::Boolean, &DeValue::Boolean(truth)) => Value::Boolean(truth),
            (Shape::Text, DeValue::String(text)) => Value::String(text.to_string()),
            (Shape::Choice(words), DeValue::String(text)) => self.choice(words, text, place),
            (Shape::List { item, length }, DeValue::Array(items)) => {
                self.list(shape, item, *length, items, place)
            }
            (Shape::Map(item), DeValue::Table(table)) => self.map(item, table, place),
            (Shape::Table(fields), DeValue::Table(table)) => {
                Value::Table(self.fields(fields, table, place, &Context::PLAIN))
            }
            (Shape::Tagged(variants), DeValue::Table(table)) => self.tagged(variants, table, place),
            (Shape::AnyOf(shapes), DeValue::Table(table)) => {
                self.any_table(shape, shapes, value, table, place)
            }
            (Shape::AnyOf(shapes), found) => {
                match shapes.iter().find(|shape| accepts(shape, found)) {
                    Some(shape) => self.value(shape, value, place),
                    None => self.mismatch(shape, found, place),
                }
            }
            (_, found) => self.mismatch(shape, found, place),
        }
    }

    fn integer(
        &mut self,
        integer: &DeInteger<'_>,
        (low, high): (i64, i64),
        shape: &Shape,
        place: &Place,
    ) -> Value {
        match i64::from_str_radix(integer.as_str(), integer.radix()) {
            Ok(value) if (low..=high).contains(&value) => Value::Integer(value),
            _ => {
                let message = format!("found {integer}, expected {shape}");
                self.report(ProblemKind::OutOfRange, place, message);
                self.stand_in(shape, place)
            }
        }
    }

    fn choice(&mut self, words: &[String], text: &str, place: &Place) -> Value {
        if words.iter().any(|word| word == text) {
            return Value::String(text.to_owned());
        }
        self.unknown_word(words, text, place);
        self.findings.mark_broken(&place.field);
        Value::String(words.first().cloned().unwrap_or_default())
    }

    fn list(
        &mut self,
        shape: &Shape,
        item: &Shape,
        length: Option<usize>,
        items: &DeArray<'_>,
        place: &Place,
    ) -> Value {
        if length.is_some_and(|length| length != items.len()) {
            let message = format!("found an array of {}, expected {shape}", items.len());
            self.report(ProblemKind::WrongType, place, message);
            return self.stand_in(shape, place);
        }
        let values = items.iter().enumerate().map(|(index, value)| {
            let place = Place {
                field: place.field.index(index),
                bytes: value.span(),
            };
            self.value(item, value, &place)
        });
        Value::Array(values.collect())
    }

    fn map(&mut self, item: &Shape, table: &DeTable<'_>, place: &Place) -> Value {
        let values = table.iter().map(|(key, value)| {
            let place = Place {
                field: place.field.key(key.get_ref()),
                bytes: value.span(),
            };
            let value = self.value(item, value, &place);
            (key.get_ref().to_string(), value)
        });
        Value::Table(values.collect())
    }

    fn tagged(
        &mut self,
        variants: &BTreeMap<String, Fields>,
        table: &DeTable<'_>,
        place: &Place,
    ) -> Value {
        let words: Vec<_> = variants.keys().cloned().collect();
        let Some(tag) = table.get(TAG) else {
            let message = format!("is missing; expected {}", quoted_choice(&words));
            let at = Place {
                field: place.field.key(TAG),
                bytes: place.bytes.clone(),
            };
            self.report(ProblemKind::MissingField, &at, message);
            return self.stand_in_of_tagged(variants, place);
        };
        let at = Place {
            field: place.field.key(TAG),
            bytes: tag.span(),
        };
        let DeValue::String(word) = tag.get_ref() else {
            self.mismatch(&Shape::Choice(words), tag.get_ref(), &at);
            return self.stand_in_of_tagged(variants, place);
        };
        let Some(fields) = variants.get(word.as_ref()) else {
            self.unknown_word(&words, word, &at);
            return self.stand_in_of_tagged(variants, place);
        };
        let elsewhere = |name: &str| {
            let owners: Vec<_> = variants
                .iter()
                .filter(|(_, fields)| fields.0.contains_key(name))
                .map(|(owner, _)| owner)
                .collect();
            (!owners.is_empty()).then(|| format!("belongs to type {}", quoted_choice(&owners)))
        };
        let context = Context {
            is_tagged: true,
            elsewhere: &elsewhere,
            forms: &[],
        };
        let mut values = self.fields(fields, table, place, &context);
        values.insert(TAG.to_owned(), Value::String(word.to_string()));
        Value::Table(values)
    }

    /// Reads a table that may have one of several forms as the form whose fields it has most of.
    fn any_table(
        &mut self,
        shape: &Shape,
        shapes: &[Shape],
        value: &Spanned<DeValue<'_>>,
        table: &DeTable<'_>,
        place: &Place,
    ) -> Value {
        let tables = shapes.iter().filter_map(|shape| match shape {
            Shape::Table(fields) => Some(fields),
            _ => None,
        });
        let forms: Vec<_> = tables.collect();
        let candidates = forms
            .iter()
            .map(|fields| (likeness(fields, table), *fields));
        // Among equals the first wins, so that the order of the format's types decides.
        let best = candidates.reduce(|best, next| if next.0 > best.0 { next } else { best });
        let Some((_, fields)) = best.filter(|((required, _), _)| *required > 0) else {
            return self.mismatch(shape, value.get_ref(), place);
        };
        let elsewhere = |name: &str| {
            let is_owner = |shape: &&Shape| match shape {
                Shape::Table(other) => other.0.contains_key(name),
                _ => false,
            };
            let owner = shapes.iter().find(is_owner)?;
            Some(format!("belongs to another form, {owner}"))
        };
        let context = Context {
            is_tagged: false,
            elsewhere: &elsewhere,
            forms: &forms,
        };
        Value::Table(self.fields(fields, table, place, &context))
    }

    /// Reads the fields of a table. Unknown fields are reported and left out; missing ones are reported and filled in.
    fn fields(
        &mut self,
        fields: &Fields,
        table: &DeTable<'_>,
        place: &Place,
        context: &Context<'_>,
    ) -> toml::Table {
        let mut meant: Vec<&str> = Vec::new();
        let mut values = toml::Table::new();
        for (key, value) in table {
            let name = key.get_ref().as_ref();
            let own = Place {
                field: place.field.key(name),
                bytes: value.span(),
            };
            match fields.0.get(name) {
                Some(field) => {
                    values.insert(name.to_owned(), self.value(&field.shape, value, &own));
                }
                None if context.is_tagged && name == TAG => {}
                None => {
                    let at = Place {
                        bytes: key.span(),
                        ..own
                    };
                    meant.extend(self.unknown_field(fields, table, &at, name, context));
                }
            }
        }
        for (name, field) in &fields.0 {
            if field.is_required && !table.contains_key(name.as_str()) {
                let value = self.missing_field(name, field, place, meant.contains(&name.as_str()));
                values.insert(name.clone(), value);
            }
        }
        values
    }

    /// Reports a field that does not exist, and returns the one that was probably meant.
    fn unknown_field<'f>(
        &mut self,
        fields: &'f Fields,
        table: &DeTable<'_>,
        at: &Place,
        name: &str,
        context: &Context<'_>,
    ) -> Option<&'f str> {
        let free = || fields.names().filter(|known| !table.contains_key(*known));
        let renamed = self.advice.renamed(name, free());
        let suggestion = renamed.or_else(|| nearest(name, free()));
        let message = match ((context.elsewhere)(name), suggestion) {
            (Some(owner), _) => format!("unknown field here: `{name}` {owner}"),
            (None, Some(known)) if renamed.is_some() => format!("was renamed to `{known}`"),
            (None, Some(known)) => format!("unknown field; did you mean `{known}`?"),
            (None, None) => "unknown field".to_owned(),
        };
        let help = match ((self.advice.on_field)(&at.field, name), context.forms) {
            (Some(advice), _) => advice.to_owned(),
            (None, [_, _, ..]) => format!("the fields here are {}", Forms(context.forms)),
            (None, _) => format!("the fields here are {}", listed(fields.names())),
        };
        let problem = Problem::new(ProblemKind::UnknownField, &at.field, message).help(help);
        self.add(problem, at);
        suggestion
    }

    /// Fills in a missing field, and reports it unless a misspelled field was reported in its place.
    fn missing_field(&mut self, name: &str, field: &Field, place: &Place, said: bool) -> Value {
        let at = Place {
            field: place.field.key(name),
            bytes: place.bytes.clone(),
        };
        if !said {
            let message = format!("is missing; expected {}", field.shape);
            let mut problem = Problem::new(ProblemKind::MissingField, &at.field, message);
            problem.help = field
                .meaning
                .as_ref()
                .map(|text| format!("`{name}`: {text}"));
            self.add(problem, &at);
        }
        self.stand_in(&field.shape, &at)
    }

    fn unknown_word(&mut self, words: &[String], word: &str, at: &Place) {
        let known = words.iter().map(String::as_str);
        let suggestion = match self.advice.renamed(word, known.clone()) {
            Some(now) => format!(
                "; {} was renamed to {now:?}",
                shortened(&format!("{word:?}"))
            ),
            None => nearest(word, known)
                .map(|known| format!("; did you mean {known:?}?"))
                .unwrap_or_default(),
        };
        let message = format!(
            "found {}, expected {}{suggestion}",
            shortened(&format!("{word:?}")),
            quoted_choice(words)
        );
        let mut problem = Problem::new(ProblemKind::UnknownName, &at.field, message);
        problem.help = (self.advice.on_type)(&at.field, word).map(str::to_owned);
        self.add(problem, at);
    }

    fn mismatch(&mut self, shape: &Shape, found: &DeValue<'_>, place: &Place) -> Value {
        let source = self.text.get(place.bytes.clone()).unwrap_or_default();
        let found = match found {
            DeValue::Table(_) => "a table".to_owned(),
            DeValue::Array(_) => "an array".to_owned(),
            DeValue::Integer(_) => format!("the whole number {}", shortened(source)),
            DeValue::Float(_) => format!("the number {}", shortened(source)),
            DeValue::String(_) => format!("the string {}", shortened(source)),
            DeValue::Boolean(_) => format!("the boolean {}", shortened(source)),
            DeValue::Datetime(_) => format!("the date {}", shortened(source)),
        };
        let message = format!("found {found}, expected {shape}");
        self.report(ProblemKind::WrongType, place, message);
        self.stand_in(shape, place)
    }

    fn report(&mut self, kind: ProblemKind, place: &Place, message: String) {
        self.add(Problem::new(kind, &place.field, message), place);
    }

    fn add(&mut self, problem: Problem, place: &Place) {
        // Finding the line takes a pass through the file, so it is done only for problems that are kept.
        if self.findings.problems.len() < Problems::MAX_SHOWN {
            let location = Location::new(self.text, place.bytes.clone());
            self.findings.add(problem.located(location));
        } else {
            self.findings.omitted += 1;
        }
    }

    fn stand_in(&mut self, shape: &Shape, place: &Place) -> Value {
        self.findings.mark_broken(&place.field);
        any_value(shape)
    }

    fn stand_in_of_tagged(&mut self, variants: &BTreeMap<String, Fields>, place: &Place) -> Value {
        self.findings.mark_broken(&place.field);
        any_tagged(variants)
    }
}

/// How many of a form's required fields a table has, misspelled or not, and how many of all its fields.
fn likeness(fields: &Fields, table: &DeTable<'_>) -> (usize, usize) {
    let names = || table.iter().map(|(key, _)| key.get_ref().as_ref());
    let required = fields
        .required()
        .filter(|field| table.contains_key(*field) || nearest(field, names()).is_some());
    let known = names().filter(|name| fields.0.contains_key(*name));
    (required.count(), known.count())
}

/// Whether a value that is not a table has the type that `shape` asks for.
fn accepts(shape: &Shape, found: &DeValue<'_>) -> bool {
    match found {
        DeValue::Integer(_) => matches!(shape, Shape::Number | Shape::Integer { .. }),
        DeValue::Float(_) => matches!(shape, Shape::Number),
        DeValue::String(_) => matches!(shape, Shape::Text | Shape::Choice(_)),
        DeValue::Array(_) => matches!(shape, Shape::List { .. }),
        DeValue::Boolean(_) => matches!(shape, Shape::Boolean),
        DeValue::Datetime(_) | DeValue::Table(_) => false,
    }
}

/// A whole number of any length as a float.
fn float_of(integer: &DeInteger<'_>) -> f64 {
    let (digits, sign) = match integer.as_str().strip_prefix('-') {
        Some(digits) => (digits, -1.0),
        None => (integer.as_str(), 1.0),
    };
    let radix = integer.radix();
    if radix == 10 {
        return digits.parse().map_or(f64::NAN, |value: f64| sign * value);
    }
    let append = |value: f64, digit: u32| value * f64::from(radix) + f64::from(digit);
    let digits = digits.chars().filter_map(|c| c.to_digit(radix));
    sign * digits.fold(0.0, append)
}

/// The simplest value of a shape, as a stand-in for a missing one.
fn any_value(shape: &Shape) -> Value {
    match shape.resolved() {
        Shape::Number => Value::Float(1.0),
        Shape::Integer { low, .. } => Value::Integer(*low),
        Shape::Boolean => Value::Boolean(false),
        Shape::Text => Value::String(String::new()),
        Shape::Choice(words) => Value::String(words.first().cloned().unwrap_or_default()),
        Shape::List { item, length } => {
            Value::Array((0..length.unwrap_or(0)).map(|_| any_value(item)).collect())
        }
        Shape::Map(_) => Value::Table(toml::Table::new()),
        Shape::Table(fields) => Value::Table(any_fields(fields)),
        Shape::Tagged(variants) => any_tagged(variants),
        Shape::AnyOf(shapes) => shapes.first().map_or(Value::Float(1.0), any_value),
        Shape::Again(_) => unreachable!("a resolved shape is not a reference"),
    }
}

fn any_fields(fields: &Fields) -> toml::Table {
    let required = fields.0.iter().filter(|(_, field)| field.is_required);
    required
        .map(|(name, field)| (name.clone(), any_value(&field.shape)))
        .collect()
}

fn any_tagged(variants: &BTreeMap<String, Fields>) -> Value {
    let mut values = toml::Table::new();
    if let Some((word, fields)) = variants.iter().next() {
        values = any_fields(fields);
        values.insert(TAG.to_owned(), Value::String(word.clone()));
    }
    Value::Table(values)
}

/// A piece of the source, shortened to fit in a message.
fn shortened(source: &str) -> String {
    const MAX: usize = 40;
    let line = source.lines().next().unwrap_or_default();
    if line.chars().count() > MAX || line.len() < source.len() {
        format!("{}…", line.chars().take(MAX).collect::<String>())
    } else {
        line.to_owned()
    }
}
