//! Reading TOML: from text to a tree with source positions, and from there to a description.
//!
//! The tree is compared with the file format's [`Shape`], which is derived from the JSON Schema and so from the types of
//! [`description`](crate::description). This finds all unknown, missing and mistyped fields at once and leaves a tree that is certain to
//! fit the types; broken values are replaced by stand-ins, and remembered, so that the rest can still be checked.

mod advice;
mod reader;
mod shape;
mod source_file;
mod tree;

use reader::{Findings, read};
pub use source_file::SourceFile;
use tree::{Tree, TreeError};
