//! Tests of `pellicle merge`, and of `render --part` and `--samples-from`.

use crate::assert_says;
use crate::place::{Place, Ran};
use crate::render::{bytes, exr, render};
use picture_file::spectral_exr;
use spectra::{LayerKey, Quantity, SpectralImage};
use std::fs;

const SMALL: &str = "--size 40x36 --bands 6";

fn make(place: &Place, options: &str) {
    let _ = place
        .run(&render(&format!("{SMALL} {options}")))
        .succeeded();
}

/// The parts of a picture, rendered by as many processes at once, in any order.
fn parts(place: &Place, backend: &str, count: u32) -> Vec<String> {
    let mut order: Vec<u32> = (1..=count).collect();
    order.sort_by_key(|part| part * 7 % 17);
    for some in order.chunks(4) {
        let start = |part: &u32| {
            let options = format!("{SMALL} --backend {backend} --samples 9 --part {part}/{count}");
            let mut command = place.command(&render(&format!("{options} -o p{part}.exr")));
            command.stderr(std::process::Stdio::null()).spawn().unwrap()
        };
        let processes: Vec<_> = some.iter().map(start).collect();
        for mut process in processes {
            assert!(process.wait().unwrap().success());
        }
    }
    order.iter().map(|part| format!("p{part}.exr")).collect()
}

fn merge(place: &Place, files: &[String], output: &str) -> Ran {
    place.run(&format!("merge {} -o {output}", files.join(" ")))
}

fn parts_give_the_bits_of_the_whole(backend: &str) {
    let place = Place::default();
    make(
        &place,
        &format!("--backend {backend} --samples 9 -o whole.exr"),
    );
    let files = parts(&place, backend, 16);
    let ran = merge(&place, &files, "merged.exr").succeeded();
    assert_says(&ran.stderr, &["merged.exr", "16 parts"]);
    let (whole, mut merged) = (exr(&place, "whole.exr"), exr(&place, "merged.exr"));
    assert!(whole.0 == merged.0, "the pixels differ");
    let noise = whole.1.settings["noise"].clone();
    merged.1.settings.insert("noise".to_owned(), noise);
    assert_eq!(merged.1.settings, whole.1.settings);
}

#[test]
fn parts_of_the_cpu_give_the_bits_of_the_whole() {
    parts_give_the_bits_of_the_whole("cpu");
}

#[test]
fn parts_of_a_gpu_give_the_bits_of_the_whole() {
    parts_give_the_bits_of_the_whole("gpu");
}

/// Asserts that no value of a light group is more than one unit in the last place away, as each range is rounded to half a unit, and
/// no sum of the two groups more than two.
fn assert_within_an_ulp(found: &SpectralImage, expected: &SpectralImage) {
    for (a, b) in found.layers().iter().zip(expected.layers()) {
        assert_eq!(a.key(), b.key());
        assert_eq!(a.counts(), b.counts());
        let most = if a.key().light_group.is_some() { 1 } else { 2 };
        let is_variance = a.key().quantity == Quantity::Variance;
        for (a, b) in a.floats().iter().zip(b.floats()) {
            let distance = (a.to_bits().cast_signed() - b.to_bits().cast_signed()).abs();
            let is_near = if is_variance {
                (a - b).abs() <= 0.01 * b.abs()
            } else {
                distance <= most
            };
            assert!(is_near, "{a} instead of {b}");
        }
    }
}

/// Renders 4 ranges of samples, with another number of them in the first.
fn ranges(place: &Place, backend: &str) -> Vec<String> {
    let ranges = [(0, 3), (3, 8), (11, 8), (19, 13)];
    let files = ranges.map(|(first, count)| {
        let options = format!("--backend {backend} --samples-from {first} --samples {count}");
        make(place, &format!("{options} -o r{first}.exr"));
        format!("r{first}.exr")
    });
    files.into_iter().rev().collect()
}

#[test]
fn ranges_give_the_mean_and_the_variance_of_the_whole() {
    let place = Place::default();
    make(&place, "--backend cpu --samples 32 -o whole.exr");
    let ran = merge(&place, &ranges(&place, "cpu"), "merged.exr").succeeded();
    assert_says(&ran.stderr, &["4 ranges of samples"]);
    let (whole, merged) = (exr(&place, "whole.exr"), exr(&place, "merged.exr"));
    assert_eq!(merged.1.settings["samples"], "32");
    assert_eq!(merged.0.samples()[7], 32);
    assert_within_an_ulp(&merged.0, &whole.0);
}

/// The sums of a GPU are rounded with every sample, so the whole is not the mean of its ranges to the last digit; the merged image is.
#[test]
fn ranges_of_a_gpu_give_their_mean() {
    let place = Place::default();
    let files = ranges(&place, "gpu");
    let _ = merge(&place, &files, "merged.exr").succeeded();
    let merged = exr(&place, "merged.exr").0;
    let images: Vec<SpectralImage> = files.iter().map(|file| exr(&place, file).0).collect();
    for key in [
        LayerKey::of_light(Quantity::Radiance, 0),
        LayerKey::of_light(Quantity::Xyz, 1),
    ] {
        let found = merged.layer(key).unwrap().floats();
        for (i, found) in found.iter().enumerate() {
            let value = |image: &SpectralImage| {
                let weight = f64::from(image.samples()[0]) / 32.0;
                weight * f64::from(image.layer(key).unwrap().floats()[i])
            };
            let mean = images.iter().map(value).sum::<f64>() as f32;
            assert!(
                (found - mean).abs() <= f32::EPSILON * mean,
                "{found} instead of {mean}"
            );
        }
    }
}

/// Some parts do not go together: all of these words are said, and nothing is written.
fn refused(prepare: impl Fn(&Place), files: &str, words: &[&str]) {
    let place = Place::default();
    for part in 1..=3 {
        make(
            &place,
            &format!("--backend cpu --samples 4 --part {part}/3 -o {part}.exr"),
        );
    }
    prepare(&place);
    let ran = place.run(&format!("merge {files} -o merged.exr"));
    assert_eq!(ran.code, 1);
    assert_says(&ran.failed(), words);
    assert!(!place.path("merged.exr").exists());
}

fn nothing(_: &Place) {}

/// Renders another file beside the parts.
fn other(options: &'static str) -> impl Fn(&Place) {
    move |place| make(place, &format!("--backend cpu {options} -o other.exr"))
}

#[test]
fn a_missing_part_is_refused() {
    refused(nothing, "1.exr 3.exr", &["rows 12 to 23 are missing"]);
    refused(nothing, "2.exr 3.exr", &["rows 0 to 11 are missing"]);
    refused(nothing, "1.exr 2.exr", &["rows 24 to 35 are missing"]);
}

#[test]
fn one_part_is_refused() {
    refused(nothing, "1.exr", &["rows 12 to 35 are missing"]);
}

#[test]
fn a_doubled_part_is_refused() {
    let copy = |place: &Place| {
        fs::copy(place.path("2.exr"), place.path("copy.exr")).unwrap();
    };
    refused(
        copy,
        "1.exr 2.exr copy.exr 3.exr",
        &["copy.exr and 2.exr", "rows 12 to 23"],
    );
}

#[test]
fn overlapping_parts_are_refused() {
    let crop = other("--samples 4 --crop 0,10,40,14");
    refused(
        crop,
        "1.exr other.exr 3.exr",
        &["other.exr and 1.exr", "rows 10 to 11"],
    );
}

#[test]
fn a_part_of_another_picture_is_refused() {
    let words = [
        "other.exr is of another render than 1.exr",
        "seed (7 instead of 0)",
    ];
    refused(
        other("--samples 4 --seed 7 --part 2/3"),
        "1.exr other.exr 3.exr",
        &words,
    );
}

#[test]
fn a_part_of_another_backend_is_refused() {
    let gpu = |place: &Place| make(place, "--backend gpu --samples 4 --part 2/3 -o other.exr");
    refused(gpu, "1.exr other.exr 3.exr", &["other.exr", "backend"]);
}

#[test]
fn a_part_with_other_samples_is_refused() {
    let words = ["other.exr has samples 0 to 2", "1.exr has samples 0 to 3"];
    refused(
        other("--samples 3 --part 2/3"),
        "1.exr other.exr 3.exr",
        &words,
    );
}

#[test]
fn a_part_that_is_no_row_is_refused() {
    let words = ["other.exr does not hold whole rows"];
    refused(
        other("--samples 4 --crop 0,12,39,12"),
        "1.exr other.exr 3.exr",
        &words,
    );
}

#[test]
fn a_gap_between_ranges_is_refused() {
    let ranges = |place: &Place| {
        for first in [0, 8] {
            let options = format!("--backend cpu --samples 4 --samples-from {first}");
            make(place, &format!("{options} -o r{first}.exr"));
        }
    };
    refused(ranges, "r0.exr r8.exr", &["samples 4 to 7 are missing"]);
}

#[test]
fn overlapping_ranges_are_refused() {
    let ranges = |place: &Place| {
        for first in [0, 3] {
            let options = format!("--backend cpu --samples 4 --samples-from {first}");
            make(place, &format!("{options} -o r{first}.exr"));
        }
    };
    refused(
        ranges,
        "r0.exr r3.exr",
        &["r3.exr and r0.exr", "samples 3 to 3"],
    );
}

/// One file is all parts if it is the whole picture.
#[test]
fn the_only_part_is_the_whole() {
    let place = Place::default();
    make(&place, "--backend cpu --samples 4 --part 1/1 -o 1.exr");
    let _ = merge(&place, &["1.exr".to_owned()], "merged.exr").succeeded();
    assert!(exr(&place, "merged.exr").0 == exr(&place, "1.exr").0);
}

/// The header alone is not believed.
#[test]
fn an_unfinished_part_is_refused() {
    let unfinished = |place: &Place| {
        let (mut image, metadata) = exr(place, "2.exr");
        image.samples_mut()[14 * 40] = 3;
        let image = image.clone();
        let frame = spectral_exr::Frame::whole([40, 36]);
        let mut strip = Some(image);
        let mut next = || Ok::<_, std::convert::Infallible>(strip.take());
        let options = spectral_exr::WriteOptions::default();
        let path = place.path("2.exr");
        spectral_exr::write_rows(&path, frame, &metadata, options, &mut next).unwrap();
    };
    let words = ["2.exr is not finished: row 0 has pixels without its 4 samples"];
    refused(unfinished, "2.exr", &words);
}

#[test]
fn an_adaptive_picture_is_refused() {
    let words = ["other.exr has other numbers of samples"];
    refused(other("--samples 4 --adaptive"), "other.exr", &words);
}

/// A flipped bit in the pixels of a part.
#[test]
fn a_damaged_part_is_refused() {
    let damage = |place: &Place| {
        let mut file = bytes(place, "2.exr");
        let at = file.len() - 200;
        file[at] ^= 4;
        fs::write(place.path("2.exr"), file).unwrap();
    };
    refused(damage, "1.exr 2.exr 3.exr", &["2.exr"]);
}

#[test]
fn a_file_that_no_render_wrote_is_refused() {
    let relabeled = |place: &Place| {
        let image = crate::images::gray([40, 12], 6, None);
        crate::images::write(&place.path("other.exr"), &image);
    };
    refused(
        relabeled,
        "1.exr other.exr 3.exr",
        &["other.exr does not say what it is a part of"],
    );
}

#[test]
fn a_part_is_not_overwritten() {
    let place = Place::default();
    make(&place, "--backend cpu --samples 4 --part 1/2 -o 1.exr");
    make(&place, "--backend cpu --samples 4 --part 2/2 -o 2.exr");
    let before = bytes(&place, "1.exr");
    assert_says(
        &place.run("merge 1.exr 2.exr -o 1.exr").failed(),
        &["would overwrite"],
    );
    assert_eq!(bytes(&place, "1.exr"), before);
    assert_says(&place.run("merge 1.exr 2.exr -o x.png").failed(), &[".exr"]);
}
