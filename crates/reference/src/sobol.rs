//! Points that fill the unit cube uniformly, bit for bit those of `shaders/sobol.wgsl`.
//!
//! Four dimensions of Sobol's sequence with Owen scrambling (1995) by hashing (Burley, Practical Hash-based Owen Scrambling, JCGT
//! 9(4), 2020). Each group of four dimensions of a path has its own points, in another order.

use crate::{pcg4d, unit_interval};

/// Number of significant digits of an index: a pixel has at most 2²⁴ samples.
const DIGITS: usize = 24;

/// Direction numbers of the four dimensions.
const DIRECTIONS: [[u32; DIGITS]; 4] = [
    directions(0, 0, [0, 0, 0]),
    directions(1, 0, [1, 0, 0]),
    directions(2, 1, [1, 3, 0]),
    directions(3, 1, [1, 3, 1]),
];

/// Returns direction numbers by the recurrence of a primitive polynomial over GF(2) of `degree`, with `coefficients` of its inner
/// terms and the first numbers `m` (Joe and Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J. Sci.
/// Comput. 30, 2008, equation 2 and their table new-joe-kuo-6). Degree 0 is the first dimension, van der Corput's.
const fn directions(degree: usize, coefficients: u32, m: [u32; 3]) -> [u32; DIGITS] {
    let mut v = [0; DIGITS];
    let mut i = 0;
    while i < DIGITS {
        v[i] = if degree == 0 {
            1 << (31 - i)
        } else if i < degree {
            m[i] << (31 - i)
        } else {
            let mut next = v[i - degree] ^ (v[i - degree] >> degree);
            let mut k = 1;
            while k < degree {
                if coefficients >> (degree - 1 - k) & 1 == 1 {
                    next ^= v[i - k];
                }
                k += 1;
            }
            next
        };
        i += 1;
    }
    v
}

/// Returns a point of Sobol's sequence, each number in units of 2⁻³².
pub fn sobol_point(index: u32) -> [u32; 4] {
    DIRECTIONS.map(|directions| {
        let of_digit = |(i, &v): (usize, &u32)| if index >> i & 1 == 1 { v } else { 0 };
        let numbers = directions.iter().enumerate().map(of_digit);
        numbers.fold(0, |sum, number| sum ^ number)
    })
}

/// Points, with their bits reversed, of the indices that are zero outside one byte; the byte's highest bit is the lowest digit. A
/// point is the sum (XOR) of the points of its index's bytes.
static REVERSED_BY_BYTE: [[[u32; 4]; 256]; DIGITS / 8] = reversed_by_byte();

const fn reversed_by_byte() -> [[[u32; 4]; 256]; DIGITS / 8] {
    let mut points = [[[0; 4]; 256]; DIGITS / 8];
    let mut place = 0;
    while place < DIGITS / 8 * 256 * 32 {
        let (byte, value) = (place / 8192, place / 32 % 256);
        let (dimension, digit) = (place % 4, place / 4 % 8);
        if value >> (7 - digit) & 1 == 1 {
            let number = DIRECTIONS[dimension][8 * byte + digit];
            points[byte][value][dimension] ^= number.reverse_bits();
        }
        place += 1;
    }
    points
}

/// Like [`sobol_point`], but with the bits of the index and of the result reversed.
fn sobol_point_reversed(index: u32) -> [u32; 4] {
    let bytes = index.to_be_bytes();
    let [a, b, c] = std::array::from_fn(|i| REVERSED_BY_BYTE[i][bytes[i] as usize]);
    std::array::from_fn(|i| a[i] ^ b[i] ^ c[i])
}

/// Returns Owen's nested uniform scrambling of a number with its bits reversed: a bit is flipped by a hash of the bits below it
/// (Laine and Karras, Comput. Graph. Forum 30, 2011, with the steps of Vegdahl, 2021).
pub fn scrambled_reversed(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

/// The scrambling of four dimensions of a pixel.
#[derive(Clone, Copy, Default)]
struct Scrambling {
    order: u32,
    seeds: [u32; 4],
}

impl Scrambling {
    fn new(pixel: [u32; 2], dimension: u32, seed: u32) -> Self {
        let key = pcg4d([pixel[0] | (pixel[1] << 16), dimension, seed, 0x50b01]);
        Self {
            order: key[0],
            seeds: pcg4d(key),
        }
    }

    #[inline]
    fn numbers(&self, sample: u32) -> SobolNumbers {
        let index = scrambled_reversed(sample.reverse_bits(), self.order);
        SobolNumbers {
            point: sobol_point_reversed(index),
            seeds: self.seeds,
        }
    }
}

/// Four numbers, each scrambled on demand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SobolNumbers {
    point: [u32; 4],
    seeds: [u32; 4],
}

impl SobolNumbers {
    #[inline]
    pub(crate) fn get(&self, lane: usize) -> f64 {
        let bits = scrambled_reversed(self.point[lane], self.seeds[lane]).reverse_bits();
        unit_interval([bits])[0]
    }
}

/// Returns four numbers in [0, 1) for a pixel of the whole picture, a sample and a dimension.
pub fn sobol4(pixel: [u32; 2], sample: u32, dimension: u32, seed: u32) -> [f64; 4] {
    let numbers = Scrambling::new(pixel, dimension, seed).numbers(sample);
    std::array::from_fn(|lane| numbers.get(lane))
}

/// [`sobol4`] for the samples of a pixel, which share everything that depends only on the pixel.
pub(crate) struct SobolPixel {
    pixel: [u32; 2],
    seed: u32,
    /// Changes with the pixel.
    epoch: u32,
    /// Indexed by the last digits of the dimension: the epoch, the dimension and its scrambling.
    known: Vec<(u32, u32, Scrambling)>,
}

impl SobolPixel {
    const KNOWN: usize = 256;

    pub(crate) fn new(seed: u32) -> Self {
        Self {
            pixel: [0; 2],
            seed,
            epoch: 1,
            known: vec![Default::default(); Self::KNOWN],
        }
    }

    /// Announces that the following samples belong to this pixel.
    pub(crate) fn begin(&mut self, pixel: [u32; 2]) {
        if pixel != self.pixel {
            self.pixel = pixel;
            self.epoch = self.epoch.wrapping_add(1);
        }
    }

    #[inline]
    pub(crate) fn numbers(&mut self, sample: u32, dimension: u32) -> SobolNumbers {
        let (epoch, of, scrambling) = &mut self.known[dimension as usize % Self::KNOWN];
        if (*epoch, *of) != (self.epoch, dimension) {
            *scrambling = Scrambling::new(self.pixel, dimension, self.seed);
            (*epoch, *of) = (self.epoch, dimension);
        }
        scrambling.numbers(sample)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first points agree with those published: Joe and Kuo's generator gives these for dimensions 1 to 4.
    #[test]
    fn the_sequence_begins_as_published() {
        let expected = [
            [0.0, 0.0, 0.0, 0.0],
            [0.5, 0.5, 0.5, 0.5],
            [0.25, 0.75, 0.75, 0.75],
            [0.75, 0.25, 0.25, 0.25],
            [0.125, 0.625, 0.375, 0.125],
            [0.625, 0.125, 0.875, 0.625],
            [0.375, 0.375, 0.625, 0.875],
            [0.875, 0.875, 0.125, 0.375],
        ];
        // Their order is that of Gray's code, which permutes each block of 2ᵐ points.
        let found: Vec<[f64; 4]> = (0..8)
            .map(|i| sobol_point(i).map(|x| f64::from(x) / 2_f64.powi(32)))
            .collect();
        for point in expected {
            assert!(found.contains(&point), "{point:?} is not in {found:?}");
        }
    }

    #[test]
    fn points_by_bytes_are_those_by_digits() {
        for i in 0..100_000_u32 {
            let index = i.wrapping_mul(0x9e37_79b9);
            let found = sobol_point_reversed(index.reverse_bits());
            assert_eq!(found.map(u32::reverse_bits), sobol_point(index));
        }
    }

    #[test]
    fn samples_of_a_pixel_are_those_of_any() {
        let mut of_pixel = SobolPixel::new(7);
        for i in 0..10_000_u32 {
            let hash = pcg4d([i, 1, 2, 3]);
            let (pixel, dimension) = ([hash[0] % 3, 5], hash[1] % 1024);
            of_pixel.begin(pixel);
            let found = of_pixel.numbers(hash[2] % 64, dimension);
            let found = std::array::from_fn(|lane| found.get(lane));
            assert_eq!(found, sobol4(pixel, hash[2] % 64, dimension, 7));
        }
    }

    /// Every interval of 2⁻ᵐ contains one number of each run of 2ᵐ samples, and every elementary rectangle of area 2⁻ᵐ contains one
    /// point of the first two of the four numbers, which are a (0, 2)-sequence.
    #[test]
    fn samples_lie_in_every_elementary_interval() {
        let fills = |cells: Vec<usize>, count: usize| {
            let mut met = vec![0; count];
            for cell in cells {
                met[cell] += 1;
            }
            met.iter().all(|&n| n == 1)
        };
        for (case, m) in (0..60_u32).zip((1..=8_u32).cycle()) {
            let count = 1_usize << m;
            let pixel = [case * 7, 5];
            let first = (case % 5) << m;
            let points: Vec<_> = (first..first + (1 << m))
                .map(|sample| sobol4(pixel, sample, case, 3))
                .collect();
            for lane in 0..4 {
                let cells = points.iter().map(|p| (p[lane] * count as f64) as usize);
                assert!(fills(cells.collect(), count), "case {case}, lane {lane}");
            }
            for across in 0..=m {
                let (columns, rows) = (1_usize << across, 1_usize << (m - across));
                let cell = |p: &[f64; 4]| {
                    (p[0] * columns as f64) as usize + columns * (p[1] * rows as f64) as usize
                };
                let cells = points.iter().map(cell).collect();
                assert!(
                    fills(cells, count),
                    "case {case}: {columns} × {rows} rectangles"
                );
            }
        }
        assert!(!fills(vec![0, 0], 2), "two points in one cell are detected");
    }

    /// Different pixels, dimensions and seeds have independent points: pairs of their numbers are uniform. Chi-square over
    /// 16 × 16 cells, 255 degrees of freedom, 0.1 % on either side.
    #[test]
    fn dimensions_and_pixels_do_not_know_of_each_other() {
        let pairs: [fn(u32) -> (f64, f64); 4] = [
            |i| (sobol4([i, 1], 5, 2, 9)[0], sobol4([i + 1, 1], 5, 2, 9)[0]),
            |i| (sobol4([i, 1], 5, 2, 9)[1], sobol4([i, 1], 5, 3, 9)[1]),
            |i| (sobol4([i, 1], 6, 2, 9)[2], sobol4([i, 1], 6, 2, 10)[2]),
            |i| (sobol4([i, 1], 6, 2, 9)[0], sobol4([i, 1], 6, 2, 9)[3]),
        ];
        for (which, pair) in pairs.into_iter().enumerate() {
            let mut cells = [0_u32; 256];
            let count = 40_000;
            for i in 0..count {
                let (a, b) = pair(i);
                cells[(a * 16.0) as usize + 16 * (b * 16.0) as usize] += 1;
            }
            let expected = f64::from(count) / 256.0;
            let terms = cells
                .iter()
                .map(|&c| (f64::from(c) - expected).powi(2) / expected);
            let chi2: f64 = terms.sum();
            assert!((190.0..332.0).contains(&chi2), "pair {which}: {chi2}");
        }
    }
}
