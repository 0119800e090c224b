//! Lambertian surfaces, and the bases below coats.

use super::{PackedSurface, Passes};
use crate::features::Feature;
use crate::layout::{self, NONE};
use crate::pack::id;
use crate::pack::tables::Tables;
use scene::Pattern;

pub(super) fn pack(tables: &mut Tables, reflectance: &Pattern) -> PackedSurface {
    let (record, mut features) = pattern(tables, reflectance);
    features.extend([Feature::Bsdfs, Feature::Scattering]);
    PackedSurface {
        surface: layout::SURFACE_DIFFUSE,
        record,
        facets: NONE,
        features,
        passes: Passes::default(),
    }
}

/// Returns the row of a reflectance that may vary, and the features that it needs.
pub(super) fn pattern(tables: &mut Tables, reflectance: &Pattern) -> (u32, Vec<Feature>) {
    let plain = layout::Diffuse {
        checker_size: 1.0,
        picture: NONE,
        ..Default::default()
    };
    let (packed, features) = match *reflectance {
        Pattern::Uniform(spectrum) => {
            let (spectrum, odd_spectrum) = (id(spectrum), id(spectrum));
            let uniform = layout::Diffuse {
                spectrum,
                odd_spectrum,
                ..plain
            };
            (uniform, vec![])
        }
        Pattern::Checker { even, odd, size } => {
            let checker = layout::Diffuse {
                spectrum: id(even),
                odd_spectrum: id(odd),
                checker_size: size as f32,
                ..plain
            };
            (checker, vec![Feature::Checkers])
        }
        Pattern::Texture { ref texels, size } => {
            let size = size.unwrap_or_default().map(|side| side as f32);
            let picture = tables.pictures.add(texels, size);
            (
                layout::Diffuse { picture, ..plain },
                vec![Feature::Textures],
            )
        }
    };
    (tables.push(&packed), features)
}
