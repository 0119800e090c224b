//! From a scene file to a validated [`Scene`].
//!
//! [`Scene`] is what the renderers read. It cannot be built invalid: it comes from a
//! [`description`] (the types as written in a file, or filled in by a program), and every number
//! in it is finite and within its domain, every index within its list.
//!
//! Space: right-handed, lengths in scene units, +Y up by custom. Angles are radians here and
//! degrees in files. Wavelengths and film thicknesses are nanometres.

mod camera;
mod material;
mod object;
mod settings;
mod validated;

pub use camera::{Camera, Projection};
pub use material::{Emission, Material, Pattern, Thickness};
pub use object::{Object, Shape};
pub use settings::{RenderSettings, WavelengthSampling};
pub use validated::{Environment, MaterialId, Scene, SpectrumId};
