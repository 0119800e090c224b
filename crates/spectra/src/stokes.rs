//! Polarized light: the components of a Stokes vector, and what is computed from them.
//!
//! S0 is the radiance and S1 the part of it that is polarized along the reference axis minus the part across it; S2 the same for the axes
//! at +45° and −45°; S3 the part that is circularly polarized to the right minus the part to the left. Positive angles turn the reference
//! axis counterclockwise as seen by who receives the light; right-handed light turns clockwise for the receiver (Born and Wolf, Principles of
//! Optics, 7th ed., section 1.4.2). In a picture the reference axis is horizontal and points to the right.

/// A component of a Stokes vector.
#[derive(Clone, Copy, Debug, Eq, Ord, PartialEq, PartialOrd)]
pub enum Stokes {
    /// The radiance.
    S0,
    /// Horizontal minus vertical.
    S1,
    /// Along +45° minus along −45°.
    S2,
    /// Right circular minus left circular.
    S3,
}

impl Stokes {
    /// All components.
    pub const ALL: [Self; 4] = [Self::S0, Self::S1, Self::S2, Self::S3];
    /// Those that describe the polarization.
    pub const POLARIZED: [Self; 3] = [Self::S1, Self::S2, Self::S3];

    /// Its name: `S0` to `S3`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::S0 => "S0",
            Self::S1 => "S1",
            Self::S2 => "S2",
            Self::S3 => "S3",
        }
    }

    /// Its place in a Stokes vector.
    pub const fn index(self) -> usize {
        self as usize
    }
}

/// Degree of polarization, √(S1² + S2² + S3²) / S0: from 0 to 1 for physical light. 0 where there is no light.
pub fn degree_of_polarization([s0, s1, s2, s3]: [f64; 4]) -> f64 {
    ratio((s1 * s1 + s2 * s2 + s3 * s3).sqrt(), s0)
}

/// Degree of linear polarization, √(S1² + S2²) / S0. 0 where there is no light.
pub fn degree_of_linear_polarization([s0, s1, s2, _]: [f64; 4]) -> f64 {
    ratio(s1.hypot(s2), s0)
}

/// Degree of circular polarization with its sign, S3 / S0: positive to the right. 0 where there is no light.
pub fn degree_of_circular_polarization([s0, _, _, s3]: [f64; 4]) -> f64 {
    ratio(s3, s0)
}

/// Angle of linear polarization, ½ atan2(S2, S1), in degrees from the reference axis: 0 ≤ angle < 180. 0 where S1 and S2 are 0.
pub fn angle_of_linear_polarization_deg([_, s1, s2, _]: [f64; 4]) -> f64 {
    let angle = 0.5 * s2.atan2(s1).to_degrees();
    if angle < 0.0 {
        // −1e-17 + 180 would be 180.
        let turned = angle + 180.0;
        return if turned < 180.0 { turned } else { 0.0 };
    }
    angle
}

fn ratio(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// A retarder: light along its slow axis is late.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Retarder {
    /// The fast axis, degrees counterclockwise from the horizontal, as the camera sees it.
    pub fast_axis_deg: f64,
    /// By how much light along the slow axis is late.
    pub retardance: Retardance,
}

/// By how much a retarder delays light along its slow axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Retardance {
    /// The same phase at every wavelength, degrees: 90 for a quarter-wave plate.
    Phase {
        /// The phase.
        deg: f64,
    },
    /// A path difference Δn·d, nm: the phase is 360° times this over the wavelength.
    Path {
        /// The path difference.
        nm: f64,
    },
}

/// An ideal linear polarizer in front of a camera, optionally behind a retarder: light passes the retarder first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polarizer {
    /// The direction of the electric field that passes, degrees counterclockwise from the horizontal, as the camera sees it.
    pub angle_deg: f64,
    /// The retarder in front of it.
    pub retarder: Option<Retarder>,
}

/// The weights with which S1, S2 and S3 enter what a polarizer transmits, ½ (S0 + w · (S1, S2, S3)), for a phase δ of the retarder:
/// w = constant + cosine · cos δ + sine · sin δ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Analyzer {
    /// Part that does not depend on the phase.
    pub constant: [f64; 3],
    /// Factor of cos δ.
    pub cosine: [f64; 3],
    /// Factor of sin δ.
    pub sine: [f64; 3],
    /// The path difference, nm, if the phase depends on the wavelength: it is 2π times this over the wavelength.
    pub path_nm: Option<f64>,
}

impl Polarizer {
    /// Returns the weights of the Stokes components (Mueller matrices of an ideal polarizer and of a linear retarder: Goldstein,
    /// Polarized Light, 3rd ed., 2011, sections 6.3 and 6.4, in the convention of this module).
    pub fn analyzer(&self) -> Analyzer {
        let still = Retarder {
            fast_axis_deg: 0.0,
            retardance: Retardance::Phase { deg: 0.0 },
        };
        let retarder = self.retarder.unwrap_or(still);
        let (sin, cos) = double_angle(retarder.fast_axis_deg);
        // The polarizer's axis, seen from the fast axis.
        let (across, along) = double_angle(self.angle_deg - retarder.fast_axis_deg);
        let analyzer = Analyzer {
            constant: [along * cos, along * sin, 0.0],
            cosine: [-across * sin, across * cos, 0.0],
            sine: [0.0, 0.0, across],
            path_nm: None,
        };
        match retarder.retardance {
            // The same at every wavelength: the constant has all.
            Retardance::Phase { deg } => Analyzer {
                constant: analyzer.with(sin_cos_deg(deg)),
                cosine: [0.0; 3],
                sine: [0.0; 3],
                ..analyzer
            },
            Retardance::Path { nm } => Analyzer {
                path_nm: Some(nm),
                ..analyzer
            },
        }
    }
}

impl Analyzer {
    /// Returns the weights at a wavelength, nm.
    pub fn weights(&self, wavelength_nm: f64) -> [f64; 3] {
        match self.path_nm {
            None => self.constant,
            Some(nm) => self.with(sin_cos_deg(360.0 * (nm / wavelength_nm).fract())),
        }
    }

    /// Returns the weights for the sine and cosine of a phase.
    fn with(&self, (sin, cos): (f64, f64)) -> [f64; 3] {
        std::array::from_fn(|i| self.constant[i] + cos * self.cosine[i] + sin * self.sine[i])
    }

    /// Returns the radiance that passes, at a wavelength, nm.
    pub fn transmitted(&self, [s0, rest @ ..]: [f64; 4], wavelength_nm: f64) -> f64 {
        let weights = self.weights(wavelength_nm);
        let sum: f64 = weights.iter().zip(rest).map(|(w, s)| w * s).sum();
        0.5 * (s0 + sum)
    }
}

/// Sine and cosine of twice an angle in degrees.
fn double_angle(deg: f64) -> (f64, f64) {
    sin_cos_deg(2.0 * deg)
}

/// Sine and cosine of an angle in degrees, exact at multiples of 90°.
fn sin_cos_deg(deg: f64) -> (f64, f64) {
    let turned = deg.rem_euclid(360.0);
    match turned {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => turned.to_radians().sin_cos(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NM: f64 = 550.0;

    /// The Stokes vector of a fully polarized field, from its definition: S2 + iS3 = 2 Ex Ey*, for Ex = a and Ey = b exp(iφ).
    fn stokes(a: f64, b: f64, phase: f64) -> [f64; 4] {
        let both = 2.0 * a * b;
        [
            a * a + b * b,
            a * a - b * b,
            both * phase.cos(),
            -both * phase.sin(),
        ]
    }

    /// The power of a field behind a retarder and a polarizer, by its amplitudes alone (Jones 1941).
    fn by_amplitudes(polarizer: &Polarizer, [a, b, phase]: [f64; 3]) -> f64 {
        let complex = |size: f64, angle: f64| [size * angle.cos(), size * angle.sin()];
        let turn = |[x, y]: [[f64; 2]; 2], deg: f64| {
            let (sin, cos) = deg.to_radians().sin_cos();
            let sum =
                |x: [f64; 2], p: f64, y: [f64; 2], q: f64| [0, 1].map(|i| p * x[i] + q * y[i]);
            [sum(x, cos, y, sin), sum(x, -sin, y, cos)]
        };
        let mut field = [complex(a, 0.0), complex(b, phase)];
        if let Some(retarder) = polarizer.retarder {
            let Retardance::Phase { deg } = retarder.retardance else {
                panic!("a phase");
            };
            let [fast, [re, im]] = turn(field, retarder.fast_axis_deg);
            let (sin, cos) = deg.to_radians().sin_cos();
            // With exp(−iωt), what is late has the factor exp(iδ).
            let slow = [re * cos - im * sin, re * sin + im * cos];
            field = turn([fast, slow], -retarder.fast_axis_deg);
        }
        let [[re, im], _] = turn(field, polarizer.angle_deg);
        re * re + im * im
    }

    #[test]
    fn a_polarizer_transmits_what_the_amplitudes_say() {
        let retarders = [
            None,
            Some((0.0, 90.0)),
            Some((45.0, 90.0)),
            Some((20.0, 133.0)),
        ];
        for (fast_axis, angle_deg) in retarders
            .iter()
            .flat_map(|r| [-30.0, 0.0, 45.0, 77.0].map(|a| (r, a)))
        {
            let retarder = fast_axis.map(|(fast_axis_deg, deg)| Retarder {
                fast_axis_deg,
                retardance: Retardance::Phase { deg },
            });
            let polarizer = Polarizer {
                angle_deg,
                retarder,
            };
            for field in [
                [1.0, 0.0, 0.0],
                [0.3, 0.8, 0.0],
                [0.7, 0.7, std::f64::consts::FRAC_PI_2],
                [0.5, 0.9, -2.1],
            ] {
                let [a, b, phase] = field;
                let found = polarizer.analyzer().transmitted(stokes(a, b, phase), NM);
                let expected = by_amplitudes(&polarizer, field);
                assert!(
                    (found - expected).abs() < 1e-12,
                    "{polarizer:?} {field:?}: {found} {expected}"
                );
            }
        }
    }

    /// I = I₀ cos²φ (Malus 1809); half of unpolarized light.
    #[test]
    fn malus_law() {
        for deg in [0.0_f64, 30.0, 45.0, 60.0, 90.0, 210.0] {
            let analyzer = Polarizer {
                angle_deg: deg,
                retarder: None,
            }
            .analyzer();
            let expected = deg.to_radians().cos().powi(2);
            let found = analyzer.transmitted([1.0, 1.0, 0.0, 0.0], NM);
            assert!((found - expected).abs() < 1e-15, "{deg}: {found}");
            assert_eq!(analyzer.transmitted([1.0, 0.0, 0.0, 0.0], NM), 0.5);
        }
    }

    /// A path difference of a wavelength changes nothing, of half a wavelength mirrors at the fast axis.
    #[test]
    fn a_path_difference_is_a_phase_that_depends_on_the_wavelength() {
        let with = |retardance| Polarizer {
            angle_deg: 10.0,
            retarder: Some(Retarder {
                fast_axis_deg: 35.0,
                retardance,
            }),
        };
        let weights = |retardance| with(retardance).analyzer().weights(NM);
        let close = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        for (nm, deg) in [(550.0, 0.0), (275.0, 180.0), (137.5, 90.0)] {
            let (path, phase) = (Retardance::Path { nm }, Retardance::Phase { deg });
            assert!(close(weights(path), weights(phase)), "{nm}");
        }
        let bare = |angle_deg| Polarizer {
            angle_deg,
            retarder: None,
        };
        let half = weights(Retardance::Phase { deg: 180.0 });
        assert!(close(half, bare(60.0).analyzer().weights(NM)));
        assert!(!close(half, bare(61.0).analyzer().weights(NM)));
    }

    #[test]
    fn degrees_and_angles_of_polarization() {
        let half = [2.0, 0.6, 0.8, 0.0];
        assert!((degree_of_polarization(half) - 0.5).abs() < 1e-15);
        assert!((degree_of_linear_polarization([2.0, 0.6, 0.8, 1.0]) - 0.5).abs() < 1e-15);
        assert_eq!(degree_of_circular_polarization([2.0, 0.0, 0.0, -1.0]), -0.5);
        for (s1, s2, angle) in [
            (1.0, 0.0, 0.0),
            (0.0, 1.0, 45.0),
            (-1.0, 0.0, 90.0),
            (0.0, -1.0, 135.0),
        ] {
            assert_eq!(angle_of_linear_polarization_deg([1.0, s1, s2, 0.0]), angle);
        }
        assert_eq!(
            angle_of_linear_polarization_deg([1.0, 1.0, -1e-300, 0.0]),
            0.0
        );
        assert_eq!(degree_of_polarization([0.0; 4]), 0.0);
    }
}
