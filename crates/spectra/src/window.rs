//! Rectangles of pixels.

use std::fmt::{self, Display};

/// A rectangle of pixels of a picture.
#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub struct Window {
    /// Column and row of its first pixel, from the upper left corner of the picture.
    pub origin: [u32; 2],
    /// Width and height.
    pub size: [u32; 2],
}

impl Window {
    /// The whole of a picture.
    pub const fn whole(size: [u32; 2]) -> Self {
        Self {
            origin: [0, 0],
            size,
        }
    }

    /// Number of pixels.
    pub fn pixels(&self) -> usize {
        self.size[0] as usize * self.size[1] as usize
    }

    /// The column and the row behind its last pixel.
    pub fn end(&self) -> [u64; 2] {
        [0, 1].map(|i| u64::from(self.origin[i]) + u64::from(self.size[i]))
    }

    /// Whether all of another window lies in this one.
    pub fn contains(&self, other: &Self) -> bool {
        let (own, end) = (self.end(), other.end());
        (0..2).all(|i| self.origin[i] <= other.origin[i] && end[i] <= own[i])
    }

    /// Some of its rows, counted from its own first one.
    #[must_use]
    pub fn rows(&self, rows: std::ops::Range<u32>) -> Self {
        Self {
            origin: [self.origin[0], self.origin[1] + rows.start],
            size: [self.size[0], rows.end - rows.start],
        }
    }
}

/// `640×480 pixels at 0,120`.
impl Display for Window {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([x, y], [width, height]) = (self.origin, self.size);
        write!(f, "{width}×{height} pixels at {x},{y}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_knows_what_lies_in_it() {
        let window = Window {
            origin: [2, 3],
            size: [5, 4],
        };
        assert_eq!((window.pixels(), window.end()), (20, [7, 7]));
        assert!(Window::whole([7, 7]).contains(&window));
        assert!(!Window::whole([7, 6]).contains(&window));
        assert!(!window.contains(&Window::whole([3, 4])));
        let rows = window.rows(1..3);
        assert_eq!(rows.to_string(), "5×2 pixels at 2,4");
        let far = Window {
            origin: [u32::MAX; 2],
            size: [u32::MAX; 2],
        };
        assert!(!window.contains(&far));
    }
}
