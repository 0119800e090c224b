//! The light that a path has found.

use super::wavelengths::Wavelengths;
use crate::PreparedScene;
use crate::bands::Spectrum;
use crate::transport::Transport;
use pulp::Arch;

/// The light that a path has found, by light group.
pub(crate) struct Found<'b, 'a> {
    pub(super) wavelengths: &'b Wavelengths<'a>,
    /// Radiance.
    pub(super) radiance: &'b mut [Spectrum],
    /// S1, S2 and S3; empty where they are not asked for.
    pub(super) polarized: &'b mut [[Spectrum; 3]],
}

/// A transport that finds the spectrum of a path.
pub(crate) trait SpectralTransport<'a>: Transport {
    /// Returns a path without light.
    fn of_scene(arch: Arch, prepared: &'a PreparedScene<'a>) -> Self;
    /// Returns the light that the traced path has found.
    fn found(&mut self) -> Found<'_, 'a>;
}

impl Found<'_, '_> {
    /// Returns the position of the wavelengths in their bands, in [0, 1).
    pub(crate) fn offset(&self) -> f64 {
        self.wavelengths.offset()
    }

    /// Returns the radiance of each light group in the bands: `[light group][band]`.
    pub(crate) fn radiance(&self) -> impl Iterator<Item = &[f64]> {
        let bands = self.bands();
        self.radiance.iter().map(move |of| &of.values()[..bands])
    }

    fn bands(&self) -> usize {
        self.wavelengths.tables.bands()
    }

    /// Scales down a path that is brighter than `most` in a band.
    pub(crate) fn dim(&mut self, most: f64) {
        let of_band = |band: usize| self.radiance().map(|group| group[band]).sum::<f64>();
        let brightest = (0..self.bands()).map(of_band).fold(most, f64::max);
        let all = self.radiance.iter_mut();
        let all = all.chain(self.polarized.iter_mut().flatten());
        for value in all.flat_map(Spectrum::values_mut) {
            *value *= most / brightest;
        }
    }
}
