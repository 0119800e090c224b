//! Codes: black level taken off, the response of each channel, rounding.
//!
//! At amounts C of its primaries a display shows M C, and on top of it the light of code 0: its black level and what it reflects
//! of the room. That light is part of what the viewer sees, so it is subtracted from what is asked for. Where less is asked for
//! than the black gives, the code is 0 and the picture there as dark as the display can be.

use colorimetry::Display;
use colorimetry::matrix::times;
use rayon::prelude::*;

use super::LinearImage;
use crate::rgb_image::RgbImage;

/// A code of a picture: `u8` or `u16`.
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

/// The amounts of red, green and blue that a display's black level and flare are.
pub(super) fn black_rgb(display: &Display) -> [f64; 3] {
    times(display.rgb_from_xyz(), display.black_xyz())
}

/// The codes by which a display shows a picture. What lies outside its range is clipped; what is not a number is 0.
///
/// Without dither a code is the nearest. With it, a value between two codes is the upper one in as many pixels, of a small
/// neighborhood, as it lies close to it, so that means are kept and gradients show no steps; a value that is a code stays
/// that code, to 1 % of a step. The pattern depends on the place alone: the same picture is the same file.
pub fn codes<C: Code>(image: &LinearImage, display: &Display, dither: bool) -> RgbImage<C> {
    let black = black_rgb(display);
    let (peak, responses) = (display.peak(), display.responses());
    let width = (image.width as usize).max(1);
    let mut data = vec![C::default(); 3 * image.rgb.len()];
    data.par_chunks_mut(3 * width)
        .zip(image.rgb.par_chunks(width))
        .enumerate()
        .for_each(|(y, (codes, row))| {
            for (x, (codes, rgb)) in codes.chunks_exact_mut(3).zip(row).enumerate() {
                for channel in 0..3 {
                    // `max` takes what is not a number to 0.
                    let light = (f64::from(rgb[channel]) - black[channel])
                        .max(0.0)
                        .min(peak);
                    let value = responses[channel].code(light).clamp(0.0, 1.0) * C::MAX;
                    let up_above = if dither {
                        threshold(x, y, channel)
                    } else {
                        0.5
                    };
                    codes[channel] = C::of((value + 1.0 - up_above).floor().min(C::MAX));
                }
            }
        });
    RgbImage {
        width: image.width,
        height: image.height,
        data,
    }
}

/// How far above a whole number a value is rounded up at this place: evenly spread over (0.01, 0.99), so that rounding errors of
/// a value that is whole do not show.
///
/// Interleaved gradient noise (J. Jimenez, Next Generation Post Processing in Call of Duty: Advanced Warfare, SIGGRAPH 2014
/// course), each channel shifted by what its author gives for another frame.
fn threshold(x: usize, y: usize, channel: usize) -> f64 {
    let shift = 5.588_238 * channel as f64;
    let (x, y) = (x as f64 + shift, y as f64 + shift);
    let noise = (52.982_918_9 * (0.067_110_56 * x + 0.005_837_15 * y).fract()).fract();
    0.01 + 0.98 * noise
}
