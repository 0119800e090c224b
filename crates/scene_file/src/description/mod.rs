//! A scene as written in a file.
//!
//! These types are the only description of the file format: both the TOML reader and the JSON Schema (`scenes/scene.schema.json`) are
//! derived from them. A program can also fill them in and pass the result to [`validate()`](crate::validate()). Nothing here is checked
//! beyond its type.

mod advice;
mod camera;
mod cook;
mod emission;
mod environment;
mod light;
mod material;
mod microsurface;
mod object;
mod polarization;
mod render;
mod thickness;

pub use camera::{Camera, Lens};
pub use cook::{
    ConductorModel, ConductorModelName, Cook1981, CookDistribution, CookNormalization, Slope,
};
pub use emission::{Emission, EmissionSpectrum, Strength};
pub use environment::Environment;
pub use light::Light;
pub use material::{DiffuseReflectance, FilmModel, Layer, Material};
/// Media and reflectances, which stacks have too.
pub use media::{
    Extrapolate, Index, IndexColumns, MixtureRule, Reflectance, SellmeierTerms, TableColumn,
};
pub use microsurface::{Brushed, Finish, Roughness};
pub use object::Object;
pub use polarization::{Polarization, Polarizer, Retarder};
pub use render::{LightGroups, Render};
/// Choices that a validated scene has as they are written.
pub use scene::{DirectLight, Distribution, Filter, PathDifference, Sampler, WavelengthSampling};
pub use thickness::{
    AnodizedMetal, Anodizing, Drainage, HeatTint, PictureChannel, Quantity, Steel, Steps, Swirls,
    Thickness,
};

use document::{Document, FieldPath, schema_of};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// A Pellicle scene.
///
/// Right-handed space with +Y up, lengths in scene units, angles in degrees, wavelengths and film
/// thicknesses in nanometers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Pellicle scene")]
pub struct Description {
    /// The camera.
    pub camera: Camera,
    /// How to render the scene.
    #[serde(default)]
    pub render: Render,
    /// The materials of the surfaces, by name.
    #[serde(default)]
    pub materials: BTreeMap<String, Material>,
    /// The objects.
    #[serde(default)]
    pub objects: Vec<Object>,
    /// Lights that are not objects.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lights: Vec<Light>,
    /// The environment; black when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub environment: Option<Environment>,
}

impl Document for Description {
    const NEEDS: &'static str = "a scene needs at least a [camera]";
    const RENAMED: &'static [(&'static str, &'static str)] = advice::RENAMED;

    fn advice_on_type(field: &FieldPath, word: &str) -> Option<&'static str> {
        advice::of_type(field, word)
    }

    fn advice_on_field(field: &FieldPath, name: &str) -> Option<&'static str> {
        advice::of_field(field, name)
    }
}

/// The JSON Schema of scene files, derived from the types of this module. It is committed as `scenes/scene.schema.json`; regenerate it
/// with `PELLICLE_BLESS=1 cargo test --release -p pellicle-scene-file schema`.
pub fn schema() -> Value {
    schema_of::<Description>()
}
