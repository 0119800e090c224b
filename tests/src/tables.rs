//! The tables of `data/`: comma-separated cells, comments before them, one line of headings.

/// The cells of a table, without its comments and its headings.
pub fn rows(table: &str) -> impl Iterator<Item = Vec<&str>> {
    let lines = table.lines().filter(|line| !line.starts_with('#'));
    lines.skip(1).map(|line| line.split(',').collect())
}

/// A cell that must be a number.
///
/// # Panics
/// If it is not.
pub fn number(cell: &str) -> f64 {
    cell.parse()
        .unwrap_or_else(|_| panic!("{cell} is no number"))
}
