//! Star-shaped glare around pixels that are too bright for the display.
//!
//! The display shows as much of a highlight as it can. The excess is smeared up, down, left and right, as in figures 15 and 16 of
//! Suzuki, Yokoi and Toriwaki. They give no profile: here a quarter of the excess goes in each direction, starting at the
//! highlight itself, and falls off exponentially. Only light that leaves the picture is lost, and no arm is brighter than its
//! origin.

use colorimetry::Display;

use picture_file::LinearImage;

/// A star with four arms around each pixel whose luminance is above the display's brightest white. Saturated colors that are no
/// brighter are left to gamut mapping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarGlare {
    /// The distance over which an arm falls to 1/e, as a fraction of the picture's height.
    pub length: f64,
}

impl Default for StarGlare {
    fn default() -> Self {
        Self { length: 0.05 }
    }
}

/// Removes from each pixel the light above the luminance of `display`'s peak, keeping its chromaticity, and smears it.
pub(super) fn add(image: &mut LinearImage, star: StarGlare, display: &Display) {
    let (luminance, peak) = (display.xyz_from_rgb()[1], display.peak());
    let (width, height) = (image.width() as usize, image.height() as usize);
    let falloff = (-1.0 / (star.length * height as f64).max(1e-3)).exp();
    let excess: Vec<[f64; 3]> = image
        .rgb_mut()
        .iter_mut()
        .map(|rgb| excess(rgb, luminance, peak))
        .collect();
    if excess.iter().flatten().all(|&v| v == 0.0) {
        return;
    }
    let mut add = |line: &mut dyn Iterator<Item = usize>| {
        // The light carried along this arm so far, including the pixel's own; the fraction `falloff` continues at each step.
        let mut carried = [0.0; 3];
        for at in line {
            let pixel = &mut image.rgb_mut()[at];
            for channel in 0..3 {
                carried[channel] = falloff * carried[channel] + excess[at][channel];
                pixel[channel] += (0.25 * (1.0 - falloff) * carried[channel]) as f32;
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

/// Returns the part of a color above the peak and leaves the color at the peak. Both are multiples of the color, so they keep its
/// chromaticity.
fn excess(rgb: &mut [f32; 3], luminance: [f64; 3], peak: f64) -> [f64; 3] {
    let color = rgb.map(f64::from);
    let y: f64 = (0..3).map(|i| luminance[i] * color[i]).sum();
    if !(y > peak && y.is_finite()) {
        return [0.0; 3];
    }
    *rgb = color.map(|v| (v * peak / y) as f32);
    color.map(|v| v * (1.0 - peak / y))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(value: [f32; 3]) -> LinearImage {
        let mut rgb = vec![[0.25; 3]; 201 * 101];
        rgb[50 * 201 + 100] = value;
        LinearImage::new(201, 101, rgb, 1.0).unwrap()
    }

    fn sum(image: &LinearImage) -> [f64; 3] {
        std::array::from_fn(|i| image.rgb().iter().map(|rgb| f64::from(rgb[i])).sum())
    }

    fn srgb() -> Display {
        Display::named("srgb").unwrap()
    }

    const STAR: StarGlare = StarGlare { length: 0.02 };

    #[test]
    fn four_arms_hold_the_excess() {
        let before = point([40.0, 20.0, 4.0]);
        let mut after = before.clone();
        add(&mut after, STAR, &srgb());
        for (before, after) in sum(&before).into_iter().zip(sum(&after)) {
            assert!((after / before - 1.0).abs() < 1e-6, "{before} {after}");
        }
        let at = |x: usize, y: usize| after.rgb()[y * 201 + x];
        // The center has the luminance of the white and its part of each arm.
        let share = f64::from(at(101, 50)[0] - 0.25) / (-1.0 / (0.02 * 101.0_f64)).exp();
        let y = 0.212_639 * 40.0 + 0.715_169 * 20.0 + 0.072_192 * 4.0;
        let expected = 40.0 / y + 4.0 * share;
        assert!(
            (f64::from(at(100, 50)[0]) / expected - 1.0).abs() < 1e-5,
            "{expected}"
        );
        assert!(at(100, 50)[0] > at(101, 50)[0]);
        for d in 1..50 {
            let arm = at(100 + d, 50);
            for other in [at(100 - d, 50), at(100, 50 + d), at(100, 50 - d)] {
                assert_eq!(other, arm);
            }
            assert_eq!(at(100 + d, 50 + d), [0.25; 3]);
            let nearer = at(100 + d - 1, 50);
            assert!(d == 1 || arm[0] <= nearer[0]);
            assert!(d > 25 || arm[0] > 0.25);
            // The color of the excess.
            assert!((2.0 * (arm[1] - 0.25) - (arm[0] - 0.25)).abs() < 1e-6);
        }
    }

    #[test]
    fn what_the_display_shows_stays() {
        let before = point([1.0, 0.5, -0.1]);
        let mut after = before.clone();
        add(&mut after, STAR, &srgb());
        assert_eq!(after, before);
        // A display that shows up to 49 times its white leaves this color unchanged too.
        let before = point([40.0, 20.0, 4.0]);
        let mut after = before.clone();
        add(&mut after, STAR, &Display::named("bt2100_pq").unwrap());
        assert_eq!(after, before);
        let before = point([f32::INFINITY, 1.0, 1.0]);
        let mut after = before.clone();
        add(&mut after, STAR, &srgb());
        assert_eq!(after, before);
    }
}
