//! A file as TOML: from text to a tree with places, and from there to a description.
//!
//! The tree is compared with the file format's [`Shape`], which is made from the JSON Schema and so from the
//! types of [`description`](crate::description). That finds every unknown, missing or mistyped field at once and
//! leaves a tree that is certain to fit the types; broken values are filled in, and remembered, so that
//! the rest can still be checked.

mod advice;
mod reader;
mod shape;
mod source_file;
mod tree;

use reader::{Findings, read};
pub use source_file::SourceFile;
use tree::{Tree, TreeError};
