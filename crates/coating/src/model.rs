//! The formula for R and T of a stack.

use crate::angle::Angle;
use optics::batch::Powers;
use optics::{Complex64, PathDifference, Polarized, ThicknessDerivative, two_beam};
use std::f64::consts::TAU;

/// The formula for R and T of a stack.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// All beams, however often they are reflected, for any stack.
    #[default]
    Exact,
    /// The two beams that the surfaces of one free film reflect once each, like `model = "two_beam"` in scenes. See
    /// [`optics::two_beam`] for the formula and where it fails. R + T is not 1, R may exceed 1, and there is no absorptance.
    ///
    /// The film is a single layer that does not absorb, between equal media, with an index not below theirs. In a medium of
    /// index n₀ the film has the relative index n/n₀; the path difference is relative to the vacuum wavelength.
    TwoBeam(PathDifference),
}

impl Model {
    /// Returns `exact` or `two_beam`, as in scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::TwoBeam(_) => "two_beam",
        }
    }

    /// Returns `optical` or `as_printed` for two beams.
    pub fn path_difference(self) -> Option<&'static str> {
        match self {
            Self::Exact => None,
            Self::TwoBeam(PathDifference::Optical) => Some("optical"),
            Self::TwoBeam(PathDifference::AsPrinted) => Some("as_printed"),
        }
    }
}

/// A film for the two-beam model, at a vacuum wavelength, nm.
pub(crate) struct TwoBeamFilm {
    pub(crate) path: PathDifference,
    pub(crate) around: f64,
    pub(crate) index: f64,
    pub(crate) thickness_nm: f64,
    pub(crate) wavelength_nm: f64,
}

impl TwoBeamFilm {
    pub(crate) fn powers(&self, angle: Angle) -> Powers {
        let relative = self.index / self.around;
        // l/λ = 2 (n/n₀) d cos θ₂ / (λ/n₀), or without the index 2 d cos θ₂ / λ.
        let wavelength_nm = match self.path {
            PathDifference::Optical => self.wavelength_nm / self.around,
            PathDifference::AsPrinted => self.wavelength_nm,
        };
        let cosine = angle.cosine();
        let found = two_beam(
            relative,
            self.thickness_nm,
            wavelength_nm,
            cosine,
            self.path,
        );
        Powers {
            reflectance: found.reflectance,
            transmittance: found.transmittance,
        }
    }

    /// ∂R/∂d and ∂T/∂d per nm. R = r² + (1 − r²)² r² − 2 r² (1 − r²) cos(q d), T = (1 − r²)².
    pub(crate) fn derivative(&self, angle: Angle) -> ThicknessDerivative {
        let sin2 = (1.0 - angle.cosine()) * (1.0 + angle.cosine());
        let inside = (1.0 - sin2 * (self.around / self.index).powi(2)).sqrt();
        let length_per_nm = match self.path {
            PathDifference::Optical => 2.0 * self.index * inside,
            PathDifference::AsPrinted => 2.0 * inside,
        };
        let q = TAU * length_per_nm / self.wavelength_nm;
        let passed = self.powers(angle).transmittance;
        let slope = |t: f64| {
            let let_in = t.sqrt();
            2.0 * (1.0 - let_in) * let_in * q * (q * self.thickness_nm).sin()
        };
        ThicknessDerivative {
            reflectance: Polarized {
                s: slope(passed.s),
                p: slope(passed.p),
            },
            transmittance: Polarized { s: 0.0, p: 0.0 },
        }
    }
}

/// Returns why the two-beam model is not defined for a stack at a wavelength; `None` if it is.
pub(crate) fn fault_of_two_beams(
    around: f64,
    layers: &[Complex64],
    substrate: Complex64,
) -> Option<String> {
    let [film] = layers else {
        return Some(format!("this stack has {} layers", layers.len()));
    };
    let is_same = (substrate.re - around).abs() <= 1e-12 * around && substrate.im.abs() <= 1e-12;
    if !is_same {
        return Some(format!(
            "the index is {around} in front of this one, and behind it {}",
            index(substrate)
        ));
    }
    if film.im != 0.0 {
        return Some(format!("this one has the index {}", index(*film)));
    }
    (film.re < around).then(|| {
        format!(
            "this one has the index {}, less than the {around} around it",
            film.re
        )
    })
}

fn index(index: Complex64) -> String {
    if index.im == 0.0 {
        index.re.to_string()
    } else {
        format!("{}+{}i", index.re, index.im)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Stack;

    fn model(path: PathDifference) -> Model {
        Model::TwoBeam(path)
    }

    fn powers(line: &str, model: Model, angle: f64) -> Powers {
        let stack = Stack::parse(line).unwrap().with_model(model);
        let sampled = stack.sampled(&[500.0]).unwrap();
        sampled.powers(stack.thicknesses_nm(), Angle::from_degrees(angle).unwrap())[0]
    }

    /// By hand at normal incidence: r = 1/5 for n = 3/2, r² = 0.04. A quarter wave (500/6 nm) has cos = −1: R = 0.04 · (1 + 0.96 ·
    /// (0.96 + 2)) = 0.153_664. As printed, l is 1/n of that, cos(2π/3) = −1/2 for l = 2 d = λ/3: R = 0.04 · (1 + 0.96 · 1.96).
    #[test]
    fn two_beams_by_hand() {
        let line = "1 | 1.5 83.33333333333333nm | 1";
        for (path, expected) in [
            (PathDifference::Optical, 0.153_664),
            (PathDifference::AsPrinted, 0.115_264),
        ] {
            let found = powers(line, model(path), 0.0);
            assert!((found.reflectance.s - expected).abs() < 1e-14, "{found:?}");
            assert!((found.transmittance.p - 0.96 * 0.96).abs() < 1e-14);
        }
    }

    /// A film in a medium equals one of the relative index in vacuum, at the wavelength in the medium. As printed, only the thickness
    /// matters.
    #[test]
    fn a_film_in_a_medium_is_one_of_the_relative_index() {
        let optical = model(PathDifference::Optical);
        let a = powers("1.25 | 1.5 300nm | 1.25", optical, 40.0);
        let b = powers("1 | 1.2 375nm | 1", optical, 40.0);
        let printed = model(PathDifference::AsPrinted);
        let c = powers("1.25 | 1.5 300nm | 1.25", printed, 40.0);
        let d = powers("1 | 1.2 300nm | 1", printed, 40.0);
        for (a, b) in [(a, b), (c, d)] {
            assert!((a.reflectance.s - b.reflectance.s).abs() < 1e-14);
            assert!((a.reflectance.p - b.reflectance.p).abs() < 1e-14);
        }
        assert!((a.reflectance.s - c.reflectance.s).abs() > 1e-3);
    }

    #[test]
    fn derivatives_follow_differences() {
        for path in [PathDifference::Optical, PathDifference::AsPrinted] {
            let stack = Stack::parse("1.1 | 1.5 300nm | 1.1").unwrap();
            let sampled = stack.with_model(model(path)).sampled(&[470.0]).unwrap();
            let angle = Angle::from_degrees(50.0).unwrap();
            let at = |nm: f64| sampled.powers(&[nm], angle)[0].reflectance;
            let slope = sampled.derivatives(&[300.0], angle)[0][0].reflectance;
            let (low, high) = (at(299.999), at(300.001));
            assert!((slope.s - (high.s - low.s) / 0.002).abs() < 1e-9);
            assert!((slope.p - (high.p - low.p) / 0.002).abs() < 1e-9);
            assert!(slope.s.abs() > 1e-4);
        }
    }

    #[test]
    fn many_at_once_are_the_same_as_each_alone() {
        let two = model(PathDifference::Optical);
        let stack = Stack::parse("air | 1.4 300nm | air").unwrap();
        let sampled = stack.with_model(two).sampled(&[450.0, 600.0]).unwrap();
        let angles = [0.0, 70.0].map(|deg| Angle::from_degrees(deg).unwrap());
        let sets = [vec![200.0], vec![900.0]];
        let each = sets
            .iter()
            .flat_map(|set| angles.map(|angle| sampled.powers(set, angle)));
        let each: Vec<Powers> = each.flatten().collect();
        assert_eq!(sampled.powers_of_all(&sets, &angles), each);
    }

    #[test]
    fn what_two_beams_are_not_for_is_refused() {
        for (line, said) in [
            ("1 | 1.5", "has 0 layers"),
            ("1 | 1.5 100nm | 1.4 100nm | 1", "has 2 layers"),
            ("1 | 1.5 100nm | 1.6", "behind it 1.6"),
            ("air | 1.5 100nm | 1", "behind it 1"),
            ("1 | 1.5 100nm | 1+0.1i", "behind it 1+0.1i"),
            ("1 | 1.5+0.01i 100nm | 1", "1.5+0.01i"),
            ("1.5 | 1.2 100nm | 1.5", "1.2, less than the 1.5"),
        ] {
            let stack = Stack::parse(line).unwrap();
            assert!(stack.sampled(&[500.0]).is_ok());
            let stack = stack.with_model(model(PathDifference::Optical));
            let error = stack.sampled(&[500.0]).unwrap_err().to_string();
            assert!(error.contains(said), "{line}: {error}");
        }
    }
}
