//! Pictures with four numbers per texel, in a validated scene.

use std::fmt;

/// A grid of texels that both renderers look up.
///
/// A pixel has one or several texels. The texel of an RGB color is `[c₀, c₁, c₂, scale]`: a smooth spectrum
/// (`colorimetry::lifting::SigmoidReflectance`) and a factor.
#[derive(Clone, PartialEq)]
pub struct Texels {
    /// Number of pixels per row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Number of texels per pixel.
    pub per_pixel: u32,
    /// The rows from top to bottom.
    pub values: Vec<[f32; 4]>,
}

impl Texels {
    /// The texels of a pixel.
    pub fn at(&self, [column, row]: [u32; 2]) -> &[[f32; 4]] {
        let count = self.per_pixel as usize;
        let first = (row as usize * self.width as usize + column as usize) * count;
        &self.values[first..first + count]
    }
}

/// The size and a digest: two grids with the same description hold the same values.
impl fmt::Debug for Texels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bits = self.values.as_flattened().iter().map(|v| v.to_bits());
        let digest = fnv(bits);
        write!(
            f,
            "Texels({} × {} × {}, {digest:016x})",
            self.width, self.height, self.per_pixel
        )
    }
}

/// FNV-1a (Fowler, Noll and Vo, RFC 9923) over words instead of bytes.
pub(crate) fn fnv(words: impl Iterator<Item = u32>) -> u64 {
    words.fold(0xcbf2_9ce4_8422_2325, |hash, word| {
        (hash ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_description_tells_values_apart() {
        let mut texels = Texels {
            width: 2,
            height: 1,
            per_pixel: 1,
            values: vec![[0.5; 4]; 2],
        };
        let before = format!("{texels:?}");
        assert!(before.starts_with("Texels(2 × 1 × 1, "), "{before}");
        for (pixel, value) in [(0, 0.25), (1, -0.5), (1, 0.500_000_1)] {
            let old = std::mem::replace(&mut texels.values[pixel][3], value);
            assert_ne!(format!("{texels:?}"), before);
            texels.values[pixel][3] = old;
        }
        assert_eq!(format!("{texels:?}"), before);
    }
}
