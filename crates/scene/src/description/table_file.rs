//! Columns of tables in files, as written in a scene file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A column of a table in a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum TableColumn {
    /// Its position; the first column of the file is 1.
    Number(#[schemars(range(min = 1))] u32),
    /// Its name in the header, or the id or name of a sample.
    Name(String),
}

/// The columns of an index in a table of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum IndexColumns {
    /// The column of n; k is 0.
    N(TableColumn),
    /// The columns of n and k.
    Both([TableColumn; 2]),
}
