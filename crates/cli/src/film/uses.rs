//! What the options of `pellicle film` affect.

use super::model::ModelName;
use super::{Arguments, BackendName, Format};
use miette::miette;

impl Arguments {
    /// Whether R and T are printed: if they are requested, or nothing else is.
    pub(super) fn prints_spectra(&self) -> bool {
        let reports = self.wanted.is_some() || self.tolerance.is_some() || self.sensitivity;
        let pictures = self.plot.is_some() || self.chart.is_some();
        self.format.is_some() || !(reports || pictures)
    }

    /// The shortest and the longest wavelength at which the data of the stack are read, nm.
    pub(super) fn used_nm(&self) -> (f64, f64) {
        let asked = self.wavelengths.iter().flat_map(|list| list.0.iter());
        let design = self.sensitivity.then_some(&self.design);
        let visible = match self.wavelengths {
            Some(_) if self.shows_no_color() => &[][..],
            _ => &[380.0, 780.0],
        };
        let used = asked.chain(design).chain(visible);
        used.fold((f64::INFINITY, 0.0), |(low, high), &nm| {
            (nm.min(low), nm.max(high))
        })
    }

    /// Whether no output has a color: CSV has none, and neither has a plot of phases.
    pub(super) fn shows_no_color(&self) -> bool {
        let plots_colors = self.plot.is_some() && !self.phases.phase;
        let prints_colors = self.prints_spectra() && self.format != Some(Format::Csv);
        let reports = self.wanted.is_some() || self.tolerance.is_some() || self.sensitivity;
        !(prints_colors || plots_colors || self.chart.is_some() || reports)
    }

    /// Returns an error if an option has no effect.
    pub(super) fn check_uses(&self) -> miette::Result<()> {
        let spectra = self.prints_spectra();
        let spectra_or_plot = spectra || self.plot.is_some();
        let is_exact = self.model == ModelName::Exact;
        let uses = [
            (
                "--backend gpu",
                self.backend == BackendName::Gpu && !spectra_or_plot,
                "R and T, printed or with --plot; the rest is computed on the CPU",
            ),
            (
                "--backend gpu",
                self.backend == BackendName::Gpu && !is_exact,
                "the exact model; two beams are computed on the CPU",
            ),
            (
                "--backend gpu",
                self.backend == BackendName::Gpu && self.phases.phase && !spectra,
                "R and T; ψ and Δ are computed on the CPU",
            ),
            (
                "--phase",
                self.phases.phase && !is_exact,
                "the exact model; of two beams, `film` computes powers alone",
            ),
            (
                "--phase",
                self.phases.phase && !spectra_or_plot,
                "printed R and T, and --plot; add --format table or --plot",
            ),
            (
                "--absorptance",
                self.absorptance && !is_exact,
                "the exact model; two beams have no absorptance, as their R + T is not 1",
            ),
            (
                "--wavelengths",
                self.wavelengths.is_some() && !spectra_or_plot,
                "R and T, printed or with --plot; colors are sums from 380 to 780 nm",
            ),
            (
                "--absorptance",
                self.absorptance && !spectra,
                "printed R and T; add --format table",
            ),
            (
                "--vary",
                self.vary.is_some() && self.wanted.is_none() && self.chart.is_none(),
                "--match and --chart",
            ),
        ];
        match uses.into_iter().find(|(_, is_unused, _)| *is_unused) {
            Some((option, _, purpose)) => {
                Err(miette!("{option} has no effect here: it is for {purpose}"))
            }
            None => Ok(()),
        }
    }
}
