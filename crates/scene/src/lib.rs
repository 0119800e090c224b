//! From a scene file to a validated [`Scene`].
//!
//! [`Scene`] is the input of the renderers. It is always valid: it is built from a [`description`] (the types as written in a file, or
//! filled in by a program), every number in it is finite and within its domain, and every index is within its list.
//!
//! ```text
//! scenes/soap_bubble.toml
//!   -> SceneFile::read      TOML, compared with the schema        mistakes are kept for later
//!   -> SceneFile.description    changed by the command line
//!   -> SceneFile::validate  numbers, names and tables checked     Problems: all of them, each with its line
//!   -> Scene
//! ```
//!
//! A program that fills in a [`Description`](description::Description) itself calls [`Scene::new`].
//!
//! Space is right-handed, lengths are in scene units, and +Y is up by convention. Angles are in radians here and in degrees in files.
//! Wavelengths and film thicknesses are in nanometers.

mod camera;
mod coated_body;
mod cook;
pub mod description;
mod drainage;
mod environment;
pub mod file;
mod growth;
mod light;
pub mod limits;
mod material;
mod microsurface;
mod notes;
mod object;
mod prepared;
mod rounding;
mod settings;
mod texels;
mod thickness;
mod validate;
mod validated;

pub use camera::{Camera, Lens, Projection};
pub use coated_body::{CoatEstimate, CoatedBody};
pub use cook::{Cook1981, CookDistribution, CookFacets, DiffuseTerm};
pub use description::{Distribution, PathDifference, Sampler, schema};
/// Types of the interface that come from the reader of documents.
pub use document::{FieldPath, Folder, Location, Problem, ProblemKind, Problems, Step};
pub use environment::{
    Environment, EnvironmentPart, EnvironmentPicture, EnvironmentShape, PictureSpectra,
};
pub use file::SceneFile;
pub use light::{EmitterKind, EmitterSource, Light, LightShape};
pub use material::{Emission, Interference, Layer, Material, Pattern};
pub use microsurface::{Grain, Microsurface};
pub use object::{Object, Shape};
pub use prepared::{
    DirectionTable, EmitterNode, EmitterTree, Energy, Estimate, FacetTable, Hierarchy, Node,
    PixelFilter, Sheet,
};
pub use settings::{DirectLight, RenderSettings, WavelengthSampling};
pub use texels::Texels;
pub use thickness::{BlackFilm, Coordinate, Picture, PictureFile, Profile, Swirls, Thickness};
pub use validated::{LightGroupId, MaterialId, Scene, SpectrumId};
