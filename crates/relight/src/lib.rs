//! Colors of a spectral image under any lamp and for any observer.
//!
//! [`relight()`] changes the lamps of light groups without rendering again. [`BandWeights`] turns the bands of a pixel into XYZ, and
//! [`XyzImage`] holds the colors alone.

mod knots;
mod polarizer;
mod relight;
mod weights;
pub mod xyz;
mod xyz_image;

pub use polarizer::{NotPolarized, behind};
pub use relight::{Relight, RelightError, over, relight};
pub use weights::{BandWeights, DarkBand};
pub use xyz_image::XyzImage;
