//! A star about what is too bright for the display.
//!
//! Of a highlight the display shows as much as it can; the rest is smeared up, down, left and right, as Suzuki, Yokoi and Toriwaki
//! do in their figures 15 and 16. They give no profile: here a quarter of the excess goes each way and falls exponentially, so
//! that nothing is lost but what leaves the picture.

use super::LinearImage;

/// A star with four arms about each pixel that is too bright.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarGlare {
    /// The distance over which an arm falls to 1/e, as a share of the picture's height.
    pub length: f64,
}

impl Default for StarGlare {
    fn default() -> Self {
        Self { length: 0.05 }
    }
}

/// Takes from each pixel what exceeds `peak`, its chromaticity kept, and smears it.
pub(super) fn add(image: &mut LinearImage, star: StarGlare, peak: f64) {
    let (width, height) = (image.width as usize, image.height as usize);
    let falloff = (-1.0 / (star.length * height as f64).max(1e-3)).exp();
    let excess: Vec<[f64; 3]> = image.rgb.iter_mut().map(|rgb| excess(rgb, peak)).collect();
    if excess.iter().flatten().all(|&v| v == 0.0) {
        return;
    }
    let mut add = |line: &mut dyn Iterator<Item = usize>| {
        // What has come along this arm so far; at each step the share `falloff` of it goes on.
        let mut carried = [0.0; 3];
        for at in line {
            let pixel = &mut image.rgb[at];
            for channel in 0..3 {
                pixel[channel] += (0.25 * (1.0 - falloff) * carried[channel]) as f32;
                carried[channel] = falloff * carried[channel] + excess[at][channel];
            }
        }
    };
    for y in 0..height {
        add(&mut (y * width..(y + 1) * width));
        add(&mut (y * width..(y + 1) * width).rev());
    }
    for x in 0..width {
        add(&mut (x..width * height).step_by(width));
        add(&mut (x..width * height).step_by(width).rev());
    }
}

/// What of a colour exceeds the peak, which is left: a multiple of the colour, so that both have its chromaticity.
fn excess(rgb: &mut [f32; 3], peak: f64) -> [f64; 3] {
    let colour = rgb.map(f64::from);
    let largest = colour.into_iter().fold(0.0, f64::max);
    if largest <= peak || !colour.iter().all(|v| v.is_finite()) {
        return [0.0; 3];
    }
    *rgb = colour.map(|v| (v * peak / largest) as f32);
    colour.map(|v| v * (1.0 - peak / largest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(value: [f32; 3]) -> LinearImage {
        let mut rgb = vec![[0.25; 3]; 201 * 101];
        rgb[50 * 201 + 100] = value;
        LinearImage {
            width: 201,
            height: 101,
            rgb,
            white_cd_m2: 1.0,
        }
    }

    fn sum(image: &LinearImage) -> [f64; 3] {
        std::array::from_fn(|i| image.rgb.iter().map(|rgb| f64::from(rgb[i])).sum())
    }

    const STAR: StarGlare = StarGlare { length: 0.02 };

    #[test]
    fn four_arms_hold_the_excess() {
        let before = point([40.0, 20.0, 4.0]);
        let mut after = before.clone();
        add(&mut after, STAR, 1.0);
        for (before, after) in sum(&before).into_iter().zip(sum(&after)) {
            assert!((after / before - 1.0).abs() < 1e-6, "{before} {after}");
        }
        let at = |x: usize, y: usize| after.rgb[y * 201 + x];
        assert_eq!(at(100, 50), [1.0, 0.5, 0.1]);
        for d in 1..50 {
            let arm = at(100 + d, 50);
            for other in [at(100 - d, 50), at(100, 50 + d), at(100, 50 - d)] {
                assert_eq!(other, arm);
            }
            assert_eq!(at(100 + d, 50 + d), [0.25; 3]);
            let nearer = at(100 + d - 1, 50);
            assert!(d == 1 || arm[0] <= nearer[0]);
            assert!(d > 25 || arm[0] > 0.25);
            // The colour of the excess.
            assert!((2.0 * (arm[1] - 0.25) - (arm[0] - 0.25)).abs() < 1e-6);
        }
    }

    #[test]
    fn what_the_display_shows_stays() {
        let before = point([1.0, 0.5, -0.1]);
        let mut after = before.clone();
        add(&mut after, STAR, 1.0);
        assert_eq!(after, before);
        // On a display that goes up to 50, so does this.
        let before = point([40.0, 20.0, 4.0]);
        let mut after = before.clone();
        add(&mut after, STAR, 50.0);
        assert_eq!(after, before);
        let before = point([f32::INFINITY, 1.0, 1.0]);
        let mut after = before.clone();
        add(&mut after, STAR, 1.0);
        assert_eq!(after, before);
    }
}
