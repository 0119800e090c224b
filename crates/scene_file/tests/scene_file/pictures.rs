//! Pictures as inputs: metadata in their files is respected and noted, and the requested layer or channel is used.
#![expect(
    clippy::float_cmp,
    reason = "the values are exact in binary, or the same arithmetic"
)]

use crate::{CAMERA, checksum};
use colorimetry::lifting::SigmoidReflectance;
use colorimetry::srgb;
use image::{DynamicImage, ImageBuffer, Luma, LumaA, Rgb, Rgba};
use pellicle_scene_file::Problems;
use scene::{Environment, Material, Pattern, Scene, Texels, Thickness};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn read(folder: &Path, rest: &str) -> Result<Scene, Problems> {
    crate::read(&format!("{CAMERA}{rest}\n"), folder)
}

/// The notes about this file.
fn notes_of(scene: &Scene, file: &str) -> Vec<String> {
    let notes = scene.notes().into_iter();
    notes.filter(|note| note.contains(file)).collect()
}

fn refusal(result: Result<Scene, Problems>) -> String {
    let problems = result.expect_err("it is accepted");
    assert_eq!(problems.iter().count(), 1, "{problems:#}");
    format!("{problems:#}")
}

/// A Radiance file of two pixels, 1 and 1/2 red, with these lines in its header.
fn surrounded(lines: &str, size: &str) -> Result<(Texels, Vec<String>), String> {
    let directory = TempDir::new().unwrap();
    let mut bytes = format!("#?RGBE\n{lines}\n\n{size}\n").into_bytes();
    bytes.extend([128, 128, 128, 129, 64, 0, 0, 129]);
    fs::write(directory.path().join("sky.hdr"), bytes).unwrap();
    let scene = read(
        directory.path(),
        "environment = { type = 'image', image = 'sky.hdr' }",
    );
    let scene = match scene {
        Ok(scene) => scene,
        error => return Err(refusal(error)),
    };
    let Environment::Picture { picture, .. } = scene.environment() else {
        panic!("it is not a picture");
    };
    Ok((picture.texels.clone(), notes_of(&scene, "sky.hdr")))
}

/// The factor of a texel is twice the largest of the three numbers.
#[test]
fn radiance_files_are_read_with_their_headers() {
    let format = "FORMAT=32-bit_rle_rgbe";
    let (plain, notes) = surrounded(format, "-Y 1 +X 2").unwrap();
    let scales = |texels: &Texels| [0, 1].map(|x| texels.at([x, 0])[0][3]);
    assert_eq!((scales(&plain), notes.len()), ([2.0, 1.0], 0));

    let (exposed, notes) = surrounded(&format!("{format}\nEXPOSURE=2"), "-Y 1 +X 2").unwrap();
    assert_eq!(scales(&exposed), [1.0, 0.5]);
    let expected = "environment.image: sky.hdr: EXPOSURE=2: pixels divided by 2";
    assert_eq!(notes, [expected]);

    let (turned, notes) = surrounded(format, "-Y 1 -X 2").unwrap();
    assert_eq!(scales(&turned), [1.0, 2.0]);
    assert!(notes[0].ends_with("turned upright from -Y 1 -X 2"));

    let (xyz, notes) = surrounded("FORMAT=32-bit_rle_xyze", "-Y 1 +X 2").unwrap();
    // XYZ (1, 1, 1) has R = 3.2406 − 1.5372 − 0.4986 by the matrix of IEC 61966-2-1.
    assert!((scales(&xyz)[0] / 2.0 - 1.2048).abs() < 2e-4);
    assert!(notes[0].contains("XYZE"), "{notes:?}");
}

fn bad_radiance_file(size: &str, problem: &str) {
    let said = surrounded("FORMAT=32-bit_rle_rgbe", size).unwrap_err();
    assert!(said.contains(problem), "{said:?} lacks {problem:?}");
}

cases! { bad_radiance_file:
    an_empty_radiance_file("-Y 0 +X 2", "sky.hdr: has 2 × 0 pixels: it is empty");
    a_square_radiance_file("-Y 4 +X 4", "4 × 4 pixels; a picture of all directions");
    half_a_radiance_file("-Y 2 +X 4", "cut short: it ends in scanline 1 of 2");
    a_radiance_file_that_is_too_large("-Y 8200 +X 16400", "at most 16384 per side");
    a_radiance_file_of_half_a_size("-Y 1", "-Y HEIGHT +X WIDTH would be right");
}

/// Adds a chunk to a PNG file, after the first.
fn with_chunk(png: &[u8], name: [u8; 4], data: &[u8]) -> Vec<u8> {
    let (first, rest) = png.split_at(8 + 4 + 4 + 13 + 4);
    let named = [&name[..], data].concat();
    let length = (data.len() as u32).to_be_bytes();
    let sum = checksum(&named).to_be_bytes();
    [first, &length, &named, &sum, rest].concat()
}

fn png(picture: impl Into<DynamicImage>) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture: DynamicImage = picture.into();
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .unwrap();
    bytes.into_inner()
}

/// Returns the first texel of a texture, and the notes about it.
fn texture(file: &[u8]) -> Result<([f32; 4], Vec<String>), String> {
    let directory = TempDir::new().unwrap();
    fs::write(directory.path().join("map.png"), file).unwrap();
    let scene = read(
        directory.path(),
        "[materials.x]\ntype = 'diffuse'\nreflectance = { texture = 'map.png' }",
    );
    let scene = match scene {
        Ok(scene) => scene,
        error => return Err(refusal(error)),
    };
    let Material::Diffuse { reflectance } = &scene.materials()[0] else {
        panic!("it is not diffuse");
    };
    let Pattern::Texture { texels, .. } = reflectance else {
        panic!("it has no texture");
    };
    Ok((texels.at([0, 0])[0], notes_of(&scene, "map.png")))
}

fn texel(linear: [f64; 3]) -> [f32; 4] {
    let [c0, c1, c2] = SigmoidReflectance::of_linear_srgb(linear).coefficients;
    [c0, c1, c2, 1.0].map(|value| value as f32)
}

#[test]
fn textures_are_read_by_their_tags() {
    let codes = [40, 120, 200_u8];
    let plain = png(ImageBuffer::from_pixel(1, 1, Rgb(codes)));
    let linear = codes.map(|code| f64::from(code) / 255.0);
    let of_srgb = texel(linear.map(srgb::decode));
    assert_eq!(texture(&plain), Ok((of_srgb, vec![])));
    let tagged = texture(&with_chunk(&plain, *b"sRGB", &[0]));
    assert_eq!(tagged, Ok((of_srgb, vec![])));

    for file in [
        with_chunk(&plain, *b"cICP", &[1, 8, 0, 1]),
        with_chunk(&plain, *b"gAMA", &100_000_u32.to_be_bytes()),
        // The chunk with the highest precedence in PNG counts, wherever it is.
        with_chunk(
            &with_chunk(&plain, *b"cICP", &[1, 8, 0, 1]),
            *b"gAMA",
            &45_455_u32.to_be_bytes(),
        ),
    ] {
        let (found, notes) = texture(&file).unwrap();
        assert_eq!(found, texel(linear));
        let field = "materials.x.reflectance.texture: map.png: ";
        assert!(notes.len() == 1 && notes[0].starts_with(field), "{notes:?}");
    }
    let said = texture(&with_chunk(&plain, *b"cICP", &[9, 16, 0, 1])).unwrap_err();
    assert!(said.contains("map.png") && said.contains("PQ"), "{said}");

    // Red of P3 is (1.2249, −0.0421, −0.0196) of sRGB.
    let red = png(ImageBuffer::from_pixel(1, 1, Rgb([255_u8, 0, 0])));
    let (found, notes) = texture(&with_chunk(&red, *b"cICP", &[12, 13, 0, 1])).unwrap();
    assert_eq!(found, texel([1.0, 0.0, 0.0]));
    assert!(
        notes[1].contains("1 of its 1 colors are outside"),
        "{notes:?}"
    );
}

/// Alpha is not part of a reflectance.
#[test]
fn transparent_pixels_are_noted() {
    let of_srgb = texel([0.25, 0.5, 0.75].map(|v: f64| srgb::decode((v * 255.0).round() / 255.0)));
    let pixel = |alpha: u8| {
        png(ImageBuffer::from_pixel(
            1,
            1,
            Rgba([64_u8, 128, 191, alpha]),
        ))
    };
    assert_eq!(texture(&pixel(255)), Ok((of_srgb, vec![])));
    let (found, notes) = texture(&pixel(0)).unwrap();
    assert_eq!(found, of_srgb);
    assert!(notes[0].contains("transparent"), "{notes:?}");
    let gray = png(ImageBuffer::from_pixel(1, 1, LumaA([64_u8, 3])));
    assert!(texture(&gray).unwrap().1[0].contains("transparent"));
}

/// Returns the values of a picture of thicknesses, and the notes about it.
fn values(file: &[u8], channel: &str) -> Result<(Vec<f32>, Vec<String>), String> {
    let directory = TempDir::new().unwrap();
    fs::write(directory.path().join("map.png"), file).unwrap();
    let scene = read(
        directory.path(),
        &format!(
            "[materials.x]\ntype = 'film'\nindex = 1.5\nthickness_nm = {{ image = 'map.png', min = 0, max = 9{channel} }}"
        ),
    );
    let scene = match scene {
        Ok(scene) => scene,
        error => return Err(refusal(error)),
    };
    let Some(Thickness::Picture(picture)) = scene.materials()[0].thicknesses().next() else {
        panic!("it is not a picture");
    };
    Ok((picture.file.values.clone(), notes_of(&scene, "map.png")))
}

#[test]
fn a_channel_of_a_picture_is_chosen() {
    // 51/255 = 0.2, 102/255 = 0.4, 153/255 = 0.6, 204/255 = 0.8.
    let colors = png(ImageBuffer::from_pixel(1, 1, Rgba([51_u8, 102, 153, 204])));
    for (channel, value) in [("r", 0.2), ("g", 0.4), ("b", 0.6), ("a", 0.8)] {
        let (found, notes) = values(&colors, &format!(", channel = '{channel}'")).unwrap();
        assert_eq!(found, [value], "{channel}");
        assert_eq!(notes.len(), usize::from(channel != "a"), "{notes:?}");
    }
    // 0.2126 · 0.2 + 0.7152 · 0.4 + 0.0722 · 0.6.
    let luma = 0.371_92;
    let (found, notes) = values(&colors, ", channel = 'luma'").unwrap();
    assert!((found[0] - luma).abs() < 2e-5, "{found:?}");
    assert!(notes.len() == 1 && notes[0].contains("transparent"));
    let (same, notes) = values(&colors, "").unwrap();
    assert_eq!(same, found);
    assert!(
        notes.iter().any(|note| note.contains("their luma is used")),
        "{notes:?}"
    );

    let deep = png(ImageBuffer::from_pixel(1, 1, Rgb([13_107_u16, 26_214, 0])));
    assert_eq!(values(&deep, ", channel = 'g'"), Ok((vec![0.4], vec![])));
    assert_eq!(values(&deep, "").unwrap().1.len(), 1);
    let said = values(&deep, ", channel = 'a'").unwrap_err();
    assert!(said.contains("has no alpha channel"), "{said}");
    assert!(values(&deep, ", channel = 'green'").is_err());
}

/// Pictures without colors get no note, whatever their form, and their tags have no effect.
#[test]
fn gray_pictures_are_numbers_as_they_stand() {
    let gray = png(ImageBuffer::from_pixel(1, 1, Luma([51_u8])));
    let colored = png(ImageBuffer::from_pixel(1, 1, Rgb([51_u8; 3])));
    let deep = png(ImageBuffer::from_pixel(
        1,
        1,
        Rgba([13_107_u16, 13_107, 13_107, u16::MAX]),
    ));
    for file in [gray, colored, deep] {
        for channel in [
            "",
            ", channel = 'luma'",
            ", channel = 'r'",
            ", channel = 'b'",
        ] {
            assert_eq!(values(&file, channel), Ok((vec![0.2], vec![])), "{channel}");
        }
        for (name, data) in [
            (b"cICP", [1, 8, 0, 1]),
            (b"cICP", [9, 16, 0, 1]),
            (b"gAMA", 100_000_u32.to_be_bytes()),
        ] {
            let tagged = with_chunk(&file, *name, &data);
            assert_eq!(values(&tagged, ""), Ok((vec![0.2], vec![])));
        }
    }
}
