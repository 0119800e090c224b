//! Free films.

use super::{PackedSurface, Passes};
use crate::features::Feature;
use crate::layout::{self, NONE};
use crate::pack::tables::Tables;
use crate::pack::thickness;
use scene::{Estimate, Interference, Layer, PathDifference};

/// Passes for a layer of a stack: its own, and those of the series for small thicknesses.
pub(super) const LAYER: u64 = 2 + layout::EXPONENTIAL_TERMS as u64;

/// Packs a film; `is_clear` for a single non-absorbing layer with n ≥ 1.
pub(super) fn pack(
    tables: &mut Tables,
    (layers, is_clear): (&[Layer], bool),
    interference: Interference,
    estimate: &Estimate,
) -> PackedSurface {
    let (factor, feature) = match interference {
        Interference::TwoBeam(PathDifference::Optical) => {
            (layout::FACTOR_TWO_BEAM, Some(Feature::TwoBeamFilms))
        }
        Interference::TwoBeam(PathDifference::AsPrinted) => (
            layout::FACTOR_TWO_BEAM_AS_PRINTED,
            Some(Feature::TwoBeamFilms),
        ),
        Interference::Exact if layers.len() > 1 => (layout::FACTOR_STACK, Some(Feature::Stacks)),
        Interference::Exact if is_clear => (layout::FACTOR_FILM, None),
        Interference::Exact => (layout::FACTOR_LOSSY_FILM, Some(Feature::LossyFilms)),
    };
    let mut features = thickness::features(layers);
    features.push(Feature::Films);
    features.extend(feature);
    let stacked = match factor {
        layout::FACTOR_STACK => 1 + LAYER * layers.len() as u64,
        _ => 0,
    };
    let film = layout::Film {
        factor,
        first_layer: thickness::layers(tables, layers),
        layer_count: layers.len() as u32,
        varying_layers: thickness::varying(layers),
        first_reflected: tables.look_up(&estimate.reflected),
        ..Default::default()
    };
    PackedSurface {
        surface: layout::SURFACE_FILM,
        record: tables.push(&film),
        facets: NONE,
        features,
        passes: Passes {
            shading: thickness::passes(layers),
            spectrum: stacked,
            crossing: stacked,
        },
    }
}
