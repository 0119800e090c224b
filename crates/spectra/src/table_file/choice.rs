//! Selects the columns of a table.

use std::borrow::Cow;

use super::block::{Block, blocks, check_axis};
use super::error::{TableFileError, cell_text};
use super::head::{Head, base};
use super::line::{DecimalSigns, Separator};
use super::options::{ColumnChoice, Options, Unit};
use super::{MAX_COLUMNS, Notes, Point, Series};

/// What to find in a table.
#[derive(Clone, Copy)]
struct Wanted<'o> {
    /// Number of columns of values.
    count: usize,
    /// Whether they are n and k; k may be absent.
    is_index: bool,
    options: &'o Options,
}

/// Returns the columns of values of a text: `count` of them, or for n and k possibly n alone.
pub(super) fn series<'a>(
    text: &'a str,
    count: usize,
    is_index: bool,
    options: &Options,
    notes: &mut Notes,
) -> Result<Vec<Series<'a>>, TableFileError> {
    let blocks = blocks(text)?;
    let wanted = Wanted {
        count,
        is_index,
        options,
    };
    match blocks.as_slice() {
        [] => Err(TableFileError::Empty),
        [block] => of_block(block, wanted, notes),
        [n, k] if is_index && names_value(n, is_n) && names_value(k, is_k) => {
            notes.add("n and k from two tables, one below the other");
            let wanted = Wanted {
                count: 1,
                is_index: false,
                options,
            };
            let mut both = of_block(n, wanted, notes)?;
            both.extend(of_block(k, wanted, notes)?);
            Ok(both)
        }
        [_, second, ..] => Err(TableFileError::Format {
            line: second.head.first().map_or(0, |head| head.line.number),
            format: "table",
            wrong: "another one begins here; only n and k may be one below the other".to_owned(),
        }),
    }
}

/// Whether the name of a block's only column of values satisfies `is`.
fn names_value(block: &Block, is: fn(&str) -> bool) -> bool {
    let Some(row) = block.rows.first() else {
        return false;
    };
    let head = Head::of(block, row.separator(), 2);
    head.names.get(1).is_some_and(|name| is(name))
}

fn of_block<'a>(
    block: &Block<'a>,
    wanted: Wanted,
    notes: &mut Notes,
) -> Result<Vec<Series<'a>>, TableFileError> {
    let Some(row) = block.rows.first() else {
        return Err(TableFileError::Empty);
    };
    let separator = row.separator();
    let cells = row.cells(separator);
    let width = cells.len();
    if width > MAX_COLUMNS {
        let (what, most) = ("columns", MAX_COLUMNS);
        return Err(TableFileError::TooMany { what, most });
    }
    let head = Head::of(block, separator, width);
    check_width(block, &head, wanted)?;
    let chosen = wanted.choose((row.number, width), &head, notes)?;
    let mut all = columns(block, (head.axis(), &chosen), width, notes)?;
    let unit = unit_of(&head, &all, wanted)?;
    if unit.is_none() && wanted.options.unit.is_none() {
        check_axis(block.head.iter().map(|head| head.line))?;
    }
    for &column in &chosen {
        head.check_logarithm(column)?;
    }
    for (series, &column) in all.iter_mut().zip(&chosen) {
        series.unit = unit;
        series.scale = head.is_percent(column).then_some(100.0);
    }
    Ok(all)
}

/// Returns the unit in the header, or the one implied by its names.
fn unit_of(
    head: &Head,
    all: &[Series],
    wanted: Wanted,
) -> Result<Option<(Unit, &'static str)>, TableFileError> {
    if wanted.options.unit.is_some() {
        return Ok(None);
    }
    if let Some(unit) = head.unit()? {
        return Ok(Some((unit, "as the header says")));
    }
    let is_wl = |name: &String| name.eq_ignore_ascii_case("wl");
    let mut names = head.names.iter();
    let is_database = names.next().is_some_and(is_wl) && names.all(|name| is_n(name) || is_k(name));
    let points = all.iter().flat_map(|series| &series.points);
    let is_short = points
        .clone()
        .any(|point| point.place < super::finish::SHORTEST_NM);
    let micrometers = (Unit::Um, "as refractiveindex.info writes them under wl");
    Ok((is_database && is_short).then_some(micrometers))
}

/// Refuses rows that have other columns than the header, or whose commas may be decimal commas.
fn check_width(block: &Block, head: &Head, wanted: Wanted) -> Result<(), TableFileError> {
    let Some(row) = block.rows.first() else {
        return Ok(());
    };
    let separator = row.separator();
    let cells = row.cells(separator);
    let is_comma = separator == Separator::Comma;
    let has_point = block.rows.iter().any(|row| row.content.contains('.'));
    let expected = match head.other_width {
        Some(expected) => expected,
        None if is_comma
            && cells.len() == 3
            && wanted.count <= 2
            && head.names.is_empty()
            && wanted.options.columns.is_empty()
            && !has_point =>
        {
            2
        }
        None => return Ok(()),
    };
    if is_comma && cells.len() > expected && expected > 1 && !has_point {
        return Err(ambiguous(row.number, row.content, &cells, expected));
    }
    Err(TableFileError::Columns {
        line: row.number,
        found: cells.len(),
        expected: format!("{expected}, as in the header in line {}", head.line),
    })
}

fn ambiguous(line: usize, text: &str, cells: &[&str], expected: usize) -> TableFileError {
    let (first, last) = cells.split_at_checked(expected - 1).unwrap_or((cells, &[]));
    let last = last.join(",");
    let joined = [first, &[last.as_str()]].concat();
    TableFileError::Ambiguous {
        line,
        text: text.to_owned(),
        one: format!("{} in {} columns", cells.join(" | "), cells.len()),
        other: format!("{} with a decimal comma", joined.join(" | ")),
        way_out: "write a header with a name for each column, decimal points, or ; between columns"
            .to_owned(),
    }
}

/// Parses the numbers of the chosen columns.
fn columns<'a>(
    block: &Block<'a>,
    (axis, chosen): (usize, &[usize]),
    width: usize,
    notes: &mut Notes,
) -> Result<Vec<Series<'a>>, TableFileError> {
    let mut signs = DecimalSigns::default();
    let mut all = vec![Series::default(); chosen.len()];
    for row in &block.rows {
        let separator = row.separator();
        let cells = row.cells(separator);
        if let Some(note) = separator.note() {
            notes.add(note);
        }
        if cells.len() != width {
            // A cell that is not a number is a more useful error than the number of columns.
            let first = cells.first().copied().unwrap_or_default();
            signs.number(row.number, 1, first)?;
            return Err(TableFileError::Columns {
                line: row.number,
                found: cells.len(),
                expected: width.to_string(),
            });
        }
        let cell = |column: usize| cells.get(column).copied().unwrap_or_default();
        let is_quoted_comma = |&&column: &&usize| cell(column).contains(',');
        let mut meant = std::iter::once(&axis).chain(chosen);
        if let Some(&column) = meant
            .find(is_quoted_comma)
            .filter(|_| separator == Separator::Comma)
        {
            // In a comma-separated row it may be a thousands separator.
            return Err(TableFileError::Number {
                line: row.number,
                text: cell(column).to_owned(),
            });
        }
        let place = signs.number(row.number, axis + 1, cell(axis))?;
        for (series, &column) in all.iter_mut().zip(chosen) {
            series.points.push(Point {
                line: row.number,
                place,
                place_text: Cow::Borrowed(cell(axis)),
                value: signs.number(row.number, column + 1, cell(column))?,
                text: Cow::Borrowed(cell(column)),
            });
        }
    }
    if signs.is_comma() {
        notes.add("decimal commas");
    }
    Ok(all)
}

impl Wanted<'_> {
    /// Chooses the columns of values, from 0.
    fn choose(
        &self,
        (line, width): (usize, usize),
        head: &Head,
        notes: &mut Notes,
    ) -> Result<Vec<usize>, TableFileError> {
        let axis = head.axis();
        if !self.options.columns.is_empty() {
            let columns = self.options.columns.iter();
            return columns
                .map(|column| asked(column, head, (axis, width)))
                .collect();
        }
        let values: Vec<usize> = (0..width).filter(|&column| column != axis).collect();
        let chosen = if self.is_index && head.names_axis {
            by_head(&values, head, width)?
        } else {
            values
        };
        let fits = chosen.len() == self.count || self.is_index && chosen.len() == 1;
        if !fits {
            return Err(self.too_many(line, width, head));
        }
        if axis != 0
            || chosen
                .iter()
                .zip(1..)
                .any(|(&column, place)| column != place)
            || chosen.len() + 1 < width
        {
            let names: Vec<_> = std::iter::once(&axis)
                .chain(&chosen)
                .filter_map(|&column| head.names.get(column).map(|name| cell_text(name)))
                .collect();
            notes.add(format!(
                "the columns {} as named in the header",
                names.join(", ")
            ));
        }
        Ok(chosen)
    }

    fn too_many(&self, line: usize, width: usize, head: &Head) -> TableFileError {
        let expected = if self.is_index {
            "3 (or 2, for k = 0)".to_owned()
        } else {
            (1 + self.count).to_string()
        };
        let can_choose = self.count == 1 || self.is_index;
        if width <= self.count || !can_choose {
            let found = width;
            return TableFileError::Columns {
                line,
                found,
                expected,
            };
        }
        TableFileError::WhichColumn {
            wrong: format!("line {line}: found {width} columns, expected {expected}"),
            known: head.known(width),
        }
    }
}

/// Returns the columns named n and k.
fn by_head(values: &[usize], head: &Head, width: usize) -> Result<Vec<usize>, TableFileError> {
    let find = |is: fn(&str) -> bool| -> Vec<usize> {
        let named = |&&column: &&usize| head.names.get(column).is_some_and(|name| is(name));
        values.iter().filter(named).copied().collect()
    };
    let which = |wrong: &str| TableFileError::WhichColumn {
        wrong: wrong.to_owned(),
        known: head.known(width),
    };
    match (find(is_n).as_slice(), find(is_k).as_slice(), values) {
        (&[n], &[k], _) => Ok(vec![n, k]),
        (&[n], &[], &[_]) => Ok(vec![n]),
        (&[], &[], &[only]) => Ok(vec![only]),
        (&[], &[_], _) => Err(which("there is k, but no n")),
        (&[_], &[], _) => Err(which("it is unclear which column is k")),
        _ => Err(which("it is unclear which columns are n and k")),
    }
}

/// Returns the column that a user requests, from 0.
fn asked(
    column: &ColumnChoice,
    head: &Head,
    (axis, width): (usize, usize),
) -> Result<usize, TableFileError> {
    let refuse = |asked: String| {
        let known = head.known(width);
        Err(TableFileError::NoColumn { asked, known })
    };
    match column {
        ColumnChoice::Number(number) => match number.checked_sub(1) {
            Some(column) if column == axis => {
                refuse(format!("{number} of values: it has the wavelengths"))
            }
            Some(column) if column < width => Ok(column),
            _ => refuse(number.to_string()),
        },
        ColumnChoice::Name(name) => {
            let find = |part: fn(&str) -> &str| -> Vec<usize> {
                let names = head.names.iter().enumerate();
                let is_it = |&(at, known): &(usize, &String)| {
                    at != axis && part(known).to_lowercase() == name.trim().to_lowercase()
                };
                names.filter(is_it).map(|(at, _)| at).collect()
            };
            let (whole, parts) = (find(str::trim), find(base));
            match (whole.as_slice(), parts.as_slice()) {
                (&[only], _) | (&[], &[only]) => Ok(only),
                (&[], &[]) => refuse(cell_text(name)),
                _ => refuse(format!(
                    "{} that is unique: several have this name",
                    cell_text(name)
                )),
            }
        }
    }
}

/// Whether a name means the real part of an index.
fn is_n(name: &str) -> bool {
    let name = name.trim().to_lowercase();
    [
        "n",
        "n_real",
        "real",
        "re(n)",
        "re",
        "index",
        "refractive index",
        "ri",
    ]
    .contains(&name.as_str())
        || ["n", "refractive index"].contains(&base(&name))
}

/// Whether a name means the imaginary part of an index.
fn is_k(name: &str) -> bool {
    let name = name.trim().to_lowercase();
    ["k", "kappa", "κ", "n_imag", "imag", "im(n)", "im", "k_imag"].contains(&name.as_str())
        || base(&name) == "k"
        || name.starts_with("extinction")
}
