//! A validated scene: what a renderer needs to know.
//!
//! [`Scene`] is the input of both renderers. Every number in it is finite and within its domain, every index is within its list,
//! and nothing refers to a name or a file anymore. Scenes come from files, or from descriptions that a program fills in, by way of the
//! crate `scene_file`, which checks all of this.
//!
//! Space is right-handed, lengths are in scene units, and +Y is up by convention. Angles are in radians. Wavelengths and film thicknesses
//! are in nanometers.

mod camera;
mod coated_body;
mod cook;
mod emission;
mod environment;
mod ids;
mod light;
pub mod limits;
mod material;
mod microsurface;
mod notes;
mod object;
mod parts;
mod pattern;
mod rounding;
mod settings;
mod tables;
mod texels;
mod thickness;
mod trees;
mod validated;

pub use camera::{Camera, Lens, Projection};
pub use coated_body::{CoatEstimate, CoatedBody};
pub use cook::{Cook1981, CookDistribution, CookFacets, DiffuseTerm};
pub use emission::{Emission, EmittedPolarization};
pub use environment::{
    Environment, EnvironmentPart, EnvironmentPicture, EnvironmentShape, PictureSpectra,
};
pub use ids::{LightGroupId, MaterialId, SpectrumId};
pub use light::{EmitterKind, EmitterSource, Light, LightShape};
pub use material::{Interference, Layer, Material, PathDifference};
pub use microsurface::{Distribution, Grain, Microsurface};
pub use object::{Object, Shape};
pub use parts::SceneParts;
pub use pattern::Pattern;
pub use settings::{DirectLight, RenderSettings, Sampler, WavelengthSampling};
pub use tables::{
    DirectionTable, Energy, Estimate, FacetTable, Filter, PixelFilter, Sampled, facet_direction,
};
pub use texels::Texels;
pub use thickness::{BlackFilm, Coordinate, Picture, PictureFile, Profile, Swirls, Thickness};
pub use trees::{EmitterNode, EmitterTree, Hierarchy, Node, Sheet};
pub use validated::Scene;
