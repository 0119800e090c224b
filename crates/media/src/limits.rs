//! The allowed ranges of the numbers of media, far wider than any material needs.

use document::Range;

/// Real part of an index. The smallest measured value is silver's 0.03.
pub const INDEX_N: Range = Range::new(0.001, 1000.0, "");
/// Imaginary part of an index.
pub const INDEX_K: Range = Range::new(0.0, 1000.0, "");
/// A fraction, such as that of a mixture's volume that one medium fills.
pub const FRACTION: Range = Range::new(0.0, 1.0, "");
/// A coefficient of a dispersion formula.
pub const COEFFICIENT: Range = Range::new(-1e12, 1e12, "");
/// The maximum number of terms of a dispersion formula.
pub const MAX_FORMULA_TERMS: usize = 16;
/// A reflectance.
pub const REFLECTANCE: Range = Range::new(0.0, 1.0, "");
/// A reflectance at normal incidence that is converted to an index: 0.996 gives the index 998.
pub const NORMAL_REFLECTANCE: Range = Range::new(0.0, 0.996, "");
/// Wavelengths of a table.
pub const TABLE_NM: Range = Range::new(1.0, 1e6, " nm");
/// The maximum number of points of a table.
pub const MAX_TABLE_POINTS: usize = 100_000;
