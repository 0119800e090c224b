//! Diffuse bodies below clear coats.

use super::{PackedSurface, Passes};
use super::{diffuse, facets};
use crate::features::Feature;
use crate::layout::{self, NONE};
use crate::pack::id;
use crate::pack::tables::Tables;
use scene::CoatedBody;

pub(super) fn pack(tables: &mut Tables, body: &CoatedBody) -> PackedSurface {
    let (base, mut features) = diffuse::pattern(tables, &body.base);
    features.extend([Feature::Bsdfs, Feature::Bases, Feature::Scattering]);
    let mut facets_row = NONE;
    let mut passes = Passes::default();
    match &body.microsurface {
        None => features.extend([Feature::CoatedBodies, Feature::Specular]),
        Some(microsurface) => {
            let (row, needed) =
                facets::pack(tables, microsurface, body.transmittance_scale.as_ref());
            facets_row = row;
            features.extend(needed);
            features.push(Feature::RoughCoats);
            passes.shading = facets::SHADING;
        }
    }
    let coated = layout::Coated {
        base,
        spectrum: id(body.n),
        mean_reflectance: id(body.mean_reflectance),
        coat_reflectances: body.reflectances.map_or(0, id),
        coat_estimate: body.estimate.n as f32,
        base_estimate: body.estimate.base as f32,
        ..Default::default()
    };
    PackedSurface {
        surface: layout::SURFACE_COATED,
        record: tables.push(&coated),
        facets: facets_row,
        features,
        passes,
    }
}
