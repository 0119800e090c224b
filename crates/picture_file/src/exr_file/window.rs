//! Position of a file's pixels in its picture.

use std::ops::Range;

use exr::meta::header::Header;

/// The data window, whose pixels a file holds, in the display window, which is the picture. Pixels of the picture that the file
/// does not hold are black; pixels of the file outside the picture are cut off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Window {
    size: (usize, usize),
    data: (usize, usize),
    /// Position of the data window's first pixel in the picture.
    offset: (i64, i64),
}

/// Consecutive samples of a row that lie in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    /// Number of samples before them that are cut off.
    pub(crate) skip: usize,
    /// Number of samples.
    pub(crate) count: usize,
    /// Column of the first one in the picture.
    pub(crate) x: usize,
    /// Their row in the picture.
    pub(crate) y: usize,
}

impl Window {
    pub(crate) fn of(header: &Header) -> Self {
        let (display, position) = (
            header.shared_attributes.display_window,
            header.own_attributes.layer_position,
        );
        let from = |data: i32, display: i32| i64::from(data) - i64::from(display);
        Self {
            size: (display.size.width(), display.size.height()),
            data: (header.layer_size.width(), header.layer_size.height()),
            offset: (
                from(position.x(), display.position.x()),
                from(position.y(), display.position.y()),
            ),
        }
    }

    /// The same pixels, with only these rows of the picture as the picture.
    pub(crate) fn of_rows(&self, rows: &Range<u32>) -> Self {
        Self {
            size: (self.size.0, rows.len()),
            data: self.data,
            offset: (self.offset.0, self.offset.1 - i64::from(rows.start)),
        }
    }

    /// The first rows of strips of `rows` rows each, above which the data window can be cut into blocks of `block_rows` rows: they begin
    /// where a block begins. The picture's first row is among them.
    pub(crate) fn strips(
        &self,
        rows: usize,
        block_rows: usize,
    ) -> impl Iterator<Item = u32> + use<> {
        let block_rows = block_rows.max(1);
        let rows = (rows / block_rows).max(1) * block_rows;
        let above = self.offset.1.rem_euclid(block_rows as i64) as usize;
        let first = (above > 0).then_some(0);
        let others = (above..self.size.1).step_by(rows);
        first.into_iter().chain(others).map(|row| row as u32)
    }

    /// The part of the picture that the file holds: column and row of its first pixel, and its width and height. All are 0 if it holds
    /// none.
    pub(crate) fn held(&self) -> ([u32; 2], [u32; 2]) {
        let range = |offset: i64, data: usize, size: usize| {
            let (start, end) = (offset.max(0), (offset + data as i64).min(size as i64));
            (start as u32, (end - start).max(0) as u32)
        };
        let (x, width) = range(self.offset.0, self.data.0, self.size.0);
        let (y, height) = range(self.offset.1, self.data.1, self.size.1);
        if width == 0 || height == 0 {
            return ([0, 0], [0, 0]);
        }
        ([x, y], [width, height])
    }

    /// Whether any pixel of a block from column `x` of row `y` of the data window is in the picture.
    pub(crate) fn meets(&self, (x, y): (usize, usize), (width, height): (usize, usize)) -> bool {
        let overlaps = |start: usize, count: usize, offset: i64, size: usize| {
            let start = (start as i64).saturating_add(offset);
            start < size as i64 && start.saturating_add(count as i64) > 0
        };
        overlaps(x, width, self.offset.0, self.size.0)
            && overlaps(y, height, self.offset.1, self.size.1)
    }

    /// Width and height of the picture in pixels.
    pub(crate) fn size(&self) -> (usize, usize) {
        self.size
    }

    /// Width and height of the data window in pixels.
    pub(crate) fn data(&self) -> (usize, usize) {
        self.data
    }

    /// Whether `count` samples from column `x` of row `y` lie in the data window.
    pub(crate) fn holds(&self, (x, y): (usize, usize), count: usize) -> bool {
        x.checked_add(count).is_some_and(|end| end <= self.data.0) && y < self.data.1
    }

    /// Returns where `count` samples from column `x` of row `y` of the data window lie; `None` if none of them is in the picture.
    pub(crate) fn place(&self, (x, y): (usize, usize), count: usize) -> Option<Run> {
        let row = usize::try_from(y as i64 + self.offset.1).ok();
        let row = row.filter(|&row| row < self.size.1)?;
        let start = x as i64 + self.offset.0;
        let end = (start + count as i64).min(self.size.0 as i64);
        let first = start.max(0);
        (first < end).then_some(Run {
            skip: (first - start) as usize,
            count: (end - first) as usize,
            x: first as usize,
            y: row,
        })
    }

    /// Number of pixels of a row of the picture that the file holds.
    pub(crate) fn held_in_row(&self, y: usize) -> usize {
        let data_row = y as i64 - self.offset.1;
        if !(0..self.data.1 as i64).contains(&data_row) {
            return 0;
        }
        self.place((0, data_row as usize), self.data.0)
            .map_or(0, |run| run.count)
    }

    /// Describes which pixels are black and which are cut off, if any.
    pub(crate) fn note(&self) -> Option<String> {
        let ((width, height), (own_width, own_height)) = (self.size, self.data);
        let (x, y) = self.offset;
        let is_over =
            |start: i64, own: usize, all: usize| start < 0 || start + own as i64 > all as i64;
        let is_short =
            |start: i64, own: usize, all: usize| start > 0 || start + (own as i64) < all as i64;
        let over = is_over(x, own_width, width) || is_over(y, own_height, height);
        let short = is_short(x, own_width, width) || is_short(y, own_height, height);
        let done = match (over, short) {
            (false, false) => return None,
            (true, false) => "pixels outside it are cut off",
            (false, true) => "the pixels without data are black",
            (true, true) => "pixels outside it are cut off, and the pixels without data are black",
        };
        Some(format!(
            "holds {own_width}×{own_height} pixels at {x},{y} of a picture of {width}×{height}: {done}"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn window(offset: (i64, i64), data: (usize, usize)) -> Window {
        Window {
            size: (8, 4),
            data,
            offset,
        }
    }

    #[test]
    fn crops_and_overscan_are_placed() {
        let crop = window((2, 1), (4, 2));
        let run = |skip, count, x, y| Some(Run { skip, count, x, y });
        assert_eq!(crop.place((0, 0), 4), run(0, 4, 2, 1));
        assert_eq!(crop.place((1, 1), 2), run(0, 2, 3, 2));
        assert_eq!([0, 1, 2, 3].map(|y| crop.held_in_row(y)), [0, 4, 4, 0]);
        let overscan = window((-3, -1), (14, 6));
        assert_eq!(overscan.place((0, 1), 14), run(3, 8, 0, 0));
        assert_eq!(overscan.place((0, 0), 14), None);
        assert_eq!(overscan.place((0, 5), 14), None);
        assert_eq!(overscan.place((2, 4), 4), run(1, 3, 0, 3));
        assert_eq!([0, 3].map(|y| overscan.held_in_row(y)), [8, 8]);
        assert!(
            overscan.holds((13, 5), 1) && !overscan.holds((13, 5), 2) && !overscan.holds((0, 6), 1)
        );
    }

    #[test]
    fn windows_that_do_not_meet_have_no_pixel_in_common() {
        for offset in [
            (8, 0),
            (-4, 0),
            (0, 4),
            (0, -2),
            (i64::from(i32::MAX) * 2, 0),
            (0, i64::from(i32::MIN) * 2),
        ] {
            let window = window(offset, (4, 2));
            assert!(
                (0..2).all(|y| window.place((0, y), 4).is_none()),
                "{offset:?}"
            );
            assert!((0..4).all(|y| window.held_in_row(y) == 0), "{offset:?}");
            assert!(window.note().is_some());
        }
    }

    #[test]
    fn rows_are_a_picture_of_their_own() {
        let crop = window((2, 1), (4, 2)).of_rows(&(2..4));
        let run = |skip, count, x, y| Some(Run { skip, count, x, y });
        assert_eq!(crop.size(), (8, 2));
        assert_eq!(
            [0, 1].map(|y| crop.place((0, y), 4)),
            [None, run(0, 4, 2, 0)]
        );
        assert_eq!([0, 1].map(|y| crop.held_in_row(y)), [4, 0]);
        assert!(!crop.meets((0, 0), (4, 1)) && crop.meets((0, 1), (4, 1)));
        assert!(crop.meets((0, 0), (4, 2)));
        let left = window((-2, 0), (4, 4));
        assert!(!left.meets((0, 0), (2, 4)) && left.meets((0, 0), (3, 4)));
    }

    #[test]
    fn strips_begin_where_blocks_do() {
        let starts = |offset, rows, block_rows| -> Vec<u32> {
            let size = (8, 20);
            let window = Window {
                size,
                ..window((0, offset), (8, 20))
            };
            window.strips(rows, block_rows).collect()
        };
        assert_eq!(starts(0, 7, 1), [0, 7, 14]);
        assert_eq!(starts(0, 100, 1), [0]);
        assert_eq!(starts(0, 0, 8), [0, 8, 16]);
        assert_eq!(starts(0, 15, 4), [0, 12]);
        assert_eq!(starts(3, 1, 8), [0, 3, 11, 19]);
        assert_eq!(starts(-3, 1, 8), [0, 5, 13]);
        assert_eq!(starts(24, 8, 8), [0, 8, 16]);
        assert_eq!(starts(0, 1, 100), [0]);
    }

    #[test]
    fn the_part_of_the_picture_that_is_held_is_cut_at_its_ends() {
        let held = |offset, data| window(offset, data).held();
        assert_eq!(held((2, 1), (4, 2)), ([2, 1], [4, 2]));
        assert_eq!(held((-3, -1), (14, 3)), ([0, 0], [8, 2]));
        assert_eq!(held((5, 3), (4, 2)), ([5, 3], [3, 1]));
        for far in [(8, 0), (-4, 0), (0, 4), (0, -2), (-(1 << 32), 1 << 32)] {
            assert_eq!(held(far, (4, 2)), ([0, 0], [0, 0]), "{far:?}");
        }
    }

    #[test]
    fn what_is_done_is_said() {
        assert_eq!(window((0, 0), (8, 4)).note(), None);
        let said = |offset, data| window(offset, data).note().unwrap_or_default();
        assert!(
            said((2, 1), (4, 2))
                .ends_with("at 2,1 of a picture of 8×4: the pixels without data are black")
        );
        assert!(said((-1, 0), (10, 4)).ends_with(": pixels outside it are cut off"));
        assert!(said((-1, 0), (4, 4)).contains("cut off, and"));
    }
}
