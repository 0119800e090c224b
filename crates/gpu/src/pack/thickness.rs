//! Thicknesses: a layer whose thickness varies has a run of fields in postfix order.

use super::vec3;
use crate::layout::{self, Field};
use glam::DVec3;
use scene::{Coordinate, Picture, PictureFile, Profile, Swirls, Thickness};
use std::sync::Arc;

/// The fields of all layers.
#[derive(Debug, Default)]
pub(super) struct Fields {
    pub(super) list: Vec<Field>,
    /// Numbers that they look up.
    pub(super) numbers: Vec<f32>,
    /// Pictures that are among the samples already, and where.
    pictures: Vec<(Arc<PictureFile>, u32)>,
}

impl Fields {
    /// A layer, with the fields that its thickness is made of.
    pub(super) fn layer(&mut self, spectrum: u32, thickness: &Thickness) -> layout::Layer {
        let first_field = self.list.len() as u32;
        let mut thickness_nm = 0.0;
        match *thickness {
            Thickness::Constant { nm } => thickness_nm = nm as f32,
            ref varying => self.push(varying),
        }
        layout::Layer {
            spectrum,
            thickness_nm,
            first_field,
            field_count: self.list.len() as u32 - first_field,
        }
    }

    fn push(&mut self, thickness: &Thickness) {
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
            Thickness::Sum(ref parts) => return self.combine(parts, layout::FIELD_SUM),
            Thickness::Product(ref parts) => return self.combine(parts, layout::FIELD_PRODUCT),
        };
        self.list.push(field);
    }

    /// Each part but the first is combined with what comes before it, so that few values wait at a time.
    fn combine(&mut self, parts: &[Thickness], kind: u32) {
        for (index, part) in parts.iter().enumerate() {
            self.push(part);
            if index > 0 {
                self.list.push(Field {
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
            base: profile.black.map_or(0.0, |black| black.nm as f32),
            threshold: profile.black.map_or(0.0, |black| black.below_nm as f32),
            swing: profile.most_nm as f32,
            ..running_along(&profile.coordinate)
        }
    }

    fn picture(&mut self, picture: &Picture) -> Field {
        let file = &picture.file;
        let known = self.pictures.iter().find(|(known, _)| known == file);
        let first_number = known.map_or(self.numbers.len() as u32, |&(_, first)| first);
        if known.is_none() {
            self.numbers.extend_from_slice(&file.values);
            self.pictures.push((Arc::clone(file), first_number));
        }
        Field {
            kind: layout::FIELD_PICTURE,
            first_number,
            sample_count: file.width,
            rows: file.height,
            base: picture.black_nm as f32,
            swing: (picture.white_nm - picture.black_nm) as f32,
            size: picture.size.unwrap_or_default().map(|side| side as f32),
            ..Default::default()
        }
    }

    /// Adds numbers to the tables, and says where they begin.
    pub(super) fn look_up(&mut self, numbers: &[f64]) -> u32 {
        let first = self.numbers.len() as u32;
        self.numbers.extend(numbers.iter().map(|&x| x as f32));
        first
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
        threshold: swirls.cells_per_unit as f32,
        warp: swirls.warp as f32,
        phase: swirls.phase as f32,
        cells: swirls.cells,
        seed: swirls.seed,
        sample_count: swirls.octaves,
        ..Default::default()
    }
}
