//! Campaigns for Radiance pictures, alone and as the environment of a scene.

use crate::scenes;
use crate::support::{expect, root};
use pellicle_fuzz::{Campaign, Outcome};
use picture_file::radiance::RadiancePicture;
use std::fs;

/// A scene with the picture as its environment.
pub(crate) fn surrounded(file: &str) -> String {
    format!(
        "camera = {{ type = 'perspective', position = [0, 0, 5], look_at = [0, 0, 0], fov_deg = 40 }}\n\
         render = {{ bands = 2 }}\nenvironment = {{ type = 'image', image = '{file}' }}\n"
    )
}

const WORDS: [&str; 20] = [
    "#?RADIANCE\n",
    "FORMAT=32-bit_rle_rgbe\n",
    "FORMAT=32-bit_rle_xyze\n",
    "EXPOSURE=2\n",
    "COLORCORR=1 1 1\n",
    "PRIMARIES=0 0 0 0 0 0 0 0\n",
    "PRIMARIES=0.64 0.33 0.3 0.6 0.15 0.06 0.33 0.33\n",
    "PIXASPECT=2\n",
    "GAMMA=2.2\n",
    "\n\n",
    "-Y 2 +X 4\n",
    "+X 2 -Y 1\n",
    "-Y ",
    "+X ",
    "\u{2}\u{2}\0\u{8}",
    "\u{1}\u{1}\u{1}\u{ff}",
    "VIEW= -vtl\n",
    "=",
    "\r\n",
    "-Y 99999 +X 199998\n",
];

fn read(bytes: &[u8]) -> Outcome {
    let picture = match RadiancePicture::new(bytes) {
        Ok(picture) => picture,
        Err(error) => return Outcome::Refused(error.to_string()),
    };
    // The callers check the size.
    if u64::from(picture.width()) * u64::from(picture.height()) > 1 << 26 {
        return Outcome::Refused("it is too large".to_owned());
    }
    match picture.pixels() {
        Ok(pixels) if !pixels.iter().flatten().all(|value| value.is_finite()) => {
            expect(false, || "a pixel is not finite".to_owned())
        }
        Ok(pixels) => Outcome::Accepted {
            kept: pixels.len() * 12,
        },
        Err(error) => Outcome::Refused(error.to_string()),
    }
}

/// Files that promise large data.
fn bombs() -> Vec<Vec<u8>> {
    let sizes = [
        "-Y 100000 +X 200000",
        "-Y 2147483647 +X 2147483647",
        "-Y 1 +X 4000000000",
        "-Y 32768 +X 32767",
        "-Y 0 +X 0",
    ];
    let header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    let mut files: Vec<_> = sizes
        .map(|size| format!("{header}{size}\n").into_bytes())
        .to_vec();
    let mut runs = format!("{header}-Y 4096 +X 8192\n").into_bytes();
    // Runs that repeat the previous pixel, each as often as a count of 255 allows.
    runs.extend([128, 128, 128, 129]);
    runs.extend([1, 1, 1, 255].repeat(2000));
    files.push(runs);
    files.push(format!("#?RADIANCE\n{}", "EXPOSURE=2\n".repeat(20_000)).into_bytes());
    files
}

fn seeds() -> Vec<Vec<u8>> {
    let plain = |lines: &str, size: &str, pixels: &[u8]| {
        let header = format!("#?RGBE\n{lines}\n\n{size}\n");
        [header.as_bytes(), pixels].concat()
    };
    let scanline = [
        &[2, 2, 0, 8][..],
        &[136, 7, 8, 1, 2, 3, 4, 5, 6, 7, 8, 136, 9, 136, 129],
    ]
    .concat();
    vec![
        fs::read(root().join("tests/data/environment.hdr")).unwrap(),
        plain(
            "FORMAT=32-bit_rle_rgbe",
            "-Y 1 +X 2",
            &[128, 128, 128, 129, 64, 0, 0, 129],
        ),
        plain(
            "FORMAT=32-bit_rle_xyze\nEXPOSURE=2",
            "+X 2 -Y 1",
            &[128, 128, 128, 129, 64, 0, 0, 129],
        ),
        plain(
            "PRIMARIES=0.64 0.33 0.3 0.6 0.15 0.06 0.33 0.33",
            "-Y 2 +X 4",
            &[1, 2, 3, 129].repeat(8),
        ),
        plain("FORMAT=32-bit_rle_rgbe", "-Y 4 +X 8", &scanline.repeat(4)),
    ]
}

#[test]
fn radiance_pictures() {
    Campaign {
        seeds: [seeds(), bombs()].concat(),
        words: &WORDS,
        ..Campaign::new("radiance", 5000)
    }
    .run(read);
}

#[test]
fn radiance_environment() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("sky.hdr");
    let text = surrounded("sky.hdr");
    Campaign {
        seeds: seeds(),
        words: &WORDS,
        ..Campaign::new("radiance_environment", 500)
    }
    .run(|bytes| {
        fs::write(&file, bytes).unwrap();
        scenes::read(&text, folder.path())
    });
}
