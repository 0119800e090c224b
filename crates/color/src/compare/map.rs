//! Heat maps: differences as a picture.

use picture_file::RgbImage8;
use spectra::knot_before;

/// The colormap magma, from black over purple and orange to pale yellow, at 17 equal steps. Its lightness rises evenly, also for
/// color-blind viewers (S. van der Walt and N. Smith, 2015, for matplotlib; CC0 1.0).
const MAGMA: [[u8; 3]; 17] = [
    [0, 0, 4],
    [10, 8, 34],
    [29, 17, 71],
    [54, 16, 107],
    [81, 18, 124],
    [106, 28, 129],
    [131, 38, 129],
    [156, 46, 127],
    [183, 55, 121],
    [208, 65, 111],
    [231, 82, 99],
    [245, 107, 92],
    [252, 137, 97],
    [254, 167, 114],
    [254, 196, 136],
    [253, 226, 163],
    [252, 253, 191],
];

/// The color of NaN.
pub(crate) const NOT_A_NUMBER: [u8; 3] = [0, 255, 0];

/// Returns a picture of one value per pixel: 0 is black, `full` and above pale yellow, NaN green. `None` unless there are
/// `width` × `height` values.
pub fn heat_map([width, height]: [usize; 2], values: &[f64], full: f64) -> Option<RgbImage8> {
    let codes = values.iter().flat_map(|value| color(value / full));
    RgbImage8::new(width as u32, height as u32, codes.collect())
}

fn color(share: f64) -> [u8; 3] {
    if share.is_nan() {
        return NOT_A_NUMBER;
    }
    magma(share)
}

/// The color at a place from 0 to 1 in [`MAGMA`].
pub(crate) fn magma(share: f64) -> [u8; 3] {
    let (below, along) = knot_before(share.clamp(0.0, 1.0), MAGMA.len());
    std::array::from_fn(|i| {
        let (low, high) = (f64::from(MAGMA[below][i]), f64::from(MAGMA[below + 1][i]));
        (low + along * (high - low)).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_their_places_on_the_scale() {
        let values = [0.0, 5.0, 10.0, 20.0, -1.0, f64::NAN];
        let map = heat_map([3, 2], &values, 10.0).unwrap();
        let expected = [MAGMA[0], MAGMA[8], MAGMA[16], MAGMA[16], MAGMA[0]];
        for (index, expected) in (0..).zip(expected) {
            assert_eq!(map.pixel(index % 3, index / 3), Some(expected));
        }
        assert_eq!(map.pixel(2, 1), Some(NOT_A_NUMBER));
        assert!(heat_map([2, 2], &values, 10.0).is_none());
    }
}
