//! Wavelengths in channel names, as in the layout and as other programs write them.

use crate::exr_file::BandLayoutError;
use spectra::Stokes;

/// Speed of light in vacuum, m/s (exact in the SI).
const LIGHT_M_PER_S: f64 = 299_792_458.0;

/// SI prefixes with their powers of ten, prefixes of two letters before those of one.
const PREFIXES: [(&str, i32); 22] = [
    ("da", 1),
    ("Y", 24),
    ("Z", 21),
    ("E", 18),
    ("P", 15),
    ("T", 12),
    ("G", 9),
    ("M", 6),
    ("k", 3),
    ("h", 2),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("u", -6),
    ("\u{b5}", -6),
    ("\u{3bc}", -6),
    ("n", -9),
    ("p", -12),
    ("f", -15),
    ("a", -18),
    ("z", -21),
    ("y", -24),
];

/// The quantity in a spectral channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Quantity {
    /// Emissive, unpolarized radiance, the first Stokes component: `S0.550nm`.
    Radiance,
    /// Reflectance: `T.550nm`.
    Reflectance,
    /// Radiance over a band whose ends the name gives: `400.00-410.00nm`. Mitsuba 0.6 and ART write such names.
    Range,
}

/// The position of a channel in the spectrum, nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SpectralPosition {
    /// A band around this wavelength, whose width follows from its neighbors.
    Center(f64),
    /// A band from one wavelength to another.
    Range(f64, f64),
}

impl SpectralPosition {
    /// The center of the band.
    pub(super) fn center_nm(self) -> f64 {
        match self {
            Self::Center(nm) => nm,
            Self::Range(low, high) => f64::midpoint(low, high),
        }
    }
}

/// Returns the quantity and position of a channel by its name; `None` if it is not a spectral channel that is read here.
pub(super) fn spectral_channel(
    name: &str,
) -> Option<Result<(Quantity, SpectralPosition), BandLayoutError>> {
    if let Some(text) = name.strip_prefix("S0.") {
        return match wavelength_nm(text) {
            Some(nm) => Some(Ok((Quantity::Radiance, SpectralPosition::Center(nm)))),
            // Light that is absorbed at one wavelength and emitted at another.
            None if is_reradiation(text) => None,
            None => Some(Err(BandLayoutError::NotAWavelength(name.to_owned()))),
        };
    }
    // Some readers and some writers omit the dot.
    let bare = name.strip_prefix("S0").and_then(wavelength_nm);
    let reflective = || wavelength_nm(name.strip_prefix('T')?.trim_start_matches('.'));
    let range = || {
        let (low, high) = name.split_once('-')?;
        let (low, high) = (number(low)?, number(high.strip_suffix("nm")?)?);
        (low < high).then_some((Quantity::Range, SpectralPosition::Range(low, high)))
    };
    let found = bare
        .map(|nm| (Quantity::Radiance, SpectralPosition::Center(nm)))
        .or_else(|| reflective().map(|nm| (Quantity::Reflectance, SpectralPosition::Center(nm))))
        .or_else(range)?;
    Some(Ok(found))
}

/// Returns the wavelength of a channel of S1, S2 or S3 by its name: `S1.550nm`, or `S1550nm` as some programs write it.
pub(super) fn component_nm(name: &str, stokes: Stokes) -> Option<f64> {
    let text = name.strip_prefix(stokes.name())?;
    wavelength_nm(text.strip_prefix('.').unwrap_or(text))
}

/// Whether a text is two wavelengths separated by a dot.
fn is_reradiation(text: &str) -> bool {
    let dots = text.match_indices('.');
    dots.into_iter().any(|(at, _)| {
        wavelength_nm(&text[..at]).is_some() && wavelength_nm(&text[at + 1..]).is_some()
    })
}

/// Parses a wavelength (`550nm`, `0,55um`) or a frequency (`5,45e2THz`) into nm: a number with a comma or a dot, a prefix, and
/// m or Hz (Fichet, Pacanowski and Wilkie, section 4).
pub(super) fn wavelength_nm(text: &str) -> Option<f64> {
    let nm = if let Some(text) = text.strip_suffix("Hz") {
        let (value, exponent) = prefixed(text)?;
        LIGHT_M_PER_S / (value * power_of_ten(exponent)) * 1e9
    } else {
        let (value, exponent) = prefixed(text.strip_suffix('m')?)?;
        value * power_of_ten(exponent + 9)
    };
    (nm.is_finite() && nm > 0.0).then_some(nm)
}

/// Returns 10^`exponent`, exact to the last digit, so that 555.5 nm stays 555.5.
fn power_of_ten(exponent: i32) -> f64 {
    let size = f64::powi(10.0, exponent.abs());
    if exponent < 0 { 1.0 / size } else { size }
}

/// Parses a number and the SI prefix after it, as a power of ten.
fn prefixed(text: &str) -> Option<(f64, i32)> {
    if let Some(value) = number(text) {
        return Some((value, 0));
    }
    PREFIXES
        .iter()
        .find_map(|&(prefix, exponent)| Some((number(text.strip_suffix(prefix)?)?, exponent)))
}

pub(super) fn number(text: &str) -> Option<f64> {
    let is_plain = |c: char| c.is_ascii_digit() || ",.eE+-".contains(c);
    let starts = text.starts_with(|c: char| c.is_ascii_digit() || ",.".contains(c));
    let is_number = starts && text.chars().all(is_plain);
    is_number.then(|| text.replace(',', ".").parse().ok())?
}

/// Returns the factor that converts values in `unit` to W m⁻² sr⁻¹ nm⁻¹; `None` if the unit is not a spectral radiance, or differs
/// by more than a scale.
///
/// A unit is written like `mW.cm^-2.sr^-1.um^-1`. The layout's own example, `W.m^-2.sr^-1`, which most programs write, does not
/// mention the wavelength and means per nm.
pub(super) fn radiance_scale(unit: &str) -> Option<f64> {
    let (mut exponent, mut meters, mut watts, mut steradians) = (0_i32, 0_i32, 0_i32, 0_i32);
    for factor in unit.split(['.', '*', ' ', '\u{b7}']) {
        let (base, power) = match factor.split_once('^') {
            Some((base, power)) => (base, power.parse::<i32>().ok()?),
            None => (factor, 1),
        };
        if base == "sr" {
            steradians = steradians.checked_add(power)?;
            continue;
        }
        let (prefix, count) = match base.strip_suffix('W') {
            Some(prefix) => (prefix, &mut watts),
            None => (base.strip_suffix('m')?, &mut meters),
        };
        *count = count.checked_add(power)?;
        let mut known = PREFIXES.iter().filter(|(name, _)| *name == prefix);
        let ten = match prefix {
            "" => 0,
            _ => known.next()?.1,
        };
        exponent = exponent.checked_add(ten.checked_mul(power)?)?;
    }
    match (watts, meters, steradians) {
        (1, -3, -1) => Some(power_of_ten(exponent - 9)),
        (1, -2, -1) => Some(power_of_ten(exponent)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn radiance_at(name: &str) -> f64 {
        match spectral_channel(name) {
            Some(Ok((Quantity::Radiance, SpectralPosition::Center(nm)))) => nm,
            other => panic!("{name}: {other:?}"),
        }
    }

    #[test]
    fn every_spelling_of_a_wavelength_is_read() {
        for name in [
            "S0.550nm",
            "S0.550,000000nm",
            "S0.550.0nm",
            "S0.5,5e2nm",
            "S0.5.5E+2nm",
            "S0.0,55um",
            "S0.,55\u{b5}m",
            "S0.550000pm",
            "S0.5,5e-7m",
            "S0.5,5e-4mm",
            "S0.5,5e-8dam",
            "S0550nm",
        ] {
            assert!((radiance_at(name) - 550.0).abs() < 1e-9, "{name}");
        }
        assert_eq!(radiance_at("S0.555,5nm"), 555.5);
        // c / 555 nm.
        for name in ["S0.540,166591THz", "S0.5,40166591e14Hz", "S0.540166,591GHz"] {
            assert!((radiance_at(name) - 555.0).abs() < 1e-6, "{name}");
        }
    }

    #[test]
    fn other_kinds_of_channel_are_distinguished() {
        let reflectance = Some(Ok((Quantity::Reflectance, SpectralPosition::Center(450.0))));
        assert_eq!(spectral_channel("T.450nm"), reflectance);
        assert_eq!(spectral_channel("T450nm"), reflectance);
        let range = Some(Ok((Quantity::Range, SpectralPosition::Range(400.0, 410.5))));
        assert_eq!(spectral_channel("400.00-410.50nm"), range);
        for other in [
            "R",
            "T",
            "Total",
            "S0",
            "S1.550nm",
            "T.450nm.500nm",
            "S0.450nm.500nm",
            "pellicle.variance.550,0nm",
            "410-400nm",
            "a-bnm",
            "left.S0.450nm",
        ] {
            assert_eq!(spectral_channel(other), None, "{other}");
        }
        for bad in [
            "S0.",
            "S0.nm",
            "S0.550",
            "S0.550xm",
            "S0.550mdam",
            "S0.NaNnm",
            "S0.infnm",
            "S0.-5nm",
            "S0.0nm",
            "S0.0Hz",
            "S0.1,2,3nm",
            "S0.1e999nm",
        ] {
            assert!(spectral_channel(bad).unwrap().is_err(), "{bad}");
        }
    }

    #[test]
    fn units_that_are_only_a_scale_away_have_it() {
        for (unit, scale) in [
            ("W.m^-2.sr^-1.nm^-1", 1.0),
            ("W.m^-2.sr^-1", 1.0),
            ("W.sr^-1.m^-2.um^-1", 1e-3),
            ("W.m^-3.sr^-1", 1e-9),
            ("mW.m^-2.sr^-1.nm^-1", 1e-3),
            ("uW*cm^-2*sr^-1*nm^-1", 1e-2),
            ("W m^-2 sr^-1 nm^-1", 1.0),
        ] {
            let found = radiance_scale(unit).unwrap();
            assert!((found / scale - 1.0).abs() < 1e-12, "{unit}: {found}");
        }
        for other in [
            "",
            "lm.m^-2.sr^-1",
            "W.m^-2.nm^-1",
            "W.m^-2.sr^-1.Hz^-1",
            "W.m^-2.sr^-1.nm^-1.s",
            "W^2147483647.W^2147483647.m^-2.sr^-1",
            "W.km^2147483647.m^-2.sr^-1",
            "W.m^x.sr^-1",
            "qW.m^-2.sr^-1",
        ] {
            assert_eq!(radiance_scale(other), None, "{other}");
        }
    }
}
