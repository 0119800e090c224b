//! Finds the rows of numbers in a text and the header above them.

use super::MAX_ROWS;
use super::axis::{axis_word, is_axis};
use super::error::TableFileError;
use super::line::{Line, lines, number};

/// A line above the rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct HeadLine<'a> {
    pub(super) line: Line<'a>,
    /// Whether it is a comment; the comment sign is removed.
    pub(super) is_comment: bool,
}

/// Rows of numbers and the header above them.
#[derive(Debug, Default)]
pub(super) struct Block<'a> {
    pub(super) head: Vec<HeadLine<'a>>,
    /// Never empty in a finished block.
    pub(super) rows: Vec<Line<'a>>,
}

/// Refuses header lines in which a spectrometer states that its axis is in wavenumbers.
pub(super) fn check_axis<'a>(
    mut lines: impl Iterator<Item = Line<'a>>,
) -> Result<(), TableFileError> {
    let says = |line: &Line| line.content.to_lowercase().contains("wavenumber");
    match lines.find(says) {
        Some(line) => Err(TableFileError::Unit {
            line: line.number,
            text: line.content.to_owned(),
        }),
        None => Ok(()),
    }
}

/// Returns the blocks of a text: one, or several if there is a header between rows.
pub(super) fn blocks(text: &str) -> Result<Vec<Block<'_>>, TableFileError> {
    let begin = lines(text)
        .filter(|line| is_begin(line.content))
        .map(|line| line.number)
        .last();
    if let Some(begin) = begin {
        check_axis(lines(text).take_while(|line| line.number < begin))?;
    }
    let mut blocks = Vec::new();
    let mut block = Block::default();
    for line in lines(text).filter(|line| begin.is_none_or(|begin| line.number > begin)) {
        if let Some(content) = line.comment() {
            if block.rows.is_empty() {
                let line = Line { content, ..line };
                let is_comment = true;
                block.head.push(HeadLine { line, is_comment });
            }
            continue;
        }
        if is_end(line.content, &block) {
            break;
        }
        if !block.rows.is_empty() && is_head(&line) {
            blocks.push(std::mem::take(&mut block));
        }
        if block.rows.is_empty() && !is_row(&line) {
            let is_comment = false;
            block.head.push(HeadLine { line, is_comment });
        } else if block.rows.len() == MAX_ROWS {
            let (what, most) = ("points", MAX_ROWS);
            return Err(TableFileError::TooMany { what, most });
        } else {
            block.rows.push(line);
        }
    }
    check_head(&block)?;
    if !block.rows.is_empty() {
        blocks.push(block);
    }
    blocks.iter().try_for_each(check_head)?;
    Ok(blocks)
}

/// Whether the data begin after this line.
fn is_begin(content: &str) -> bool {
    let is_marker = |rest: &str| {
        rest.trim_start_matches('>')
            .trim_start()
            .starts_with("Begin")
    };
    content.strip_prefix(">>>").is_some_and(is_marker) || content.eq_ignore_ascii_case("[data]")
}

/// Whether the data end at this line.
fn is_end(content: &str, block: &Block) -> bool {
    !block.rows.is_empty() && (content.starts_with(">>>") || content.starts_with('['))
}

/// Whether a line is a row of numbers, below which all other lines must be rows too.
fn is_row(line: &Line) -> bool {
    let cells = line.cells(line.separator());
    let is_number = |at: usize| {
        cells
            .get(at)
            .is_none_or(|cell| cell.is_empty() || number(cell).is_some())
    };
    cells.first().is_some_and(|first| number(first).is_some()) && is_number(1)
        || cells.first().is_some_and(|first| first.is_empty()) && cells.len() > 1 && is_number(1)
}

/// Whether a line between rows is the header of another table.
fn is_head(line: &Line) -> bool {
    let cells = line.cells(line.separator());
    let first = cells.first().copied().unwrap_or_default();
    cells.len() > 1
        && (axis_word(first) || is_axis(first))
        && cells.iter().all(|cell| number(cell).is_none())
}

/// Refuses a header line that would be a row except for a cell that is not a number.
fn check_head(block: &Block) -> Result<(), TableFileError> {
    let width = block
        .rows
        .first()
        .map(|row| row.cells(row.separator()).len());
    let own = block.head.iter().filter(|head| !head.is_comment);
    for HeadLine { line, .. } in own {
        let cells = line.cells(line.separator());
        let Some((first, others)) = cells.split_first() else {
            continue;
        };
        let is_as_wide = width.is_none_or(|width| width == cells.len());
        let is_broken = number(first).is_some()
            || first.starts_with(|c: char| c.is_ascii_digit())
                && others.iter().all(|cell| number(cell).is_some());
        if is_as_wide && is_broken && !others.is_empty() {
            let text = cells.iter().find(|cell| number(cell).is_none());
            return Err(TableFileError::Number {
                line: line.number,
                text: text.copied().unwrap_or_default().to_owned(),
            });
        }
    }
    Ok(())
}
