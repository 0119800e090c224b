use super::*;
use colorimetry::display::Response;
use colorimetry::srgb;
use relight::xyz::equal_energy_luminance;

/// An image of one row with these colors, as XYZ relative to Y = 1 of the white.
pub(crate) fn row(colors: &[[f64; 3]]) -> XyzImage {
    let xyz = colors
        .iter()
        .map(|color| color.map(|v| (v * equal_energy_luminance()) as f32));
    XyzImage::new(colors.len() as u32, 1, xyz.collect()).unwrap()
}

const D65: [f64; 3] = [0.3127 / 0.3290, 1.0, (1.0 - 0.3127 - 0.3290) / 0.3290];

fn developed(colors: &[[f64; 3]], stops: f64) -> RgbImage8 {
    develop(&row(colors), &DevelopSettings::srgb(stops)).unwrap()
}

#[test]
fn white_black_and_gray_get_their_codes() {
    let gray = D65.map(|v| v * srgb::from_u8(119));
    let picture = developed(&[D65, [0.0; 3], gray], 0.0);
    assert_eq!((picture.width(), picture.height()), (3, 1));
    assert_eq!(picture.data(), [255, 255, 255, 0, 0, 0, 119, 119, 119]);
    assert_eq!(picture.pixel(2, 0), Some([119; 3]));
    assert_eq!(picture.pixel(3, 0), None);
}

#[test]
fn a_stop_doubles_the_light() {
    let half = D65.map(|v| v * 0.25);
    assert_eq!(developed(&[half], 2.0), developed(&[D65], 0.0));
    assert_ne!(developed(&[half], 1.0), developed(&[D65], 0.0));
}

#[test]
fn what_is_not_a_number_is_black_and_stays_alone() {
    let picture = developed(&[[f64::NAN; 3], D65, [f64::INFINITY; 3]], 0.0);
    assert_eq!(picture.pixel(0, 0), Some([0; 3]));
    assert_eq!(picture.pixel(1, 0), Some([255; 3]));
}

/// Every code of each channel alone, every gray, and mixed codes.
fn all_codes() -> Vec<[u8; 3]> {
    let alone = (0..=255).flat_map(|v| [[v, 0, 0], [0, v, 0], [0, 0, v], [v; 3]]);
    let mixed = (0..4096_u32).map(|i| i.wrapping_mul(2_654_435_761).to_le_bytes());
    alone.chain(mixed.map(|[a, b, c, _]| [a, b, c])).collect()
}

#[test]
fn every_code_comes_back() {
    for name in Display::names() {
        let display = Display::named(name).unwrap();
        // Where several codes give the same light, as below the α of a tube, the recovered code may be any of them.
        let is_own = |&code: &u8| {
            let light = |code| display.responses().each_ref().map(|r| r.light(code));
            let step = 1.0 / 255.0;
            let code = f64::from(code) * step;
            let (below, at, above) = (light(code - step), light(code), light(code + step));
            (0..3).all(|i| (code == 0.0 || below[i] < at[i]) && (code == 1.0 || at[i] < above[i]))
        };
        let codes: Vec<[u8; 3]> = all_codes()
            .into_iter()
            .filter(|codes| codes.iter().all(is_own))
            // In XYZ with 24 bits, colors fifty times as bright as the white leave no precision for the darkest codes of PQ.
            .filter(|codes| display.peak() == 1.0 || codes.iter().all(|code| *code == codes[0]))
            .collect();
        assert!(codes.len() > 250, "{name} {}", codes.len());
        let colors: Vec<[f64; 3]> = codes
            .iter()
            .map(|codes| {
                let light = std::array::from_fn(|i| {
                    display.responses()[i].light(f64::from(codes[i]) / 255.0)
                });
                let shown = times(display.xyz_from_rgb(), light);
                std::array::from_fn(|i| shown[i] + display.black_xyz()[i])
            })
            .collect();
        // A power law is steep at black: the rounding error of XYZ there, 1e-8, is a tenth of a code, and dither shows it.
        let has_finite_slope = |r: &Response| matches!(r, Response::Linear | Response::Srgb);
        let dithers: &[bool] = if display.responses().iter().all(has_finite_slope) {
            &[false, true]
        } else {
            &[false]
        };
        for &dither in dithers {
            for gamut in [
                GamutMapping::Keep,
                GamutMapping::Clip,
                GamutMapping::TowardWhite,
                GamutMapping::Perceptual,
            ] {
                let settings = DevelopSettings {
                    gamut,
                    dither,
                    ..DevelopSettings::new(display.clone())
                };
                let picture = develop(&row(&colors), &settings).unwrap();
                let expected: Vec<u8> = codes.iter().flatten().copied().collect();
                let wrong = picture
                    .data()
                    .iter()
                    .zip(&expected)
                    .position(|(a, b)| a != b);
                assert_eq!(wrong, None, "{name} {dither} {gamut:?}");
            }
        }
    }
}
