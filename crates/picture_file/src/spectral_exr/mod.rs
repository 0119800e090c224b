//! Spectral `OpenEXR` files, in the layout of Fichet, Pacanowski and Wilkie.
//!
//! Source: A. Fichet, R. Pacanowski and A. Wilkie, "An `OpenEXR` Layout for Spectral Images", Journal of
//! Computer Graphics Techniques 10 (3), 2021.
//!
//! | channel | type | content |
//! | --- | --- | --- |
//! | `S0.385,000000nm` … | float | mean radiance over the band with this center, W m⁻² sr⁻¹ nm⁻¹ |
//! | `S1.385,000000nm` …, `S2.…`, `S3.…` | float | the other components of the Stokes vector, if the light is polarized |
//! | `R`, `G`, `B` | float | developed linear sRGB for viewers, not clipped |
//! | `pellicle.cieX`, `.cieY`, `.cieZ` | float | CIE 1931 XYZ of the pixel, cd/m² |
//! | `pellicle.S1.cieX`, `.cieY`, `.cieZ` … | float | XYZ of S1, S2 and S3 |
//! | `pellicle.samples` | uint | number of samples of the pixel |
//! | `pellicle.variance.385,000000nm` … | float | variance of the mean of `S0.…`, if requested |
//! | `pellicle.light.key.385,000000nm` …, `.cieX`, `.cieY`, `.cieZ` | float | radiance and XYZ of the light group `key` alone |
//! | `pellicle.light.key.S1.385,000000nm` …, `.S1.cieX` … | float | S1, S2 and S3 of the light group alone |
//! | `key.R`, `key.G`, `key.B` | float | developed color of the light group, as a layer for viewers |
//!
//! | attribute | type | content |
//! | --- | --- | --- |
//! | `spectralLayoutVersion` | string | `1.0` |
//! | `emissiveUnits` | string | `W.m^-2.sr^-1.nm^-1` |
//! | `polarisationHandedness` | string | `right`: S3 > 0 is right-handed, if the light is polarized |
//! | `chromaticities` | | primaries and white of sRGB |
//! | `software` | string | name and version |
//! | `pellicle.lambdaMin`, `pellicle.lambdaMax` | double | ends of the band grid, nm |
//! | `pellicle.exposureEv` | double | the exposure of R, G and B |
//! | `pellicle.lightGroups` | string | names of the light groups, separated by spaces |
//! | `pellicle.light.key.lamp` | string | lamp of `key`, if known: lines of wavelength in nm, a comma, and power at scale 1 |
//! | `pellicle.setting.…` | string | settings given by the caller |
//! | `pellicle.digest` | string | BLAKE3 of the pixels: of the y coordinate and the compressed bytes of every chunk, in order |
//!
//! Light groups have channels if there are several; the sum of their bands is `S0.…`. Lamps are written in any case.
//!
//! Our own channels are in a separate layer, so that neither an ordinary viewer nor a reader of the
//! layout takes them for color, depth or spectrum.
//!
//! A file whose pixels do not have its digest is damaged, and is refused by whatever reads all of it. A program that changes the pixels
//! must remove the attribute.
//!
//! Files of other programs are read too: wavelengths with any SI prefix or as frequencies, in any order, with a comma or a dot;
//! bands of different widths; half floats; several parts; units that differ by a scale; reflectances (`T.550nm`) and bands named
//! by their ends (`400.00-410.00nm`). [`Metadata::notes`] lists the changes and assumptions made on reading.
//!
//! The file has scan lines with lossless compression; see [`write`](write()) for its cost. [`write_rows`] writes and
//! [`RowReader`] reads an image in strips of rows.

mod attribute_order;
mod bands;
mod channels;
mod content;
mod frame;
mod lights;
mod metadata;
mod read;
mod wavelength;
mod write;

pub use crate::exr_file::{BATCH_BYTES, BandLayoutError, MAX_BYTES, ReadExrError};
pub use frame::Frame;
pub use metadata::{Metadata, software};
pub use read::{RowReader, read, read_size, read_xyz};
pub use write::{WriteExrError, WriteOptions, WriteRowsError, write, write_rows};
