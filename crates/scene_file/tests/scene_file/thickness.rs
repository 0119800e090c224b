//! Thicknesses that vary: how valid ones are read, and how others are reported.
#![expect(
    clippy::float_cmp,
    reason = "the values are exact in binary, or rounding is what is tested"
)]

use crate::{CAMERA, checksum};
use glam::DVec3;
use pellicle_scene_file::{Problem, Problems};
use scene::{BlackFilm, Coordinate, Profile, Scene, Swirls, Thickness};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A scene at 30 s; the thickness begins on line 5, column 16.
fn read(thickness: &str, directory: &Path) -> Result<Scene, Problems> {
    let text = format!(
        "{CAMERA}render = {{ time_s = 30 }}\n[materials.x]\ntype = 'film'\nthickness_nm = {thickness}\nindex = 1.5\n"
    );
    crate::read(&text, directory)
}

fn thickness_in(thickness: &str, directory: &Path) -> Thickness {
    let scene = read(thickness, directory).unwrap_or_else(|problems| panic!("{problems:#}"));
    let only = scene.materials()[0].thicknesses().next();
    only.expect("a film has a layer").clone()
}

fn thickness(written: &str) -> Thickness {
    thickness_in(written, Path::new(""))
}

fn profile(written: &str) -> Profile {
    match thickness(written) {
        Thickness::Profile(profile) => profile,
        other => panic!("{other:?}"),
    }
}

/// There is one problem, with this column on the line of the thickness, this field and these words.
fn assert_refused(written: &str, column: usize, field: &str, said: &[&str]) {
    assert_refused_in(written, Path::new(""), column, field, said);
}

fn assert_refused_in(written: &str, directory: &Path, column: usize, field: &str, said: &[&str]) {
    let problems = read(written, directory).expect_err(written);
    assert_eq!(problems.iter().len(), 1, "{written}: {problems:#}");
    assert_problem(problems.iter().next().unwrap(), column, field, said);
}

fn assert_problem(problem: &Problem, column: usize, field: &str, said: &[&str]) {
    let place = problem.location.as_ref().expect("a place in the file");
    assert_eq!((place.line, place.column), (5, column), "{problem}");
    let expected = format!("materials.x.thickness_nm{field}");
    assert_eq!(problem.field.to_string(), expected, "{problem}");
    for words in said {
        assert!(
            problem.message.contains(words),
            "{:?} lacks {words:?}",
            problem.message
        );
    }
}

#[test]
fn a_bubble_drains_from_its_top() {
    let film = "{ drainage = { initial = 1000, radius_m = 0.03, viscosity_pa_s = 1e-6 } }";
    let profile = profile(film);
    assert_eq!(profile.coordinate, Coordinate::Polar { axis: DVec3::Y });
    let black = BlackFilm {
        below_nm: 30.0,
        nm: 7.0,
    };
    assert_eq!(profile.black, Some(black));
    // h⁻² = h₀⁻² + ρ g t / (3 η R) at the top.
    let thinning = 998.2 * 9.806_65 * 30.0 / (3.0 * 1e-6 * 0.03) * 1e-18;
    let top = 1.0 / (1e-6 + thinning);
    assert!((profile.squares_nm2[0] / top - 1.0).abs() < 1e-12);
    assert!(profile.squares_nm2.is_sorted(), "thicker toward the bottom");
    assert_eq!(
        profile.squares_nm2.last(),
        Some(&4e8),
        "the drop is cut off"
    );
}

#[test]
fn a_film_that_has_had_no_time_is_even() {
    for (film, most) in [
        (
            "{ drainage = { initial = 500, radius_m = 0.03 } }",
            20_000.0,
        ),
        (
            "{ drainage = { initial = 500, height_m = 0.03, from = [0, 1, 0], to = [0, 0, 0] } }",
            500.0,
        ),
    ] {
        let film_of = "[materials.x]\ntype = 'film'\nindex = 1.5\nthickness_nm = ";
        let scene = crate::read(&format!("{CAMERA}{film_of}{film}\n"), "")
            .unwrap_or_else(|problems| panic!("{problems:#}"));
        let Some(Thickness::Profile(profile)) = scene.materials()[0].thicknesses().next() else {
            panic!("{film}");
        };
        assert_eq!(profile.most_nm, most);
        for square in &profile.squares_nm2 {
            assert!((square.sqrt().min(most) - 500.0).abs() < 1e-9, "{square}");
        }
    }
}

#[test]
fn a_leaning_film_drains_by_its_slope() {
    let film = |to: &str| {
        format!(
            "{{ drainage = {{ initial = 900, from = [0, 1, 0], to = {to}, height_m = 0.05, viscosity_pa_s = 1e-6 }} }}"
        )
    };
    let upright = profile(&film("[0, 0, 0]"));
    let leaning = profile(&film("[1, 0, 0]"));
    assert_eq!((upright.most_nm, upright.squares_nm2[0]), (900.0, 0.0));
    // √(4 η z / (ρ g t)), Jeffreys 1930.
    let bottom = 4.0 * 1e-6 * 0.05 / (998.2 * 9.806_65 * 30.0) * 1e18;
    assert!((upright.squares_nm2[1] / bottom - 1.0).abs() < 1e-12);
    let ratio = leaning.squares_nm2[1] / upright.squares_nm2[1];
    assert!((ratio - 2.0_f64.sqrt()).abs() < 1e-12, "{ratio}");
    assert_refused(
        &film("[0, 1, 2]"),
        69,
        ".drainage.to",
        &["does not run down", "lower than `from`"],
    );
}

#[test]
fn swirls_count_the_lives_that_have_passed() {
    let found = thickness(
        "{ swirls = { mean = 300, amplitude = 40, scale = 0.5, seed = 9, rate = 0.35 } }",
    );
    let expected = Swirls {
        mean: 300.0,
        amplitude: 40.0,
        cells_per_unit: 2.0,
        seed: 9,
        octaves: 3,
        warp: 1.0,
        cells: 10,
        phase: 0.5,
    };
    let Thickness::Swirls(found) = found else {
        panic!("{found:?}");
    };
    assert!((found.phase - expected.phase).abs() < 1e-12);
    assert_eq!(
        Swirls {
            phase: 0.5,
            ..found
        },
        expected
    );
}

#[test]
fn process_knobs_become_nanometers() {
    let volts = |volts: &str| {
        thickness(&format!(
            "{{ anodizing = {{ metal = 'titanium', volts = {volts} }} }}"
        ))
    };
    assert_eq!(volts("60"), Thickness::Constant { nm: 152.0 });
    let bar = volts("{ start = 5, end = 120, from = [0, 0, 0], to = [1, 0, 0] }");
    let expected = Thickness::Linear {
        start: DVec3::ZERO,
        end: DVec3::X,
        start_nm: 14.5,
        end_nm: 302.0,
    };
    assert_eq!(bar, expected);
    let tint = profile(
        "{ heat_tint = { temperature_c = { start = 200, end = 340, from = [0, 0, 0], to = [1, 0, 0] }, minutes = 10 } }",
    );
    assert!(tint.black.is_none() && tint.squares_nm2.is_sorted());
    let half = thickness("{ heat_tint = { temperature_c = 270, minutes = 10 } }");
    let Thickness::Constant { nm } = half else {
        panic!("{half:?}");
    };
    assert!((tint.squares_nm2[256].sqrt() - nm).abs() < 1e-9);
}

#[test]
fn fields_combine() {
    let found = thickness(
        "{ product = [{ sum = [1, { swirls = { amplitude = 0.1, scale = 1 } }] }, { pole = 100, equator = 200 }, 2] }",
    );
    assert_eq!(found.parts().count(), 6);
    let Thickness::Product(parts) = found else {
        panic!("{found:?}");
    };
    assert!(matches!(&parts[0], Thickness::Sum(inner) if inner.len() == 2));
    assert_eq!(parts[2], Thickness::Constant { nm: 2.0 });
}

#[test]
fn every_number_of_a_thickness_is_rounded() {
    let written = "{ sum = [0.1, { steps = { values = [0.1, 0.2], from = [0.1, 0, 0], to = [0.7, 0, 0] } }, \
                   { swirls = { mean = 0.1, amplitude = 0.3, scale = 0.7, warp = 0.9, rate = 0.33 } }, \
                   { drainage = { initial = 0.7, radius_m = 0.1, black_below = 0.3, black = 0.1 } }] }";
    let scene = read(written, Path::new("")).unwrap();
    let rounded = scene.rounded_to_f32();
    assert_ne!(scene, rounded);
    assert_eq!(rounded, rounded.rounded_to_f32());
    // The text of a number shows whether it is an f32: an f64 has more digits than an f32 needs.
    let text = format!("{:?}", rounded.materials());
    let numbers = text.split(|c: char| !(c.is_ascii_digit() || ".e-".contains(c)));
    let is_f32 = |number: f64| f64::from(number as f32) == number;
    assert!(
        numbers.filter_map(|number| number.parse().ok()).all(is_f32),
        "{text}"
    );
}

// Values out of range are reported where they stand.
cases! { assert_refused:
    a_sum_of_nothing("{ sum = [] }", 24, ".sum", &["at least one part"]);
    an_equator_below_0(
        "{ sum = [1, { pole = 1, equator = -1 }] }",
        50,
        ".sum[1].equator",
        &["found -1", "0 to 100000 nm"],
    );
    a_product_that_is_too_large(
        "{ product = [1e5, 1e5] }",
        28,
        ".product",
        &["1.0e10", "first 2 parts", "at most 1e9"],
    );
    no_steps(
        "{ steps = { values = [], from = [0, 0, 0], to = [1, 0, 0] } }",
        37,
        ".steps.values",
        &["found 0 steps", "from 1 to 4096"],
    );
    a_step_that_is_no_number(
        "{ steps = { values = [1, nan], from = [0, 0, 0], to = [1, 0, 0] } }",
        41,
        ".steps.values[1]",
        &["found nan"],
    );
    a_bubble_without_a_radius(
        "{ drainage = { initial = 500, radius_m = 0 } }",
        57,
        ".drainage.radius_m",
        &["1e-6 to 1000 m"],
    );
    too_many_octaves(
        "{ swirls = { amplitude = 5, scale = 1, octaves = 7 } }",
        65,
        ".swirls.octaves",
        &["found 7", "1 to 6"],
    );
    too_many_volts(
        "{ anodizing = { metal = 'titanium', volts = 200 } }",
        60,
        ".anodizing.volts",
        &["0 to 150 V"],
    );
    too_much_heat(
        "{ heat_tint = { temperature_c = 900, minutes = 1 } }",
        48,
        ".heat_tint.temperature_c",
        &["150 to 400 °C"],
    );
}

/// Infinity times 0 is NaN, and a product that overflows `f32` on the way differs on the GPU.
#[test]
fn a_factor_of_nought_hides_no_overflow() {
    let product = |count: usize| format!("{{ product = [{}0] }}", "1e5, ".repeat(count));
    assert_refused(&product(62), 28, ".product", &["1.0e10", "first 2 parts"]);
    assert_refused(
        &format!("{{ sum = [300, {}] }}", product(10)),
        42,
        ".sum[1].product",
        &["1.0e10"],
    );
    assert!(read("{ product = [0, 1e5, 1e5] }", Path::new("")).is_ok());
    assert!(read("{ product = [1e5, 1e4, 0] }", Path::new("")).is_ok());
}

/// The first problem is at this column on the line of the thickness, with this field and these words.
fn misfit(written: &str, column: usize, field: &str, said: &[&str]) {
    let problems = read(written, Path::new("")).expect_err(written);
    assert_problem(problems.iter().next().unwrap(), column, field, said);
}

cases! { misfit:
    a_misspelled_pattern_at_any_depth(
        "{ sum = [1, { product = [2, { swirl = 3 }] }] }",
        46,
        ".sum[1].product[1].swirl",
        &["did you mean `swirls`"],
    );
    a_word_in_a_sum("{ sum = [1, 'thick'] }", 28, ".sum[1]", &["the string 'thick'", "a number"]);
    a_drainage_without_a_radius(
        "{ drainage = { initial = 500 } }",
        29,
        ".drainage.radius_m",
        &["is missing"],
    );
    an_unknown_metal(
        "{ anodizing = { metal = 'tin', volts = 3 } }",
        40,
        ".anodizing.metal",
        &["\"tin\"", "\"titanium\""],
    );
}

#[test]
fn nesting_and_length_are_bounded() {
    let nested = |depth: usize| format!("{}1{}", "{ sum = [".repeat(depth), "] }".repeat(depth));
    assert!(read(&nested(4), Path::new("")).is_ok());
    assert_refused(&nested(5), 16, "", &["5 levels", "at most 4"]);
    let long = |count: usize| format!("{{ sum = [{}] }}", vec!["1"; count].join(", "));
    assert!(read(&long(63), Path::new("")).is_ok());
    assert_refused(&long(64), 16, "", &["65 parts", "at most 64"]);
}

/// Four gray values of 16 bits, as a PNG file.
fn write_picture(path: &Path) {
    let values: Vec<u16> = vec![0, 65_535, 13_107, 26_214];
    let picture = image::ImageBuffer::<image::Luma<u16>, _>::from_raw(2, 2, values).unwrap();
    picture.save(path).unwrap();
}

#[test]
fn a_picture_is_read_as_numbers() {
    let directory = TempDir::new().unwrap();
    write_picture(&directory.path().join("map.png"));
    let gray = image::ImageBuffer::<image::Luma<u8>, _>::from_raw(1, 2, vec![51_u8, 255]).unwrap();
    gray.save(directory.path().join("gray.png")).unwrap();
    let values = |name: &str| {
        let written = format!("{{ image = '{name}', min = 10, max = 400, size = [2, 1] }}");
        match thickness_in(&written, directory.path()) {
            Thickness::Picture(picture) => {
                assert_eq!(
                    (picture.black_nm, picture.white_nm, picture.size),
                    (10.0, 400.0, Some([2.0, 1.0]))
                );
                (
                    picture.file.width,
                    picture.file.height,
                    picture.file.values.clone(),
                )
            }
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(values("map.png"), (2, 2, vec![0.0, 1.0, 0.2, 0.4]));
    assert_eq!(values("gray.png"), (1, 2, vec![0.2, 1.0]));
}

fn bad_picture(name: &str, said: &str) {
    let directory = TempDir::new().unwrap();
    let path = |name: &str| directory.path().join(name);
    write_picture(&path("whole.png"));
    let whole = fs::read(path("whole.png")).unwrap();
    fs::write(path("cut.png"), &whole[..whole.len() / 2]).unwrap();
    fs::write(path("text.png"), "not a picture").unwrap();
    fs::write(path("empty.png"), "").unwrap();
    let mut huge = whole.clone();
    huge[16..20].copy_from_slice(&17_000_u32.to_be_bytes());
    fs::write(path("huge.png"), with_checksum(huge)).unwrap();
    let written = format!("{{ image = '{name}', min = 0, max = 9 }}");
    assert_refused_in(&written, directory.path(), 26, ".image", &[said]);
}

cases! { bad_picture:
    a_missing_picture("none.png", "none.png: cannot be opened");
    half_a_picture("cut.png", "cut.png: is not a PNG picture");
    a_text_as_picture("text.png", "text.png: is not a PNG picture");
    an_empty_picture("empty.png", "empty.png: is not a PNG picture");
    a_picture_that_is_too_large("huge.png", "has 17000 × 2 pixels; at most 16384");
    a_folder_as_picture("", "is a directory");
}

/// Returns the file with the checksum of its first chunk corrected.
fn with_checksum(mut file: Vec<u8>) -> Vec<u8> {
    let sum = checksum(&file[12..29]);
    file[29..33].copy_from_slice(&sum.to_be_bytes());
    file
}
