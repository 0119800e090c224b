//! Spectral `OpenEXR` files, in the layout of Fichet, Pacanowski and Wilkie.
//!
//! Source: A. Fichet, R. Pacanowski and A. Wilkie, "An `OpenEXR` Layout for Spectral Images", Journal of
//! Computer Graphics Techniques 10 (3), 2021.
//!
//! | channel | type | content |
//! | --- | --- | --- |
//! | `S0.385,000000nm` … | float | mean radiance over the band with this center, W m⁻² sr⁻¹ nm⁻¹ |
//! | `R`, `G`, `B` | float | developed linear sRGB for viewers, not clipped |
//! | `pellicle.cieX`, `.cieY`, `.cieZ` | float | CIE 1931 XYZ of the pixel, cd/m² |
//! | `pellicle.samples` | uint | number of samples of the pixel |
//! | `pellicle.variance.385,000000nm` … | float | variance of the mean of `S0.…`, where asked for |
//! | `pellicle.light.key.385,000000nm` …, `.cieX`, `.cieY`, `.cieZ` | float | the same of the light group `key` alone |
//! | `key.R`, `key.G`, `key.B` | float | that developed, as a layer for viewers |
//!
//! | attribute | type | content |
//! | --- | --- | --- |
//! | `spectralLayoutVersion` | string | `1.0` |
//! | `emissiveUnits` | string | `W.m^-2.sr^-1.nm^-1` |
//! | `chromaticities` | | primaries and white of sRGB |
//! | `software` | string | name and version |
//! | `pellicle.lambdaMin`, `pellicle.lambdaMax` | double | ends of the band grid, nm |
//! | `pellicle.exposureEv` | double | the exposure that R, G and B were developed with |
//! | `pellicle.lightGroups` | string | names of the light groups, with spaces between them |
//! | `pellicle.light.key.lamp` | string | lamp of `key` where it is known: lines of wavelength in nm, a comma, and power at scale 1 |
//! | `pellicle.setting.…` | string | settings that the caller gave |
//!
//! Light groups have channels where there are several; the sum of their bands is `S0.…`. Lamps are told in any case.
//!
//! Our own channels stand in a layer of their own, so that neither an ordinary viewer nor a reader
//! of the layout takes them for color, depth or spectrum.
//!
//! Files of other origin are read too: wavelengths with any prefix of the SI or as frequencies, in any order, with a comma or a
//! dot; bands of different widths; half floats; several parts; units that are a scale away; reflectances (`T.550nm`) and bands
//! named by their ends (`400.00-410.00nm`). What reading had to change or assume stands in [`Metadata::notes`].
//!
//! The file is in scan lines, compressed without loss; see [`write`](write()) for what that costs.

mod attribute_order;
mod bands;
mod channels;
mod lights;
mod metadata;
mod read;
mod wavelength;
mod write;

pub use bands::BandLayoutError;
pub use metadata::{Metadata, software};
pub use read::{MAX_BYTES, ReadExrError, read, read_size, read_xyz};
pub(crate) use write::blocks_at_a_time;
pub use write::{BATCH_BYTES, WriteExrError, WriteOptions, write};
