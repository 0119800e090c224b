//! Campaigns for PNG pictures: their codes, their color information, and ICC profiles in them.

use crate::scenes;
use crate::support::{expect, files, refused};
use color::compare::Picture;
use colorimetry::Display;
use pellicle_fuzz::{Campaign, Outcome};
use picture_file::icc;
use picture_file::png_colors::CodeColors;
use png::{BitDepth, ColorType, Encoder};
use std::fs;

/// A picture of 2 × 2 pixels with this profile, or none.
fn png(color: ColorType, depth: BitDepth, profile: Option<&[u8]>) -> Vec<u8> {
    let mut info = png::Info::with_size(2, 2);
    info.color_type = color;
    info.bit_depth = depth;
    info.icc_profile = profile.map(|bytes| bytes.to_vec().into());
    let mut file = Vec::new();
    let mut writer = Encoder::with_info(&mut file, info)
        .unwrap()
        .write_header()
        .unwrap();
    let length = 4 * color.samples() * if depth == BitDepth::Sixteen { 2 } else { 1 };
    let codes: Vec<u8> = (0..length).map(|i| (i * 37) as u8).collect();
    writer.write_image_data(&codes).unwrap();
    writer.finish().unwrap();
    file
}

/// The file with the checksum at the end of each chunk corrected, as far as the chunks can be followed.
fn repaired(file: &[u8]) -> Vec<u8> {
    let mut bytes = file.to_vec();
    let mut at = 8;
    while let Some(head) = bytes.get(at..at + 8) {
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let end = at + 8 + length;
        let Some(chunk) = bytes.get(at + 4..end) else {
            break;
        };
        let sum = checksum(chunk).to_be_bytes();
        let Some(place) = bytes.get_mut(end..end + 4) else {
            break;
        };
        place.copy_from_slice(&sum);
        at = end + 4;
    }
    bytes
}

/// CRC-32 of a chunk (PNG 1.2, 3.4).
fn checksum(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| {
            (sum >> 1) ^ (0xedb8_8320 & (sum & 1).wrapping_neg())
        })
    })
}

fn with_chunk(file: &[u8], name: [u8; 4], data: &[u8]) -> Vec<u8> {
    let (first, rest) = file.split_at(8 + 4 + 4 + 13 + 4);
    let length = (data.len() as u32).to_be_bytes();
    repaired(&[first, &length, &name, data, &[0; 4], rest].concat())
}

fn seeds() -> Vec<Vec<u8>> {
    use ColorType::{Grayscale, GrayscaleAlpha, Rgb, Rgba};
    let plain = png(Rgb, BitDepth::Eight, None);
    let mut seeds = files("tests/data", "png");
    seeds
        .extend([Grayscale, GrayscaleAlpha, Rgba].map(|color| png(color, BitDepth::Sixteen, None)));
    let chromaticities = [
        31_270_u32, 32_900, 64_000, 33_000, 30_000, 60_000, 15_000, 6_000,
    ];
    seeds.extend([
        with_chunk(&plain, *b"gAMA", &45_455_u32.to_be_bytes()),
        with_chunk(&plain, *b"sRGB", &[0]),
        with_chunk(&plain, *b"cICP", &[9, 16, 0, 1]),
        with_chunk(
            &plain,
            *b"cHRM",
            &chromaticities.map(u32::to_be_bytes).concat(),
        ),
        with_chunk(&plain, *b"iCCP", b"name\0\0no profile"),
        plain,
    ]);
    seeds
}

/// Files whose headers promise large data, and small data that expand to large.
fn bombs() -> Vec<Vec<u8>> {
    let file = png(ColorType::Rgb, BitDepth::Eight, None);
    let sized = |width: u32, height: u32| {
        let mut copy = file.clone();
        copy[16..20].copy_from_slice(&width.to_be_bytes());
        copy[20..24].copy_from_slice(&height.to_be_bytes());
        repaired(&copy)
    };
    let sizes = [
        (0, 0),
        (1 << 31, 1),
        (65_535, 65_535),
        (1, 1 << 30),
        (16_384, 16_384),
    ];
    let mut files: Vec<_> = sizes.map(|(width, height)| sized(width, height)).to_vec();
    // 4 MB of zeros, which compress to 4 kB.
    let zeros = vec![0; 4 << 20];
    files.push(png(ColorType::Rgb, BitDepth::Eight, Some(&zeros)));
    files
}

/// A scene that uses the picture as a texture and as a thickness.
const SCENE: &str = "camera = { type = 'perspective', position = [0, 0, 5], look_at = [0, 0, 0], fov_deg = 40 }\n\
    render = { bands = 2 }\n\
    materials.a = { type = 'diffuse', reflectance = { texture = 'a.png' } }\n\
    materials.b = { type = 'film', index = 1.33, thickness_nm = { image = 'a.png', min = 100, max = 900 } }\n";

#[test]
fn png_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let campaign = Campaign {
        seeds: [seeds(), bombs()].concat(),
        repair: repaired,
        ..Campaign::new("png", 1000)
    };
    campaign.run(|bytes| {
        fs::write(&path, bytes).unwrap();
        if let Ok(picture) = Picture::read_png(&path) {
            let is_finite = picture
                .linear()
                .iter()
                .flatten()
                .all(|value| value.is_finite());
            if !is_finite {
                return Outcome::Unsound("a pixel is not finite".to_owned());
            }
        }
        scenes::read(SCENE, folder.path())
    });
}

/// Mutates the profile alone; the file around it stays sound.
#[test]
fn icc_profiles() {
    let displays = ["srgb", "display_p3", "crt_1997"].map(|name| Display::named(name).unwrap());
    let mut seeds: Vec<_> = displays
        .iter()
        .map(|display| icc::profile(display).unwrap())
        .collect();
    seeds.push(vec![0; 1 << 20]);
    let campaign = Campaign {
        seeds,
        ..Campaign::new("icc", 1000)
    };
    campaign.run(|profile| {
        let file = png(ColorType::Rgb, BitDepth::Eight, Some(profile));
        let colors = match CodeColors::of_png(&file) {
            Ok(colors) => colors,
            Err(error) => return refused(&error),
        };
        let codes = [0, 1, 255, 32_767, 65_535];
        let is_finite = codes.iter().all(|&code| {
            let mixed = [[code; 3], [code, 0, 65_535]];
            mixed.iter().all(|&codes| {
                colors
                    .linear_srgb(codes)
                    .iter()
                    .all(|light| light.is_finite())
            })
        });
        // A profile that cannot be used is ignored with a note, which distinguishes outcomes.
        match colors.notes() {
            notes if is_finite && !notes.is_empty() => Outcome::Refused(notes.concat()),
            _ => expect(is_finite, || "a color is not finite".to_owned()),
        }
    });
}
