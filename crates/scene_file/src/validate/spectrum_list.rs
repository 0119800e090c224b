//! Spectra: from names, tables and constants to band tables without duplicates.

use super::checks::Checks;
use super::polarization;
use super::strength::{self, Amount, Radiator};
use crate::description::{
    self, EmissionSpectrum, Extrapolate, Index, Reflectance, WavelengthSampling,
};
use crate::limits;
use document::{FieldPath, Problem, ProblemKind, Shown};
use media::points::{self, Column, FileTable};
use media::{Advice, extrapolated, read_index, read_reflectance};
use scene::{Emission, LightGroupId, SpectrumId};
use spectra::table_file::QuantityKind;
use spectra::{BandGrid, BandTable, OpticalConstants, Spectrum, Tabulated};
use std::collections::HashMap;
use std::path::Path;

/// The spectra of a scene without duplicates.
pub(crate) struct SpectrumList {
    grid: Option<BandGrid>,
    sampling: WavelengthSampling,
    tables: Vec<BandTable>,
    singles: HashMap<Vec<u64>, SpectrumId>,
    pairs: HashMap<Vec<u64>, SpectrumId>,
    lamps: Vec<Lamp>,
}

/// The lamp of an emission.
#[derive(Clone, Debug)]
pub(crate) struct Lamp {
    /// The name of an illuminant, the stem of a file, or the kind of spectrum.
    pub(crate) name: String,
    /// Its spectrum at scale 1.
    pub(crate) spectrum: Tabulated,
    /// Whether it emits any light.
    pub(crate) shines: bool,
}

/// An emission's spectrum, for messages: the noun, and the range of its values.
const EMISSION: Column = Column::new(
    "radiance",
    "values",
    &limits::EMISSION,
    QuantityKind::Amount,
);

impl SpectrumList {
    /// Creates an empty list over `grid`. Without a grid everything is still checked, but no spectra result.
    pub(crate) fn new(grid: Option<BandGrid>, sampling: WavelengthSampling) -> Self {
        Self {
            grid,
            sampling,
            tables: Vec::new(),
            singles: HashMap::new(),
            pairs: HashMap::new(),
            lamps: Vec::new(),
        }
    }

    /// The bands.
    pub(crate) fn grid(&self) -> Option<BandGrid> {
        self.grid
    }

    /// All spectra, indexed by their numbers.
    pub(crate) fn into_tables(self) -> Vec<BandTable> {
        self.tables
    }

    /// The lamps of all emissions, indexed by the numbers that [`Self::emission`] gives in place of their light groups.
    pub(crate) fn lamps(&self) -> &[Lamp] {
        &self.lamps
    }

    /// Whether a spectrum is 0 everywhere.
    pub(crate) fn is_black(&self, id: SpectrumId) -> bool {
        self.tables[id.index()].extent() == (0.0, 0.0)
    }

    /// The largest value of a spectrum.
    pub(crate) fn peak(&self, id: SpectrumId) -> f64 {
        self.tables[id.index()].extent().1
    }

    /// The smallest value of a spectrum.
    pub(crate) fn least(&self, id: SpectrumId) -> f64 {
        self.tables[id.index()].extent().0
    }

    /// The spectrum with this number.
    pub(crate) fn table(&self, id: SpectrumId) -> &BandTable {
        &self.tables[id.index()]
    }

    /// Adds spectra with consecutive numbers, and returns the first number.
    pub(crate) fn run(&mut self, tables: impl IntoIterator<Item = BandTable>) -> SpectrumId {
        let first = SpectrumId::new(self.tables.len());
        self.tables.extend(tables);
        first
    }

    /// The mean of a spectrum over its knots.
    pub(crate) fn mean(&self, id: SpectrumId) -> f64 {
        self.tables[id.index()].mean()
    }

    /// The CIE 1931 color-matching functions on the grid.
    pub(crate) fn observer(&self, checks: &mut Checks) -> Option<[BandTable; 3]> {
        let field = FieldPath::root().key("render").key("wavelengths_nm");
        let [x, y, z] = spectra::observer_1931().clone().map(|table| {
            let curve = Spectrum::Table(table);
            self.resampled(checks, &field, &curve, Advice::None)
        });
        Some([x?, y?, z?])
    }

    /// The number of a reflectance.
    pub(crate) fn reflectance(
        &mut self,
        checks: &mut Checks,
        field: &FieldPath,
        written: &Reflectance,
    ) -> Option<SpectrumId> {
        let (spectrum, advice) =
            read_reflectance(checks, &media::limits::REFLECTANCE, field, written)?;
        let table = self.resampled(checks, field, &spectrum, advice)?;
        Some(self.single(&table, media::limits::REFLECTANCE))
    }

    /// The number of a spectrum computed from two others, knot by knot.
    pub(crate) fn combined(
        &mut self,
        of: [SpectrumId; 2],
        f: impl Fn([f64; 2]) -> f64,
    ) -> SpectrumId {
        let [a, b] = of.map(|id| &self.tables[id.index()]);
        let table = a.combined(b, |a, b| f([a, b]));
        self.single(&table, limits::EMISSION)
    }

    /// The numbers of an index's n and k; the number of k is one more than that of n.
    pub(crate) fn index(
        &mut self,
        checks: &mut Checks,
        field: &FieldPath,
        written: &Index,
    ) -> Option<(SpectrumId, SpectrumId)> {
        let (OpticalConstants { n, k }, advice) = read_index(checks, field, written)?;
        let n = self.resampled(checks, field, &n, advice)?;
        let k = self.resampled(checks, field, &k, advice)?;
        Some(self.pair(&n, &k))
    }

    /// An emission with the number of its spectrum. In place of its light group, which depends on all other emissions, it has the number of
    /// its lamp.
    pub(crate) fn emission(
        &mut self,
        checks: &mut Checks,
        field: &FieldPath,
        written: &description::Emission,
        radiator: Radiator,
    ) -> Option<Emission> {
        let spectrum = emission_spectrum(checks, field, &written.spectrum);
        let name = lamp_name(&written.spectrum);
        let polarization = polarization::check(checks, field, written, radiator);
        let emission = self.emission_of(
            checks,
            field,
            (name, spectrum),
            (&written.strength, radiator),
        );
        Some(Emission {
            polarization: polarization?,
            ..emission?
        })
    }

    /// Like [`Self::emission`], for unpolarized light with a spectrum that is not written in the file, with the name of its lamp.
    pub(crate) fn emission_of(
        &mut self,
        checks: &mut Checks,
        field: &FieldPath,
        (name, spectrum): (String, Option<Spectrum>),
        (strength, radiator): (&description::Strength, Radiator),
    ) -> Option<Emission> {
        let amount = strength::check(checks, field, strength, radiator);
        let spectrum = spectrum?;
        let table = self.resampled(checks, field, &spectrum, Advice::Add)?;
        let (amount, grid) = (amount?, self.grid?);
        let scale = amount.scale(checks, &table, (&grid, self.sampling))?;
        let peak = table.extent().1;
        // The radiance of an emitter by power depends on the object.
        let is_by_area = radiator == Radiator::Emitter && amount.unit.starts_with("power");
        if !is_by_area {
            check_brightness(checks, (field, &amount), radiator, peak * scale)?;
        }
        let light_group = LightGroupId::new(self.lamps.len());
        self.lamps.push(Lamp {
            name,
            spectrum: grid.lamp(&spectrum)?,
            shines: scale > 0.0 && peak > 0.0,
        });
        Some(Emission {
            spectrum: self.single(&table, limits::EMISSION),
            scale,
            light_group,
            polarization: None,
        })
    }

    /// The numbers of an index with the same n and k = 0.
    pub(crate) fn without_absorption(&mut self, n: SpectrumId) -> (SpectrumId, SpectrumId) {
        let n = self.tables[n.index()].clone();
        let k = n.map(|_| 0.0);
        self.pair(&n, &k)
    }

    fn resampled(
        &self,
        checks: &mut Checks,
        field: &FieldPath,
        spectrum: &Spectrum,
        advice: Advice<'_>,
    ) -> Option<BandTable> {
        let grid = self.grid?;
        let error = match BandTable::new(&grid, spectrum) {
            Ok(table) => return Some(table),
            Err(error) => error,
        };
        let bands = format!("the bands cover {} to {} nm", grid.min_nm(), grid.max_nm());
        let message = if let Some(fault) = &error.fault {
            format!("{fault}, and {bands}")
        } else {
            let (low, high) = (error.min_nm, error.max_nm);
            format!("the data cover {low} to {high} nm, but {bands}")
        };
        let mut problem = Problem::new(ProblemKind::Inconsistent, field, message)
            .involving(FieldPath::root().key("render").key("wavelengths_nm"));
        problem.help = match error.fault {
            Some(_) => Some("correct the data, or narrow `render.wavelengths_nm`".to_owned()),
            None => advice_text(advice),
        };
        checks.report(problem);
        None
    }

    fn single(&mut self, table: &BandTable, range: document::Range) -> SpectrumId {
        let table = kept_within(table, range);
        let key = bits(&table);
        let next = SpectrumId::new(self.tables.len());
        let id = *self.singles.entry(key).or_insert(next);
        if id == next {
            self.tables.push(table);
        }
        id
    }

    fn pair(&mut self, n: &BandTable, k: &BandTable) -> (SpectrumId, SpectrumId) {
        let n = kept_within(n, media::limits::INDEX_N);
        let k = kept_within(k, media::limits::INDEX_K);
        let mut key = bits(&n);
        key.extend(bits(&k));
        let next = SpectrumId::new(self.tables.len());
        let id = *self.pairs.entry(key).or_insert(next);
        if id == next {
            self.tables.extend([n, k]);
        }
        (id, id.after(1))
    }
}

fn named_illuminant(
    checks: &mut Checks,
    field: &FieldPath,
    name: &str,
    extrapolate: Extrapolate,
) -> Option<Spectrum> {
    match spectra::find_illuminant(name) {
        Ok(set) => Some(extrapolated(set.data, extrapolate)),
        Err(error) => {
            let mut problem = Problem::new(ProblemKind::UnknownName, field, error.to_string());
            let ending = Path::new(name)
                .extension()
                .and_then(|ending| ending.to_str());
            if ending.is_some_and(|ending| ending.starts_with(|c: char| c.is_ascii_alphabetic())) {
                problem = problem.help(format!("for a file, write {{ csv = {name:?} }}"));
            }
            checks.report(problem);
            None
        }
    }
}

fn lamp_name(written: &EmissionSpectrum) -> String {
    match written {
        EmissionSpectrum::Constant { .. } => "constant".to_owned(),
        EmissionSpectrum::Illuminant { illuminant, .. } => illuminant.clone(),
        EmissionSpectrum::Table { .. } => "table".to_owned(),
        EmissionSpectrum::File { csv, .. } => {
            let stem = csv.file_stem().unwrap_or_default();
            stem.to_string_lossy().into_owned()
        }
    }
}

/// What a user can do about data that do not cover the bands.
fn advice_text(advice: Advice<'_>) -> Option<String> {
    let clamp = match advice {
        Advice::None => return None,
        Advice::Part => {
            "add `extrapolate = \"clamp\"` to the part of the mixture that ends there".to_owned()
        }
        Advice::Add => "add `extrapolate = \"clamp\"`".to_owned(),
        Advice::Name(name) => format!("write {{ name = {name:?}, extrapolate = \"clamp\" }}"),
    };
    Some(format!(
        "{clamp} to continue with its end values, or narrow `render.wavelengths_nm`"
    ))
}

/// Checks the peak of an emission of this amount.
fn check_brightness(
    checks: &mut Checks,
    (field, amount): (&FieldPath, &Amount),
    radiator: Radiator,
    found: f64,
) -> Option<()> {
    let most = limits::EMISSION.high;
    if limits::EMISSION.contains(found) {
        return Some(());
    }
    let (quantity, unit) = radiator.quantity();
    let message = format!(
        "found {}, which gives {quantity} of {found:.3e} {unit} at the spectrum's peak; at most {} is possible, which is `{}` = {:.3e}",
        Shown(amount.value),
        Shown(most),
        amount.unit,
        amount.value * (most / found),
    );
    let mut problem = Problem::new(ProblemKind::OutOfRange, &amount.field, message);
    let falls_from_small_disk = !matches!(amount.unit, "radiance" | "luminance_cd_m2");
    if matches!(radiator, Radiator::Distant(solid) if solid > 0.0) && falls_from_small_disk {
        let help =
            "a larger `diameter_deg` allows more, and so does 0, light from a single direction";
        problem = problem.help(help);
    }
    checks.report(problem.involving(field.clone()));
    None
}

/// Clamps a table to `range`, which interpolation between two values within it may leave by rounding.
fn kept_within(table: &BandTable, range: document::Range) -> BandTable {
    table.map(|value| value.clamp(range.low, range.high))
}

fn bits(table: &BandTable) -> Vec<u64> {
    let rows = (0..=table.steps()).flat_map(|step| table.row(step));
    rows.map(|value| value.to_bits()).collect()
}

/// The spectrum of an emission at scale 1.
fn emission_spectrum(
    checks: &mut Checks,
    field: &FieldPath,
    written: &EmissionSpectrum,
) -> Option<Spectrum> {
    match written {
        EmissionSpectrum::Constant { constant } => {
            let constant = checks.number(&field.key("constant"), *constant, &limits::EMISSION);
            constant.map(Spectrum::Constant)
        }
        EmissionSpectrum::Illuminant {
            illuminant,
            extrapolate,
        } => named_illuminant(checks, &field.key("illuminant"), illuminant, *extrapolate),
        EmissionSpectrum::Table {
            nm,
            values,
            extrapolate,
        } => {
            let columns = [(EMISSION, values.as_slice())];
            let [spectrum] = points::inline(checks, field, nm, columns, *extrapolate)?;
            Some(spectrum)
        }
        EmissionSpectrum::File {
            csv,
            column,
            unit,
            extrapolate,
        } => {
            let table = FileTable {
                path: &checks.path(&field.key("csv"), csv)?,
                columns: points::chosen(column.as_ref()),
                unit: unit.as_deref(),
                extrapolate: *extrapolate,
            };
            let [spectrum] = points::file(checks, field, table, [EMISSION])?;
            Some(spectrum)
        }
    }
}
