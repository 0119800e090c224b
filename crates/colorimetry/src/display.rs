//! Displays: how codes become light.
//!
//! A display mixes three primaries: XYZ = M C with C the amounts of red, green and blue, 1 each for its white, and each amount
//! is what the channel's [`Response`] makes of the code V in \[0, 1\] (Suzuki, Yokoi and Toriwaki, sections 2-2 and 2-3).

use crate::chromaticity::{xy_of_xyz, xyz_of_xy};
use crate::matrix::{Matrix3, inverse, of_columns, times};
use crate::srgb;

/// What a channel makes of a code.
#[derive(Clone, Debug, PartialEq)]
pub enum Response {
    /// C = V.
    Linear,
    /// The piecewise curve of IEC 61966-2-1:1999.
    Srgb,
}

impl Response {
    /// The amount C of light for a code V in \[0, 1\].
    pub fn light(&self, code: f64) -> f64 {
        match self {
            Self::Linear => code,
            Self::Srgb => srgb::decode(code),
        }
    }

    /// The code V for an amount C of light in \[0, [`Display::peak`]\]: [`Self::light`] backwards.
    pub fn code(&self, light: f64) -> f64 {
        match self {
            Self::Linear => light,
            Self::Srgb => srgb::encode(light),
        }
    }
}

/// A display.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    name: String,
    xyz_from_rgb: Matrix3,
    rgb_from_xyz: Matrix3,
    responses: [Response; 3],
    white_luminance: f64,
    black: [f64; 3],
}

impl Display {
    /// A display that Pellicle carries, by its name.
    pub fn named(name: &str) -> Option<Self> {
        (name == "srgb").then(|| {
            let columns = srgb::PRIMARIES.map(xyz_of_xy);
            let p = of_columns(columns);
            let scales = times(&inverse(&p), xyz_of_xy(srgb::WHITE));
            let xyz_from_rgb = p.map(|row| std::array::from_fn(|i| row[i] * scales[i]));
            Self {
                name: name.to_owned(),
                xyz_from_rgb,
                rgb_from_xyz: inverse(&xyz_from_rgb),
                responses: [const { Response::Srgb }; 3],
                white_luminance: 80.0,
                black: [0.0; 3],
            }
        })
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// M: the columns are XYZ of full red, green and blue, relative to the white's Y = 1.
    pub fn xyz_from_rgb(&self) -> &Matrix3 {
        &self.xyz_from_rgb
    }

    /// M⁻¹.
    pub fn rgb_from_xyz(&self) -> &Matrix3 {
        &self.rgb_from_xyz
    }

    /// XYZ of the white (1, 1, 1), Y = 1.
    pub fn white_xyz(&self) -> [f64; 3] {
        times(&self.xyz_from_rgb, [1.0; 3])
    }

    /// Chromaticities of full red, green and blue.
    pub fn primaries_xy(&self) -> [[f64; 2]; 3] {
        std::array::from_fn(|i| xy_of_xyz(self.xyz_from_rgb.map(|row| row[i])))
    }

    /// What each channel makes of a code.
    pub fn responses(&self) -> &[Response; 3] {
        &self.responses
    }

    /// The largest amount that a channel gives: 1, or more where codes above the white exist (PQ).
    pub fn peak(&self) -> f64 {
        1.0
    }

    /// Luminance of the white, cd/m².
    pub fn white_luminance(&self) -> f64 {
        self.white_luminance
    }

    /// XYZ that the screen shows at code 0, its black level and the ambient light that it reflects; relative to the white's
    /// Y = 1. It adds to every colour.
    pub fn black_xyz(&self) -> [f64; 3] {
        self.black
    }
}
