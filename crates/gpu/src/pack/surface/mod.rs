//! Materials: a header for each and, by its kind, the record of its surface, the features that the shader needs for it, and the
//! number of passes of its loops.

mod coated;
mod cook;
mod diffuse;
mod facets;
mod film;
mod interface;

use super::tables::Tables;
use super::{emission_ref, id, polarization_row};
use crate::features::Feature;
use crate::layout;
use scene::{Estimate, Material, Pattern, Scene};

/// A packed surface of a material.
#[derive(Debug)]
pub(super) struct PackedSurface {
    /// A `SURFACE_` tag.
    pub(super) surface: u32,
    /// The row of its record.
    pub(super) record: u32,
    /// The row of its facets, NONE where it is smooth.
    pub(super) facets: u32,
    /// The features that it needs.
    pub(super) features: Vec<Feature>,
    /// Number of passes of its loops.
    pub(super) passes: Passes,
}

/// Maximum numbers of passes of loops.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Passes {
    /// Passes where a path meets the surface.
    pub(super) shading: u64,
    /// Passes of its spectrum, for each group of four bands.
    pub(super) spectrum: u64,
    /// Passes of its spectrum where an emitter sample of another surface crosses it.
    pub(super) crossing: u64,
}

impl Passes {
    /// Returns the larger of each.
    pub(super) fn max(self, other: Self) -> Self {
        Self {
            shading: self.shading.max(other.shading),
            spectrum: self.spectrum.max(other.spectrum),
            crossing: self.crossing.max(other.crossing),
        }
    }
}

/// Adds a material to the records.
pub(super) fn pack(
    scene: &Scene,
    (number, material, estimate): (usize, &Material, &Estimate),
    tables: &mut Tables,
) -> PackedSurface {
    let mut packed = match material {
        Material::Diffuse { reflectance } => diffuse::pack(tables, reflectance),
        Material::Emitter { reflectance, .. } => match *reflectance {
            Some(spectrum) => diffuse::pack(tables, &Pattern::Uniform(spectrum)),
            None => black(),
        },
        Material::Interface {
            n,
            layers,
            microsurface,
            ..
        } => interface::pack(tables, id(*n), layers, microsurface.as_ref()),
        Material::CoatedBody(body) => coated::pack(tables, body),
        Material::Cook(of) => cook::pack(tables, of),
        Material::Film {
            layers,
            interference,
            transparent,
        } => {
            let is_clear = *transparent
                && matches!(layers.as_slice(), [only] if scene.spectrum(only.n).extent().0 >= 1.0);
            film::pack(tables, (layers, is_clear), *interference, estimate)
        }
    };
    let emission = match material {
        Material::Cook(of) => of.ambient,
        _ => material.emission(),
    };
    if emission.is_some() && packed.surface != layout::SURFACE_BLACK {
        packed.features.push(Feature::Glow);
    }
    let head = layout::Material {
        surface: packed.surface,
        record: packed.record,
        facets: packed.facets,
        albedo: estimate.albedo as f32,
        emission: emission.map_or(0, emission_ref),
        emission_scale: emission.map_or(0.0, |emission| emission.scale as f32),
        polarization: emission.map_or(layout::NONE, |emission| polarization_row(tables, emission)),
        ..Default::default()
    };
    tables.set_material(number, &head);
    packed
}

/// Returns a surface that reflects nothing.
fn black() -> PackedSurface {
    PackedSurface {
        surface: layout::SURFACE_BLACK,
        record: 0,
        facets: layout::NONE,
        features: Vec::new(),
        passes: Passes::default(),
    }
}
