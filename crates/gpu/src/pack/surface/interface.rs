//! Conductors, bare or coated, smooth or rough.

use super::{PackedSurface, Passes};
use super::{facets, film};
use crate::features::Feature;
use crate::layout::{self, NONE};
use crate::pack::tables::Tables;
use crate::pack::thickness;
use scene::{Layer, Microsurface};

/// Passes over the cosines of a vertex.
const COSINES: u64 = layout::COATING_COSINES as u64;

pub(super) fn pack(
    tables: &mut Tables,
    spectrum: u32,
    layers: &[Layer],
    microsurface: Option<&Microsurface>,
) -> PackedSurface {
    let mut features = thickness::features(layers);
    features.extend([Feature::Bsdfs, Feature::Interfaces]);
    let mut facets_row = NONE;
    let mut passes = Passes {
        shading: thickness::passes(layers),
        spectrum: 1 + COSINES * (1 + film::LAYER * layers.len() as u64),
        crossing: 0,
    };
    match microsurface {
        None => features.extend([Feature::Mirrors, Feature::Specular]),
        Some(microsurface) => {
            let (row, needed) = facets::pack(tables, microsurface, None);
            facets_row = row;
            features.extend(needed);
            features.extend([Feature::RoughConductors, Feature::Scattering]);
            passes.shading += facets::SHADING;
        }
    }
    if !layers.is_empty() {
        features.push(Feature::Coatings);
    }
    let boundary = layout::Interface {
        spectrum,
        first_layer: thickness::layers(tables, layers),
        layer_count: layers.len() as u32,
        varying_layers: thickness::varying(layers),
    };
    PackedSurface {
        surface: layout::SURFACE_INTERFACE,
        record: tables.push(&boundary),
        facets: facets_row,
        features,
        passes,
    }
}
