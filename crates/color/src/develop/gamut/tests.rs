use super::*;
use colorimetry::Oklab;

const MAPPINGS: [GamutMapping; 3] = [
    GamutMapping::Clip,
    GamutMapping::TowardWhite,
    GamutMapping::Perceptual,
];

fn display() -> Display {
    Display::named("srgb").unwrap()
}

/// Colors inside and around the gamut of sRGB, including some far outside.
fn colors() -> impl Iterator<Item = [f64; 3]> {
    let steps = (-6..=18).map(|i| f64::from(i) / 8.0);
    steps.clone().flat_map(move |r| {
        let steps = steps.clone();
        steps
            .clone()
            .flat_map(move |g| steps.clone().map(move |b| [r, g, b]))
    })
}

fn luminance(rgb: [f64; 3]) -> f64 {
    xyz_of(&display(), rgb)[1]
}

fn oklab(rgb: [f64; 3]) -> Oklab {
    Oklab::from_xyz(xyz_of(&display(), rgb))
}

#[test]
fn mapped_colors_are_shown_and_shown_ones_stay() {
    let gamut = Gamut::new(&display());
    for rgb in colors() {
        for mapping in MAPPINGS {
            let mapped = gamut.map(mapping, rgb);
            let is_inside = rgb.iter().all(|v| (0.0..=1.0).contains(v));
            assert_eq!(is_inside, gamut.contains(rgb), "{rgb:?}");
            if is_inside {
                assert_eq!(mapped, rgb, "{mapping:?}");
            }
            assert!(
                mapped.iter().all(|v| (0.0..=1.0).contains(v)),
                "{mapping:?} {rgb:?} {mapped:?}"
            );
        }
        assert_eq!(gamut.map(GamutMapping::Keep, rgb), rgb);
    }
}

#[test]
fn toward_white_keeps_luminance() {
    let gamut = Gamut::new(&display());
    for rgb in colors() {
        let mapped = gamut.map(GamutMapping::TowardWhite, rgb);
        let (found, expected) = (luminance(mapped), luminance(rgb).clamp(0.0, 1.0));
        assert!((found - expected).abs() < 1e-9, "{rgb:?} {mapped:?}");
    }
}

#[test]
fn perceptual_keeps_hue_and_lightness_and_takes_the_least_chroma() {
    let gamut = Gamut::new(&display());
    let mut changed = 0;
    for rgb in colors().filter(|&rgb| !gamut.contains(rgb)) {
        let (from, to) = (oklab(rgb), oklab(gamut.map(GamutMapping::Perceptual, rgb)));
        // The white of Ottosson's matrix and that of sRGB differ in the fourth digit.
        let lightness = from.l.clamp(0.0, 1.0);
        assert!((to.l - lightness).abs() < 2e-4, "{rgb:?} {from:?} {to:?}");
        assert!(to.chroma() < from.chroma() + 1e-6);
        if to.chroma() > 0.03 {
            let turn = (from.hue_deg() - to.hue_deg() + 540.0).rem_euclid(360.0) - 180.0;
            assert!(turn.abs() < 0.6, "{rgb:?} {from:?} {to:?}");
            changed += 1;
        }
        // The display cannot show the color with slightly more chroma.
        let share = to.chroma() / from.chroma();
        if from.l > 0.05 && from.l < 0.95 {
            let more = Oklab {
                l: from.l,
                a: from.a * (share + 0.01),
                b: from.b * (share + 0.01),
            };
            let rgb = times(display().rgb_from_xyz(), more.to_xyz());
            assert!(!gamut.contains(rgb), "{more:?} {rgb:?}");
        }
    }
    assert!(changed > 3000, "{changed}");
}

#[test]
fn what_is_no_color_is_clipped() {
    let gamut = Gamut::new(&display());
    for mapping in MAPPINGS {
        let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        assert_eq!(gamut.map(mapping, odd), [0.0, 1.0, 0.0], "{mapping:?}");
        assert!(!gamut.contains(odd));
    }
}
