//! The image of a small emitter, as spread by the lens and by the pixel filter.

use super::comparison::{LAMBERT, pictures, scene};
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::{OUT_OF_FOCUS, PIXEL_FILTER};
use spectra::SpectralImage;
use std::f64::consts::{PI, TAU};

/// Side of the picture in pixels; odd, so that one pixel is in the middle.
const SIDE: u32 = 15;
/// Distance of the plane of focus, and the side of a pixel there.
const FOCUS: f64 = 4.0;
const PIXEL: f64 = 0.02;

/// A perspective camera with further settings, and an emitter on its axis.
fn lamp_on_the_axis(camera: &str, samples: u32, distance: f64, radius: f64) -> scene::Scene {
    let fov = 2.0 * (f64::from(SIDE) * PIXEL / 2.0 / FOCUS).atan().to_degrees();
    let text = format!(
        "[camera]\ntype = \"perspective\"\nposition = [0, 0, 0]\nlook_at = [0, 0, -1]\nfov_deg = {fov}\n{camera}\n\
         [render]\nsize = [{SIDE}, {SIDE}]\nsamples = {samples}\nbands = 1\nmax_path_segments = 1\n\
         [[objects]]\ntype = \"sphere\"\nmaterial = \"lamp\"\ncenter = [0, 0, {:?}]\nradius = {radius:?}\n",
        -distance
    );
    scene(&[&text, LAMBERT])
}

/// Positions of pixels, relative to the middle, and their light.
fn lit(image: &SpectralImage) -> impl Iterator<Item = ([f64; 2], f64)> {
    let pixels = (0..SIDE * SIDE).map(|i| [i % SIDE, i / SIDE]);
    let middle = f64::from(SIDE / 2);
    pixels.map(move |[x, y]| {
        let from_middle = [x, y].map(|i| f64::from(i) - middle);
        (from_middle, f64::from(image.pixel(x, y)[0]))
    })
}

/// Similar triangles: at the plane of focus a point at distance z becomes the lens's disk times |1 − f/z|. Its mean r² is half of the
/// radius squared; the emitter's own disk adds half of its radius squared, and sorting into pixels a twelfth of a pixel squared for each
/// axis (Sheppard).
#[test]
fn a_lamp_out_of_focus_becomes_the_disk_of_the_lens() {
    const LENS: f64 = 0.1;
    let gpu = lend();
    // Radius of the emitter's own disk there, in pixels.
    let own = 1.0_f64;
    for distance in [2.0, 2.5, 20.0] {
        let lens = format!("lens = {{ radius = {LENS}, focus_distance = {FOCUS} }}");
        let blurred = lamp_on_the_axis(&lens, 16_384, distance, own * PIXEL * distance / FOCUS);
        let disk = LENS * (1.0 - FOCUS / distance).abs() / PIXEL;
        for (who, image) in pictures(&gpu, &blurred) {
            let light: f64 = lit(&image).map(|(_, value)| value).sum();
            let spread = lit(&image).map(|([x, y], value)| value * (x * x + y * y));
            let (found, expected) = (
                spread.sum::<f64>() / light,
                f64::midpoint(disk * disk, own * own) + 1.0 / 6.0,
            );
            println!(
                "lamp at {distance}, {who}: mean r² {found:.4}, expected {expected:.4} pixels²; light {light:.4}"
            );
            assert!(
                (found / expected - 1.0).abs() < OUT_OF_FOCUS,
                "lamp at {distance}, {who}: {found} instead of {expected}"
            );
            // The lens neither removes nor adds light: the total is that of the emitter's own disk.
            let whole = PI * own * own;
            assert!(
                (light / whole - 1.0).abs() < OUT_OF_FOCUS,
                "lamp at {distance}, {who}: {light} instead of {whole}"
            );
            let beyond = |([x, y], value): &([f64; 2], f64)| {
                *value > 0.0 && x.hypot(*y) > disk + own + 0.5_f64.sqrt()
            };
            assert!(lit(&image).find(beyond).is_none(), "{distance}, {who}");
        }
    }
}

#[test]
fn a_lamp_in_focus_is_a_point() {
    let gpu = lend();
    let lens = format!("lens = {{ radius = 0.5, focus_distance = {FOCUS} }}");
    // Such a wide lens sees the emitter's front from the side, where it extends slightly beyond the plane.
    let sharp = lamp_on_the_axis(&lens, 256, FOCUS, 0.2 * PIXEL);
    for (who, image) in pictures(&gpu, &sharp) {
        let lit: Vec<_> = lit(&image).filter(|(_, value)| *value > 0.0).collect();
        assert_eq!(lit.len(), 1, "{who}: {lit:?}");
        assert_eq!(lit[0].0, [0.0; 2], "{who}");
    }
}

/// The light of a small emitter in a pixel is the mean of the pixel's filter over the emitter's disk. Gaussian: exp(−x²/2σ²), σ half a
/// pixel; Harris's window over 3 pixels (1978, equation 33).
#[test]
fn a_lamp_is_weighted_by_the_pixel_filter() {
    const LAMP: f64 = 0.45;
    let gaussian = |x: f64| (-2.0 * x * x).exp();
    let window = |x: f64| {
        let turn = PI * x / 1.5;
        0.358_75
            + 0.488_29 * turn.cos()
            + 0.141_28 * (2.0 * turn).cos()
            + 0.011_68 * (3.0 * turn).cos()
    };
    let gpu = lend();
    for (name, filter) in [
        ("gaussian", &gaussian as &dyn Fn(f64) -> f64),
        ("blackman_harris", &window),
    ] {
        let weight = |[x, y]: [f64; 2]| {
            let on_disk = |i: u32| {
                let (radius, angle) = (
                    LAMP * (f64::from(i / 32) + 0.5).sqrt() / 32.0_f64.sqrt(),
                    f64::from(i % 32) / 32.0 * TAU,
                );
                let [x, y] = [x + radius * angle.cos(), y + radius * angle.sin()];
                if x.abs().max(y.abs()) < 1.5 {
                    filter(x) * filter(y)
                } else {
                    0.0
                }
            };
            (0..1024).map(on_disk).sum::<f64>() / 1024.0
        };
        let seen = lamp_on_the_axis(&format!("filter = \"{name}\""), 16_384, FOCUS, LAMP * PIXEL);
        for (who, image) in pictures(&gpu, &seen) {
            let light: f64 = lit(&image).map(|(_, value)| value).sum();
            let whole: f64 = lit(&image).map(|(at, _)| weight(at)).sum();
            for (at, value) in lit(&image) {
                let (found, expected) = (value / light, weight(at) / whole);
                assert!(
                    (found - expected).abs() < PIXEL_FILTER,
                    "{name} at {at:?}, {who}: {found} instead of {expected}"
                );
            }
        }
    }
}
