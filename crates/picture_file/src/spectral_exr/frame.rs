//! The picture of a file, and the part of it that the file holds.

use spectra::Window;

/// The size of a picture, and the part of it whose pixels a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Frame {
    /// Width and height of the picture in pixels (the display window of the file).
    pub picture: [u32; 2],
    /// The part of the picture that the file holds (the data window of the file).
    pub window: Window,
}

impl Frame {
    /// The frame of a file that holds its whole picture.
    pub fn whole(picture: [u32; 2]) -> Self {
        Self {
            picture,
            window: Window::whole(picture),
        }
    }

    /// Whether the window lies in the picture, and the picture is not larger than the numbers of a file.
    pub(super) fn is_sound(&self) -> bool {
        (0..2).all(|axis| {
            let end = self.window.origin[axis].checked_add(self.window.size[axis]);
            let is_within = end.is_some_and(|end| end <= self.picture[axis]);
            is_within && i32::try_from(self.picture[axis]).is_ok()
        })
    }
}
