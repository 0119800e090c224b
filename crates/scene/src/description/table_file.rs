//! What is said of tables in files.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A column of a table in a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum TableColumn {
    /// Its position; the first column of the file is 1.
    Number(#[schemars(range(min = 1))] u32),
    /// Its name in the head, or the id or name of a sample.
    Name(String),
}

/// The columns of an index in a table of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum IndexColumns {
    /// That of n; k is 0.
    N(TableColumn),
    /// Those of n and k.
    Both([TableColumn; 2]),
}
