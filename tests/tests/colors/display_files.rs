//! Display files: their contents, and how errors in them are reported.

use colorimetry::Display;
use colorimetry::display::{DisplayError, Response};
use std::fs;

fn assert_near(found: &[f64], expected: &[f64], tolerance: f64, case: &str) {
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found - expected).abs() < tolerance,
            "{case}: {found} {expected}"
        );
    }
}

const SRGB: &str = "
white = 'D65'
white_luminance = 200
black_luminance = 0.2
primaries = { red = [0.64, 0.33], green = [0.3, 0.6], blue = [0.15, 0.06] }
response = { curve = 'gamma', gamma = [2.1, 2.2, 2.3], alpha = 0.02 }
ambient = { illuminance_lux = 314.159265358979, reflectance = 0.01, illuminant = 'A' }
";

/// Reads a display file in a folder with tables.
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
    // D65 by sums at 5 nm has the chromaticity 0.31272, 0.32903.
    let m = display.xyz_from_rgb();
    assert_near(
        m.as_flattened(),
        Display::named("srgb")
            .unwrap()
            .xyz_from_rgb()
            .as_flattened(),
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
    // 100 π lx on a reflectance of 0.01 gives 1 cd/m² with the color of A; black adds 0.2 cd/m² with the color of the white.
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

fn change(from: &str, to: &str) -> String {
    assert!(SRGB.contains(from), "{from}");
    SRGB.replace(from, to)
}

/// Checks that each text is refused with these words and the name of the file.
fn refused(cases: impl IntoIterator<Item = (String, &'static str)>) {
    for (text, said) in cases {
        let error = read(&text).unwrap_err().to_string();
        assert!(error.contains(said), "{text}: {error}");
        assert!(
            error.contains("screen.toml") || error.contains(".csv"),
            "{error}"
        );
    }
}

#[test]
fn mistakes_of_colors_say_where_and_what_would_be_right() {
    refused([
        (
            String::new(),
            "the file is empty; a display needs at least [primaries]",
        ),
        ("what = [".to_owned(), "screen.toml:1:"),
        (
            change("white = 'D65'", "white = 'D66'"),
            "white: there is no illuminant \"D66\"",
        ),
        (
            change("white = 'D65'", "white = 6500"),
            "white: found the whole number 6500, expected an array of numbers or a string",
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
    ]);
}

#[test]
fn mistakes_of_light_and_tables_say_where_and_what_would_be_right() {
    let spectra =
        |csv: &str| format!("primaries = {{ spectra = '{csv}' }}\nresponse = {{ curve = 'srgb' }}");
    let table = |csv: &str| {
        change(
            "curve = 'gamma', gamma = [2.1, 2.2, 2.3], alpha = 0.02",
            &format!("curve = 'table', csv = '{csv}'"),
        )
    };
    refused([
        (
            change("white_luminance = 200", "white_luminance = 0"),
            "white_luminance: found 0",
        ),
        (
            change("[0.3, 0.6]", "[0.3, 0.6, 0.1]"),
            "primaries.green: found 3 numbers",
        ),
        (
            change(
                "curve = 'gamma', gamma = [2.1, 2.2, 2.3], alpha = 0.02",
                "curve = 'pq'",
            )
            .replace("white_luminance = 200", "white_luminance = 20000"),
            "white_luminance: found 20000; the codes of PQ end at 10000 cd/m²",
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
            "response.gamma: found an array of 2, expected an array of 3 numbers",
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
            "response.curve: found \"rec709\", expected \"linear\", ",
        ),
        (
            change("alpha", "alfa"),
            "response.alfa: unknown field; did you mean `alpha`?",
        ),
        (
            change("reflectance = 0.01", "reflectance = 1.01"),
            "ambient.reflectance: found 1.01",
        ),
        (spectra("none.csv"), "none.csv: cannot be opened"),
        (
            spectra("short.csv"),
            "primaries.spectra: each primary's spectrum must emit light and cover 380 to 780 nm",
        ),
        (
            spectra("dark.csv"),
            "primaries.spectra: each primary's spectrum must emit light",
        ),
        (table("falls.csv"), "response.csv: codes must rise"),
        (
            table("starts.csv"),
            "response.csv: codes must rise from 0, but the first is 1",
        ),
        (table("none.csv"), "none.csv: cannot be opened"),
    ]);
}

/// All mistakes are reported at once, each with line and column.
#[test]
fn mistakes_are_reported_together() {
    let text = change("white = 'D65'", "white = 'D66'")
        .replace("black_luminance = 0.2", "black_luminance = -1")
        .replace("alpha", "alfa");
    let said = read(&text).unwrap_err().to_string();
    for line in [
        "screen.toml:2:9: white: there is no illuminant",
        "screen.toml:4:19: black_luminance: found -1",
        "response.alfa: unknown field",
    ] {
        assert!(said.contains(line), "{line} is not in\n{said}");
    }
}

#[test]
fn names_that_nothing_has_bring_a_suggestion() {
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
    let error = Display::open("CRT").unwrap_err().to_string();
    assert!(error.contains("did you mean \"crt_1997\"?"), "{error}");
    assert_eq!(
        Display::open("srgb").unwrap(),
        Display::named("srgb").unwrap()
    );
}

/// With `-` or `9` in place of any character, the file is either refused or gives finite numbers.
#[test]
fn a_changed_file_is_refused_or_sound() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("screen.toml");
    let mut sound = 0;
    for at in 0..SRGB.len() {
        for by in ["-", "9"] {
            let mut text = SRGB.to_owned();
            text.replace_range(at..=at, by);
            fs::write(&path, text).unwrap();
            let Ok(display) = Display::read(&path) else {
                continue;
            };
            sound += 1;
            let numbers = display.xyz_from_rgb().as_flattened().iter();
            let numbers = numbers.chain(display.rgb_from_xyz().as_flattened());
            let codes = display.responses().each_ref().map(|r| r.code(r.light(0.5)));
            let mut all = numbers.chain(&codes).copied().chain(display.black_xyz());
            assert!(all.all(f64::is_finite), "{at} {by:?}");
        }
    }
    assert!(sound > 10, "{sound}");
}
