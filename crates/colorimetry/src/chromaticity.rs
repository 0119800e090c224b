//! Chromaticity: colour without its amount.

/// Chromaticity x, y of XYZ (CIE 015:2018, equation 7.5); not finite for black.
pub fn xy_of_xyz([x, y, z]: [f64; 3]) -> [f64; 2] {
    let sum = x + y + z;
    [x / sum, y / sum]
}

/// XYZ with Y = 1 of a chromaticity: (x/y, 1, (1 − x − y)/y).
pub fn xyz_of_xy([x, y]: [f64; 2]) -> [f64; 3] {
    [x / y, 1.0, (1.0 - x - y) / y]
}
