//! Random numbers as a function of (pixel, sample, dimension, seed), bit for bit those of `shaders/random.wgsl`.

/// The generator pcg4d (Jarzynski and Olano, Hash Functions for GPU Rendering, JCGT 9(3), 2020).
pub fn pcg4d(key: [u32; 4]) -> [u32; 4] {
    let v = key.map(|k| k.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    stir(stir(v).map(|x| x ^ (x >> 16)))
}

/// One round: the product of two other numbers is added to each number.
fn stir([mut x, mut y, mut z, mut w]: [u32; 4]) -> [u32; 4] {
    x = x.wrapping_add(y.wrapping_mul(w));
    y = y.wrapping_add(z.wrapping_mul(x));
    z = z.wrapping_add(x.wrapping_mul(y));
    w = w.wrapping_add(y.wrapping_mul(z));
    [x, y, z, w]
}

/// Returns the upper 24 bits as a multiple of 2⁻²⁴ in [0, 1).
pub fn unit_interval<const N: usize>(bits: [u32; N]) -> [f64; N] {
    bits.map(|b| f64::from(b >> 8) * (0.5_f64).powi(24))
}

/// Returns four numbers in [0, 1) for a pixel of the whole picture, a sample and a dimension.
pub fn random4(pixel: [u32; 2], sample: u32, dimension: u32, seed: u32) -> [f64; 4] {
    let place = pixel[0] | (pixel[1] << 16);
    unit_interval(pcg4d([place, sample, dimension, seed]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each of the four numbers is uniform: chi-square over 64 cells, 63 degrees of freedom, 0.1 % on either side.
    #[test]
    fn every_component_is_uniform_over_pixels_samples_and_dimensions() {
        for lane in 0..4 {
            let mut cells = [0_u32; 64];
            let mut count = 0;
            for pixel in 0..64 {
                for sample in 0..16 {
                    for dimension in 0..16 {
                        let u = random4([pixel, pixel / 3], sample, dimension, 7)[lane];
                        cells[(u * 64.0) as usize] += 1;
                        count += 1;
                    }
                }
            }
            let expected = f64::from(count) / 64.0;
            let chi2: f64 = cells
                .iter()
                .map(|&c| (f64::from(c) - expected).powi(2) / expected)
                .sum();
            assert!((33.0..108.0).contains(&chi2), "lane {lane}: {chi2}");
        }
    }
}
