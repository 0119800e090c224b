//! Readers of the tables in `data/`: comma-separated cells, with comments and a line of headings before them.

/// The cells of a table, without its comments and its headings.
pub fn rows(table: &str) -> impl Iterator<Item = Vec<&str>> {
    let lines = table.lines().filter(|line| !line.starts_with('#'));
    lines.skip(1).map(|line| line.split(',').collect())
}

/// The number in a cell.
///
/// # Panics
/// If the cell is not a number.
pub fn number(cell: &str) -> f64 {
    cell.parse()
        .unwrap_or_else(|_| panic!("{cell} is not a number"))
}
