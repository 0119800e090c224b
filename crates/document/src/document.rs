//! What a type must have to be read from TOML files.

use crate::FieldPath;
use schemars::JsonSchema;
use serde::de::DeserializeOwned;

/// A type that TOML files are read as.
pub trait Document: DeserializeOwned + JsonSchema + 'static {
    /// What such a file must contain, for the error about an empty one: `"a scene needs at least a [camera]"`.
    const NEEDS: &'static str;
    /// Fields and words that were renamed: the old and the new name.
    const RENAMED: &'static [(&'static str, &'static str)] = &[];

    /// What to write instead of an unknown `type`, if it is a word from elsewhere.
    fn advice_on_type(_field: &FieldPath, _word: &str) -> Option<&'static str> {
        None
    }

    /// What to write instead of an unknown field, if it is a word from elsewhere.
    fn advice_on_field(_field: &FieldPath, _name: &str) -> Option<&'static str> {
        None
    }
}
