//! The allowed forms of values in a file.

use crate::schema_of;
use schemars::JsonSchema;
use serde_json::Value as Json;
use std::any::TypeId;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// The allowed form of a value: the part of JSON Schema that the format needs, in a form that is easy to traverse.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    Number,
    Integer {
        low: i64,
        high: i64,
    },
    Boolean,
    Text,
    /// One of these words.
    Choice(Vec<String>),
    List {
        item: Box<Shape>,
        length: Option<usize>,
    },
    /// A table with arbitrary keys.
    Map(Box<Shape>),
    Table(Fields),
    /// A table whose field `type` determines its other fields.
    Tagged(BTreeMap<String, Fields>),
    /// Any of several, distinguished by their type or by their fields. Never nested.
    AnyOf(Vec<Shape>),
    /// A shape that contains this one.
    Again(Again),
}

/// The fields of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Fields(pub(crate) BTreeMap<String, Field>);

/// A field of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Field {
    pub(crate) shape: Shape,
    pub(crate) is_required: bool,
    /// Its description, for advice.
    pub(crate) meaning: Option<String>,
}

/// The field that selects the variant of a [`Shape::Tagged`].
pub(crate) const TAG: &str = "type";

/// A shape that contains itself: an index may be a mixture of indices, a thickness a sum of thicknesses.
#[derive(Clone)]
pub(crate) struct Again {
    name: String,
    shape: Arc<OnceLock<Shape>>,
}

impl fmt::Debug for Again {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Again({})", self.name)
    }
}

impl PartialEq for Again {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// The shapes of the types that have been read so far. There are few types, and their shapes are kept forever.
static KNOWN: Mutex<BTreeMap<TypeId, Arc<Shape>>> = Mutex::new(BTreeMap::new());

impl Shape {
    /// The shape of files that are read as `T`.
    pub(crate) fn of<T: JsonSchema + 'static>() -> Arc<Self> {
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        let compiled = || {
            let root = schema_of::<T>();
            Arc::new(Compiler::new(&root).shape(&root))
        };
        Arc::clone(known.entry(TypeId::of::<T>()).or_insert_with(compiled))
    }

    /// The shape itself, if this is only a reference to it.
    pub(crate) fn resolved(&self) -> &Self {
        match self {
            Self::Again(again) => again
                .shape
                .get()
                .expect("a shape is complete before it is used"),
            shape => shape,
        }
    }
}

impl Fields {
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    pub(crate) fn required(&self) -> impl Iterator<Item = &str> {
        self.0
            .iter()
            .filter(|(_, field)| field.is_required)
            .map(|(name, _)| name.as_str())
    }
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number => write!(f, "a number"),
            Self::Integer { low, high } => write!(f, "a whole number from {low} to {high}"),
            Self::Boolean => write!(f, "true or false"),
            Self::Text => write!(f, "a string"),
            Self::Choice(words) => write!(f, "{}", quoted_choice(words)),
            Self::List { item, length } => {
                write!(f, "an array of ")?;
                if let Some(length) = length {
                    write!(f, "{length} ")?;
                }
                match *item.resolved() {
                    Self::Number => write!(f, "numbers"),
                    Self::Integer { .. } => write!(f, "whole numbers"),
                    Self::Table(_) | Self::Tagged(_) => write!(f, "tables"),
                    _ => write!(f, "values"),
                }
            }
            Self::Again(_) => self.resolved().fmt(f),
            Self::Map(_) => write!(f, "a table"),
            Self::Tagged(_) => write!(f, "a table with `{TAG}`"),
            Self::Table(fields) => {
                let required: Vec<_> = fields.required().map(|name| format!("`{name}`")).collect();
                match required.as_slice() {
                    [] => write!(f, "a table"),
                    names => write!(f, "a table with {}", names.join(" and ")),
                }
            }
            Self::AnyOf(shapes) => {
                for (position, shape) in shapes.iter().enumerate() {
                    match position {
                        0 => {}
                        last if last + 1 == shapes.len() => write!(f, " or ")?,
                        _ => write!(f, ", ")?,
                    }
                    write!(f, "{shape}")?;
                }
                Ok(())
            }
        }
    }
}

/// `` `a`, `b`, `c` ``.
pub(crate) fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<_> = names.map(|name| format!("`{name}`")).collect();
    names.join(", ")
}

/// The fields of a table that has one of several forms: first those that differ between the forms, then those that all have.
pub(crate) struct Forms<'a>(pub(crate) &'a [&'a Fields]);

impl fmt::Display for Forms<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_shared = |name: &&str| self.0.iter().all(|form| form.0.contains_key(*name));
        let of_form = |form: &&Fields| {
            let (required, optional): (Vec<_>, Vec<_>) = form
                .0
                .iter()
                .filter(|(name, _)| !is_shared(&name.as_str()))
                .partition(|(_, field)| field.is_required);
            let names =
                |of: &[(&'_ String, &Field)]| listed(of.iter().map(|(name, _)| name.as_str()));
            match (required.as_slice(), optional.as_slice()) {
                (required, []) => names(required),
                (required, optional) => format!("{} (and {})", names(required), names(optional)),
            }
        };
        let forms: Vec<_> = self.0.iter().map(of_form).collect();
        write!(f, "either {}", forms.join("; or "))?;
        let shared = self.0.first().into_iter().flat_map(|form| form.names());
        let shared: Vec<_> = shared.filter(is_shared).collect();
        if !shared.is_empty() {
            write!(f, "; and with each {}", listed(shared.into_iter()))?;
        }
        Ok(())
    }
}

/// `"a", "b" or "c"`.
pub(crate) fn quoted_choice<S: AsRef<str>>(words: &[S]) -> String {
    let quoted: Vec<_> = words.iter().map(|w| format!("{:?}", w.as_ref())).collect();
    match quoted.as_slice() {
        [] => "nothing".to_owned(),
        [only] => only.clone(),
        [start @ .., last] => format!("{} or {last}", start.join(", ")),
    }
}

/// Reads the schema of our own types. An unknown form is a bug in this crate, which any test that reads a file of the type reveals, so it panics.
struct Compiler<'a> {
    root: &'a Json,
    /// The references that are being read, outermost first.
    open: RefCell<Vec<Again>>,
}

impl<'a> Compiler<'a> {
    fn new(root: &'a Json) -> Self {
        let open = RefCell::default();
        Self { root, open }
    }

    /// The shape of a reference such as `#/definitions/Index`.
    fn named(&self, reference: &str) -> Shape {
        let name = reference.trim_start_matches("#/definitions/").to_owned();
        let mut open = self.open.borrow().clone().into_iter();
        if let Some(again) = open.find(|again| again.name == name) {
            return Shape::Again(again.clone());
        }
        let Some(target) = self.root.pointer(reference.trim_start_matches('#')) else {
            panic!("the schema has no {reference}")
        };
        let shape = Arc::default();
        self.open.borrow_mut().push(Again { name, shape });
        let shape = self.shape(target);
        if let Some(again) = self.open.borrow_mut().pop()
            && Arc::strong_count(&again.shape) > 1
        {
            again.shape.get_or_init(|| shape.clone());
        }
        shape
    }

    fn shape(&self, schema: &Json) -> Shape {
        if let Some(reference) = schema["$ref"].as_str() {
            return self.named(reference);
        }
        if let Some([only]) = schema["allOf"].as_array().map(Vec::as_slice) {
            return self.shape(only);
        }
        if let Some(choices) = schema["oneOf"].as_array() {
            return self.one_of(choices);
        }
        if let Some(choices) = schema["anyOf"].as_array() {
            return self.any_of(choices);
        }
        self.plain(schema)
    }

    fn plain(&self, schema: &Json) -> Shape {
        match schema["type"].as_str() {
            Some("number") => Shape::Number,
            Some("integer") => Shape::Integer {
                low: schema["minimum"].as_f64().map_or(0, |low| low as i64),
                high: schema["maximum"]
                    .as_f64()
                    .map_or(i64::from(u32::MAX), |high| high as i64),
            },
            Some("boolean") => Shape::Boolean,
            Some("string") => match schema["enum"].as_array() {
                Some(words) => Shape::Choice(words.iter().map(word).collect()),
                None => Shape::Text,
            },
            Some("array") => Shape::List {
                item: Box::new(self.shape(&schema["items"])),
                length: exact_length(schema),
            },
            Some("object") => match &schema["additionalProperties"] {
                item @ Json::Object(_) => Shape::Map(Box::new(self.shape(item))),
                _ => Shape::Table(self.fields(schema)),
            },
            _ => panic!("a schema of a form unknown to the reader: {schema}"),
        }
    }

    fn one_of(&self, choices: &[Json]) -> Shape {
        if choices.iter().all(|choice| choice["const"].is_string()) {
            return Shape::Choice(
                choices
                    .iter()
                    .map(|choice| word(&choice["const"]))
                    .collect(),
            );
        }
        let variant = |choice: &Json| {
            let mut fields = self.fields(choice);
            fields.0.remove(TAG);
            (word(&choice["properties"][TAG]["const"]), fields)
        };
        Shape::Tagged(choices.iter().map(variant).collect())
    }

    fn any_of(&self, choices: &[Json]) -> Shape {
        let mut shapes = Vec::new();
        for choice in choices {
            match self.shape(choice) {
                Shape::AnyOf(inner) => shapes.extend(inner),
                shape => shapes.push(shape),
            }
        }
        Shape::AnyOf(shapes)
    }

    fn fields(&self, schema: &Json) -> Fields {
        let required = schema["required"].as_array();
        let is_required = |name: &str| required.is_some_and(|list| list.iter().any(|n| n == name));
        let properties = schema["properties"].as_object();
        Fields(
            properties
                .into_iter()
                .flatten()
                .map(|(name, schema)| {
                    let field = Field {
                        shape: self.shape_of_property(schema),
                        is_required: is_required(name),
                        meaning: schema["description"].as_str().map(str::to_owned),
                    };
                    (name.clone(), field)
                })
                .collect(),
        )
    }

    /// The schema of the tag itself is a constant, which is handled elsewhere.
    fn shape_of_property(&self, schema: &Json) -> Shape {
        if schema["const"].is_string() {
            Shape::Choice(vec![word(&schema["const"])])
        } else {
            self.shape(schema)
        }
    }
}

/// The length of arrays of fixed length. If it may vary, the checks report wrong lengths.
fn exact_length(schema: &Json) -> Option<usize> {
    let [least, most] = ["minItems", "maxItems"].map(|bound| schema[bound].as_u64());
    least
        .filter(|_| least == most)
        .map(|length| length as usize)
}

fn word(schema: &Json) -> String {
    schema.as_str().unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A thing of one of two kinds.
    #[derive(JsonSchema)]
    #[serde(tag = "type", rename_all = "snake_case")]
    #[expect(dead_code, reason = "only its schema is used")]
    enum Thing {
        Plain {
            size: f64,
        },
        Sum {
            of: Vec<Thing>,
            #[schemars(range(min = 1, max = 4))]
            count: Option<u32>,
        },
    }

    #[derive(JsonSchema)]
    #[expect(dead_code, reason = "only its schema is used")]
    struct File {
        thing: Thing,
        name: Option<String>,
    }

    #[test]
    fn a_schema_is_understood() {
        let shape = Shape::of::<File>();
        let Shape::Table(file) = &*shape else {
            panic!("a file is a table, not {shape}");
        };
        assert_eq!(file.required().collect::<Vec<_>>(), ["thing"]);
        let Shape::Tagged(things) = &file.0["thing"].shape else {
            panic!("a thing has a type");
        };
        assert_eq!(things["sum"].required().collect::<Vec<_>>(), ["of"]);
        let count = &things["sum"].0["count"];
        assert_eq!(count.shape, Shape::Integer { low: 1, high: 4 });
        // The things within a sum are things again.
        let Shape::List { item, .. } = &things["sum"].0["of"].shape else {
            panic!("a sum is a list");
        };
        assert_eq!(item.resolved(), &file.0["thing"].shape);
        assert!(Arc::ptr_eq(&shape, &Shape::of::<File>()));
    }
}
