//! Diffuse reflectances: the 24 patches of the `ColorChecker`.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::DataSet;
use super::table::{Table, TableError, embedded};
use crate::Spectrum;

fn read(table: &Table) -> Result<BTreeMap<&'static str, DataSet<Spectrum>>, TableError> {
    let citation = table.citation()?;
    let set = |name| {
        let data = Spectrum::Table(table.series(name)?);
        let citation = citation.clone();
        Ok((
            name,
            DataSet {
                name: name.into(),
                citation,
                data,
            },
        ))
    };
    table.series_names().into_iter().map(set).collect()
}

fn all() -> &'static BTreeMap<&'static str, DataSet<Spectrum>> {
    static ALL: OnceLock<BTreeMap<&'static str, DataSet<Spectrum>>> = OnceLock::new();
    ALL.get_or_init(|| {
        let text = include_str!("../../data/reflectances/colorchecker.csv");
        embedded("reflectances/colorchecker.csv", text, read)
    })
}

/// Returns a diffuse reflectance by name: a patch of the `ColorChecker` (`"dark_skin"`, `"white_9_5"`), 380 to 780 nm at 5 nm.
///
/// Source: N. Ohta (1997).
pub fn reflectance(name: &str) -> Option<DataSet<Spectrum>> {
    all().get(name).cloned()
}

/// The names that [`reflectance`] accepts, sorted.
pub fn reflectance_names() -> Vec<&'static str> {
    all().keys().copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reflectances_cover_the_visible_range_and_stay_below_one() {
        for name in reflectance_names() {
            let Spectrum::Table(table) = reflectance(name).unwrap().data else {
                panic!("{name} is not a table");
            };
            assert_eq!(table.range_nm(), (380.0, 780.0), "{name}");
            assert!(table.points().all(|(_, r)| r > 0.0 && r < 1.0), "{name}");
        }
    }

    #[test]
    fn patches_have_the_color_of_their_name() {
        let at = |name, nm| reflectance(name).unwrap().data.at(nm).unwrap();
        assert!(at("red", 650.0) > 5.0 * at("red", 500.0));
        assert!(at("green", 530.0) > 2.0 * at("green", 650.0));
        assert!(at("blue", 450.0) > 5.0 * at("blue", 600.0));
        // The white patch is named after its lightness: Munsell value 9.5 is a reflectance of 0.9.
        assert!((at("white_9_5", 560.0) - 0.9).abs() < 0.03);
    }
}
