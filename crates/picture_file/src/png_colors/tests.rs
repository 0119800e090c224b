use super::*;
use moxcms::ColorProfile;

/// A picture of one pixel with these declarations of its colors.
#[derive(Default)]
struct Tagged {
    icc: Option<Vec<u8>>,
    is_gray: bool,
    chunks: Vec<([u8; 4], Vec<u8>)>,
}

impl Tagged {
    fn with(mut self, name: [u8; 4], data: &[u8]) -> Self {
        self.chunks.push((name, data.to_vec()));
        self
    }

    fn profile(mut self, profile: &ColorProfile) -> Self {
        self.icc = Some(profile.encode().unwrap());
        self
    }

    fn file(&self) -> Vec<u8> {
        let mut info = ::png::Info::with_size(1, 1);
        let (color_type, pixel): (_, &[u8]) = if self.is_gray {
            (::png::ColorType::Grayscale, &[9])
        } else {
            (::png::ColorType::Rgb, &[9, 8, 7])
        };
        info.color_type = color_type;
        info.bit_depth = ::png::BitDepth::Eight;
        info.icc_profile = self.icc.as_ref().map(Into::into);
        let mut bytes = Vec::new();
        let encoder = ::png::Encoder::with_info(&mut bytes, info).unwrap();
        let mut writer = encoder.write_header().unwrap();
        for (name, data) in &self.chunks {
            writer
                .write_chunk(::png::chunk::ChunkType(*name), data)
                .unwrap();
        }
        writer.write_image_data(pixel).unwrap();
        writer.finish().unwrap();
        bytes
    }

    fn read(&self) -> Result<CodeColors, PngColorsError> {
        CodeColors::of_png(&self.file())
    }

    fn colors(&self) -> CodeColors {
        self.read().unwrap()
    }

    fn refusal(&self) -> String {
        self.read().unwrap_err().to_string()
    }
}

fn tagged(name: [u8; 4], data: &[u8]) -> Tagged {
    Tagged::default().with(name, data)
}

fn cicp(points: [u8; 4]) -> Tagged {
    tagged(*b"cICP", &points)
}

/// Numbers of `gAMA` and `cHRM`, in units of 1e-5, as bytes.
fn scaled(numbers: &[u32]) -> Vec<u8> {
    numbers.iter().flat_map(|n| n.to_be_bytes()).collect()
}

/// White and primaries of Adobe RGB (1998).
const ADOBE: [u32; 8] = [31_270, 32_900, 64_000, 33_000, 21_000, 71_000, 15_000, 6000];

fn assert_near(found: [f64; 3], expected: [f64; 3], within: f64) {
    for (a, b) in found.into_iter().zip(expected) {
        assert!((a - b).abs() < within, "{found:?} {expected:?}");
    }
}

/// The columns of the matrix to linear sRGB.
fn columns(colors: &CodeColors) -> [[f64; 3]; 3] {
    std::array::from_fn(|channel| {
        let mut codes = [0; 3];
        codes[channel] = u16::MAX;
        colors.linear_srgb(codes)
    })
}

/// From Display P3, BT.2020 and Adobe RGB to sRGB, by column (CSS Color Module Level 4, section 18, and Rec. ITU-R BT.2087).
const P3: [[f64; 3]; 3] = [
    [1.224_94, -0.042_06, -0.019_64],
    [-0.224_94, 1.042_06, -0.078_64],
    [0.0, 0.0, 1.098_27],
];
const BT2020: [[f64; 3]; 3] = [
    [1.6605, -0.1246, -0.0182],
    [-0.5876, 1.1329, -0.1006],
    [-0.0728, -0.0083, 1.1187],
];
const ADOBE_TO_SRGB: [[f64; 3]; 3] = [
    [1.398_36, 0.0, 0.0],
    [-0.398_36, 1.0, -0.042_93],
    [0.0, 0.0, 1.042_93],
];

fn assert_columns(colors: &CodeColors, expected: [[f64; 3]; 3], within: f64) {
    for (found, expected) in columns(colors).into_iter().zip(expected) {
        assert_near(found, expected, within);
    }
}

/// Exact to the bit, and without a note.
#[test]
fn pictures_in_srgb_are_read_as_such() {
    for picture in [
        Tagged::default(),
        tagged(*b"sRGB", &[0]),
        tagged(*b"sRGB", &[1]).with(*b"gAMA", &scaled(&[100_000])),
        cicp([1, 13, 0, 1]),
        Tagged::default().profile(&ColorProfile::new_srgb()),
    ] {
        let colors = picture.colors();
        assert_eq!(colors.notes(), [""; 0]);
        for code in (0..=u16::MAX).step_by(251) {
            let codes = [code, 77, u16::MAX - code];
            let expected = codes.map(|code| srgb::decode(f64::from(code) / 65_535.0));
            assert_eq!(colors.linear_srgb(codes), expected);
        }
    }
}

#[test]
fn code_points_are_honored() {
    let half = [32_768; 3];
    let exact = f64::from(half[0]) / 65_535.0;
    // 0.5^2.2 = exp(−2.2 ln 2), 0.5^2.8; and ((0.5 + 0.0993) / 1.0993)^(1/0.45) = exp(−0.60667 / 0.45).
    for (transfer, expected) in [
        (8, exact),
        (4, 0.217_638),
        (5, 0.143_587),
        (1, 0.2597),
        (14, 0.2597),
    ] {
        let colors = cicp([1, transfer, 0, 1]).colors();
        assert_near(colors.linear_srgb(half), [expected; 3], 1e-4);
        assert_eq!(colors.notes().len(), 1);
        // 0.045 / 4.5 where the camera's curve is a line.
        if transfer == 1 {
            assert_near(colors.linear_srgb([2949; 3]), [0.01; 3], 1e-6);
        }
    }
    assert_columns(&cicp([12, 13, 0, 1]).colors(), P3, 1e-4);
    assert_columns(&cicp([9, 8, 0, 1]).colors(), BT2020, 1e-4);
    let note = &cicp([12, 13, 0, 1]).colors().notes()[0].clone();
    assert!(note.contains("cICP") && note.contains("12"), "{note}");
    // DCI's white and C are not D65, but still map to white.
    for primaries in [4, 5, 6, 7, 9, 11, 12] {
        let colors = cicp([primaries, 8, 0, 1]).colors();
        assert_near(colors.linear_srgb([u16::MAX; 3]), [1.0; 3], 1e-12);
    }
}

#[test]
fn gamma_and_primaries_are_honored() {
    let code = 20_000_u16;
    let v = f64::from(code) / 65_535.0;
    let gamma = |gamma: u32| tagged(*b"gAMA", &scaled(&[gamma]));
    assert_near(
        gamma(100_000).colors().linear_srgb([code; 3]),
        [v; 3],
        1e-12,
    );
    // v = 0.305180: v^2.2 = exp(2.2 · ln v) = exp(2.2 · −1.186853).
    let colors = gamma(45_455).colors();
    assert_near(colors.linear_srgb([code; 3]), [0.073_449; 3], 2e-5);
    assert!(
        colors.notes()[0].contains("gAMA 0.45455"),
        "{:?}",
        colors.notes()
    );

    let adobe = gamma(45_470).with(*b"cHRM", &scaled(&ADOBE));
    assert_columns(&adobe.colors(), ADOBE_TO_SRGB, 1e-4);
    let alone = tagged(*b"cHRM", &scaled(&ADOBE)).colors();
    assert_columns(&alone, ADOBE_TO_SRGB, 1e-4);
    let linear = alone.linear_srgb([code; 3]);
    assert_near(linear, [srgb::decode(v); 3], 1e-12);
    // With another white, white still maps to white.
    let mut warm = ADOBE;
    warm[..2].copy_from_slice(&[34_567, 35_850]);
    let colors = tagged(*b"cHRM", &scaled(&warm)).colors();
    assert_near(colors.linear_srgb([u16::MAX; 3]), [1.0; 3], 1e-12);
}

#[test]
fn profiles_are_honored() {
    let of = |profile: &ColorProfile| Tagged::default().profile(profile).colors();
    assert_columns(&of(&ColorProfile::new_display_p3()), P3, 1e-3);
    let adobe = of(&ColorProfile::new_adobe_rgb());
    assert_columns(&adobe, ADOBE_TO_SRGB, 1e-3);
    // Adobe's curve is the power 563/256: 0.5 becomes exp(−2.19922 · 0.693147).
    assert_near(adobe.linear_srgb([32_768; 3]), [0.217_755; 3], 2e-4);
    assert!(
        adobe.notes()[0].contains("ICC profile \""),
        "{:?}",
        adobe.notes()
    );

    let gray = ColorProfile::new_gray_with_gamma(1.8);
    let picture = Tagged {
        is_gray: true,
        ..Tagged::default()
    };
    // exp(−1.8 · 0.693147).
    let colors = picture.profile(&gray).colors();
    assert!(
        colors.notes()[0].starts_with("read by"),
        "{:?}",
        colors.notes()
    );
    let found = colors.linear_srgb([32_768; 3]);
    assert_near(found, [0.287_175; 3], 3e-4);
}

/// Curves of profiles, each at codes where the value is simple arithmetic.
#[test]
fn curves_of_profiles() {
    let function = |numbers: &[f32]| moxcms::ToneReprCurve::Parametric(numbers.to_vec());
    let table = |numbers: &[u16]| moxcms::ToneReprCurve::Lut(numbers.to_vec());
    for (curve, points) in [
        (table(&[]), vec![(0.0, 0.0), (0.3, 0.3), (1.0, 1.0)]),
        // 512 / 256 = 2.
        (table(&[512]), vec![(0.0, 0.0), (0.3, 0.09), (1.0, 1.0)]),
        (
            table(&[0, 13_107, 65_535]),
            vec![(0.25, 0.1), (0.5, 0.2), (0.75, 0.6), (1.0, 1.0)],
        ),
        (function(&[3.0]), vec![(0.5, 0.125)]),
        // (2 x − 1)^2 for x ≥ 1/2.
        (function(&[2.0, 2.0, -1.0]), vec![(0.25, 0.0), (0.75, 0.25)]),
        (
            function(&[2.0, 2.0, -1.0, 0.125]),
            vec![(0.25, 0.125), (0.75, 0.375)],
        ),
        (
            function(&[2.0, 1.0, 0.0, 0.25, 0.5]),
            vec![(0.25, 0.0625), (0.5, 0.25), (0.75, 0.5625)],
        ),
        (
            function(&[2.0, 1.0, 0.0, 0.25, 0.5, 0.125, 0.5]),
            vec![(0.25, 0.5625), (0.5, 0.375)],
        ),
    ] {
        let curve = ProfileCurve::new(&curve).unwrap();
        for (code, light) in points {
            let found = curve.light(code);
            assert!((found - light).abs() < 1e-12, "{curve:?} {code}: {found}");
        }
    }
    assert!(ProfileCurve::new(&function(&[1.0, 2.0])).is_none());
}

#[test]
fn profiles_that_cannot_be_used_are_reported() {
    let mut tables = ColorProfile::new_srgb();
    tables.red_trc = None;
    let mut black = ColorProfile::new_srgb();
    black.red_colorant = moxcms::Xyzd::default();
    for (profile, problem) in [
        (
            ColorProfile::new_gray_with_gamma(1.8).encode(),
            "is for gray",
        ),
        (tables.encode(), "tables are not read"),
        (black.encode(), "does not map (1, 1, 1) to white"),
        (
            ColorProfile::new_lab().encode(),
            "neither for red, green and blue nor for gray",
        ),
        (Ok(b"no profile".to_vec()), "is damaged"),
    ] {
        let picture = Tagged {
            icc: Some(profile.unwrap()),
            ..Tagged::default()
        };
        let colors = picture.with(*b"gAMA", &scaled(&[100_000])).colors();
        let notes = colors.notes();
        assert!(notes[0].contains(problem), "{notes:?}");
        // The next declaration counts.
        assert!(notes[1].contains("gAMA 1"), "{notes:?}");
        assert_near(colors.linear_srgb([u16::MAX / 5; 3]), [0.2; 3], 1e-12);
    }
}

/// cICP takes precedence over iCCP, iCCP over sRGB, and sRGB over gAMA and cHRM.
#[test]
fn the_first_that_is_said_counts() {
    let gamma = scaled(&[100_000]);
    let fifth = [u16::MAX / 5; 3];
    let all = cicp([1, 8, 0, 1])
        .profile(&ColorProfile::new_display_p3())
        .with(*b"gAMA", &scaled(&[45_455]))
        .with(*b"cHRM", &scaled(&ADOBE));
    assert_near(all.colors().linear_srgb(fifth), [0.2; 3], 1e-12);
    let profile = Tagged::default().profile(&ColorProfile::new_display_p3());
    let two = profile.with(*b"gAMA", &gamma).colors();
    assert_columns(&two, P3, 1e-3);
    assert_near(two.linear_srgb(fifth), [srgb::decode(0.2); 3], 1e-3);
    let open = cicp([2, 8, 0, 1]).with(*b"gAMA", &gamma).colors();
    assert_near(open.linear_srgb(fifth), [0.2; 3], 1e-12);
    assert!(
        open.notes()[0].contains("leaves open"),
        "{:?}",
        open.notes()
    );
    // Chunks after the pixels do not count.
    let mut late = Tagged::default().file();
    let end = late.split_off(late.len() - 12);
    let whole = tagged(*b"gAMA", &gamma).file();
    let at = whole.windows(4).position(|name| name == b"gAMA").unwrap();
    late.extend_from_slice(&whole[at - 4..at + 12]);
    late.extend(end);
    assert_eq!(CodeColors::of_png(&late).unwrap().notes(), [""; 0]);
}

#[test]
fn what_cannot_be_honored_is_refused() {
    for (picture, problem) in [
        (cicp([9, 16, 0, 1]), "PQ"),
        (cicp([9, 18, 0, 1]), "HLG"),
        (cicp([1, 13, 0, 0]), "narrow range"),
        (cicp([1, 13, 1, 1]), "its cICP chunk is damaged"),
        (cicp([1, 13, 0, 7]), "its cICP chunk is damaged"),
        (cicp([77, 13, 0, 1]), "primaries 77"),
        (cicp([1, 9, 0, 1]), "transfer function 9"),
        (tagged(*b"cICP", &[1]), "its cICP chunk is damaged"),
        (tagged(*b"gAMA", &scaled(&[0])), "its gAMA chunk is damaged"),
        (tagged(*b"gAMA", &scaled(&[1])), "says 0.00001"),
        (tagged(*b"gAMA", &scaled(&[u32::MAX])), "from 0.1 to 10"),
        (
            tagged(*b"cHRM", &scaled(&[31_270; 8])),
            "not have three primaries",
        ),
        (
            tagged(*b"cHRM", &scaled(&[0; 8])),
            "not have three primaries",
        ),
        (tagged(*b"cHRM", &[1, 2, 3]), "its cHRM chunk is damaged"),
    ] {
        let said = picture.refusal();
        assert!(said.contains(problem), "{said:?} lacks {problem:?}");
    }
    let pq = Tagged::default().profile(&ColorProfile::new_display_p3_pq());
    assert!(pq.refusal().contains("its iCCP chunk says"));
}

#[test]
fn damage_is_never_a_panic() {
    let whole = Tagged::default()
        .profile(&ColorProfile::new_srgb())
        .with(*b"gAMA", &scaled(&[45_455]))
        .with(*b"cHRM", &scaled(&ADOBE))
        .file();
    assert!(CodeColors::of_png(&whole).is_ok());
    for length in 0..whole.len() {
        let _ = CodeColors::of_png(&whole[..length]);
    }
    assert!(CodeColors::of_png(&whole[..60]).is_err());
    for at in 0..whole.len() {
        for value in [0, 1, 127, 255] {
            let mut damaged = whole.clone();
            damaged[at] = value;
            let _ = CodeColors::of_png(&damaged);
        }
    }
    // Damage in the profile itself, which the file's checksums would catch first.
    let profile = ColorProfile::new_adobe_rgb().encode().unwrap();
    for at in 0..profile.len() {
        for value in [0, 1, 127, 255] {
            let mut damaged = profile.clone();
            damaged[at] = value;
            let _ = icc_profile::colors(&damaged, false);
        }
        let _ = icc_profile::colors(&profile[..at], false);
    }
}
