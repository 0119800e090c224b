//! Pictures of display codes.

/// A picture of display codes, with row 0 at the top.
#[derive(Clone, Debug, Eq, PartialEq)]
pub struct RgbImage<Code> {
    width: u32,
    height: u32,
    data: Vec<Code>,
}

/// The type of a picture's codes: `u8` or `u16`.
pub trait Code: Copy + Default + Send + Sync {
    /// The largest code.
    const MAX: f64;

    /// The code of a whole number from 0 to [`Self::MAX`].
    fn of(value: f64) -> Self;
}

impl Code for u8 {
    const MAX: f64 = u8::MAX as f64;

    fn of(value: f64) -> Self {
        value as Self
    }
}

impl Code for u16 {
    const MAX: f64 = u16::MAX as f64;

    fn of(value: f64) -> Self {
        value as Self
    }
}

/// A picture of 8-bit codes.
pub type RgbImage8 = RgbImage<u8>;
/// A picture of 16-bit codes.
pub type RgbImage16 = RgbImage<u16>;

impl<Code: Copy> RgbImage<Code> {
    /// Creates a picture from codes, red, green and blue of each pixel in turn, row by row; `None` unless there are
    /// 3 × `width` × `height` codes.
    pub fn new(width: u32, height: u32, data: Vec<Code>) -> Option<Self> {
        let pixels = (width as usize).checked_mul(height as usize)?;
        let expected = pixels.checked_mul(3)?;
        (data.len() == expected).then_some(Self {
            width,
            height,
            data,
        })
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The codes, red, green and blue of each pixel in turn, row by row.
    pub fn data(&self) -> &[Code] {
        &self.data
    }

    /// Red, green and blue of pixel (x, y); `None` outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[Code; 3]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let start = 3 * (y as usize * self.width as usize + x as usize);
        self.data[start..start + 3].try_into().ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_has_three_codes_per_pixel() {
        assert!(RgbImage8::new(2, 1, vec![0; 6]).is_some());
        assert_eq!(RgbImage8::new(2, 1, vec![0; 5]), None);
        // 3 (2³² − 1)² does not fit into 64 bits.
        assert_eq!(RgbImage8::new(u32::MAX, u32::MAX, Vec::new()), None);
    }
}
