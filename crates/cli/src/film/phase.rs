//! Amplitudes and ellipsometric angles: their options, columns and plot.

use super::Film;
use clap::ValueEnum;
use pellicle::coating::{Amplitudes, Angle, EllipsometricAngles, Over, PSign, PhasePlot, Sampled};
use serde_json::{Value, json};

#[derive(clap::Args)]
pub(super) struct PhaseOptions {
    /// Also print amplitude coefficients of electric fields, with the phases (CSV and JSON: rs_re, rs_im, rp_re, …, tp_im), and the
    /// ellipsometric angles of reflected light (all formats: psi_deg, delta_deg). --plot shows ψ and Δ in place of R, T and A.
    ///
    /// Amplitudes are for the time factor exp(-iωt) and the index n + ik; r is at the first boundary, t from the first to the last.
    /// ψ and Δ are those of ellipsometers (Nebraska convention): rp/rs = tan ψ exp(iΔ) for exp(+iωt), which is tan ψ exp(-iΔ) in the
    /// printed amplitudes; with --p-sign verdet, Δ is 180° at normal incidence, and a thin film lowers it. Δ is from 0 to less than 360.
    /// Where rs or rp is 0, as at Brewster's angle, Δ is empty (null in JSON, - in the table); ψ too where both are. All are computed on the CPU in f64.
    #[arg(long)]
    pub(super) phase: bool,
    /// Positive direction of p in reflected light
    #[arg(long, value_enum, default_value_t = PSignName::Verdet, requires = "phase")]
    p_sign: PSignName,
    /// What the horizontal axis of --plot shows with --phase: the wavelength, with a curve per angle; or the angle, with a curve per
    /// wavelength
    #[arg(long, value_enum, default_value_t = OverName::Wavelength, requires = "phase", requires = "plot")]
    pub(super) plot_over: OverName,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum PSignName {
    /// rp = -rs at normal incidence: that of ellipsometry
    Verdet,
    /// rp = +rs at normal incidence: Δ differs by 180°
    Fresnel,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub(super) enum OverName {
    Wavelength,
    Angle,
}

impl PhaseOptions {
    pub(super) fn p_sign(&self) -> PSign {
        match self.p_sign {
            PSignName::Verdet => PSign::Verdet,
            PSignName::Fresnel => PSign::Fresnel,
        }
    }
}

/// What is printed at a wavelength and an angle.
pub(super) struct Phase {
    amplitudes: Amplitudes,
    angles: EllipsometricAngles,
}

impl Phase {
    /// The columns of CSV, which are the keys of JSON.
    pub(super) const COLUMNS: [&str; 10] = [
        "rs_re",
        "rs_im",
        "rp_re",
        "rp_im",
        "ts_re",
        "ts_im",
        "tp_re",
        "tp_im",
        "psi_deg",
        "delta_deg",
    ];

    /// The numbers of all columns; `None` where one is not defined.
    pub(super) fn figures(&self) -> [Option<f64>; 10] {
        let Amplitudes { r_s, r_p, t_s, t_p } = self.amplitudes;
        // + 0 turns −0 into 0.
        let [rs, rp, ts, tp] = [r_s, r_p, t_s, t_p].map(|a| [a.re, a.im].map(|part| part + 0.0));
        let [psi, delta] = self.angles();
        let [a, b, c, d, e, f, g, h] =
            [rs[0], rs[1], rp[0], rp[1], ts[0], ts[1], tp[0], tp[1]].map(Some);
        [a, b, c, d, e, f, g, h, psi, delta]
    }

    /// ψ and Δ.
    pub(super) fn angles(&self) -> [Option<f64>; 2] {
        [self.angles.psi_deg, self.angles.delta_deg]
    }
}

/// The amplitudes and angles at each wavelength; empty if they were not requested.
pub(super) fn phases(film: &Film, sampled: &Sampled, angle: Angle) -> Vec<Phase> {
    let options = &film.arguments.phases;
    if !options.phase {
        return Vec::new();
    }
    let thicknesses = film.stack.thicknesses_nm();
    let found = sampled.amplitudes(thicknesses, angle, options.p_sign());
    let phase = |amplitudes: Amplitudes| Phase {
        angles: EllipsometricAngles::of(&amplitudes),
        amplitudes,
    };
    found.into_iter().map(phase).collect()
}

/// What the JSON says of amplitudes and angles.
pub(super) fn about(film: &Film) -> Value {
    json!({
        "about": "amplitudes of electric fields for exp(-iωt) and n + ik, r at the first boundary, t from the first to the last; \
                  ψ and Δ for exp(+iωt) as ellipsometers show them, rp/rs = tan ψ exp(-iΔ) in these amplitudes; null where not defined",
        "p_sign": film.arguments.phases.p_sign().name(),
    })
}

/// The plot of ψ and Δ.
pub(super) fn plot(film: &Film) -> miette::Result<PhasePlot> {
    let nm = film.wavelengths_nm(1)?;
    let sampled = film.stack.sampled(&nm)?;
    let angles_at = |&angle: &Angle| -> Vec<EllipsometricAngles> {
        let phases = phases(film, &sampled, angle);
        phases.iter().map(|phase| phase.angles).collect()
    };
    // By angle, then by wavelength.
    let found: Vec<Vec<EllipsometricAngles>> = film.angles.iter().map(angles_at).collect();
    let degrees = film.angles.iter().map(|angle| angle.degrees());
    let (over, curves) = match film.arguments.phases.plot_over {
        OverName::Wavelength => {
            let names = degrees.map(|deg| format!("{deg}°"));
            (Over::Wavelengths(nm), names.zip(found).collect())
        }
        OverName::Angle => {
            let at = |w: usize| found.iter().map(|at_angle| at_angle[w]).collect();
            let curve = |(w, nm): (usize, &f64)| (format!("{nm} nm"), at(w));
            let curves = nm.iter().enumerate().map(curve).collect();
            (Over::Angles(degrees.collect()), curves)
        }
    };
    Ok(PhasePlot {
        title: film.title(),
        over,
        curves,
        p_sign: film.arguments.phases.p_sign(),
    })
}
