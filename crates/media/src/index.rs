//! Indices of refraction: from the description to n and k over wavelength.

use crate::database;
use crate::description::{Extrapolate, Index, MixtureRule, Reflectance};
use crate::formula;
use crate::limits;
use crate::points::{self, Column, FileTable};
use crate::reflectance::read_reflectance;
use crate::{Advice, extrapolated};
use document::{Checks, FieldPath, Folder, Problem, ProblemKind, Problems};
use spectra::table_file::QuantityKind;
use spectra::{DispersionFormula, OpticalConstants, Spectrum, Tabulated};

const INDEX_N: Column = Column::new("n", "n", &limits::INDEX_N, QuantityKind::Plain);
const INDEX_K: Column = Column::new("k", "k", &limits::INDEX_K, QuantityKind::Plain);

/// Returns the optical constants of `index`, and the assumptions about its files, one line each. Paths of files are relative to `folder`,
/// and the files must be in it.
///
/// The wavelengths of interest are not known here: reading a table outside its range fails later.
///
/// ```
/// use pellicle_media::{Index, optical_constants};
/// let gold = Index::Name("gold".to_owned());
/// let (constants, _) = optical_constants(&gold, "").unwrap();
/// assert!(constants.k.at(600.0).unwrap() > 2.0);
/// assert!(constants.k.at(1e5).is_err());
/// ```
///
/// # Errors
/// All problems of the index, and of the file that it names. The fields of the problems start at the index: `n[2]` is the third value of
/// its table.
pub fn optical_constants(
    index: &Index,
    folder: impl Into<Folder>,
) -> Result<(OpticalConstants, Vec<String>), Problems> {
    let mut checks = Checks::new(&folder.into());
    let constants = read_index(&mut checks, &FieldPath::root(), index);
    checks
        .finish(constants.map(|(constants, _)| constants))
        .map_err(|list| Problems::of_program("the index", list))
}

/// n and k over wavelength, and advice for the case that they do not cover the bands.
pub fn read_index<'w>(
    checks: &mut Checks,
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
            // A missing k is replaced by as many zeros as there are wavelengths, so that only n is checked.
            let zeros = vec![0.0; nm.len()];
            let k = k.as_deref().unwrap_or(&zeros);
            let columns = [(INDEX_N, n.as_slice()), (INDEX_K, k)];
            let spectra = points::inline(checks, field, nm, columns, *extrapolate)?;
            (spectra, Advice::Add)
        }
        Index::File {
            csv,
            column,
            unit,
            extrapolate,
        } => {
            let table = FileTable {
                path: &checks.path(&field.key("csv"), csv)?,
                columns: points::chosen_of_index(column.as_ref()),
                unit: unit.as_deref(),
                extrapolate: *extrapolate,
            };
            let spectra = points::file(checks, field, table, [INDEX_N, INDEX_K])?;
            (spectra, Advice::Add)
        }
        Index::Database { yaml, extrapolate } => {
            let field = field.key("yaml");
            let path = checks.path(&field, yaml)?;
            let spectra = database::read(checks, &field, &path)?;
            let spectra = spectra.map(|spectrum| extrapolated(spectrum, *extrapolate));
            (spectra, Advice::Add)
        }
        Index::Cauchy {
            cauchy,
            extrapolate,
        } => {
            let formula = formula::cauchy(checks, &field.key("cauchy"), cauchy)?;
            (transparent(formula, *extrapolate), Advice::Add)
        }
        Index::Sellmeier {
            sellmeier,
            extrapolate,
        } => {
            let formula = formula::sellmeier(checks, &field.key("sellmeier"), sellmeier)?;
            (transparent(formula, *extrapolate), Advice::Add)
        }
        Index::Reflecting { normal_reflectance } => {
            let field = field.key("normal_reflectance");
            reflecting(checks, &field, normal_reflectance)?
        }
        Index::Mixture {
            mixture: rule,
            of,
            fraction,
        } => {
            let OpticalConstants { n, k } = mixture(checks, field, (*rule, of, *fraction))?;
            ([n, k], Advice::Part)
        }
    };
    Some((OpticalConstants { n, k }, advice))
}

fn transparent(formula: DispersionFormula, extrapolate: Extrapolate) -> [Spectrum; 2] {
    let n = extrapolated(Spectrum::Formula(formula), extrapolate);
    [n, Spectrum::Constant(0.0)]
}

/// The real index with a given reflectance at normal incidence.
fn reflecting<'w>(
    checks: &mut Checks,
    field: &FieldPath,
    written: &'w Reflectance,
) -> Option<([Spectrum; 2], Advice<'w>)> {
    if let Reflectance::Name(name) | Reflectance::Named { name, .. } = written
        && spectra::reflectance(name).is_none()
        && spectra::optical_constants(name).is_some()
    {
        let message = format!("found {name:?}, the name of an index; it must be a reflectance");
        let problem = Problem::new(ProblemKind::UnknownName, field, message);
        checks.report(problem.help(format!("write index = {name:?} for its exact index")));
        return None;
    }
    let range = &limits::NORMAL_REFLECTANCE;
    let (reflectance, advice) = read_reflectance(checks, range, field, written)?;
    let points = points_of(&reflectance);
    if let Some((nm, value)) = points.iter().find(|(_, value)| !range.contains(*value)) {
        // Numbers are already checked where they are written: this is a name or a color.
        let message = format!("found {value:.4} at {nm} nm; it must be from {range}");
        checks.report(Problem::new(ProblemKind::OutOfRange, field, message));
        return None;
    }
    let index = |(nm, value)| (nm, optics::index_from_normal_reflectance(value));
    let n = match &reflectance {
        Spectrum::Constant(value) => {
            Spectrum::Constant(optics::index_from_normal_reflectance(*value))
        }
        other => {
            // The wavelengths of `finely` increase like those of its table.
            let table = Tabulated::new(finely(&points).map(index).collect()).ok()?;
            match other {
                Spectrum::ClampedTable(_) => Spectrum::ClampedTable(table),
                _ => Spectrum::Table(table),
            }
        }
    };
    Some(([n, Spectrum::Constant(0.0)], advice))
}

/// The points of a table; a constant as one point.
fn points_of(spectrum: &Spectrum) -> Vec<(f64, f64)> {
    match spectrum {
        Spectrum::Constant(value) => vec![(0.0, *value)],
        Spectrum::Table(table) | Spectrum::ClampedTable(table) => table.points().collect(),
        Spectrum::Formula(_) | Spectrum::ClampedFormula(_) => Vec::new(),
    }
}

/// The same piecewise linear curve through more points, at most a nanometer apart unless an interval is very long: where the reflectance is
/// linear, the index is curved.
fn finely(points: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> {
    const MAX: f64 = 1000.0;
    let between = points.windows(2).flat_map(|ends| {
        let [(nm, value), (next_nm, next)] = [ends[0], ends[1]];
        let parts = (next_nm - nm).ceil().clamp(1.0, MAX);
        (0..parts as u32).map(move |part| {
            let t = f64::from(part) / parts;
            (nm + t * (next_nm - nm), value + t * (next - value))
        })
    });
    between.chain(points.last().copied())
}

fn mixture(
    checks: &mut Checks,
    field: &FieldPath,
    (rule, of, fraction): (MixtureRule, &[Index; 2], f64),
) -> Option<OpticalConstants> {
    let rule = match rule {
        MixtureRule::Bruggeman => spectra::MixtureRule::Bruggeman,
        MixtureRule::MaxwellGarnett => spectra::MixtureRule::MaxwellGarnett,
    };
    let parts = field.key("of");
    let a = read_index(checks, &parts.index(0), &of[0]);
    let b = read_index(checks, &parts.index(1), &of[1]);
    let fraction = checks.number(&field.key("fraction"), fraction, &limits::FRACTION);
    let ((a, _), (b, _), fraction) = (a?, b?, fraction?);
    let mixture = OpticalConstants::mixture(rule, [&a, &b], fraction);
    mixture
        .map_err(|error| {
            let problem = Problem::new(ProblemKind::Inconsistent, &parts, error.to_string());
            checks.report(problem);
        })
        .ok()
}

fn named(
    checks: &mut Checks,
    field: &FieldPath,
    name: &str,
    extrapolate: Extrapolate,
) -> Option<[Spectrum; 2]> {
    let Some(set) = spectra::optical_constants(name) else {
        let aliases = spectra::material_aliases().iter().map(|&(alias, _)| alias);
        let known: Vec<&str> = spectra::material_names()
            .into_iter()
            .chain(aliases)
            .collect();
        checks.unknown_name(field, ("material with a known index", name), &known);
        return None;
    };
    if name != set.name
        && let [taken, others @ ..] = spectra::material_sets(name).as_slice()
        && !others.is_empty()
    {
        let paper = spectra::material_info(taken).map_or("", |info| info.paper);
        let others = others.join(", ");
        let note = format!("{name} is taken as {taken} ({paper}); there are also {others}");
        checks.note(field, note);
    }
    Some([set.data.n, set.data.k].map(|spectrum| extrapolated(spectrum, extrapolate)))
}
