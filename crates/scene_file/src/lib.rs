//! From a scene file to a validated [`Scene`](scene::Scene).
//!
//! ```text
//! scenes/soap_bubble.toml
//!   -> SceneFile::read      TOML, compared with the schema        mistakes are kept for later
//!   -> SceneFile.description    changed by the command line
//!   -> SceneFile::validate  numbers, names and tables checked     Problems: all of them, each with its line
//!   -> scene::Scene
//! ```
//!
//! A program that fills in a [`Description`](description::Description) itself calls [`validate()`].

pub mod description;
mod drainage;
mod file;
mod growth;
pub mod limits;
mod validate;

pub use description::schema;
/// Types of the interface that come from the reader of documents.
pub use document::{FieldPath, Folder, Location, Problem, ProblemKind, Problems, Step};
pub use file::{SceneFile, load, validate};
