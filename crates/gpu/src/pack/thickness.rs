//! Packing of thicknesses: a layer whose thickness varies has a sequence of fields in postfix order.

use super::tables::Tables;
use super::{id, vec3};
use crate::features::Feature;
use crate::layout::{self, Field, NONE};
use glam::DVec3;
use scene::limits::OCTAVES;
use scene::{Coordinate, Layer, Picture, Profile, Swirls, Thickness};

/// Maximum number of passes of `gradient_noise` for each of the flow's steps and the streaks' octaves.
const SWIRLS: u64 =
    (1 + layout::LATTICE_CORNERS as u64) * (layout::WARP_STEPS as u64 + OCTAVES.high as u64);

/// Adds layers to the records, one after the other, and returns the row of the first.
pub(super) fn layers(tables: &mut Tables, layers: &[Layer]) -> u32 {
    let packed: Vec<_> = layers.iter().map(|of| tables.layer(of)).collect();
    let rows = packed.iter().map(|layer| tables.push(layer));
    rows.min().unwrap_or(NONE)
}

/// Returns the number of layers whose thickness varies over the surface.
pub(super) fn varying(layers: &[Layer]) -> u32 {
    let varies = |layer: &&Layer| !matches!(layer.thickness, Thickness::Constant { .. });
    layers.iter().filter(varies).count() as u32
}

/// Returns the passes of computing the thicknesses of all layers.
pub(super) fn passes(layers: &[Layer]) -> u64 {
    let of_part = |part: &Thickness| match part {
        Thickness::Swirls(_) => 1 + SWIRLS,
        _ => 1,
    };
    let of_layer = |layer: &Layer| 1 + layer.thickness.parts().map(of_part).sum::<u64>();
    1 + layers.iter().map(of_layer).sum::<u64>()
}

/// Returns the features that the thicknesses of layers need.
pub(super) fn features(layers: &[Layer]) -> Vec<Feature> {
    let parts = layers.iter().flat_map(|layer| layer.thickness.parts());
    parts.flat_map(features_of_part).copied().collect()
}

fn features_of_part(part: &Thickness) -> &'static [Feature] {
    match part {
        Thickness::Constant { .. } => &[],
        Thickness::Polar { .. } => &[Feature::Fields, Feature::PolarFields],
        Thickness::Linear { .. } => &[Feature::Fields, Feature::LineFields],
        Thickness::Steps { .. } => &[Feature::Fields, Feature::SampledFields, Feature::LineFields],
        Thickness::Profile(Profile { coordinate, .. }) => match coordinate {
            Coordinate::Polar { .. } => &[
                Feature::Fields,
                Feature::SampledFields,
                Feature::PolarFields,
            ],
            Coordinate::Line { .. } => {
                &[Feature::Fields, Feature::SampledFields, Feature::LineFields]
            }
        },
        Thickness::Swirls(_) => &[Feature::Fields, Feature::Swirls],
        Thickness::Picture(_) => &[Feature::Fields, Feature::Pictures],
        Thickness::Sum(_) | Thickness::Product(_) => &[Feature::Fields, Feature::CombinedFields],
    }
}

impl Tables {
    /// Packs a layer, with the fields of its thickness.
    fn layer(&mut self, layer: &Layer) -> layout::Layer {
        let mut fields = Vec::new();
        let mut thickness_nm = 0.0;
        match layer.thickness {
            Thickness::Constant { nm } => thickness_nm = nm as f32,
            ref varying => self.fields(varying, &mut fields),
        }
        let rows: Vec<_> = fields.iter().map(|field| self.push(field)).collect();
        layout::Layer {
            spectrum: id(layer.n),
            thickness_nm,
            first_field: rows.first().copied().unwrap_or(NONE),
            field_count: fields.len() as u32,
        }
    }

    fn fields(&mut self, thickness: &Thickness, fields: &mut Vec<Field>) {
        let field = match *thickness {
            Thickness::Constant { nm } => Field {
                kind: layout::FIELD_CONSTANT,
                base: nm as f32,
                ..Default::default()
            },
            Thickness::Polar {
                axis,
                pole_nm,
                equator_nm,
            } => Field {
                kind: layout::FIELD_LINEAR,
                base: pole_nm as f32,
                swing: (2.0 * (equator_nm - pole_nm)) as f32,
                ..running_along(&Coordinate::Polar { axis })
            },
            Thickness::Linear {
                start,
                end,
                start_nm,
                end_nm,
            } => Field {
                kind: layout::FIELD_LINEAR,
                base: start_nm as f32,
                swing: (end_nm - start_nm) as f32,
                ..running_along(&Coordinate::Line { start, end })
            },
            Thickness::Steps { start, end, ref nm } => self.steps((start, end), nm),
            Thickness::Profile(ref profile) => self.profile(profile),
            Thickness::Swirls(ref swirls) => pack_swirls(swirls),
            Thickness::Picture(ref picture) => self.picture(picture),
            Thickness::Sum(ref parts) => return self.combine(parts, layout::FIELD_SUM, fields),
            Thickness::Product(ref parts) => {
                return self.combine(parts, layout::FIELD_PRODUCT, fields);
            }
        };
        fields.push(field);
    }

    /// Each part but the first is combined with the value before it, so that few values wait at a time.
    fn combine(&mut self, parts: &[Thickness], kind: u32, fields: &mut Vec<Field>) {
        for (index, part) in parts.iter().enumerate() {
            self.fields(part, fields);
            if index > 0 {
                fields.push(Field {
                    kind,
                    ..Default::default()
                });
            }
        }
    }

    fn steps(&mut self, (start, end): (DVec3, DVec3), nm: &[f64]) -> Field {
        Field {
            kind: layout::FIELD_STEPS,
            first_number: self.look_up(nm),
            sample_count: nm.len() as u32,
            ..running_along(&Coordinate::Line { start, end })
        }
    }

    fn profile(&mut self, profile: &Profile) -> Field {
        Field {
            kind: layout::FIELD_PROFILE,
            first_number: self.look_up(&profile.squares_nm2),
            sample_count: profile.squares_nm2.len() as u32,
            black_nm: profile.black.map_or(0.0, |black| black.nm as f32),
            black_below_nm: profile.black.map_or(0.0, |black| black.below_nm as f32),
            most_nm: profile.most_nm as f32,
            ..running_along(&profile.coordinate)
        }
    }

    fn picture(&mut self, picture: &Picture) -> Field {
        let file = &picture.file;
        let known = self
            .thickness_pictures
            .iter()
            .find(|(known, _)| known == file);
        let first_number = known.map_or(self.numbers.len() as u32, |&(_, first)| first);
        if known.is_none() {
            self.numbers.extend_from_slice(&file.values);
            self.thickness_pictures
                .push((std::sync::Arc::clone(file), first_number));
        }
        Field {
            kind: layout::FIELD_PICTURE,
            first_number,
            columns: file.width,
            rows: file.height,
            base: picture.black_nm as f32,
            swing: (picture.white_nm - picture.black_nm) as f32,
            size: picture.size.unwrap_or_default().map(|side| side as f32),
            ..Default::default()
        }
    }
}

fn running_along(coordinate: &Coordinate) -> Field {
    match *coordinate {
        Coordinate::Polar { axis } => Field {
            runs_along: layout::ALONG_POLAR_ANGLE,
            origin: vec3(axis),
            ..Default::default()
        },
        Coordinate::Line { start, end } => {
            let along = end - start;
            Field {
                runs_along: layout::ALONG_LINE,
                origin: vec3(start),
                along: vec3(along / along.length_squared()),
                ..Default::default()
            }
        }
    }
}

fn pack_swirls(swirls: &Swirls) -> Field {
    Field {
        kind: layout::FIELD_SWIRLS,
        base: swirls.mean as f32,
        swing: swirls.amplitude as f32,
        cells_per_unit: swirls.cells_per_unit as f32,
        warp: swirls.warp as f32,
        phase: swirls.phase as f32,
        cells: swirls.cells,
        seed: swirls.seed,
        octaves: swirls.octaves,
        ..Default::default()
    }
}
