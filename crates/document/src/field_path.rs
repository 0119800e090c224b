//! The position of a value in a description.

use std::fmt;

/// The path from the root of a description to one of its values, shown as `objects[2].radius`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FieldPath(Vec<Step>);

/// One step of a [`FieldPath`].
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Step {
    /// Into the field of a table.
    Key(String),
    /// Into an element of an array, counted from 0.
    Index(usize),
}

impl FieldPath {
    /// The description itself.
    pub fn root() -> Self {
        Self::default()
    }

    /// The path to the field `key` of this table.
    #[must_use]
    pub fn key(&self, key: &str) -> Self {
        self.then(Step::Key(key.to_owned()))
    }

    /// The path to element `index` of this array.
    #[must_use]
    pub fn index(&self, index: usize) -> Self {
        self.then(Step::Index(index))
    }

    /// The path to what `inner` names relative to this value.
    #[must_use]
    pub fn join(&self, inner: &Self) -> Self {
        Self(self.0.iter().chain(&inner.0).cloned().collect())
    }

    /// Whether this is the description itself.
    pub fn is_root(&self) -> bool {
        self.0.is_empty()
    }

    /// The steps from the root.
    pub fn steps(&self) -> &[Step] {
        &self.0
    }

    /// This value, the table or array that contains it, and so on up to the description itself.
    pub(crate) fn and_around(&self) -> impl Iterator<Item = Self> + '_ {
        (0..=self.0.len())
            .rev()
            .map(|length| Self(self.0[..length].to_vec()))
    }

    fn then(&self, step: Step) -> Self {
        let mut steps = self.0.clone();
        steps.push(step);
        Self(steps)
    }
}

impl fmt::Display for FieldPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, step) in self.0.iter().enumerate() {
            match step {
                Step::Index(index) => write!(f, "[{index}]")?,
                Step::Key(key) => {
                    if position > 0 {
                        write!(f, ".")?;
                    }
                    write_key(f, key)?;
                }
            }
        }
        Ok(())
    }
}

/// Writes a key as in TOML: bare if possible.
fn write_key(f: &mut fmt::Formatter<'_>, key: &str) -> fmt::Result {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !key.is_empty() && key.chars().all(is_bare) {
        write!(f, "{key}")
    } else {
        write!(f, "{key:?}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_shown_as_a_user_would_write_it() {
        let radius = FieldPath::root().key("objects").index(2).key("radius");
        assert_eq!(radius.to_string(), "objects[2].radius");
        let quoted = FieldPath::root().key("materials").key("my gold");
        assert_eq!(quoted.to_string(), "materials.\"my gold\"");
        let around: Vec<_> = radius.and_around().map(|part| part.to_string()).collect();
        assert_eq!(around, ["objects[2].radius", "objects[2]", "objects", ""]);
    }
}
