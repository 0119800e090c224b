//! The wavelengths of a path.

use crate::bands::{At, Bands, Spectrum, Tables};
use optics::wide::{Lanes, Real};
use pulp::{Arch, Simd, WithSimd};

/// The wavelengths of a path in its bands, and the tables of spectra.
pub(crate) struct Wavelengths<'a> {
    pub(super) arch: Arch,
    pub(super) tables: &'a Tables,
    /// Position in the bands, in [0, 1).
    offset: f64,
    place: (usize, f64),
    /// 1/λ, where it has been needed.
    inverse: Spectrum,
    are_known: bool,
}

impl<'a> Wavelengths<'a> {
    pub(super) fn new(arch: Arch, tables: &'a Tables) -> Self {
        Self {
            arch,
            tables,
            offset: 0.0,
            place: (0, 0.0),
            inverse: Spectrum::zero(tables.chunks()),
            are_known: false,
        }
    }

    /// Begins a path.
    pub(super) fn begin(&mut self, offset: f64) {
        self.offset = offset;
        self.place = self.tables.place(offset);
        self.are_known = false;
    }

    /// Returns the position of the wavelengths in their bands, in [0, 1).
    pub(super) fn offset(&self) -> f64 {
        self.offset
    }

    /// Computes 1/λ, unless that is done.
    pub(super) fn know(&mut self) {
        if !self.are_known {
            self.arch.dispatch(Know(self));
            self.are_known = true;
        }
    }

    #[inline(always)]
    pub(super) fn bands<S: Simd>(&self, simd: S) -> Bands<'_, S> {
        Bands::new(simd, self.tables, self.place, &self.inverse)
    }
}

struct Know<'b, 'a>(&'b mut Wavelengths<'a>);

impl WithSimd for Know<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(wavelengths) = self;
        let grid = wavelengths.tables.grid();
        let [offset, width, first_nm] = [wavelengths.offset, grid.width_nm(), grid.min_nm()]
            .map(|number| Lanes::splat(simd, number));
        for chunk in 0..wavelengths.inverse.0.len() {
            for at in At::lanes::<S>(chunk) {
                let nm = (at.band(simd) + offset).mul_add(width, first_nm);
                at.store(nm.recip(), &mut wavelengths.inverse.0);
            }
        }
    }
}
