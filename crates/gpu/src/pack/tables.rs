//! The lists that a scene's records and numbers are put into.

use super::texels::Pictures;
use crate::layout::{self, Record};
use scene::PictureFile;
use std::sync::Arc;

/// The lists, while they are being filled.
#[derive(Debug, Default)]
pub(super) struct Tables {
    /// Materials first, then their parts.
    pub(super) records: Vec<[u32; 4]>,
    /// Numbers for lookups.
    pub(super) numbers: Vec<f32>,
    /// Pictures with four numbers per texel.
    pub(super) pictures: Pictures,
    /// Pictures of thicknesses that are already among the numbers, and where.
    pub(super) thickness_pictures: Vec<(Arc<PictureFile>, u32)>,
}

impl Tables {
    /// Returns empty lists with room for `count` materials.
    pub(super) fn with_materials(count: usize) -> Self {
        let mut tables = Self::default();
        for _ in 0..count {
            tables.push(&layout::Material::default());
        }
        tables
    }

    /// Adds a record, and returns its row.
    pub(super) fn push<R: Record>(&mut self, record: &R) -> u32 {
        let row = self.records.len() as u32;
        self.records
            .extend_from_slice(bytemuck::cast_slice(std::slice::from_ref(record)));
        row
    }

    /// Stores a material at its index.
    pub(super) fn set_material(&mut self, number: usize, material: &layout::Material) {
        let first = number * layout::Material::ROWS as usize;
        let rows: &[[u32; 4]] = bytemuck::cast_slice(std::slice::from_ref(material));
        self.records[first..first + rows.len()].copy_from_slice(rows);
    }

    /// Adds numbers, and returns the index of the first.
    pub(super) fn look_up(&mut self, numbers: &[f64]) -> u32 {
        let first = self.numbers.len() as u32;
        self.numbers.extend(numbers.iter().map(|&x| x as f32));
        first
    }
}
