use super::*;
use std::fs;

/// M by name: from the primaries and whites of the standards with colour-science 0.4.7 (`normalised_primary_matrix`, numpy). The
/// same figures, to the digits that they print: W3C, CSS Color Module Level 4 (srgb, display_p3, adobe_rgb, bt2020), SMPTE EG
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

/// SMPTE EG 432-1:2010 prints M of DCI-P3 and Poynton (1997) that of SMPTE C.
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

/// Chromaticities of red, green, blue and white from the same spectra with the CIE 1931 observer at 5 nm, computed apart from
/// this code (numpy).
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
        // Six decimals are given.
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

/// The areas of the triangles by hand: sRGB 0.11205, BT.2020 0.21186 in x, y.
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

/// Spectra know how another observer sees them; chromaticities do not.
#[test]
fn another_observer_sees_spectra_otherwise() {
    let crt = named("crt_1997");
    let same = crt.xyz_from_rgb_seen_by(Observer::Cie1931Deg2).unwrap();
    assert_near(
        same.as_flattened(),
        crt.xyz_from_rgb().as_flattened(),
        1e-15,
        "1931",
    );
    let other = crt.xyz_from_rgb_seen_by(Observer::Cie1964Deg10).unwrap();
    assert!((other[0][0] - same[0][0]).abs() > 1e-3);
    assert!((times(&other, [1.0; 3])[1] - 1.0).abs() < 1e-12);
    assert_eq!(
        named("srgb").xyz_from_rgb_seen_by(Observer::Cie1931Deg2),
        None
    );
}

const SRGB: &str = "
white = 'D65'
white_luminance = 200
black_luminance = 0.2
primaries = { red = [0.64, 0.33], green = [0.3, 0.6], blue = [0.15, 0.06] }
response = { curve = 'gamma', gamma = [2.1, 2.2, 2.3], alpha = 0.02 }
ambient = { illuminance_lux = 314.159265358979, reflectance = 0.01, illuminant = 'A' }
";

/// A folder with a display file and tables.
fn read(text: &str) -> Result<Display, DisplayError> {
    let folder = tempfile::tempdir().unwrap();
    let table = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    table(
        "good.csv",
        "code,red,green,blue\n0,0,0,0\n128,10,20,5\n255,50,90,10\n",
    );
    table(
        "falls.csv",
        "code,red,green,blue\n0,0,0,0\n128,60,20,5\n255,50,90,10\n",
    );
    table("starts.csv", "code,red,green,blue\n1,0,0,0\n255,50,90,10\n");
    table("short.csv", "nm,red,green,blue\n400,0,0,1\n700,1,1,0\n");
    table("dark.csv", "nm,red,green,blue\n300,0,0,1\n800,0,1,0\n");
    table(
        "bands.csv",
        "nm,red,green,blue\n300,0,0,1\n450,0,0,1\n550,0,1,0\n610,1,0,0\n800,1,0,0\n",
    );
    let path = folder.path().join("screen.toml");
    fs::write(&path, text).unwrap();
    Display::read(&path)
}

#[test]
fn a_file_says_everything() {
    let display = read(SRGB).unwrap();
    assert_eq!(
        (display.name(), display.white_luminance()),
        ("screen", 200.0)
    );
    // D65 by sums at 5 nm is 0.31272, 0.32903.
    let m = display.xyz_from_rgb();
    assert_near(
        m.as_flattened(),
        named("srgb").xyz_from_rgb().as_flattened(),
        1e-3,
        "M",
    );
    let gammas = display
        .responses()
        .each_ref()
        .map(|response| match response {
            Response::Gamma { gamma, alpha } => (*gamma, *alpha),
            other => panic!("{other:?}"),
        });
    assert_eq!(gammas, [(2.1, 0.02), (2.2, 0.02), (2.3, 0.02)]);
    // 100 π lx on a hundredth is 1 cd/m², of A's colour; black adds 0.2 of the white's.
    let black = display.black_xyz();
    assert!((black[1] - 1.2 / 200.0).abs() < 1e-12);
    assert!(
        (black[0] - (1.098_49 + 0.2 * 0.950_43) / 200.0).abs() < 1e-6,
        "{black:?}"
    );
}

#[test]
fn a_file_names_tables() {
    let display =
        read("[primaries]\nspectra = 'bands.csv'\n[response]\ncurve = 'table'\ncsv = 'good.csv'")
            .unwrap();
    assert!((display.responses()[0].light(128.0 / 255.0) - 0.2).abs() < 1e-15);
    assert!((display.responses()[1].code(20.0 / 90.0) - 128.0 / 255.0).abs() < 1e-15);
    assert_eq!(display.white_luminance(), 100.0);
}

#[test]
fn mistakes_say_where_and_what_would_be_right() {
    let change = |from: &str, to: &str| {
        assert!(SRGB.contains(from), "{from}");
        SRGB.replace(from, to)
    };
    let spectra =
        |csv: &str| format!("primaries = {{ spectra = '{csv}' }}\nresponse = {{ curve = 'srgb' }}");
    let table = |csv: &str| {
        change(
            "curve = 'gamma', gamma = [2.1, 2.2, 2.3], alpha = 0.02",
            &format!("curve = 'table', csv = '{csv}'"),
        )
    };
    for (text, said) in [
        (String::new(), "missing field `primaries`"),
        ("what = [".to_owned(), "line 1"),
        (
            change("white = 'D65'", "white = 'D66'"),
            "white: there is no illuminant \"D66\"",
        ),
        (
            change("white = 'D65'", "white = 6500"),
            "expected a chromaticity [x, y] or the name of an illuminant",
        ),
        (
            change("white = 'D65'", "white = [0.1, 0.8]"),
            "white: the white must lie within the triangle",
        ),
        (change("white = 'D65'", ""), "white: it is missing"),
        (
            change("[0.3, 0.6]", "[0.3, 0]"),
            "primaries.green: found [0.3, 0]",
        ),
        (change("[0.3, 0.6]", "[0.395, 0.195]"), "triangle"),
        (
            change("red = [0.64, 0.33], ", ""),
            "primaries: it needs either red, green and blue",
        ),
        (
            change("white_luminance = 200", "white_luminance = 0"),
            "white_luminance: found 0",
        ),
        (
            change("black_luminance = 0.2", "black_luminance = -1"),
            "black_luminance: found -1",
        ),
        (
            change("alpha = 0.02", "alpha = 1"),
            "response.alpha: found 1; it must be from -0.9 to 0.9",
        ),
        (
            change("gamma = [2.1, 2.2, 2.3]", "gamma = [2.1, 2.2]"),
            "expected a number, or three",
        ),
        (
            change("gamma = [2.1, 2.2, 2.3], ", ""),
            "response.gamma: it is missing",
        ),
        (
            change("curve = 'gamma'", "curve = 'srgb'"),
            "response.gamma: it has no effect here",
        ),
        (
            change("curve = 'gamma'", "curve = 'rec709'"),
            "unknown variant `rec709`",
        ),
        (change("alpha", "alfa"), "unknown field `alfa`"),
        (
            change("reflectance = 0.01", "reflectance = 1.01"),
            "ambient.reflectance: found 1.01",
        ),
        (spectra("none.csv"), "none.csv: cannot be opened"),
        (
            spectra("short.csv"),
            "primaries.spectra: each primary's spectrum must shine and cover 380 to 780 nm",
        ),
        (
            spectra("dark.csv"),
            "primaries.spectra: each primary's spectrum must shine",
        ),
        (table("falls.csv"), "response.csv: codes must rise"),
        (
            table("starts.csv"),
            "response.csv: codes must rise from 0, but the first is 1",
        ),
        (table("none.csv"), "none.csv: cannot be opened"),
    ] {
        let error = read(&text).unwrap_err().to_string();
        assert!(error.contains(said), "{text}: {error}");
        assert!(
            error.contains("screen.toml") || error.contains(".csv"),
            "{error}"
        );
    }
    let error = Display::open("sgrb").unwrap_err().to_string();
    assert!(
        error.contains("did you mean \"srgb\"?") && error.contains("crt_1997"),
        "{error}"
    );
    assert!(
        Display::open("no/such.toml")
            .unwrap_err()
            .to_string()
            .contains("no/such.toml: cannot be opened")
    );
    assert_eq!(Display::open("srgb").unwrap(), named("srgb"));
}
