//! The model of Cook and Torrance.

use super::{PackedSurface, Passes};
use crate::features::Feature;
use crate::layout::{self, NONE};
use crate::pack::id;
use crate::pack::tables::Tables;
use scene::{Cook1981, CookDistribution};

pub(super) fn pack(tables: &mut Tables, cook: &Cook1981) -> PackedSurface {
    let slopes = cook.facets.iter();
    let numbers: Vec<_> = slopes.flat_map(|f| [f.slope, f.weight, f.part]).collect();
    let mut features = vec![Feature::Cook, Feature::Bsdfs, Feature::Scattering];
    let mut packed = layout::Cook {
        spectrum: id(cook.n),
        distribution: match cook.distribution {
            CookDistribution::Gaussian => layout::COOK_GAUSSIAN,
            CookDistribution::Beckmann => layout::COOK_BECKMANN,
        },
        first_slope: tables.look_up(&numbers),
        slope_count: cook.facets.len() as u32,
        ..Default::default()
    };
    if let Some(diffuse) = &cook.diffuse {
        packed.base = id(diffuse.reflectance);
        packed.base_fraction = diffuse.fraction as f32;
        packed.base_probability = diffuse.probability as f32;
        features.push(Feature::Bases);
    }
    PackedSurface {
        surface: layout::SURFACE_COOK,
        record: tables.push(&packed),
        facets: NONE,
        features,
        // The value for the emitter sample and for the path, and the sample.
        passes: Passes {
            shading: 3 * (1 + cook.facets.len() as u64),
            ..Default::default()
        },
    }
}
