//! The color of a stack.

use crate::fringes::{Fringes, Places};
use crate::response::{Angle, Sampled};
pub(crate) use crate::view::{Polarization, Side, View};
use crate::{Light, SampleError, Stack};
use colorimetry::lab::delta_e_2000;
use colorimetry::{Lab, srgb};
use optics::Complex64;
use optics::batch::Powers;
use rayon::prelude::*;
use thiserror::Error;

/// A color under an illuminant: XYZ, relative to the illuminant's Y = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Color {
    /// X, Y, Z; Y = 1 for a perfect mirror.
    pub xyz: [f64; 3],
    /// XYZ of the illuminant itself.
    pub white: [f64; 3],
}

impl Color {
    /// Returns CIELAB under the illuminant's own white.
    pub fn lab(&self) -> Lab {
        Lab::from_xyz(self.xyz, self.white)
    }

    /// Returns the chromaticity x, y; `None` for black.
    pub fn chromaticity(&self) -> Option<[f64; 2]> {
        let [x, y, z] = self.xyz;
        let sum = x + y + z;
        (sum > 0.0).then(|| [x / sum, y / sum])
    }

    /// Returns linear sRGB, 2^EV times as bright, neither adapted to the display's white nor clipped.
    pub fn linear_srgb(&self, exposure_ev: f64) -> [f64; 3] {
        srgb::linear_from_xyz(self.xyz.map(|v| v * exposure_ev.exp2()))
    }

    /// Returns codes of sRGB, 2^EV times as bright, clipped to what the display can show.
    pub fn srgb8(&self, exposure_ev: f64) -> [u8; 3] {
        self.linear_srgb(exposure_ev).map(srgb::to_u8)
    }

    /// Returns the codes as `#2e6fd0`.
    pub fn hex(&self, exposure_ev: f64) -> String {
        let [r, g, b] = self.srgb8(exposure_ev);
        format!("#{r:02x}{g:02x}{b:02x}")
    }

    /// Returns whether an sRGB display can show it, 2^EV times as bright, to half an 8-bit code: a color closer than that to the gamut
    /// is only rounded, not clipped.
    pub fn is_in_srgb(&self, exposure_ev: f64) -> bool {
        const HALF: f64 = 0.5 / 255.0;
        // The sRGB curve (IEC 61966-2-1) half a code below 0 and above 1.
        let (low, high) = (-HALF / 12.92, ((1.0 + HALF + 0.055) / 1.055).powf(2.4));
        let fits = |v: f64| (low..=high).contains(&v);
        self.linear_srgb(exposure_ev).into_iter().all(fits)
    }
}

/// Why a text is not a color.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0:?} is not a color; write an sRGB color like #2e6fd0")]
pub struct ParseColorError(String);

/// Returns XYZ, Y = 1 for the display's white, of an sRGB color such as `#2e6fd0` or `#28c`.
///
/// # Errors
/// If the text does not have this form.
pub fn parse_srgb(text: &str) -> Result<[f64; 3], ParseColorError> {
    let refuse = || ParseColorError(text.chars().take(40).collect());
    let digits = text.strip_prefix('#').unwrap_or(text);
    if !digits.chars().all(|c| c.is_ascii_hexdigit()) {
        return Err(refuse());
    }
    let value = u32::from_str_radix(digits, 16).map_err(|_| refuse())?;
    let codes = match digits.len() {
        6 => [16, 8, 0].map(|shift| (value >> shift) as u8),
        3 => [8, 4, 0].map(|shift| 17 * ((value >> shift) & 15) as u8),
        _ => return Err(refuse()),
    };
    Ok(srgb::xyz_from_linear(codes.map(srgb::from_u8)))
}

/// A stack under an illuminant, which gives its color for any thicknesses and angle.
#[derive(Clone, Debug, PartialEq)]
pub struct StackColor {
    sampled: Sampled,
    /// The stack at every nm.
    fine: Sampled,
    /// The largest index of each layer at these wavelengths.
    largest: Vec<f64>,
    light: Light,
    view: View,
}

impl StackColor {
    /// Reads the stack's media at the wavelengths of the light's sums.
    ///
    /// # Errors
    /// If one of them has no data somewhere from 380 to 780 nm.
    pub fn new(stack: &Stack, light: Light, view: View) -> Result<Self, SampleError> {
        let wavelengths_nm = light.wavelengths_nm();
        let every_nm: Vec<f64> = match wavelengths_nm[..] {
            [first, .., last] => (first as u32..=last as u32).map(f64::from).collect(),
            _ => wavelengths_nm.clone(),
        };
        let fine = stack.sampled(&every_nm)?;
        let largest =
            |indices: &Vec<Complex64>| indices.iter().fold(0.0, |most: f64, n| most.max(n.re));
        Ok(Self {
            sampled: stack.sampled(&wavelengths_nm)?,
            largest: fine.layers().iter().map(largest).collect(),
            fine,
            light,
            view,
        })
    }

    /// Returns the color with these thicknesses, nm, one per layer, at an angle, for any thickness, however fine its fringes are. The
    /// weights of the light's sums are assumed linear between their wavelengths.
    ///
    /// # Panics
    /// If there is not one thickness per layer.
    pub fn at(&self, thicknesses_nm: &[f64], angle: Angle) -> Color {
        let shares = self.shares(thicknesses_nm, angle);
        self.color(self.fringes(thicknesses_nm, angle).xyz(&shares))
    }

    /// The reflectance or transmittance at each wavelength of the sums.
    fn shares(&self, thicknesses_nm: &[f64], angle: Angle) -> Vec<f64> {
        let powers = self.sampled.powers(thicknesses_nm, angle);
        powers.iter().map(|powers| self.seen(powers)).collect()
    }

    fn seen(&self, powers: &Powers) -> f64 {
        self.view.of(powers.reflectance, powers.transmittance)
    }

    fn fringes<'a>(&'a self, thicknesses_nm: &'a [f64], angle: Angle) -> Fringes<'a> {
        Fringes {
            light: &self.light,
            view: self.view,
            fine: &self.fine,
            largest: &self.largest,
            thicknesses_nm,
            angle,
        }
    }

    /// Uncertainty of the color due to the limited resolution of the light's table: ΔE₀₀ between the color, for which the power is
    /// linear between the points of the table, and the sum over those points alone. 0 where the film's spectrum is smooth.
    pub fn doubt(&self, thicknesses_nm: &[f64], angle: Angle) -> f64 {
        let shares = self.shares(thicknesses_nm, angle);
        let of_points = self.light.xyz(shares.iter().copied());
        let integral = self.fringes(thicknesses_nm, angle).xyz(&shares);
        let [a, b] = [of_points, integral].map(|xyz| self.color(xyz).lab());
        delta_e_2000(a, b)
    }

    /// Positions and weights of the sum for its color with these thicknesses.
    pub(crate) fn positions(&self, thicknesses_nm: &[f64], angle: Angle) -> Places {
        let shares = self.shares(thicknesses_nm, angle);
        self.fringes(thicknesses_nm, angle).positions(&shares)
    }

    /// Returns XYZ with many sets of thicknesses at many angles, as `[set][angle]`, on all cores.
    ///
    /// # Panics
    /// If there is not one thickness per layer.
    pub fn xyz_of_all(&self, sets: &[Vec<f64>], angles: &[Angle]) -> Vec<[f64; 3]> {
        /// Number of spectra in memory at a time, some 13 kB each.
        const AT_ONCE: usize = 1024;
        let wavelengths = self.sampled.wavelengths_nm().len();
        sets.chunks(AT_ONCE.div_ceil(angles.len().max(1)))
            .flat_map(|sets| {
                let powers = self.sampled.powers_of_all(sets, angles);
                let films = sets
                    .iter()
                    .flat_map(|set| angles.iter().map(move |&angle| (set, angle)));
                let films: Vec<_> = films.collect();
                let spectra = powers.par_chunks(wavelengths).zip(&films);
                let xyz = |(spectrum, &(set, angle)): (&[Powers], &(&Vec<f64>, Angle))| {
                    let shares: Vec<f64> =
                        spectrum.iter().map(|powers| self.seen(powers)).collect();
                    self.fringes(set, angle).xyz(&shares)
                };
                spectra.map(xyz).collect::<Vec<_>>()
            })
            .collect()
    }

    pub(crate) fn color(&self, xyz: [f64; 3]) -> Color {
        Color {
            xyz,
            white: self.light.white(),
        }
    }

    /// The stack at the wavelengths of the sums.
    pub fn sampled(&self) -> &Sampled {
        &self.sampled
    }

    /// The light.
    pub fn light(&self) -> &Light {
        &self.light
    }

    /// Side and polarization.
    pub fn view(&self) -> View {
        self.view
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_are_written_with_three_or_six_digits() {
        let white = parse_srgb("#ffffff").unwrap();
        for (found, expected) in white.into_iter().zip(srgb::white_xyz()) {
            assert!((found - expected).abs() < 1e-14);
        }
        assert_eq!(parse_srgb("#28c"), parse_srgb("2288CC"));
        for bad in [
            "", "#", "#12345", "#1234567", "#12g", "blue", "#+12345", "#é1234",
        ] {
            assert!(parse_srgb(bad).is_err(), "{bad:?}");
        }
        let color = Color {
            xyz: parse_srgb("#2e6fd0").unwrap(),
            white: srgb::white_xyz(),
        };
        assert_eq!(color.hex(0.0), "#2e6fd0");
        assert!(color.is_in_srgb(0.0) && !color.is_in_srgb(1.0));
    }

    /// A mirror is white: the sums at 1 nm differ from the display's white by rounding.
    #[test]
    fn a_perfect_mirror_is_not_clipped() {
        let white = Light::named("D65").unwrap().white();
        let times = |by: f64| Color {
            xyz: white.map(|v| by * v),
            white,
        };
        assert!(times(1.0).is_in_srgb(0.0) && times(1.002).is_in_srgb(0.0));
        assert!(!times(1.01).is_in_srgb(0.0));
        let lamp = Light::named("A").unwrap().white();
        let orange = Color {
            xyz: lamp,
            white: lamp,
        };
        assert!(!orange.is_in_srgb(0.0));
    }

    #[test]
    fn a_bare_surface_of_glass_is_gray_and_dark() {
        let stack = Stack::parse("1 | 1.5").unwrap();
        let color = |side| {
            let view = View {
                side,
                ..View::default()
            };
            StackColor::new(&stack, Light::named("D65").unwrap(), view)
                .unwrap()
                .at(&[], Angle::NORMAL)
        };
        let reflected = color(Side::Reflected);
        assert!((reflected.xyz[1] - 0.04).abs() < 1e-14 && reflected.lab().chroma() < 1e-10);
        assert!((color(Side::Transmitted).xyz[1] - 0.96).abs() < 1e-14);
    }
}
