//! Reflectances, and the illuminant under which they are shown.

use exr::meta::header::Header;
use spectra::{
    BandGrid, LightGroup, Observer, SpectralImage, Spectrum, Tabulated, find_illuminant,
    illuminant_names, observer_1931,
};

use crate::spectral_exr::metadata::attribute_text;
use crate::spectral_exr::wavelength::{number, wavelength_nm};
use relight::xyz::equal_energy_luminance;
use relight::{BandWeights, Relight, RelightError, over, relight};

/// The light group of an image of reflectances.
const GROUP: &str = "illuminant";
/// The attribute of the layout: the illuminant's name, or its table as `380nm:50.0;440nm:104.9`.
const ATTRIBUTE: &str = "illuminant";
/// The illuminant of files without a usable one.
const USUAL: &str = "D65";
/// The fewest points of a table that can be recognized as a known illuminant.
const MIN_POINTS: usize = 6;
/// Relative tolerance within which the values of a table are those of a known illuminant, up to a factor.
const SAME: f64 = 2e-3;
/// The most points of a table; longer tables are not used.
const MAX_POINTS: usize = 4096;

/// The light group of the image while it is read: its lamp has a radiance of 1.
pub(super) fn light_groups(grid: &BandGrid) -> Vec<LightGroup> {
    vec![LightGroup {
        name: GROUP.to_owned(),
        lamp: over(grid, &Spectrum::Constant(1.0)).ok(),
    }]
}

/// Applies the illuminant to an image that was read as lit by a radiance of 1; a perfect white keeps the Y of that radiance.
pub(super) fn light(image: &mut SpectralImage, illuminant: Spectrum) -> Result<(), RelightError> {
    let factor = white_factor(image.bands(), &illuminant).unwrap_or(1.0);
    let change = Relight {
        lamp: Some(illuminant),
        factor,
    };
    relight(image, &[(GROUP.to_owned(), change)], Observer::Cie1931Deg2)
}

/// Returns the factor that gives a perfect white over these bands the Y of a radiance of 1.
fn white_factor(grid: &BandGrid, illuminant: &Spectrum) -> Option<f64> {
    let flat = over(grid, &Spectrum::Constant(1.0)).ok()?;
    let lamp = over(grid, illuminant).ok()?;
    let weights = BandWeights::new(grid, &flat, &lamp, Observer::Cie1931Deg2).ok()?;
    let [_, y, _] = weights.xyz(&vec![1.0; grid.count() as usize]);
    let factor = equal_energy_luminance() / y;
    factor.is_finite().then_some(factor)
}

/// Returns the illuminant that a file names or tabulates, otherwise D65, and adds a note on the choice.
pub(super) fn illuminant(header: &Header, grid: &BandGrid, notes: &mut Vec<String>) -> Spectrum {
    let said = attribute_text(&header.shared_attributes, &header.own_attributes, ATTRIBUTE);
    let mut say = |how: &str| notes.push(format!("holds reflectances: {how}"));
    if let Some(said) = &said {
        if let Some((name, spectrum)) = named(said.trim()) {
            say(&format!("they are shown under its illuminant {name}"));
            return spectrum;
        }
        if let Some(table) = table(said) {
            if let Some((name, spectrum)) = recognized(&table) {
                say(&format!(
                    "they are shown under {name}, which its table matches"
                ));
                return spectrum;
            }
            if let Some(spectrum) = normalized(&table, grid) {
                let (from_nm, to_nm) = table.range_nm();
                let rest = if from_nm > 380.0 || to_nm < 780.0 {
                    format!(", which is constant beyond {from_nm} to {to_nm} nm")
                } else {
                    String::new()
                };
                say(&format!(
                    "they are shown under the illuminant of its table{rest}"
                ));
                return spectrum;
            }
        }
    }
    match said {
        None => say("it names no illuminant, so they are shown under D65"),
        Some(said) => {
            let start: String = said.chars().take(40).collect();
            say(&format!(
                "its illuminant {start:?} is not known, so they are shown under D65"
            ));
        }
    }
    find_illuminant(USUAL).map_or(Spectrum::Constant(1.0), |set| set.data)
}

/// Finds an illuminant by its name in any of the spellings `D65`, `d65`, `CIE D65`.
fn named(text: &str) -> Option<(String, Spectrum)> {
    let bare = text.strip_prefix("CIE").unwrap_or(text);
    let bare = bare.trim_start_matches([' ', '-', '_']);
    let same = |name: &&&str| name.eq_ignore_ascii_case(bare);
    let names = illuminant_names();
    let name = names.iter().find(same).map_or(bare, |name| *name);
    let set = find_illuminant(name).ok()?;
    Some((set.name.into_owned(), set.data))
}

/// Parses a table like `380nm:50.0;440nm:104.9`, with wavelengths as in the names of channels.
fn table(text: &str) -> Option<Tabulated> {
    let point = |entry: &str| {
        let (place, value) = entry.split_once(':')?;
        let (nm, value) = (wavelength_nm(place.trim())?, number(value.trim())?);
        (value >= 0.0 && value.is_finite()).then_some((nm, value))
    };
    let entries = text.split(';').filter(|entry| !entry.trim().is_empty());
    let points: Option<Vec<(f64, f64)>> = entries.take(MAX_POINTS + 1).map(point).collect();
    let mut points = points.filter(|points| points.len() <= MAX_POINTS)?;
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    Tabulated::new(points).ok()
}

/// Returns the known illuminant whose values a table has, up to a factor and rounding.
fn recognized(table: &Tabulated) -> Option<(String, Spectrum)> {
    let is_same = |known: &Spectrum| {
        let ratio = |(nm, value): (f64, f64)| Some(value / known.at(nm).ok()?);
        let ratios: Option<Vec<f64>> = table.points().map(ratio).collect();
        let Some(ratios) = ratios.filter(|ratios| ratios.len() >= MIN_POINTS) else {
            return false;
        };
        let (low, high) = ratios
            .iter()
            .fold((f64::INFINITY, 0.0_f64), |(low, high), &ratio| {
                (low.min(ratio), high.max(ratio))
            });
        low > 0.0 && high - low <= 2.0 * SAME * low
    };
    let (from_nm, to_nm) = table.range_nm();
    if from_nm > 420.0 || to_nm < 680.0 {
        return None;
    }
    let mut known = illuminant_names().into_iter().filter_map(named);
    known.find(|(_, spectrum)| is_same(spectrum))
}

/// Returns a table as an illuminant over the bands, scaled to the Y of the constant 1 and constant beyond its ends.
fn normalized(table: &Tabulated, grid: &BandGrid) -> Option<Spectrum> {
    let (low, high) = (grid.min_nm(), grid.max_nm());
    let inner = table.points().filter(|(nm, _)| (low..=high).contains(nm));
    let mut points: Vec<(f64, f64)> = inner.collect();
    for nm in [low, high] {
        if points.iter().all(|point| point.0 != nm) {
            points.push((nm, table.clamped_at(nm)));
        }
    }
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let [_, y_bar, _] = observer_1931();
    let sum = |power: &dyn Fn(f64) -> f64| -> f64 {
        let seen = (380..=780).map(f64::from);
        seen.map(|nm| power(nm) * y_bar.clamped_at(nm)).sum()
    };
    let factor = sum(&|_| 1.0) / sum(&|nm| table.clamped_at(nm));
    let is_light = factor.is_finite() && factor > 0.0;
    let table = Tabulated::new(points).ok().filter(|_| is_light)?;
    Some(Spectrum::Table(table.scaled(factor)))
}
