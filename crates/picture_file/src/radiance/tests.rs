use super::*;

/// A file of these header lines, an empty line, a line with the size, and pixels.
fn file(lines: &[&str], size: &str, pixels: &[u8]) -> Vec<u8> {
    let mut bytes = lines.join("\n").into_bytes();
    bytes.extend_from_slice(format!("\n\n{size}\n").as_bytes());
    bytes.extend_from_slice(pixels);
    bytes
}

const PLAIN: [&str; 2] = ["#?RADIANCE", "FORMAT=32-bit_rle_rgbe"];

/// At the exponent 136 a mantissa is the value: 2^(136 − 136).
const ONE: u8 = 136;

struct Read {
    size: [u32; 2],
    pixels: Vec<[f32; 3]>,
    notes: Vec<String>,
}

fn read(bytes: &[u8]) -> Result<Read, RadianceError> {
    let picture = RadiancePicture::new(bytes)?;
    Ok(Read {
        size: [picture.width(), picture.height()],
        pixels: picture.pixels()?,
        notes: picture.notes().to_vec(),
    })
}

/// The color and the notes of a single pixel of these bytes with these header lines.
fn one(lines: &[&str], pixel: [u8; 4]) -> (Vec<f64>, Vec<String>) {
    let read = read(&file(lines, "-Y 1 +X 1", &pixel)).unwrap();
    (read.pixels[0].map(f64::from).to_vec(), read.notes)
}

fn assert_near(found: &[f64], expected: [f64; 3], within: f64) {
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < within, "{found} {expected}");
    }
}

fn said(bytes: &[u8]) -> String {
    read(bytes).err().map(|error| error.to_string()).unwrap()
}

#[test]
fn magics_and_line_ends() {
    for magic in ["#?RADIANCE", "#?RGBE", "#?AUTOPANO", "#?"] {
        let lines = [magic, "# a comment", "FORMAT=32-bit_rle_rgbe", "SOFTWARE=x"];
        let (pixel, notes) = one(&lines, [3, 4, 250, ONE]);
        assert_eq!((pixel, notes), (vec![3.0, 4.0, 250.0], vec![]));
        let mut bytes = lines.join("\r\n").into_bytes();
        bytes.extend_from_slice(b"\r\n\r\n-Y 1 +X 1\r\n");
        bytes.extend_from_slice(&[3, 4, 250, ONE + 1]);
        assert_eq!(read(&bytes).unwrap().pixels, [[6.0, 8.0, 500.0]]);
    }
    let (pixel, notes) = one(&["#?RADIANCE"], [128, 0, 0, 129]);
    assert_eq!(pixel, [1.0, 0.0, 0.0]);
    assert!(notes[0].contains("no FORMAT"), "{notes:?}");
    // An exponent of 0 is black, whatever the mantissas; the largest value is 255 · 2^119, with exponent 255.
    assert_eq!(one(&PLAIN, [255, 255, 255, 0]).0, [0.0; 3]);
    assert_eq!(one(&PLAIN, [255, 0, 0, 255]).0[0], 255.0 * 2_f64.powi(119));
    assert_eq!(one(&PLAIN, [200, 0, 0, 1]).0[0], 200.0 * 2_f64.powi(-135));
}

/// The picture a b c over d e f, with its scanlines written by hand for each orientation.
#[test]
fn every_orientation_is_turned_upright() {
    for (size, order) in [
        ("-Y 2 +X 3", "abcdef"),
        ("-Y 2 -X 3", "cbafed"),
        ("+Y 2 +X 3", "defabc"),
        ("+Y 2 -X 3", "fedcba"),
        ("+X 3 -Y 2", "adbecf"),
        ("+X 3 +Y 2", "daebfc"),
        ("-X 3 -Y 2", "cfbead"),
        ("-X 3 +Y 2", "fcebda"),
    ] {
        let pixels = order.bytes().flat_map(|name| [name, 7, 200, ONE]);
        let found = read(&file(&PLAIN, size, &pixels.collect::<Vec<u8>>())).unwrap();
        assert_eq!(found.size, [3, 2], "{size}");
        let names: Vec<u8> = found.pixels.iter().map(|pixel| pixel[0] as u8).collect();
        assert_eq!(names, b"abcdef", "{size}");
        let is_turned = size != "-Y 2 +X 3";
        assert_eq!(found.notes.len(), usize::from(is_turned), "{size}");
        assert!(found.notes.iter().all(|note| note.contains(size)));
    }
}

/// Flat pixels, the old encoding with repeats and the new one with runs give the same picture.
#[test]
fn every_way_to_write_scanlines() {
    // Ten times (9, 8, 7), then (6, 5, 4) twice.
    let expected: Vec<[f32; 3]> = [vec![[9.0, 8.0, 7.0]; 10], vec![[6.0, 5.0, 4.0]; 2]].concat();
    let flat = [[9, 8, 7, ONE].repeat(10), [6, 5, 4, ONE].repeat(2)].concat();
    let old = [9, 8, 7, ONE, 1, 1, 1, 9, 6, 5, 4, ONE, 1, 1, 1, 1];
    let component = |first: u8, last: u8| [128 + 10, first, 2, last, last];
    let mut new = vec![2, 2, 0, 12];
    for (first, last) in [(9, 6), (8, 5), (7, 4), (ONE, ONE)] {
        new.extend(component(first, last));
    }
    for pixels in [&flat[..], &old, &new] {
        let found = read(&file(&PLAIN, "-Y 1 +X 12", pixels)).unwrap();
        assert_eq!(found.pixels, expected);
    }
    // 3 + 256 · 1 repeats of the first of 260 pixels; the second scanline starts over.
    let long = [9, 8, 7, ONE, 1, 1, 1, 3, 1, 1, 1, 1];
    let found = read(&file(&PLAIN, "-Y 2 +X 260", &long.repeat(2))).unwrap();
    assert_eq!(found.pixels, vec![[9.0, 8.0, 7.0]; 520]);
    // A flat scanline of eight or more pixels may begin with 2, 2 if its third byte shows that it has no runs.
    let dark = [2, 2, 130, ONE].repeat(8);
    let found = read(&file(&PLAIN, "-Y 1 +X 8", &dark)).unwrap();
    assert_eq!(found.pixels, vec![[2.0, 2.0, 130.0]; 8]);
    // Shorter ones have no runs at all.
    let found = read(&file(&PLAIN, "-Y 1 +X 2", &[2, 2, 0, 2, 5, 5, 5, ONE])).unwrap();
    assert_eq!(found.pixels[1], [5.0; 3]);
}

#[test]
fn exposures_and_corrections_are_divided_by() {
    let lines = [
        "#?RADIANCE",
        "EXPOSURE=2.0",
        "EXPOSURE= 4",
        "\tEXPOSURE=100",
    ];
    let (pixel, notes) = one(&lines, [8, 16, 24, ONE]);
    assert_eq!(pixel, [1.0, 2.0, 3.0]);
    assert_eq!(notes[0], "EXPOSURE=8: pixels divided by 8");
    let lines = [
        "#?RADIANCE",
        "FORMAT=32-bit_rle_rgbe",
        "COLORCORR=1 2 4",
        "COLORCORR= 2 2 1",
        "EXPOSURE=.5",
    ];
    let (pixel, notes) = one(&lines, [8, 16, 24, ONE]);
    assert_eq!(pixel, [8.0, 8.0, 12.0]);
    assert_eq!(notes.len(), 1);
    for ignored in [
        "EXPOSURE=0",
        "EXPOSURE=-2",
        "EXPOSURE=inf",
        "EXPOSURE=NaN",
        "COLORCORR=1 0 1",
    ] {
        let (pixel, notes) = one(&[PLAIN[0], PLAIN[1], ignored], [8, 16, 24, ONE]);
        assert_eq!(pixel, [8.0, 16.0, 24.0]);
        assert!(
            notes.len() == 1 && notes[0].contains("ignored"),
            "{notes:?}"
        );
    }
    assert_eq!(
        one(&[PLAIN[0], PLAIN[1], "EXPOSURE=1"], [8, 16, 24, ONE])
            .1
            .len(),
        0
    );
    let tiny = ["#?RADIANCE", "EXPOSURE=1e-200", "EXPOSURE=1e-200"];
    assert!(said(&file(&tiny, "-Y 1 +X 1", &[8, 8, 8, ONE])).contains("multiply to"));
    let small = ["#?RADIANCE", "EXPOSURE=1e-300"];
    let bright = file(&small, "-Y 1 +X 1", &[200, 8, 8, 200]);
    assert!(said(&bright).contains("scanline 1 is larger"));
    for (line, problem) in [
        (
            "EXPOSURE=two",
            "line 2 of its header, \"EXPOSURE=two\", is not a number",
        ),
        ("COLORCORR=1 2", "is not three numbers"),
        ("PRIMARIES=1 2", "is not the eight numbers"),
        (
            "PRIMARIES=.64 .33 .64 .33 .15 .06 .3127 .3290",
            "not three primaries",
        ),
        (
            "FORMAT=Radiance_spectra",
            "is a format that is not supported",
        ),
    ] {
        let said = said(&file(&["#?RADIANCE", line], "-Y 1 +X 1", &[8, 8, 8, ONE]));
        assert!(said.contains(problem), "{said}");
    }
}

/// XYZ (1/4, 1/2, 1/8) by the matrix printed in IEC 61966-2-1: R = 3.2406 · 0.25 − 1.5372 · 0.5 − 0.4986 · 0.125, and so on.
#[test]
fn xyz_becomes_srgb() {
    let lines = ["#?RADIANCE", "FORMAT=32-bit_rle_xyze", "EXPOSURE=2"];
    // 64, 128 and 32 of 2^−8, times the exposure.
    let (pixel, notes) = one(&lines, [64, 128, 32, 129]);
    assert_near(&pixel, [-0.020_775, 0.700_862, 0.044_050], 1e-4);
    assert!(notes.iter().any(|note| note.contains("1/179")), "{notes:?}");
}

/// Published matrices between primaries of one white: Adobe RGB (1998) and Display P3 to sRGB, both with D65 (CSS Color Module
/// Level 4, section 18).
#[test]
fn primaries_become_those_of_srgb() {
    let adobe = "PRIMARIES=0.64 0.33 0.21 0.71 0.15 0.06 0.3127 0.3290";
    let p3 = "PRIMARIES= 0.680 0.320 0.265 0.690 0.150 0.060 0.3127 0.3290";
    for (primaries, columns) in [
        (
            adobe,
            [
                [1.398_36, 0.0, 0.0],
                [-0.398_36, 1.0, -0.042_93],
                [0.0, 0.0, 1.042_93],
            ],
        ),
        (
            p3,
            [
                [1.224_94, -0.042_06, -0.019_64],
                [-0.224_94, 1.042_06, -0.078_64],
                [0.0, 0.0, 1.098_27],
            ],
        ),
    ] {
        for (channel, column) in columns.into_iter().enumerate() {
            let mut pixel = [0, 0, 0, 129];
            pixel[channel] = 128;
            let (found, notes) = one(&[PLAIN[0], PLAIN[1], primaries], pixel);
            assert_near(&found, column, 1e-4);
            assert!(notes[0].starts_with("PRIMARIES=0.6"), "{notes:?}");
        }
    }
    // The primaries of sRGB change no bit and give no note.
    let own = "PRIMARIES=0.640 0.330 0.300 0.600 0.150 0.060 0.313 0.329";
    let (found, notes) = one(&[PLAIN[0], PLAIN[1], own], [77, 3, 211, 121]);
    assert_eq!((found, notes), one(&PLAIN, [77, 3, 211, 121]));
    // Radiance's white (0.333, 0.333) is not adapted: XYZ (1, 1, 1.003) by the matrix of IEC 61966-2-1.
    let radiance = "PRIMARIES=0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333";
    let (found, _) = one(&[PLAIN[0], PLAIN[1], radiance], [128, 128, 128, 129]);
    assert_near(&found, [1.2033, 0.9485, 0.9119], 5e-4);
}

#[test]
fn what_is_no_picture_is_one_error() {
    let pixel = [8, 8, 8, ONE];
    for (bytes, problem) in [
        (
            b"#!RADIANCE\n\n-Y 1 +X 1\n".to_vec(),
            "does not begin with #?",
        ),
        (vec![], "does not begin with #?"),
        (
            b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe".to_vec(),
            "there is no empty line",
        ),
        (
            b"#?RADIANCE\n\n-Y 1 +X 1".to_vec(),
            "there is no empty line",
        ),
        (
            b"#?x\n"
                .iter()
                .chain(&vec![b'a'; 70_000])
                .copied()
                .collect(),
            "there is no empty line",
        ),
        (
            file(&PLAIN, "-Y 0 +X 2", &[]),
            "has 2 × 0 pixels: it is empty",
        ),
        (file(&PLAIN, "+X 0 -Y 2", &[]), "has 0 × 2 pixels"),
        (file(&PLAIN, "-Y 1 +Y 1", &pixel), "line 4 of its header"),
        (
            file(&PLAIN, "-Y 1 +X", &pixel),
            "-Y HEIGHT +X WIDTH would be right",
        ),
        (file(&PLAIN, "-Y 1 +X 99999999999", &pixel), "how large"),
        (file(&PLAIN, "-Y 1 +X 1 +Z 1", &pixel), "how large"),
        (file(&PLAIN, "é 1 +X 1", &pixel), "how large"),
        (
            file(&PLAIN, "-Y 2 +X 1", &pixel),
            "cut short: it ends in scanline 2 of 2",
        ),
        (
            file(&PLAIN, "-Y 1 +X 2", &[1, 1, 1, 1]),
            "begins with the repeat",
        ),
        (
            file(&PLAIN, "-Y 1 +X 2", &[8, 8, 8, ONE, 1, 1, 1, 2]),
            "beyond its end",
        ),
        (
            file(&PLAIN, "-Y 1 +X 9", &[2, 2, 0, 8]),
            "says that it has another length",
        ),
        (
            file(&PLAIN, "-Y 1 +X 8", &[2, 2, 0, 8, 137, 5]),
            "beyond its end",
        ),
        (
            file(&PLAIN, "-Y 1 +X 8", &[2, 2, 0, 8, 0, 5]),
            "run of no length",
        ),
        (file(&PLAIN, "-Y 1 +X 8", &[2, 2, 0, 8, 8, 5]), "cut short"),
    ] {
        let said = said(&bytes);
        assert!(said.contains(problem), "{said:?} lacks {problem:?}");
    }
    let both = [
        "#?RADIANCE",
        "FORMAT=32-bit_rle_rgbe",
        "FORMAT=32-bit_rle_xyze",
    ];
    assert!(said(&file(&both, "-Y 1 +X 1", &pixel)).contains("line 3"));
}

/// No memory is allocated for a file that claims about 10^10 pixels and holds nine.
#[test]
fn absurd_sizes_are_cut_short() {
    let bytes = file(&PLAIN, "-Y 1073741824 +X 9", &[8, 8, 8, ONE].repeat(9));
    assert!(said(&bytes).contains("scanline 2 of 1073741824"));
}

/// Every prefix of a file, and files with one byte changed: any picture that is read has the number of pixels that it claims.
#[test]
fn damage_is_never_a_panic() {
    let mut pixels = vec![2, 2, 0, 12];
    for value in [9, 8, 7, ONE] {
        pixels.extend([128 + 10, value, 2, value, value]);
    }
    let lines = [
        "#?RADIANCE",
        "EXPOSURE=2",
        "COLORCORR=1 2 1",
        "FORMAT=32-bit_rle_xyze",
    ];
    let whole = file(&lines, "+Y 2 -X 12", &pixels.repeat(2));
    assert_eq!(read(&whole).unwrap().pixels.len(), 24);
    for length in 0..whole.len() {
        assert!(read(&whole[..length]).is_err(), "{length}");
    }
    for at in 0..whole.len() {
        for value in [0, 1, 2, b'\n', b'9', b'-', 127, 128, 129, 255] {
            let mut damaged = whole.clone();
            damaged[at] = value;
            if let Ok(read) = read(&damaged) {
                assert_eq!(read.pixels.len() as u32, read.size[0] * read.size[1]);
            }
        }
    }
}
