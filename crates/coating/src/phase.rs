//! Phases of a stack: amplitude coefficients, and the angles that ellipsometers measure.

use crate::angle::Angle;
use crate::response::Sampled;
use optics::{Amplitudes, Complex64};

/// Which direction of the p component of reflected light counts as positive.
///
/// Incident and transmitted light, and s, are the same in both: (s, p, direction of propagation) is right-handed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PSign {
    /// Verdet's convention: (s, p, direction of propagation) is right-handed for reflected light too, so r_p = −r_s at normal incidence.
    /// It is that of ellipsometry (Muller 1969; Azzam and Bashara, Ellipsometry and Polarized Light, section 4.2).
    #[default]
    Verdet,
    /// Fresnel's convention: the opposite direction, so r_p = +r_s at normal incidence.
    Fresnel,
}

impl PSign {
    /// Returns `verdet` or `fresnel`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Verdet => "verdet",
            Self::Fresnel => "fresnel",
        }
    }

    /// Returns the amplitudes with this sign of r_p, from those of [`optics`], which are Verdet's.
    fn of(self, verdet: Amplitudes) -> Amplitudes {
        match self {
            Self::Verdet => verdet,
            Self::Fresnel => Amplitudes {
                r_p: -verdet.r_p,
                ..verdet
            },
        }
    }
}

/// The ellipsometric angles ψ and Δ of reflected light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipsometricAngles {
    /// ψ = arctan |r_p / r_s|, degrees, from 0 to 90; `None` if nothing is reflected.
    pub psi_deg: Option<f64>,
    /// Δ, degrees, at least 0 and less than 360; `None` if r_s or r_p is 0, as at Brewster's angle, where a phase has no meaning.
    pub delta_deg: Option<f64>,
}

impl EllipsometricAngles {
    /// An amplitude below this (a reflectance below 1e-20) is a rounding error of 0.
    pub const ZERO: f64 = 1e-10;

    /// Returns ψ and Δ from amplitudes of the time factor exp(−iωt).
    ///
    /// ρ = r_p / r_s = tan ψ exp(iΔ) is defined with the time factor exp(+iωt) and the index n − ik (the Nebraska convention: Muller,
    /// Surf. Sci. 16, 14, 1969; Azzam and Bashara, chapter 4), which conjugates all amplitudes. So Δ = −arg(r_p / r_s) here. With
    /// [`PSign::Verdet`] it is the Δ of ellipsometers and their tables: 180° at normal incidence, and a thin film on a bare
    /// substrate lowers it.
    pub fn of(amplitudes: &Amplitudes) -> Self {
        let (r_s, r_p) = (amplitudes.r_s, amplitudes.r_p);
        let [has_s, has_p] = [r_s, r_p].map(|r| r.norm() >= Self::ZERO);
        let psi_deg = match (has_s, has_p) {
            (true, true) => Some(r_p.norm().atan2(r_s.norm()).to_degrees()),
            (true, false) => Some(0.0),
            (false, true) => Some(90.0),
            (false, false) => None,
        };
        Self {
            psi_deg,
            delta_deg: (has_s && has_p).then(|| delta_deg(r_s, r_p)),
        }
    }
}

/// −arg(r_p / r_s) in degrees, at least 0 and less than 360.
fn delta_deg(r_s: Complex64, r_p: Complex64) -> f64 {
    /// A full turn less this is a rounding error of 0.
    const ROUNDING_DEG: f64 = 1e-9;
    let delta = (r_s * r_p.conj()).arg().to_degrees().rem_euclid(360.0);
    if delta > 360.0 - ROUNDING_DEG {
        0.0
    } else {
        // −0 is 0.
        delta + 0.0
    }
}

impl Sampled {
    /// Returns the amplitude coefficients at each wavelength, with these thicknesses (nm, one per layer): ratios of electric fields,
    /// reflected at the first boundary to incident there, and transmitted at the last boundary to incident at the first one. The time
    /// factor is exp(−iωt).
    ///
    /// They are those of the exact model, whatever the model is: of two beams, only powers are computed here.
    ///
    /// # Panics
    /// If there is not one thickness per layer.
    pub fn amplitudes(
        &self,
        thicknesses_nm: &[f64],
        angle: Angle,
        p_sign: PSign,
    ) -> Vec<Amplitudes> {
        self.each(thicknesses_nm, |n0, layers, substrate, nm| {
            let found = optics::stack(n0, layers, substrate, nm, angle.cosine());
            p_sign.of(found.amplitudes)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Stack;
    use std::f64::consts::TAU;

    const RED_NM: f64 = 632.8;

    fn amplitudes(line: &str, nm: f64, deg: f64, p_sign: PSign) -> Amplitudes {
        let stack = Stack::parse(line).unwrap();
        let sampled = stack.sampled(&[nm]).unwrap();
        let angle = Angle::from_degrees(deg).unwrap();
        sampled.amplitudes(stack.thicknesses_nm(), angle, p_sign)[0]
    }

    fn angles(line: &str, nm: f64, deg: f64) -> (Option<f64>, Option<f64>) {
        let found = EllipsometricAngles::of(&amplitudes(line, nm, deg, PSign::Verdet));
        (found.psi_deg, found.delta_deg)
    }

    /// Ambient, film and substrate with indices n − ik and the time factor exp(+iωt): r_p, r_s, t_p, t_s and the cosine in the
    /// substrate (Azzam and Bashara, Ellipsometry and Polarized Light, sections 4.2 and 4.3).
    fn azzam_bashara(n: [Complex64; 3], d: f64, nm: f64, deg: f64) -> ([Complex64; 4], Complex64) {
        let sine = n[0] * deg.to_radians().sin();
        let c = n.map(|n| (1.0 - (sine / n) * (sine / n)).sqrt());
        let p = |a: usize, b: usize| {
            let sum = n[b] * c[a] + n[a] * c[b];
            [(n[b] * c[a] - n[a] * c[b]) / sum, 2.0 * n[a] * c[a] / sum]
        };
        let s = |a: usize, b: usize| {
            let sum = n[a] * c[a] + n[b] * c[b];
            [(n[a] * c[a] - n[b] * c[b]) / sum, 2.0 * n[a] * c[a] / sum]
        };
        let once = (Complex64::new(0.0, -TAU * d / nm) * n[1] * c[1]).exp();
        let whole = |first: [Complex64; 2], second: [Complex64; 2]| {
            let below = 1.0 + first[0] * second[0] * once * once;
            let r = (first[0] + second[0] * once * once) / below;
            [r, first[1] * second[1] * once / below]
        };
        let ([r_p, t_p], [r_s, t_s]) = (whole(p(0, 1), p(1, 2)), whole(s(0, 1), s(1, 2)));
        ([r_p, r_s, t_p, t_s], c[2])
    }

    /// A stack in a line, its media as (n, k), and the thickness of its film.
    type Case = (&'static str, [(f64, f64); 3], f64);

    const CASES: [Case; 4] = [
        (
            "1 | 1.4571 100nm | 3.875+0.018i",
            [(1.0, 0.0), (1.4571, 0.0), (3.875, 0.018)],
            100.0,
        ),
        (
            "1 | 1.4571 230nm | 3.875+0.018i",
            [(1.0, 0.0), (1.4571, 0.0), (3.875, 0.018)],
            230.0,
        ),
        (
            "1.33 | 0.18+3.43i 20nm | 1.5",
            [(1.33, 0.0), (0.18, 3.43), (1.5, 0.0)],
            20.0,
        ),
        (
            "1 | 2.1+0.4i 60nm | 0.18+3.43i",
            [(1.0, 0.0), (2.1, 0.4), (0.18, 3.43)],
            60.0,
        ),
    ];

    #[test]
    fn amplitudes_and_angles_are_those_of_azzam_and_bashara() {
        for (line, media, d) in CASES {
            let n = media.map(|(n, k)| Complex64::new(n, -k));
            for deg in [0.0, 30.0, 55.0, 70.0, 85.0] {
                let ([r_p, r_s, t_p, t_s], _) = azzam_bashara(n, d, RED_NM, deg);
                let found = amplitudes(line, RED_NM, deg, PSign::Verdet);
                for (found, expected) in [
                    (found.r_p, r_p),
                    (found.r_s, r_s),
                    (found.t_p, t_p),
                    (found.t_s, t_s),
                ] {
                    let off = (found - expected.conj()).norm();
                    assert!(off < 1e-13, "{line} {deg}: {found} {expected}");
                }
                let rho = r_p / r_s;
                let expected = (rho.norm().atan().to_degrees(), rho.arg().to_degrees());
                let (psi, delta) = angles(line, RED_NM, deg);
                assert!((psi.unwrap() - expected.0).abs() < 1e-10, "{line} {deg}");
                let off = delta.unwrap() - expected.1.rem_euclid(360.0);
                assert!(off.abs() < 1e-9, "{line} {deg}: {delta:?} {expected:?}");
            }
        }
    }

    #[test]
    fn powers_are_those_of_the_amplitudes() {
        for (line, media, d) in CASES {
            let n = media.map(|(n, k)| Complex64::new(n, -k));
            let deg = 55.0;
            let (_, cosine) = azzam_bashara(n, d, RED_NM, deg);
            let stack = Stack::parse(line).unwrap();
            let angle = Angle::from_degrees(deg).unwrap();
            let sampled = stack.sampled(&[RED_NM]).unwrap();
            let powers = sampled.powers(stack.thicknesses_nm(), angle)[0];
            // Born and Wolf, section 1.5.3, and Macleod, chapter 2, for an absorbing substrate.
            let ahead = n[0].re * angle.cosine();
            let (s, p) = (
                (n[2] * cosine).re / ahead,
                (n[2].conj() * cosine).re / ahead,
            );
            for p_sign in [PSign::Verdet, PSign::Fresnel] {
                let found = amplitudes(line, RED_NM, deg, p_sign);
                for (power, expected) in [
                    (found.r_s.norm_sqr(), powers.reflectance.s),
                    (found.r_p.norm_sqr(), powers.reflectance.p),
                    (found.t_s.norm_sqr() * s, powers.transmittance.s),
                    (found.t_p.norm_sqr() * p, powers.transmittance.p),
                ] {
                    assert!((power - expected).abs() < 1e-13, "{line}");
                    assert!(expected > 1e-4, "{line}");
                }
            }
        }
    }

    /// Computed with the Python package tmm 0.2.0, whose Δ is arg(−r_p / r_s) for exp(−iωt): 180° minus that of ellipsometers.
    #[test]
    fn silica_on_silicon_is_as_computed_elsewhere() {
        let (psi, delta) = angles("1 | 1.4571 100nm | 3.875+0.018i", RED_NM, 70.0);
        assert!((psi.unwrap() - 41.042_961_424_323).abs() < 1e-9, "{psi:?}");
        assert!(
            (delta.unwrap() - 79.712_897_758_042).abs() < 1e-9,
            "{delta:?}"
        );
    }

    /// Silicon below its principal angle, 75.5°: ψ is small and Δ nearly 180°, and an oxide lowers Δ at first, by 3° per nm
    /// (Drude 1890).
    #[test]
    fn an_oxide_lowers_delta() {
        let (psi, bare) = angles("1 | 3.88+0.02i", RED_NM, 70.0);
        assert!((psi.unwrap() - 10.56).abs() < 0.01, "{psi:?}");
        assert!((bare.unwrap() - 179.19).abs() < 0.01, "{bare:?}");
        let (_, covered) = angles("1 | 1.46 2nm | 3.88+0.02i", RED_NM, 70.0);
        assert!((5.0..6.5).contains(&(bare.unwrap() - covered.unwrap())));
        let (_, beyond) = angles("1 | 3.88+0.02i", RED_NM, 80.0);
        assert!(beyond.unwrap() < 5.0, "{beyond:?}");
    }

    /// Fresnel's rhomb: glass of index 1.51 shifts s by 45° relative to p at 54°37' (Born and Wolf, section 1.5.4).
    #[test]
    fn a_reflection_in_fresnels_rhomb_is_an_eighth_of_a_turn() {
        let (psi, delta) = angles("1.51 | 1", 500.0, 54.0 + 37.0 / 60.0);
        assert!((psi.unwrap() - 45.0).abs() < 1e-12, "{psi:?}");
        assert!((delta.unwrap() - 45.0).abs() < 0.02, "{delta:?}");
    }

    #[test]
    fn the_sign_of_p_shifts_delta_by_half_a_turn() {
        let line = CASES[0].0;
        for deg in [0.0, 40.0, 70.0] {
            let verdet = amplitudes(line, RED_NM, deg, PSign::Verdet);
            let fresnel = amplitudes(line, RED_NM, deg, PSign::Fresnel);
            assert_eq!(fresnel.r_p, -verdet.r_p);
            assert_eq!(
                (fresnel.r_s, fresnel.t_s, fresnel.t_p),
                (verdet.r_s, verdet.t_s, verdet.t_p)
            );
            let [a, b] = [verdet, fresnel].map(|a| EllipsometricAngles::of(&a));
            assert_eq!(a.psi_deg, b.psi_deg);
            let shift = (a.delta_deg.unwrap() - b.delta_deg.unwrap()).rem_euclid(360.0);
            assert!((shift - 180.0).abs() < 1e-9, "{shift}");
        }
        let normal = |p_sign| {
            let delta = EllipsometricAngles::of(&amplitudes(line, RED_NM, 0.0, p_sign)).delta_deg;
            delta.unwrap()
        };
        assert!((normal(PSign::Verdet) - 180.0).abs() < 1e-9);
        assert!(normal(PSign::Fresnel) < 1e-9);
    }

    #[test]
    fn what_is_not_reflected_has_no_phase() {
        let brewster = 1.5_f64.atan().to_degrees();
        assert_eq!(angles("1 | 1.5", 500.0, brewster), (Some(0.0), None));
        assert_eq!(angles("1.5 | 1.5 80nm | 1.5", 500.0, 30.0), (None, None));
        let only_p = Amplitudes {
            r_s: 1e-17.into(),
            ..amplitudes("1 | 1.5", 500.0, 30.0, PSign::Verdet)
        };
        let found = EllipsometricAngles::of(&only_p);
        assert_eq!((found.psi_deg, found.delta_deg), (Some(90.0), None));
        // Near Brewster's angle there is one, on either side of the jump.
        let [below, above] = [-0.01, 0.01].map(|off| angles("1 | 1.5", 500.0, brewster + off).1);
        assert_eq!((below, above), (Some(180.0), Some(0.0)));
    }

    #[test]
    fn a_rounded_turn_is_0() {
        let turn = |off: f64| delta_deg(Complex64::ONE, Complex64::new(1.0, off));
        assert_eq!(turn(1e-17), 0.0);
        assert_eq!(turn(1e-14), 0.0);
        assert!(turn(1e-6) > 359.9 && turn(1e-6) < 360.0);
        assert_eq!(delta_deg(Complex64::ONE, Complex64::new(-1.0, 0.0)), 180.0);
        assert_eq!(delta_deg(Complex64::ONE, Complex64::new(-1.0, -0.0)), 180.0);
    }
}
