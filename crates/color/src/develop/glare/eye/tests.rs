use super::*;
use crate::develop::{DevelopSettings, Exposure, Glare, expose};
use colorimetry::Display;
use spectra::{Observer, SpectralImage};

/// ∫ f dω over the half space in front of the eye, f in steradians⁻¹.
fn integral(index: usize, nm: f64) -> f64 {
    // θ = e^u − 0.02 resolves the core and the tail alike.
    let (low, high) = (0.02_f64.ln(), 90.02_f64.ln());
    let steps = 200_000;
    let du = (high - low) / f64::from(steps);
    let at = |i: i32| {
        let near = (low + (f64::from(i) + 0.5) * du).exp();
        let theta = near - 0.02;
        let ring = 2.0 * std::f64::consts::PI * theta.to_radians().sin();
        point_spread(theta, nm)[index] * ring * near.to_radians() * du
    };
    (0..steps).map(at).sum()
}

/// Spencer's constants normalize each function to spread all of the light: f₀, f₁ and the halo exactly; f₂ to a few percent,
/// because of its long tail.
#[test]
fn each_function_holds_all_light() {
    for (index, nm, tolerance) in [
        (0, 568.0, 2e-3),
        (1, 568.0, 2e-3),
        (2, 568.0, 0.08),
        (3, 400.0, 2e-3),
        (3, 568.0, 2e-3),
        (3, 700.0, 2e-3),
    ] {
        let sum = integral(index, nm);
        println!("f{index} at {nm} nm: {sum:.4}");
        assert!((sum - 1.0).abs() < tolerance, "f{index} {nm} {sum}");
    }
    for vision in [Vision::Photopic, Vision::Mesopic, Vision::Scotopic] {
        let sum: f64 = vision.shares().iter().sum();
        assert!((sum - 1.0).abs() < 1e-12);
    }
}

/// The error of the core f₀ and of the halo is relative to their maximum, that of the others relative to the value.
#[test]
fn pixels_hold_the_mean_of_the_functions() {
    for pixel in [0.02, 0.2, 0.5] {
        let mut worst = [0.0_f64; 4];
        let ring = (3.0 / pixel) as usize;
        let near = [[0, 0], [1, 0], [1, 1], [2, 1], [5, 3]];
        let about_ring = (0..=6).map(|i| [ring + i - 3, i]);
        for at in near.into_iter().chain(about_ring) {
            for nm in [420.0, 568.0, 700.0] {
                for (i, worst) in worst.iter_mut().enumerate() {
                    let parts = if i < 3 {
                        core_parts(at, pixel)
                    } else {
                        halo_parts(pixel)
                    };
                    let f = |theta| point_spread(theta, nm)[i];
                    let found = over_pixel(at, pixel, parts, f);
                    let fine = over_pixel(at, pixel, 500, f);
                    let brightest = point_spread(3.0 * nm / 568.0, nm)[3];
                    let core = || over_pixel([0, 0], pixel, 500, f);
                    let whole = match i {
                        0 => core(),
                        3 => brightest,
                        _ => fine,
                    };
                    *worst = worst.max((found - fine).abs() / whole);
                }
            }
        }
        println!("{pixel}° per pixel: {worst:.5?}");
        assert!(worst.iter().all(|&v| v < 0.015), "{pixel} {worst:?}");
        assert!(worst[3] < 0.004, "{pixel} {worst:?}");
    }
}

const SIZE: [usize; 2] = [24, 16];
const BANDS: u32 = 5;

/// An image with a lamp of one band and some light elsewhere; its XYZ is slightly more than its bands add up to.
fn image(lamp: f32, lamp_band: usize) -> SpectralImage {
    image_for(lamp, lamp_band, Observer::Cie1931Deg2)
}

fn image_for(lamp: f32, lamp_band: usize, observer: Observer) -> SpectralImage {
    let grid = BandGrid::visible(BANDS).unwrap();
    let observer = BandWeights::observed(&grid, observer);
    let mut image = SpectralImage::new(SIZE[0] as u32, SIZE[1] as u32, grid);
    for y in 0..SIZE[1] as u32 {
        for x in 0..SIZE[0] as u32 {
            let mut radiance = vec![0.1 * (1 + (x * 7 + y * 3) % 5) as f32; BANDS as usize];
            if (x, y) == (9, 6) {
                radiance[lamp_band] = lamp;
            }
            let xyz = observer.xyz(&radiance).map(|v| (1.01 * v) as f32);
            image.set_pixel((x, y), &radiance, &[0.0; BANDS as usize], xyz, 1);
        }
    }
    image
}

fn eye(vision: Vision) -> EyeGlare {
    EyeGlare {
        degrees_per_pixel: 0.5,
        vision,
    }
}

fn exposed(image: &SpectralImage, glare: Glare) -> LinearImage {
    exposed_for(image, glare, Observer::Cie1931Deg2)
}

fn exposed_for(image: &SpectralImage, glare: Glare, observer: Observer) -> LinearImage {
    let settings = DevelopSettings {
        observer,
        exposure: Exposure::Stops(0.0),
        glare,
        ..DevelopSettings::new(Display::named("srgb").unwrap())
    };
    expose(image, &settings).unwrap()
}

fn mirrored(at: isize, size: usize) -> usize {
    let size = size as isize;
    let at = at.rem_euclid(2 * size);
    at.min(2 * size - 1 - at) as usize
}

/// Direct sum: every pixel spreads the light of every band over every other pixel.
fn direct(image: &SpectralImage, eye: EyeGlare, observer: Observer) -> Vec<[f64; 3]> {
    let plain = exposed(image, Glare::Off);
    let scale = relight::xyz::exposure_scale(0.0);
    let display = Display::named("srgb").unwrap();
    let observer = BandWeights::observed(image.bands(), observer);
    let shares = eye.vision.shares();
    let kernel = |nm: f64, dx: usize, dy: usize| {
        let (at, pixel) = ([dx, dy], eye.degrees_per_pixel);
        let core = over_pixel(at, pixel, core_parts(at, pixel), |theta| {
            let f = point_spread(theta, nm);
            (0..3).map(|i| shares[i] * f[i]).sum()
        });
        let halo = |theta| shares[3] * point_spread(theta, nm)[3];
        core + over_pixel(at, pixel, halo_parts(pixel), halo)
    };
    let [w, h] = SIZE.map(|v| v as isize);
    let mut result = vec![[0.0; 3]; SIZE[0] * SIZE[1]];
    let mut spread = |nm: f64, light: &dyn Fn(usize) -> [f64; 3]| {
        let offsets = (1 - h..=h).flat_map(|dy| (1 - w..=w).map(move |dx| (dx, dy)));
        let kernel: Vec<((isize, isize), f64)> = offsets
            .map(|(dx, dy)| ((dx, dy), kernel(nm, dx.unsigned_abs(), dy.unsigned_abs())))
            .collect();
        let sum: f64 = kernel.iter().map(|(_, k)| k).sum();
        for y in 0..h {
            for x in 0..w {
                for &((dx, dy), k) in &kernel {
                    let from = mirrored(y + dy, SIZE[1]) * SIZE[0] + mirrored(x + dx, SIZE[0]);
                    let light = light(from);
                    for c in 0..3 {
                        result[(y * w + x) as usize][c] += light[c] * k / sum;
                    }
                }
            }
        }
    };
    let band_rgb = |i: usize, band: usize| {
        let value = f64::from(image.radiance()[i * BANDS as usize + band]);
        times(
            display.rgb_from_xyz(),
            observer.weights()[band].map(|w| w * value * scale),
        )
    };
    for band in 0..BANDS as usize {
        let nm = image.bands().center_nm(band as u32);
        spread(nm, &|i| band_rgb(i, band));
    }
    spread(MEAN_NM, &|i| {
        let mut rest = plain.rgb()[i].map(f64::from);
        for band in 0..BANDS as usize {
            let rgb = band_rgb(i, band);
            for c in 0..3 {
                rest[c] -= rgb[c];
            }
        }
        rest
    });
    result
}

/// The largest difference of a picture from the direct sum.
fn worst(found: &LinearImage, expected: &[[f64; 3]]) -> f64 {
    let found = found.rgb().as_flattened().iter();
    let pairs = found.zip(expected.as_flattened());
    pairs.fold(0.0, |worst, (&found, expected)| {
        worst.max((f64::from(found) - expected).abs())
    })
}

#[test]
fn it_is_the_direct_sum() {
    let of_1931 = Observer::Cie1931Deg2;
    for observer in [of_1931, Observer::Cie1964Deg10] {
        let image = image_for(50.0, 1, observer);
        for vision in [Vision::Photopic, Vision::Mesopic, Vision::Scotopic] {
            let glare = Glare::Eye(eye(vision));
            let expected = direct(&image, eye(vision), observer);
            let found = worst(&exposed_for(&image, glare, observer), &expected);
            // The picture is kept in f32, and its brightest value is about 20.
            assert!(found < 2e-5, "{observer} {vision:?} {found}");
            // Without a halo the bands are not used.
            if observer != of_1931 && vision != Vision::Photopic {
                let mistaken = worst(&exposed_for(&image, glare, of_1931), &expected);
                assert!(mistaken > 5.0 * 2e-5, "{vision:?} {mistaken}");
            }
        }
    }
}

fn sum(image: &LinearImage) -> [f64; 3] {
    std::array::from_fn(|c| image.rgb().iter().map(|rgb| f64::from(rgb[c])).sum())
}

#[test]
fn no_light_is_lost_and_it_is_linear() {
    for vision in [Vision::Photopic, Vision::Mesopic, Vision::Scotopic] {
        let glare = Glare::Eye(eye(vision));
        let (one, two) = (image(50.0, 3), image(100.0, 3));
        let none = image(0.0, 3);
        let developed = [&none, &one, &two].map(|image| exposed(image, glare));
        for c in 0..3 {
            let (before, after) = (sum(&exposed(&one, Glare::Off)), sum(&developed[1]));
            assert!(
                (after[c] / before[c] - 1.0).abs() < 1e-6,
                "{before:?} {after:?}"
            );
            for i in 0..one.xyz().len() {
                let [none, one, two] = developed.each_ref().map(|d| f64::from(d.rgb()[i][c]));
                assert!(
                    (two - none - 2.0 * (one - none)).abs() < 2e-5,
                    "{none} {one} {two}"
                );
            }
        }
    }
}

/// The halo of red light is wider than that of blue light, since its wavelength is longer.
#[test]
fn the_halo_follows_wavelength() {
    let radius_deg = |nm: f64| {
        let angles = (0..900).map(|i| f64::from(i) * 0.01);
        let brightest =
            angles.max_by(|&a, &b| point_spread(a, nm)[3].total_cmp(&point_spread(b, nm)[3]));
        brightest.unwrap()
    };
    for nm in [420.0, 568.0, 700.0] {
        assert!((radius_deg(nm) - 3.0 * nm / 568.0).abs() < 0.006);
    }
}

#[test]
fn an_even_picture_stays_even_and_what_is_no_number_stays_alone() {
    let grid = BandGrid::visible(BANDS).unwrap();
    let mut image = SpectralImage::new(SIZE[0] as u32, SIZE[1] as u32, grid);
    for y in 0..SIZE[1] as u32 {
        for x in 0..SIZE[0] as u32 {
            let luminance = relight::xyz::equal_energy_luminance() as f32;
            image.set_pixel((x, y), &[1.0; 5], &[0.0; 5], [luminance; 3], 1);
        }
    }
    let glare = Glare::Eye(eye(Vision::Scotopic));
    let (before, after) = (exposed(&image, Glare::Off), exposed(&image, glare));
    for (before, after) in before.rgb().iter().zip(after.rgb()) {
        for c in 0..3 {
            assert!((before[c] - after[c]).abs() < 1e-6, "{before:?} {after:?}");
        }
    }
    image.set_pixel((3, 3), &[f32::NAN; 5], &[0.0; 5], [f32::NAN; 3], 1);
    let with_nan = exposed(&image, glare);
    let odd = with_nan.rgb().iter().filter(|rgb| rgb[0].is_nan()).count();
    assert_eq!(odd, 1);
}

#[test]
fn colors_without_spectra_have_no_halo() {
    let image = relight::XyzImage::from(&image(50.0, 3));
    let with = |vision| DevelopSettings {
        glare: Glare::Eye(eye(vision)),
        ..DevelopSettings::srgb(0.0)
    };
    let found = expose(&image, &with(Vision::Mesopic));
    assert_eq!(found, Err(DevelopError::NoSpectrum));
    assert!(expose(&image, &with(Vision::Photopic)).is_ok());
}
