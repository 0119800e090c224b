//! Indices of refraction: from what is written to n and k over wavelength.

use super::checks::Checks;
use super::points::{self, Column};
use super::spectrum_list::{Advice, extrapolated};
use crate::description::{Extrapolate, Index};
use crate::{FieldPath, limits};
use spectra::{OpticalConstants, Spectrum};
use std::path::Path;

const INDEX_N: Column = Column::new("n", "n", &limits::INDEX_N);
const INDEX_K: Column = Column::new("k", "k", &limits::INDEX_K);

/// n and k over wavelength, and what to do where they do not reach far enough; files are looked for from `directory`.
pub(crate) fn read<'w>(
    checks: &mut Checks,
    directory: &Path,
    field: &FieldPath,
    written: &'w Index,
) -> Option<(OpticalConstants, Advice<'w>)> {
    let ([n, k], advice) = match written {
        Index::Real(n) => {
            let n = checks.number(field, *n, &limits::INDEX_N)?;
            ([n, 0.0].map(Spectrum::Constant), Advice::None)
        }
        Index::Complex([n, k]) => {
            let n = checks.number(&field.index(0), *n, &limits::INDEX_N);
            let k = checks.number(&field.index(1), *k, &limits::INDEX_K);
            ([n?, k?].map(Spectrum::Constant), Advice::None)
        }
        Index::Name(name) => (
            named(checks, field, name, Extrapolate::Error)?,
            Advice::Name(name),
        ),
        Index::Named { name, extrapolate } => (
            named(checks, &field.key("name"), name, *extrapolate)?,
            Advice::Add,
        ),
        Index::Table {
            nm,
            n,
            k,
            extrapolate,
        } => {
            // Without k there are as many zeros as it takes for n alone to be judged.
            let zeros = vec![0.0; nm.len()];
            let k = k.as_deref().unwrap_or(&zeros);
            let columns = [(INDEX_N, n.as_slice()), (INDEX_K, k)];
            let spectra = points::inline(checks, field, nm, columns, *extrapolate)?;
            (spectra, Advice::Add)
        }
        Index::File { csv, extrapolate } => {
            let path = directory.join(csv);
            let columns = [INDEX_N, INDEX_K];
            let spectra = points::file(checks, field, &path, columns, *extrapolate)?;
            (spectra, Advice::Add)
        }
    };
    Some((OpticalConstants { n, k }, advice))
}

fn named(
    checks: &mut Checks,
    field: &FieldPath,
    name: &str,
    extrapolate: Extrapolate,
) -> Option<[Spectrum; 2]> {
    let Some(set) = spectra::optical_constants(name) else {
        checks.unknown_name(
            field,
            ("material with a known index", name),
            &spectra::material_names(),
        );
        return None;
    };
    Some([set.data.n, set.data.k].map(|spectrum| extrapolated(spectrum, extrapolate)))
}
