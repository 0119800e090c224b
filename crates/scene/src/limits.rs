//! Limits that a renderer relies on: of thicknesses, and of how many there are of something.

use document::Range;

/// Thickness of a film: 100 µm is far beyond the last visible fringe.
pub const THICKNESS_NM: Range = Range::new(0.0, 100_000.0, " nm");
/// The maximum nesting depth of sums and products in a thickness.
pub const MAX_FIELD_DEPTH: usize = 4;
/// Number of octaves of swirls; each is half as large and half as strong as the one before.
pub const OCTAVES: Range = Range::new(1.0, 6.0, "");
/// The maximum number of layers of a film or coating.
pub const MAX_LAYERS: usize = 64;
/// The maximum number of materials.
pub const MAX_MATERIALS: usize = 4096;
/// The maximum number of light groups: with 1024 bands, their values for a row of 512 pixels fit in the 128 MiB that any device can bind.
pub const MAX_LIGHT_GROUPS: usize = 32;
