//! The roughness of a surface.

use crate::features::Feature;
use crate::layout;
use crate::pack::tables::Tables;
use crate::pack::vec3;
use glam::DVec3;
use scene::{Distribution, FacetTable, Grain, Microsurface};

/// Passes of sampling a facet: two slopes.
pub(super) const SHADING: u64 = 2 * (1 + layout::SLOPE_STEPS as u64);

/// Packs facets and returns their row and the features that they need; `transmittance_scale` is the table of the transmittance
/// scale of a brushed coat.
pub(super) fn pack(
    tables: &mut Tables,
    microsurface: &Microsurface,
    transmittance_scale: Option<&FacetTable>,
) -> (u32, Vec<Feature>) {
    let (grain_kind, grain) = match microsurface.grain {
        Grain::None => (layout::GRAIN_NONE, DVec3::ZERO),
        Grain::Along(direction) => (layout::GRAIN_ALONG, direction),
        Grain::Around(axis) => (layout::GRAIN_AROUND, axis),
    };
    let (distribution, feature) = match microsurface.distribution {
        Distribution::Beckmann => (layout::FACETS_BECKMANN, Feature::Beckmann),
        Distribution::Ggx => (layout::FACETS_GGX, Feature::Ggx),
    };
    let mut features = vec![feature];
    if microsurface.is_brushed() {
        features.push(Feature::Grain);
    }
    let facets = layout::Facets {
        grain: vec3(grain),
        grain_kind,
        alpha: microsurface.roughness.map(|alpha| alpha as f32),
        distribution,
        first_energy: tables.look_up(microsurface.energy.table().values()),
        mean_energy: microsurface.energy.mean() as f32,
        first_transmittance_scale: transmittance_scale
            .map_or(0, |table| tables.look_up(table.values())),
        ..Default::default()
    };
    (tables.push(&facets), features)
}
