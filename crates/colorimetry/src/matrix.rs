//! 3×3 matrices in row-major order.

/// A 3×3 matrix in row-major order.
pub type Matrix3 = [[f64; 3]; 3];

/// The identity matrix.
pub const IDENTITY: Matrix3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Returns the product m v.
pub fn times(m: &Matrix3, v: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// Returns the product a b, which applies `b` first and then `a`.
pub fn product(a: &Matrix3, b: &Matrix3) -> Matrix3 {
    a.map(|row| {
        std::array::from_fn(|column| (0..3).map(|inner| row[inner] * b[inner][column]).sum())
    })
}

/// Returns the cofactor of an element; taking the next rows and columns in cyclic order includes the sign.
fn cofactor(m: &Matrix3, row: usize, column: usize) -> f64 {
    let (r1, r2) = ((row + 1) % 3, (row + 2) % 3);
    let (c1, c2) = ((column + 1) % 3, (column + 2) % 3);
    m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]
}

/// Returns the determinant.
pub fn determinant(m: &Matrix3) -> f64 {
    (0..3).map(|c| m[0][c] * cofactor(m, 0, c)).sum()
}

/// Returns the inverse by cofactors; for a singular matrix, the numbers are not finite.
pub fn inverse(m: &Matrix3) -> Matrix3 {
    let determinant = determinant(m);
    std::array::from_fn(|row| std::array::from_fn(|column| cofactor(m, column, row) / determinant))
}

/// Returns the matrix with these columns.
pub fn of_columns(columns: [[f64; 3]; 3]) -> Matrix3 {
    std::array::from_fn(|row| columns.map(|column| column[row]))
}
