//! Dielectrics: opaque bodies, and coats over a diffuse base.

use super::checks::Checks;
use super::spectrum_list::SpectrumList;
use crate::description::Index;
use crate::limits::CLEAR_COAT_K;
use document::{FieldPath, Problem, ProblemKind, Shown};
use prepare::RoughCoat;
use scene::{CoatEstimate, CoatedBody, Material, Microsurface, Pattern, SpectrumId};

/// Checks the material at `field` with the index `(n, k)`, written as `index`, and with `base` below it, if any.
pub(super) fn check(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    (field, index): (&FieldPath, &Index),
    ((n, k), microsurface): ((SpectrumId, SpectrumId), Option<Microsurface>),
    base: Option<Pattern>,
) -> Option<Material> {
    let Some(base) = base else {
        return Some(Material::Interface {
            n,
            k,
            layers: Vec::new(),
            microsurface,
        });
    };
    let absorption = spectra.peak(k);
    if absorption > CLEAR_COAT_K {
        let found = (absorption, spectra.mean(n));
        report_absorption(checks, &field.key("index"), index, found);
        return None;
    }
    let (n, k) = spectra.without_absorption(n);
    let (reflectances, transmittance_scale, mean_reflectance) = match &microsurface {
        None => {
            let mean =
                |[n, k]: [f64; 2]| optics::hemispherical_reflectance(optics::Complex64::new(n, k));
            (None, None, spectra.combined([n, k], mean))
        }
        Some(microsurface) => {
            let coat = RoughCoat::new(microsurface, spectra.table(n), spectra.mean(n));
            let first = spectra.run(coat.reflectances);
            (
                Some(first),
                coat.transmittance_scale,
                spectra.run([coat.mean]),
            )
        }
    };
    let base_estimate = match base {
        Pattern::Uniform(only) => spectra.mean(only),
        Pattern::Checker { even, odd, .. } => 0.5 * (spectra.mean(even) + spectra.mean(odd)),
        Pattern::Texture { .. } => 0.5,
    };
    Some(Material::CoatedBody(CoatedBody {
        n,
        k,
        microsurface,
        mean_reflectance,
        reflectances,
        transmittance_scale,
        estimate: CoatEstimate {
            n: spectra.mean(n),
            base: base_estimate,
        },
        base,
    }))
}

fn report_absorption(checks: &mut Checks, field: &FieldPath, index: &Index, (k, n): (f64, f64)) {
    let found = match index {
        Index::Name(name) | Index::Named { name, .. } => {
            format!("{name:?}, whose k reaches {}", digits(k))
        }
        Index::Complex(_) => format!("k = {}", Shown(k)),
        _ => format!("an index whose k reaches {}", digits(k)),
    };
    let message = format!(
        "found {found}; a coat over a base must be clear (k at most {}), since its thickness is not known",
        Shown(CLEAR_COAT_K)
    );
    let help = format!(
        "leave out `base` for an opaque body of this index, or write only the real part, such as index = {n:.3}, for a colorless coat"
    );
    let problem = Problem::new(ProblemKind::Inconsistent, field, message);
    checks.report(problem.help(help));
}

/// A number rounded to two digits.
fn digits(number: f64) -> Shown {
    let rounded = format!("{number:.1e}").parse();
    Shown(rounded.unwrap_or(number))
}
