//! Chromaticity coordinates x, y and u′, v′, and mixtures of primaries that they define.

use crate::matrix::{Matrix3, inverse, of_columns, times};

/// Returns the chromaticity x, y of XYZ (CIE 015:2018, equation 7.5); not finite for black.
pub fn xy_of_xyz([x, y, z]: [f64; 3]) -> [f64; 2] {
    let sum = x + y + z;
    [x / sum, y / sum]
}

/// Returns XYZ with Y = 1 for a chromaticity: (x/y, 1, (1 − x − y)/y).
pub fn xyz_of_xy([x, y]: [f64; 2]) -> [f64; 3] {
    [x / y, 1.0, (1.0 - x - y) / y]
}

/// Returns u′, v′ of the CIE 1976 uniform chromaticity scale diagram, 4X/(X + 15Y + 3Z) and 9Y/(X + 15Y + 3Z) (CIE 015:2018,
/// equation 8.1); not finite for black.
pub fn uv_of_xyz([x, y, z]: [f64; 3]) -> [f64; 2] {
    let sum = x + 15.0 * y + 3.0 * z;
    [4.0 * x / sum, 9.0 * y / sum]
}

/// Converts a chromaticity x, y to u′, v′.
pub fn uv_of_xy([x, y]: [f64; 2]) -> [f64; 2] {
    uv_of_xyz([x, y, 1.0 - x - y])
}

/// Converts a chromaticity u′, v′ to x, y: 9u′/(6u′ − 16v′ + 12) and 4v′/(6u′ − 16v′ + 12).
pub fn xy_of_uv([u, v]: [f64; 2]) -> [f64; 2] {
    let sum = 6.0 * u - 16.0 * v + 12.0;
    [9.0 * u / sum, 4.0 * v / sum]
}

/// Returns M, the matrix from linear RGB to XYZ, from the chromaticities of the primaries and the white, with Y = 1 for the white (SMPTE RP 177:1993). If the points are not
/// primaries of that white, the numbers are not finite.
pub fn xyz_from_rgb_of(primaries: [[f64; 2]; 3], white: [f64; 2]) -> Matrix3 {
    let columns = of_columns(primaries.map(xyz_of_xy));
    mixed(&columns, times(&inverse(&columns), xyz_of_xy(white)))
}

/// Returns M: the columns times the amounts, scaled to Y = 1 for the white.
pub(crate) fn mixed(columns: &Matrix3, amounts: [f64; 3]) -> Matrix3 {
    let luminance: f64 = (0..3).map(|i| columns[1][i] * amounts[i]).sum();
    columns.map(|row| std::array::from_fn(|i| row[i] * amounts[i] / luminance))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// D65 has x = 0.31272, y = 0.32903 and u′ = 0.1978, v′ = 0.4683 (CIE 015:2018, table T.3).
    #[test]
    fn diagrams_lead_into_one_another() {
        let xyz = [95.04, 100.0, 108.88];
        let [u, v] = uv_of_xyz(xyz);
        assert!(
            (u - 0.1978).abs() < 0.5e-4 && (v - 0.4683).abs() < 0.5e-4,
            "{u} {v}"
        );
        for (found, expected) in xy_of_uv([u, v]).into_iter().zip(xy_of_xyz(xyz)) {
            assert!((found - expected).abs() < 1e-15);
        }
        for (found, expected) in uv_of_xy(xy_of_xyz(xyz)).into_iter().zip([u, v]) {
            assert!((found - expected).abs() < 1e-15);
        }
        for (found, expected) in xyz_of_xy(xy_of_xyz(xyz)).into_iter().zip(xyz) {
            assert!((found - expected / 100.0).abs() < 1e-14);
        }
    }
}
