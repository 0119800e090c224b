//! Codes: subtracting the black level, the response of each channel, rounding.
//!
//! For amounts C of its primaries, a display shows M C plus the light of code 0: its black level and its reflection of the room.
//! The viewer sees that light too, so it is subtracted from the wanted amount. Where the wanted amount is less than the black,
//! the code is 0 and the pixel is as dark as the display can make it.

use colorimetry::Display;
use colorimetry::matrix::times;
use rayon::prelude::*;

use picture_file::{Code, LinearImage, RgbImage};

/// Returns a display's black level and flare as amounts of red, green and blue.
pub(super) fn black_rgb(display: &Display) -> [f64; 3] {
    times(display.rgb_from_xyz(), display.black_xyz())
}

/// Returns the codes with which a display shows a picture. Values outside its range are clipped; NaN becomes 0.
///
/// Without dither, each value is rounded to the nearest code. With dither, a value between two codes is rounded up in a fraction of
/// the pixels of a small neighborhood that equals its distance from the lower code, so means are kept and gradients show no steps.
/// A value within 1 % of a step of a code becomes that code. The pattern depends only on the position: the same picture always
/// gives the same file.
///
/// # Panics
/// Never: a linear image has three amounts for each pixel.
pub fn codes<C: Code>(image: &LinearImage, display: &Display, dither: bool) -> RgbImage<C> {
    let black = black_rgb(display);
    let (peak, responses) = (display.peak(), display.responses());
    let width = (image.width() as usize).max(1);
    let mut data = vec![C::default(); 3 * image.rgb().len()];
    data.par_chunks_mut(3 * width)
        .zip(image.rgb().par_chunks(width))
        .enumerate()
        .for_each(|(y, (codes, row))| {
            for (x, (codes, rgb)) in codes.chunks_exact_mut(3).zip(row).enumerate() {
                for channel in 0..3 {
                    // `max` turns NaN into 0.
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
    RgbImage::new(image.width(), image.height(), data).expect("each pixel has three codes")
}

/// Returns the fractional part from which a value is rounded up at this position. It is evenly distributed over (0.01, 0.99), so
/// rounding errors of whole values do not show.
///
/// Interleaved gradient noise (J. Jimenez, Next Generation Post Processing in Call of Duty: Advanced Warfare, SIGGRAPH 2014
/// course), with each channel shifted by the offset that its author gives for successive frames.
fn threshold(x: usize, y: usize, channel: usize) -> f64 {
    let shift = 5.588_238 * channel as f64;
    let (x, y) = (x as f64 + shift, y as f64 + shift);
    let noise = (52.982_918_9 * (0.067_110_56 * x + 0.005_837_15 * y).fract()).fract();
    0.01 + 0.98 * noise
}
