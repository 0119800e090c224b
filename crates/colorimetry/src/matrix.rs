//! 3×3 matrices, row by row.

/// A 3×3 matrix, row by row.
pub type Matrix3 = [[f64; 3]; 3];

/// The matrix that changes nothing.
pub const IDENTITY: Matrix3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// m v.
pub fn times(m: &Matrix3, v: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// a b: what `b` does first and `a` after it.
pub fn product(a: &Matrix3, b: &Matrix3) -> Matrix3 {
    a.map(|row| {
        std::array::from_fn(|column| (0..3).map(|inner| row[inner] * b[inner][column]).sum())
    })
}

/// The cofactor of an element, by the rows and columns that follow its own in turn, so that it needs no sign.
fn cofactor(m: &Matrix3, row: usize, column: usize) -> f64 {
    let (r1, r2) = ((row + 1) % 3, (row + 2) % 3);
    let (c1, c2) = ((column + 1) % 3, (column + 2) % 3);
    m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]
}

/// The determinant.
pub fn determinant(m: &Matrix3) -> f64 {
    (0..3).map(|c| m[0][c] * cofactor(m, 0, c)).sum()
}

/// The inverse by cofactors; of a singular matrix, numbers that are not finite.
pub fn inverse(m: &Matrix3) -> Matrix3 {
    let determinant = determinant(m);
    std::array::from_fn(|row| std::array::from_fn(|column| cofactor(m, column, row) / determinant))
}

/// The matrix with these columns.
pub fn of_columns(columns: [[f64; 3]; 3]) -> Matrix3 {
    std::array::from_fn(|row| columns.map(|column| column[row]))
}
