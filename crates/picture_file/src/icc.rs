//! ICC profiles of displays.

use colorimetry::matrix::product;
use colorimetry::{Adaptation, Display};
use moxcms::{
    ColorProfile, DataColorSpace, LocalizableString, Matrix3d, ProfileClass, ProfileText,
    RenderingIntent, ToneReprCurve, Xyzd,
};
use thiserror::Error;

/// Why a display has no profile.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum IccError {
    /// The encoder rejected the profile.
    #[error("cannot make an ICC profile of the display {0}")]
    Encode(String, #[source] moxcms::CmsError),
}

/// XYZ of the profile connection space's white, D50 (ICC.1:2022, 6.3.4.3).
pub(crate) const D50: [f64; 3] = [0.9642, 1.0, 0.8249];
/// Position of the time of creation in the header, six big-endian numbers of two bytes (ICC.1:2022, 7.2.8).
const CREATION: std::ops::Range<usize> = 24..36;
/// Year, month, day, hours, minutes and seconds.
const CREATED: [u16; 6] = [2026, 1, 1, 0, 0, 0];
/// Number of points of a response curve; readers interpolate between them.
const CURVE_POINTS: u16 = 4096;

/// The most characters of a profile's description that a message shows.
const DESCRIPTION_CHARACTERS: usize = 60;

/// Returns a profile's description; `None` if it has none or is not a profile.
pub fn description(profile: &[u8]) -> Option<String> {
    let text = match ColorProfile::new_from_slice(profile).ok()?.description? {
        ProfileText::PlainString(text) => text,
        ProfileText::Localizable(texts) => texts.into_iter().next()?.value,
        ProfileText::Description(text) => text.ascii_string,
    };
    Some(text.chars().take(DESCRIPTION_CHARACTERS).collect())
}

/// Returns a display's profile: a matrix and a curve per channel (ICC.1:2022, 8.3.3).
///
/// The primaries are adapted from the display's white to D50 by Bradford's matrix, which the profile contains too. The curves are
/// tables of the channels' response to codes; for a display that exceeds its white (PQ) they end at the white. The light of
/// code 0 is left out, as in relative colorimetry.
///
/// # Errors
/// When a number does not fit the format.
pub fn profile(display: &Display) -> Result<Vec<u8>, IccError> {
    let white = display.white_xyz();
    let to_d50 = Adaptation::Bradford.matrix(white, D50);
    let colorants = product(&to_d50, display.xyz_from_rgb());
    let colorant = |i: usize| Xyzd::new(colorants[0][i], colorants[1][i], colorants[2][i]);
    let curve = |channel: usize| {
        let response = &display.responses()[channel];
        let light = |i: u16| response.light(f64::from(i) / f64::from(CURVE_POINTS - 1));
        let value = |i| light(i).clamp(0.0, 1.0) * f64::from(u16::MAX);
        Some(ToneReprCurve::Lut(
            (0..CURVE_POINTS).map(|i| value(i).round() as u16).collect(),
        ))
    };
    let mut profile = ColorProfile::new_srgb();
    profile.pcs = DataColorSpace::Xyz;
    profile.color_space = DataColorSpace::Rgb;
    profile.profile_class = ProfileClass::DisplayDevice;
    profile.rendering_intent = RenderingIntent::RelativeColorimetric;
    profile.cicp = None;
    [
        profile.red_colorant,
        profile.green_colorant,
        profile.blue_colorant,
    ] = [0, 1, 2].map(colorant);
    [profile.red_trc, profile.green_trc, profile.blue_trc] = [0, 1, 2].map(curve);
    profile.white_point = xyzd(D50);
    profile.media_white_point = Some(xyzd(D50));
    profile.chromatic_adaptation = Some(Matrix3d { v: to_d50 });
    profile.description = Some(text(display.name()));
    profile.copyright = Some(text("no copyright, use freely"));
    let encoded = profile.encode();
    let mut bytes =
        encoded.map_err(|source| IccError::Encode(display.name().to_owned(), source))?;
    // The encoder writes the current time there. A fixed time makes the same display always give the same profile.
    for (field, number) in bytes[CREATION].chunks_exact_mut(2).zip(CREATED) {
        field.copy_from_slice(&number.to_be_bytes());
    }
    Ok(bytes)
}

fn xyzd([x, y, z]: [f64; 3]) -> Xyzd {
    Xyzd::new(x, y, z)
}

fn text(value: &str) -> ProfileText {
    let (language, country) = ("en".to_owned(), "US".to_owned());
    let string = LocalizableString::new(language, country, value.to_owned());
    ProfileText::Localizable(vec![string])
}

#[cfg(test)]
mod tests {
    use super::*;
    use colorimetry::matrix::times;
    use std::time::Duration;

    /// Every other byte is a function of the display, so a profile written a second later is the same.
    #[test]
    fn a_profile_is_the_same_at_any_time() {
        let display = Display::named("display_p3").unwrap();
        let first = profile(&display).unwrap();
        std::thread::sleep(Duration::from_millis(1100));
        assert_eq!(first, profile(&display).unwrap());
        let created = first[CREATION].chunks_exact(2);
        let created: Vec<u16> = created.map(|b| u16::from_be_bytes([b[0], b[1]])).collect();
        assert_eq!(created, CREATED);
    }

    /// A reader of a profile gets the display's own light, adapted to D50.
    #[test]
    fn a_profile_says_what_the_display_does() {
        for name in Display::names() {
            let display = Display::named(name).unwrap();
            let bytes = profile(&display).unwrap();
            assert_eq!(bytes, profile(&display).unwrap());
            let read = ColorProfile::new_from_slice(&bytes).unwrap();

            let colorants = read.colorant_matrix();
            let back = read.chromatic_adaptation.unwrap().inverse();
            let white: f64 = colorants.v[1].iter().sum();
            assert!((white - 1.0).abs() < 1e-4, "{name} {white}");
            for channel in 0..3 {
                let column = colorants.v.map(|row| row[channel]);
                let found = times(&back.v, column);
                for row in 0..3 {
                    // Sixteen fractional bits, and the inverse of nine such numbers.
                    let expected = display.xyz_from_rgb()[row][channel];
                    assert!((found[row] - expected).abs() < 2e-4, "{name} {found:?}");
                }
            }
            let Some(ToneReprCurve::Lut(curve)) = &read.green_trc else {
                panic!("{name}");
            };
            let middle = f64::from(curve[2048]) / 65535.0;
            let expected = display.responses()[1].light(2048.0 / 4095.0).min(1.0);
            assert!(
                (middle - expected).abs() < 1e-5,
                "{name} {middle} {expected}"
            );
        }
    }
}
