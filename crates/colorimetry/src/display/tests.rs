use super::*;

/// M by name: from the primaries and whites of the standards with colour-science 0.4.7 (`normalized_primary_matrix`, numpy). The
/// same values are published, to fewer digits, in W3C, CSS Color Module Level 4 (srgb, display_p3, adobe_rgb, bt2020), SMPTE EG
/// 432-1:2010 (dci_p3, ten digits), C. Poynton, Frequently asked questions about color (1997; smpte_c, six digits).
const PUBLISHED: [(&str, [[f64; 3]; 3]); 9] = [
    (
        "adobe_rgb",
        [
            [0.576_669_042_910, 0.185_558_237_907, 0.188_228_646_235],
            [0.297_344_975_251, 0.627_363_566_255, 0.075_291_458_494],
            [0.027_031_361_386, 0.070_688_852_536, 0.991_337_536_838],
        ],
    ),
    (
        "bt2020",
        [
            [
                0.636_958_048_301_3,
                0.144_616_903_586_2,
                0.168_880_975_164_2,
            ],
            [
                0.262_700_212_011_3,
                0.677_998_071_518_9,
                0.059_301_716_469_86,
            ],
            [0.0, 0.028_072_693_049_09, 1.060_985_057_711],
        ],
    ),
    (
        "bt2100_pq",
        [
            [
                0.636_958_048_301_3,
                0.144_616_903_586_2,
                0.168_880_975_164_2,
            ],
            [
                0.262_700_212_011_3,
                0.677_998_071_518_9,
                0.059_301_716_469_86,
            ],
            [0.0, 0.028_072_693_049_09, 1.060_985_057_711],
        ],
    ),
    (
        "dci_p3",
        [
            [
                0.445_169_815_564_6,
                0.277_134_409_206_8,
                0.172_282_669_815_6,
            ],
            [
                0.209_491_677_912_7,
                0.721_595_254_161_0,
                0.068_913_067_926_23,
            ],
            [0.0, 0.047_060_560_053_98, 0.907_355_394_362_0],
        ],
    ),
    (
        "display_p3",
        [
            [
                0.486_570_948_648_2,
                0.265_667_693_169_1,
                0.198_217_285_234_4,
            ],
            [
                0.228_974_564_069_7,
                0.691_738_521_836_5,
                0.079_286_914_093_74,
            ],
            [0.0, 0.045_113_381_858_90, 1.043_944_368_901],
        ],
    ),
    (
        "ebu",
        [
            [0.431_943_305_297, 0.341_234_996_757, 0.178_189_479_101],
            [0.222_720_766_794, 0.706_003_441_566, 0.071_275_791_641],
            [0.020_247_342_436, 0.129_433_964_287, 0.938_464_589_934],
        ],
    ),
    (
        "ntsc_1953",
        [
            [
                0.606_863_809_295_6,
                0.173_507_280_955_5,
                0.200_334_881_408_8,
            ],
            [
                0.298_903_070_250_1,
                0.586_619_854_659_2,
                0.114_477_075_090_7,
            ],
            [0.0, 0.066_098_011_792_59, 1.116_151_482_135],
        ],
    ),
    (
        "smpte_c",
        [
            [0.393_520_903_659, 0.365_258_076_718, 0.191_676_946_675],
            [0.212_376_360_705, 0.701_059_856_926, 0.086_563_782_369],
            [0.018_739_090_650, 0.111_933_926_736, 0.958_384_733_373],
        ],
    ),
    (
        "srgb",
        [
            [0.412_390_799_266, 0.357_584_339_384, 0.180_480_788_402],
            [0.212_639_005_872, 0.715_168_678_768, 0.072_192_315_361],
            [0.019_330_818_716, 0.119_194_779_795, 0.950_532_152_250],
        ],
    ),
];

fn named(name: &str) -> Display {
    Display::named(name).unwrap()
}

fn assert_near(found: &[f64], expected: &[f64], tolerance: f64, case: &str) {
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found - expected).abs() < tolerance,
            "{case}: {found} {expected}"
        );
    }
}

#[test]
fn matrices_are_the_published_ones() {
    for (name, published) in PUBLISHED {
        let found = *named(name).xyz_from_rgb();
        assert_near(found.as_flattened(), published.as_flattened(), 1e-11, name);
    }
}

/// SMPTE EG 432-1:2010 publishes M of DCI-P3, and Poynton (1997) that of SMPTE C.
#[test]
fn matrices_have_the_digits_of_the_standards() {
    let dci = [
        [0.445_169_815_6, 0.277_134_409_2, 0.172_282_669_8],
        [0.209_491_677_9, 0.721_595_254_2, 0.068_913_067_9],
        [0.0, 0.047_060_560_1, 0.907_355_394_4],
    ];
    let found = *named("dci_p3").xyz_from_rgb();
    assert_near(found.as_flattened(), dci.as_flattened(), 1e-10, "dci_p3");
    let smpte = [
        [0.393_521, 0.365_258, 0.191_677],
        [0.212_376, 0.701_060, 0.086_564],
        [0.018_739, 0.111_934, 0.958_385],
    ];
    let found = *named("smpte_c").xyz_from_rgb();
    assert_near(found.as_flattened(), smpte.as_flattened(), 1e-6, "smpte_c");
}

/// Chromaticities of red, green, blue and white from the same spectra with the CIE 1931 observer at 5 nm, computed
/// independently (numpy).
#[test]
fn measured_displays_have_their_chromaticities() {
    let expected = [
        (
            "crt_1997",
            [
                [0.618_854, 0.344_040],
                [0.276_494, 0.604_917],
                [0.151_190, 0.061_085],
            ],
            [0.288_431, 0.313_072],
        ),
        (
            "lcd",
            [
                [0.657_127, 0.330_824],
                [0.284_770, 0.642_671],
                [0.140_410, 0.090_460],
            ],
            [0.314_462, 0.356_824],
        ),
    ];
    for (name, primaries, white) in expected {
        let display = named(name);
        // The values have six decimals.
        assert_near(
            display.primaries_xy().as_flattened(),
            primaries.as_flattened(),
            0.51e-6,
            name,
        );
        assert_near(&xy_of_xyz(display.white_xyz()), &white, 0.51e-6, name);
    }
}

#[test]
fn every_display_mixes_its_white_and_gives_light_back() {
    assert!(Display::names().windows(2).all(|pair| pair[0] < pair[1]));
    assert!(Display::named("crt").is_none());
    for name in Display::names() {
        let display = named(name);
        assert_eq!(display.name(), name);
        assert!(
            display.source().len() > 10 && !display.title().is_empty(),
            "{name}"
        );
        assert!((display.white_xyz()[1] - 1.0).abs() < 1e-12, "{name}");
        let xyz = times(display.xyz_from_rgb(), [0.2, 0.7, 0.1]);
        assert_near(
            &times(display.rgb_from_xyz(), xyz),
            &[0.2, 0.7, 0.1],
            1e-14,
            name,
        );
        assert!(display.black_xyz().iter().all(|&v| v == 0.0), "{name}");
        assert_eq!(display.peak() > 1.0, name == "bt2100_pq");
    }
    assert!((named("bt2100_pq").peak() - 10_000.0 / 203.0).abs() < 1e-9);
}

/// The areas of the triangles, computed by hand: sRGB 0.11205, BT.2020 0.21186 in x, y.
#[test]
fn gamuts_have_their_areas() {
    let srgb = named("srgb");
    assert!((srgb.gamut_area_xy() - 0.112_05).abs() < 1e-12);
    assert!(
        (named("bt2020").gamut_area_xy() - 0.211_866_5).abs() < 1e-6,
        "{}",
        named("bt2020").gamut_area_xy()
    );
    assert!(named("display_p3").gamut_area_uv() > 1.2 * srgb.gamut_area_uv());
}

/// Spectra determine the colors for another observer; chromaticities do not.
#[test]
fn another_observer_sees_spectra_otherwise() {
    let crt = named("crt_1997");
    assert_eq!(crt.seen_by(Observer::Cie1931Deg2).as_ref(), Some(&crt));
    let other = crt.seen_by(Observer::Cie1964Deg10).unwrap();
    assert_eq!(other.observer(), Observer::Cie1964Deg10);
    assert!((other.xyz_from_rgb()[0][0] - crt.xyz_from_rgb()[0][0]).abs() > 1e-3);
    assert!((other.white_xyz()[1] - 1.0).abs() < 1e-12);
    assert_eq!(other.seen_by(Observer::Cie1931Deg2), Some(crt));
    assert_eq!(named("srgb").seen_by(Observer::Cie1964Deg10), None);
}
