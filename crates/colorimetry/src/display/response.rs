//! Responses of display channels: the amount of light for a code.

use spectra::Tabulated;

use crate::srgb;

/// The response of a channel: the amount C of light for a code V in \[0, 1\], 1 for its amount in the white.
#[derive(Clone, Debug, PartialEq)]
pub enum Response {
    /// C = V.
    Linear,
    /// The piecewise curve of IEC 61966-2-1:1999.
    Srgb,
    /// C = ((V − α)/(1 − α))^γ, and 0 below α (Suzuki, Yokoi and Toriwaki, section 2-3, where V = 1 gives C = 1).
    Gamma {
        /// The exponent, above 0.
        gamma: f64,
        /// The code above which there is light, below 1; negative if code 0 already gives light.
        alpha: f64,
    },
    /// The curve of ITU-R BT.1886 (2011) for a black of `black` times the luminance of the white: (max(V + b, 0)/(1 + b))^2.4 minus
    /// its value at V = 0, scaled so that V = 1 gives C = 1.
    Bt1886 {
        /// Luminance of black, relative to that of white and black together, from 0 to less than 1.
        black: f64,
    },
    /// The curve of SMPTE ST 2084:2014, whose codes are luminances up to 10000 cd/m².
    Pq {
        /// The luminance for C = 1, cd/m².
        white_luminance: f64,
    },
    /// A measured curve C over V, linear between its points, where V rises and C does not fall.
    Table(Tabulated),
}

/// The exponent of BT.1886.
const BT1886_GAMMA: f64 = 2.4;

impl Response {
    /// Returns the amount C of light for a code V in \[0, 1\].
    pub fn light(&self, code: f64) -> f64 {
        match self {
            Self::Linear => code,
            Self::Srgb => srgb::decode(code),
            Self::Gamma { gamma, alpha } => ((code - alpha) / (1.0 - alpha)).max(0.0).powf(*gamma),
            Self::Bt1886 { black } => {
                let b = bt1886_lift(*black);
                let luminance = ((code + b) / (1.0 + b)).max(0.0).powf(BT1886_GAMMA);
                (luminance - black) / (1.0 - black)
            }
            Self::Pq { white_luminance } => pq_luminance(code) / white_luminance,
            Self::Table(table) => table.clamped_at(code),
        }
    }

    /// Returns the code V for an amount C of light in \[0, [`Self::peak`]\]: the inverse of [`Self::light`]. If several codes give no
    /// light, it is the largest of them for a curve with α, the smallest for a table.
    pub fn code(&self, light: f64) -> f64 {
        match self {
            Self::Linear => light,
            Self::Srgb => srgb::encode(light),
            Self::Gamma { gamma, alpha } => {
                alpha + (1.0 - alpha) * light.max(0.0).powf(1.0 / gamma)
            }
            Self::Bt1886 { black } => {
                let b = bt1886_lift(*black);
                let luminance = (black + (1.0 - black) * light).max(0.0);
                (1.0 + b) * luminance.powf(1.0 / BT1886_GAMMA) - b
            }
            Self::Pq { white_luminance } => pq_code(light * white_luminance),
            Self::Table(table) => code_of_table(table, light),
        }
    }

    /// Returns the amount of light at code 1: 1, but with PQ the ratio of 10000 cd/m² to the luminance of the white.
    pub fn peak(&self) -> f64 {
        match self {
            Self::Pq { .. } => self.light(1.0),
            _ => 1.0,
        }
    }

    /// The name of the curve in display files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Srgb => "srgb",
            Self::Gamma { .. } => "gamma",
            Self::Bt1886 { .. } => "bt1886",
            Self::Pq { .. } => "pq",
            Self::Table(_) => "table",
        }
    }
}

/// The lift b of BT.1886, annex 1: L_B^(1/γ) / (L_W^(1/γ) − L_B^(1/γ)), with L_W = 1.
fn bt1886_lift(black: f64) -> f64 {
    let root = black.powf(1.0 / BT1886_GAMMA);
    root / (1.0 - root)
}

/// Constants of SMPTE ST 2084:2014, equation 4.1.
const PQ_M1: f64 = 2610.0 / 16384.0;
const PQ_M2: f64 = 2523.0 / 4096.0 * 128.0;
const PQ_C1: f64 = 3424.0 / 4096.0;
const PQ_C2: f64 = 2413.0 / 4096.0 * 32.0;
const PQ_C3: f64 = 2392.0 / 4096.0 * 32.0;
/// Luminance of the largest code, cd/m².
pub(super) const PQ_PEAK: f64 = 10_000.0;

/// Returns the luminance of a code, cd/m² (ST 2084, equation 4.1).
fn pq_luminance(code: f64) -> f64 {
    let root = code.max(0.0).powf(1.0 / PQ_M2);
    PQ_PEAK * ((root - PQ_C1).max(0.0) / (PQ_C2 - PQ_C3 * root)).powf(1.0 / PQ_M1)
}

/// Returns the code for a luminance in cd/m² (ST 2084, equation 5.2), clipped at the peak. By the equation, no light has the code 7e-7.
fn pq_code(luminance: f64) -> f64 {
    let power = (luminance / PQ_PEAK).clamp(0.0, 1.0).powf(PQ_M1);
    ((PQ_C1 + PQ_C2 * power) / (1.0 + PQ_C3 * power)).powf(PQ_M2)
}

/// Returns the smallest code for which a measured curve, whose values do not fall, reaches an amount of light; linear between its points.
fn code_of_table(table: &Tabulated, light: f64) -> f64 {
    table
        .first_reach(light)
        .unwrap_or_else(|| table.range_nm().1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<Response> {
        let table = Tabulated::new(vec![(0.0, 0.0), (0.25, 0.1), (0.5, 0.3), (1.0, 1.0)]).unwrap();
        vec![
            Response::Linear,
            Response::Srgb,
            Response::Gamma {
                gamma: 2.2,
                alpha: 0.0,
            },
            Response::Gamma {
                gamma: 1.8,
                alpha: -0.05,
            },
            Response::Bt1886 { black: 0.0 },
            Response::Bt1886 { black: 0.001 },
            Response::Pq {
                white_luminance: 203.0,
            },
            Response::Table(table),
        ]
    }

    #[test]
    fn light_rises_to_its_peak_and_codes_come_back() {
        for response in all() {
            let lights: Vec<f64> = (0..=1000)
                .map(|i| response.light(f64::from(i) / 1000.0))
                .collect();
            assert!(
                lights.windows(2).all(|pair| pair[0] < pair[1]),
                "{response:?}"
            );
            assert!(
                (lights[1000] - response.peak()).abs() < 1e-12 * response.peak(),
                "{response:?}"
            );
            for (i, &light) in (0..).zip(&lights).skip(1) {
                let code = response.code(light);
                // The pieces of sRGB meet with a step of 1e-8.
                assert!(
                    (code - f64::from(i) / 1000.0).abs() < 1e-7,
                    "{response:?}: {i} {code}"
                );
            }
        }
    }

    /// The curve of the paper by hand: γ = 2, α = 0.2, V = 0.6 is ((0.6 − 0.2)/0.8)² = 0.25.
    #[test]
    fn the_curve_with_an_offset() {
        let response = Response::Gamma {
            gamma: 2.0,
            alpha: 0.2,
        };
        assert!((response.light(0.6) - 0.25).abs() < 1e-15);
        assert!((response.code(0.25) - 0.6).abs() < 1e-15);
        assert_eq!([0.0, 0.1, 0.2].map(|code| response.light(code)), [0.0; 3]);
        assert_eq!(response.code(0.0), 0.2);
        assert_eq!((response.light(1.0), response.code(1.0)), (1.0, 1.0));
        assert_eq!(response.code(-1.0), 0.2);
    }

    /// ITU-R BT.2408-7 (2023), table 1: 203 cd/m² is 58 % of PQ, 1000 cd/m² 75 %; ST 2084: 100 cd/m² is 0.508.
    #[test]
    fn pq_has_its_published_points() {
        for (luminance, code, digits) in [
            (203.0, 0.58, 2),
            (1000.0, 0.75, 2),
            (100.0, 0.508, 3),
            (10_000.0, 1.0, 6),
        ] {
            let found = pq_code(luminance);
            assert!(
                (found - code).abs() <= 0.5 * 10.0_f64.powi(-digits),
                "{luminance}: {found}"
            );
            assert!((pq_luminance(found) / luminance - 1.0).abs() < 1e-11);
        }
        let response = Response::Pq {
            white_luminance: 203.0,
        };
        assert!((response.peak() - 10_000.0 / 203.0).abs() < 1e-10);
        assert!(response.light(response.code(0.0)) < 1e-12 && response.code(1e9) == 1.0);
    }

    /// Without black, the curve is the power 2.4; with black, it is (V + b)^2.4 by the equations of BT.1886, annex 1.
    #[test]
    fn bt1886_is_its_equation() {
        let plain = Response::Bt1886 { black: 0.0 };
        assert!((plain.light(0.5) - 0.5_f64.powf(2.4)).abs() < 1e-15);
        let (white, black) = (100.0_f64, 0.1_f64);
        let roots = (white.powf(1.0 / 2.4), black.powf(1.0 / 2.4));
        let (a, b) = ((roots.0 - roots.1).powf(2.4), roots.1 / (roots.0 - roots.1));
        let lifted = Response::Bt1886 {
            black: black / white,
        };
        for code in [0.0, 0.3, 1.0] {
            let luminance = a * (code + b).powf(2.4);
            let found = black + lifted.light(code) * (white - black);
            assert!(
                (found - luminance).abs() < 1e-12,
                "{code}: {found} {luminance}"
            );
        }
    }

    #[test]
    fn a_table_is_read_backwards_and_flats_are_passed() {
        let points = vec![(0.0, 0.0), (0.2, 0.0), (0.6, 0.5), (0.8, 0.5), (1.0, 1.0)];
        let response = Response::Table(Tabulated::new(points).unwrap());
        assert_eq!(response.code(0.0), 0.0);
        assert!((response.code(0.25) - 0.4).abs() < 1e-15);
        assert_eq!(response.code(0.5), 0.6);
        assert_eq!(response.code(2.0), 1.0);
        assert_eq!(response.code(-1.0), 0.0);
    }
}
