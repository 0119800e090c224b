//! The axis of wavelengths, with their colors.

use crate::axes::{Axis, Labels};
use crate::picture::{Drawn, Scale};
use colorimetry::srgb;
use plotters::coord::Shift;
use plotters::prelude::*;

/// Returns the axis from one wavelength to another.
pub(crate) fn axis(ends_nm: (f64, f64)) -> Axis<'static> {
    Axis {
        range: ends_nm,
        name: "wavelength in vacuum / nm",
        labels: Labels {
            most: 9,
            decimals: 0,
        },
    }
}

/// Draws the colors of the wavelengths, as far as a display can show them, in a strip along the lower edge.
pub(crate) fn draw_colors<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    scale: Scale,
    (first, last): (f64, f64),
) -> Drawn<B> {
    let (width, height) = area.dim_in_pixel();
    let top = height as i32 - scale.px(6.0);
    let step = scale.px(1.0).max(1);
    for x in (0..width as i32).step_by(step as usize) {
        let nm = first + (last - first) * (f64::from(x) + 0.5) / f64::from(width);
        if !(380.0..=780.0).contains(&nm) {
            continue;
        }
        // One step wider than its own, so that no gap shows between neighbors.
        let strip = [(x, top), ((x + 2 * step).min(width as i32), height as i32)];
        area.draw(&Rectangle::new(strip, color_of(nm).filled()))?;
    }
    Ok(())
}

/// The color of a wavelength, made pale enough for a display.
fn color_of(nm: f64) -> RGBColor {
    let xyz = spectra::observer_1931()
        .each_ref()
        .map(|curve| curve.clamped_at(nm));
    let rgb = srgb::linear_from_xyz(xyz);
    let paleness = rgb
        .into_iter()
        .fold(0.0, |paleness: f64, v| paleness.max(-v));
    let [r, g, b] = rgb.map(|v| srgb::to_u8((v + paleness) / 1.8));
    RGBColor(r, g, b)
}
