//! Coding-independent code points: numbers for color spaces that are known by name.

use colorimetry::Display;
use colorimetry::chromaticity::xy_of_xyz;
use colorimetry::display::Response;

/// Code points of sRGB: BT.709 primaries (1), the sRGB curve (13), RGB (0), full range (1); ITU-R H.273 (2021) and the PNG
/// specification, third edition, 11.3.2.6.
pub(crate) const SRGB: [u8; 4] = [1, 13, 0, 1];

const D65: [f64; 2] = [0.3127, 0.3290];
const C: [f64; 2] = [0.310, 0.316];

/// Chromaticities of red, green, blue and white with their code point: H.273, table 2.
const PRIMARIES: [([[f64; 2]; 4], u8); 7] = [
    ([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], D65], 1),
    ([[0.67, 0.33], [0.21, 0.71], [0.14, 0.08], C], 4),
    ([[0.64, 0.33], [0.29, 0.60], [0.15, 0.06], D65], 5),
    ([[0.630, 0.340], [0.310, 0.595], [0.155, 0.070], D65], 6),
    ([[0.708, 0.292], [0.170, 0.797], [0.131, 0.046], D65], 9),
    (
        [
            [0.680, 0.320],
            [0.265, 0.690],
            [0.150, 0.060],
            [0.314, 0.351],
        ],
        11,
    ),
    ([[0.680, 0.320], [0.265, 0.690], [0.150, 0.060], D65], 12),
];

/// Returns the chromaticities of red, green, blue and white of a code point; `None` if the code point is not in H.273, table 2,
/// or does not stand for three primaries of a screen.
pub(crate) fn primaries(number: u8) -> Option<[[f64; 2]; 4]> {
    // SMPTE ST 240 has the primaries of SMPTE C.
    let number = if number == 7 { 6 } else { number };
    let mut known = PRIMARIES.iter();
    known
        .find(|(_, own)| *own == number)
        .map(|(primaries, _)| *primaries)
}

/// Largest difference of chromaticities that count as equal: half of the last decimal where the table has three. White C, for
/// example, is 0.31006, 0.31616 elsewhere.
const TOLERANCE: f64 = 5e-4;

/// Returns the code points of a display; `None` if its primaries or its response have none. BT.1886 has no code point of its
/// own: the related curves of H.273 are those of cameras.
pub(crate) fn code_points(display: &Display) -> Option<[u8; 4]> {
    let [red, green, blue] = display.primaries_xy();
    let own = [red, green, blue, xy_of_xyz(display.white_xyz())];
    let is_own = |known: &[[f64; 2]; 4]| {
        let pairs = own.as_flattened().iter().zip(known.as_flattened());
        pairs.into_iter().all(|(a, b)| (a - b).abs() < TOLERANCE)
    };
    let (_, primaries) = PRIMARIES.iter().find(|(known, _)| is_own(known))?;
    let [response, others @ ..] = display.responses();
    if others.iter().any(|other| other != response) {
        return None;
    }
    // H.273, table 3.
    let transfer = match response {
        Response::Gamma { gamma, alpha } if *gamma == 2.2 && *alpha == 0.0 => 4,
        Response::Gamma { gamma, alpha } if *gamma == 2.8 && *alpha == 0.0 => 5,
        Response::Linear => 8,
        Response::Srgb => 13,
        Response::Pq { .. } => 16,
        _ => return None,
    };
    Some([*primaries, transfer, 0, 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn displays_have_the_numbers_of_their_standards() {
        let expected = [
            ("adobe_rgb", None),
            ("bt2020", None),
            ("bt2100_pq", Some([9, 16, 0, 1])),
            ("crt_1997", None),
            ("dci_p3", None),
            ("display_p3", Some([12, 13, 0, 1])),
            ("ebu", None),
            ("lcd", None),
            ("ntsc_1953", Some([4, 4, 0, 1])),
            ("smpte_c", Some([6, 4, 0, 1])),
            ("srgb", Some([1, 13, 0, 1])),
        ];
        assert_eq!(expected.map(|(name, _)| name), *Display::names());
        for (name, points) in expected {
            assert_eq!(
                code_points(&Display::named(name).unwrap()),
                points,
                "{name}"
            );
        }
    }
}
