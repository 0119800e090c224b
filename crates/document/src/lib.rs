//! Text files that people write: read with positions, and with all mistakes reported at once.
//!
//! A type that implements [`Document`] is read from TOML by [`SourceFile`]. The text is first parsed to a tree in which every value has
//! its source position. The tree is compared with the type's JSON Schema, which finds all unknown, missing and mistyped fields at once.
//! Broken values are replaced by stand-ins and remembered, so that [`Checks`] can still examine the rest. [`SourceFile::finish`] reports
//! the [`Problems`] of both, each with its line.
//!
//! ```text
//! text -> Tree -> reader, against the schema -> T and findings
//!                                               T -> Checks -> problems
//!                                                    SourceFile::finish -> value, or Problems
//! ```

mod checks;
mod document;
mod field_path;
mod folder;
mod problem;
mod range;
mod reader;
mod schema;
mod shape;
mod snippet;
mod source_file;
pub mod suggestion;
pub mod text_file;
mod tree;
pub mod wording;

pub use checks::Checks;
pub use document::Document;
pub use field_path::{FieldPath, Step};
pub use folder::{Folder, OutsideError};
pub use problem::{Location, Problem, ProblemKind, Problems};
pub use range::{Range, Shown};
pub use schema::schema_of;
pub use snippet::Snippet;
pub use source_file::SourceFile;
