//! Optical constants of materials.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::table::{Table, TableError, embedded};
use super::{DataSet, aliases};
use crate::{DispersionFormula, FormulaKind, OpticalConstants, Spectrum};

/// A material's name and the text of its file.
macro_rules! material {
    ($name:literal) => {
        (
            $name,
            include_str!(concat!("../../data/materials/", $name, ".csv")),
        )
    };
}

const FILES: [(&str, &str); 69] = [
    material!("air"),
    material!("alumina"),
    material!("alumina_film"),
    material!("aluminum"),
    material!("aluminum_cheng"),
    material!("aluminum_mcpeak"),
    material!("anatase"),
    material!("bk7"),
    material!("brass"),
    material!("calcium_fluoride"),
    material!("chromium"),
    material!("chromium_sytchkova"),
    material!("cobalt"),
    material!("copper"),
    material!("copper_mcpeak"),
    material!("copper_querry"),
    material!("diamond"),
    material!("ethanol"),
    material!("germanium"),
    material!("glycerol"),
    material!("gold"),
    material!("gold_mcpeak"),
    material!("gold_olmon"),
    material!("gold_silver"),
    material!("hafnia"),
    material!("hematite"),
    material!("iron"),
    material!("ito"),
    material!("ito_minenkov"),
    material!("magnesium_fluoride"),
    material!("magnesium_fluoride_film"),
    material!("magnetite"),
    material!("nickel"),
    material!("niobia"),
    material!("niobium"),
    material!("platinum"),
    material!("pmma"),
    material!("polystyrene"),
    material!("polystyrene_sultanova"),
    material!("rutile"),
    material!("sf11"),
    material!("silica"),
    material!("silica_film"),
    material!("silicon"),
    material!("silicon_aspnes"),
    material!("silicon_monoxide"),
    material!("silicon_nitride"),
    material!("silicon_nitride_film"),
    material!("silicon_schinke"),
    material!("silver"),
    material!("silver_mcpeak"),
    material!("soda_lime"),
    material!("tantala"),
    material!("tantala_evaporated"),
    material!("titania"),
    material!("titania_amorphous"),
    material!("titania_sarkar"),
    material!("titania_zhukovsky"),
    material!("titanium"),
    material!("titanium_nitride"),
    material!("titanium_palm"),
    material!("tungsten"),
    material!("tungsten_trioxide"),
    material!("water"),
    material!("water_hale"),
    material!("zinc"),
    material!("zinc_oxide"),
    material!("zinc_sulfide"),
    material!("zirconia"),
];

/// Information about a material's data: source, license, range.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialInfo {
    /// The name that scenes use, such as `gold`.
    pub name: &'static str,
    /// Other names of the material, such as `Au`.
    pub aliases: Vec<&'static str>,
    /// What was measured, in a few words.
    pub material: &'static str,
    /// The name of the data set in the refractiveindex.info database, such as `Au-Johnson`.
    pub data_set: &'static str,
    /// Authors and year.
    pub paper: &'static str,
    /// The publication in full.
    pub citation: &'static str,
    /// The license of the data.
    pub license: &'static str,
    /// What a user of the data should know.
    pub notes: &'static str,
    /// First and last wavelength where both n and k have a value, nm.
    pub range_nm: (f64, f64),
}

/// A material's data and the information about them.
struct Entry {
    info: MaterialInfo,
    set: DataSet<OpticalConstants>,
}

/// Reads the dispersion formula of a file, if it has one.
fn formula(table: &Table) -> Result<Option<DispersionFormula>, TableError> {
    let Ok(number) = table.head("formula") else {
        return Ok(None);
    };
    let kind = number.parse().ok().and_then(FormulaKind::from_number);
    let kind = kind.ok_or(TableError::Value {
        key: "formula",
        value: number,
    })?;
    let range = table.head("range_nm")?;
    let ends = range.split_once(" to ");
    let ends = ends.and_then(|(low, high)| Some((low.parse().ok()?, high.parse().ok()?)));
    let ends = ends.ok_or(TableError::Value {
        key: "range_nm",
        value: range,
    })?;
    Ok(Some(DispersionFormula::new(
        kind,
        table.column("coefficient"),
        ends,
    )?))
}

/// Reads n from a formula or table, and k from a table, or 0 if the source has none.
fn read(table: &Table) -> Result<OpticalConstants, TableError> {
    let n = match formula(table)? {
        Some(formula) => Spectrum::Formula(formula),
        None => Spectrum::Table(table.series("n")?),
    };
    let k = match table.series("k") {
        Ok(k) => Spectrum::Table(k),
        Err(TableError::MissingColumns(_)) => Spectrum::Constant(0.0),
        Err(other) => return Err(other),
    };
    Ok(OpticalConstants { n, k })
}

fn entry(name: &'static str, table: &Table) -> Result<Entry, TableError> {
    let data = read(table)?;
    let info = MaterialInfo {
        name,
        aliases: aliases::of(name),
        material: table.head("material")?,
        data_set: table.head("name")?,
        paper: table.head("paper")?,
        citation: table.head("citation")?,
        license: table.head("license")?,
        notes: table.head("notes")?,
        range_nm: data.range_nm().unwrap_or((0.0, f64::INFINITY)),
    };
    let citation = table.citation()?;
    let set = DataSet {
        name: name.into(),
        citation,
        data,
    };
    Ok(Entry { info, set })
}

/// Finds a material by name; its file is parsed on first use.
fn find(name: &str) -> Option<&'static Entry> {
    static ALL: OnceLock<BTreeMap<&'static str, (&'static str, OnceLock<Entry>)>> = OnceLock::new();
    let all = ALL.get_or_init(|| {
        let unread = |(name, text)| (name, (text, OnceLock::new()));
        FILES.into_iter().map(unread).collect()
    });
    let (&name, (text, read)) = all.get_key_value(aliases::resolved(name))?;
    Some(read.get_or_init(|| embedded(name, text, |table| entry(name, table))))
}

/// Returns optical constants by name (`"gold"`, `"water"`); [`material_info`] gives their source.
///
/// | kind | names |
/// | --- | --- |
/// | metals | `aluminum`, `brass`, `chromium`, `cobalt`, `copper`, `gold`, `gold_silver`, `iron`, `nickel`, `niobium`, `platinum`, `silver`, `titanium`, `tungsten`, `zinc` |
/// | oxides | `alumina`, `anatase`, `hafnia`, `hematite`, `magnetite`, `niobia`, `rutile`, `silica`, `silicon_monoxide`, `tantala`, `titania`, `tungsten_trioxide`, `zinc_oxide`, `zirconia` |
/// | nitrides | `silicon_nitride`, `titanium_nitride` |
/// | fluorides | `calcium_fluoride`, `magnesium_fluoride` |
/// | glasses | `bk7`, `sf11`, `soda_lime` |
/// | semiconductors | `germanium`, `ito`, `silicon`, `zinc_sulfide` |
/// | liquids | `ethanol`, `glycerol`, `water` |
/// | polymers | `pmma`, `polystyrene` |
/// | others | `air`, `diamond` |
///
/// Chemical formulas and trade names are also accepted, in their usual case: `Au`, `SiO2`, `ITO`, `N-BK7`; see
/// [`material_aliases`].
///
/// A name with a suffix (`gold_olmon`, `copper_mcpeak`, `silica_film`) is another data set for the same material. The choice
/// of data set changes a metal's color more than any numerical error: name it with a result.
///
/// Tables are linear between their points, separately for n and k; formulas are evaluated at the exact wavelength.
/// Outside its range, a material has no value; some ranges begin within the visible range (`polystyrene` at 400 nm).
pub fn optical_constants(name: &str) -> Option<DataSet<OpticalConstants>> {
    find(name).map(|entry| entry.set.clone())
}

/// Returns the source and range of the optical constants with this name.
pub fn material_info(name: &str) -> Option<MaterialInfo> {
    find(name).map(|entry| entry.info.clone())
}

/// The names of the data sets that [`optical_constants`] knows, sorted.
pub fn material_names() -> Vec<&'static str> {
    FILES.iter().map(|&(name, _)| name).collect()
}

/// Aliases that [`optical_constants`] accepts, sorted, each with the data set that it stands for: `Au` is `gold`.
pub fn material_aliases() -> &'static [(&'static str, &'static str)] {
    &aliases::ALIASES
}

/// Returns all data sets of the substance that this name stands for, beginning with the name's own: `TiO2` has `titania`,
/// `anatase`, `rutile` and more. Empty if the name is unknown.
pub fn material_sets(name: &str) -> Vec<&'static str> {
    let name = aliases::resolved(name);
    let Some(&(own, text)) = FILES.iter().find(|(known, _)| *known == name) else {
        return Vec::new();
    };
    let others = FILES.iter().filter(|(known, other)| {
        *known != own && substance(other).is_some() && substance(other) == substance(text)
    });
    std::iter::once(own)
        .chain(others.map(|&(known, _)| known))
        .collect()
}

/// Returns the database's name for the substance of a file: `TiO2` for `TiO2-Siefke`.
fn substance(text: &str) -> Option<&str> {
    let data_set = text
        .lines()
        .find_map(|line| line.strip_prefix("# name: "))?;
    data_set.split('-').next()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn index(name: &str, nm: f64) -> (f64, f64) {
        let data = optical_constants(name).unwrap().data;
        (data.n.at(nm).unwrap(), data.k.at(nm).unwrap())
    }

    #[test]
    fn the_range_stated_is_the_range_read() {
        for name in material_names() {
            let (low, high) = material_info(name).unwrap().range_nm;
            let data = optical_constants(name).unwrap().data;
            assert!(low >= 182.0 && high <= 9700.0, "{name}: {low} to {high}");
            let steps = 1000;
            for step in 0..=steps {
                let nm = low + (high - low) * f64::from(step) / f64::from(steps);
                let (n, k) = index(name, nm);
                assert!(n > 0.0 && k >= 0.0, "{name} at {nm} nm: {n} + {k}i");
            }
            assert!(
                data.at(low - 0.01).is_err() && data.at(high + 0.01).is_err(),
                "{name}"
            );
        }
    }

    #[test]
    fn what_begins_within_the_default_range_is_known() {
        let short = |name: &&str| {
            let (low, high) = material_info(name).unwrap().range_nm;
            low > 380.0 || high < 780.0
        };
        let found: Vec<_> = material_names().into_iter().filter(short).collect();
        let known = [
            "ethanol",
            "glycerol",
            "pmma",
            "polystyrene",
            "polystyrene_sultanova",
            "rutile",
            "zinc_sulfide",
        ];
        assert_eq!(found, known);
    }

    #[test]
    fn every_material_says_where_it_comes_from() {
        for name in material_names() {
            let info = material_info(name).unwrap();
            let year = |text: &str| text.contains("19") || text.contains("20");
            assert!(year(info.paper) && year(info.citation), "{info:?}");
            assert!(info.license.starts_with("CC0 1.0"), "{info:?}");
            assert!(
                !info.material.is_empty() && !info.data_set.is_empty(),
                "{info:?}"
            );
        }
        assert_eq!(material_info("unobtainium"), None);
    }

    #[test]
    fn aliases_are_the_substances_of_their_sets() {
        let aliases = material_aliases();
        assert!(aliases.windows(2).all(|pair| pair[0].0 < pair[1].0));
        for &(alias, name) in aliases {
            assert!(!material_names().contains(&alias), "{alias}");
            let info = material_info(alias).unwrap();
            assert_eq!(info.name, name);
            assert!(info.aliases.contains(&alias));
            assert_eq!(optical_constants(alias), optical_constants(name));
            // The database's name of the substance equals the alias, except for names in words and of glasses.
            let head = info.data_set.split('-').next().unwrap();
            let written = alias.replace("N-", "N");
            let in_words = ["aluminium", "sapphire", "PS", "BK7", "SF11"].contains(&alias);
            assert!(in_words || written == head, "{alias}: {head}");
        }
        for stranger in ["au", "AU", "sio2", "SIO2", "Hg", "", "N-BK10"] {
            assert_eq!(optical_constants(stranger), None, "{stranger}");
        }
    }

    #[test]
    fn the_sets_of_a_substance_are_those_of_its_formula() {
        let titania = [
            "titania",
            "anatase",
            "rutile",
            "titania_amorphous",
            "titania_sarkar",
            "titania_zhukovsky",
        ];
        assert_eq!(material_sets("TiO2"), titania);
        assert_eq!(material_sets("silica_film"), ["silica_film", "silica"]);
        assert_eq!(material_sets("Ge"), ["germanium"]);
        assert_eq!(material_sets("ge"), [""; 0]);
    }

    #[test]
    fn formulas_give_the_published_indices() {
        // Water at 20 °C and the sodium D line: Daimon and Masumura (2007).
        assert!((index("water", 589.3).0 - 1.33335).abs() < 1e-5);
        // Fused silica at the d line, 587.5618 nm: Malitson (1965), table 1 (1.45846).
        assert!((index("silica", 587.5618).0 - 1.45846).abs() < 1e-5);
        // N-BK7: n_d = 1.51680, n_F = 1.52238, n_C = 1.51432 (SCHOTT data sheet 517642.251).
        assert!((index("bk7", 587.5618).0 - 1.51680).abs() < 1e-5);
        assert!((index("bk7", 486.1327).0 - 1.52238).abs() < 1e-5);
        assert!((index("bk7", 656.2725).0 - 1.51432).abs() < 1e-5);
    }

    #[test]
    fn gold_is_the_published_table() {
        // Johnson and Christy (1972), table I: 0.43 + 2.455i at 2.26 eV, which is 548.6 nm.
        assert_eq!(index("gold", 548.6), (0.43, 2.455));
        let (n, k) = index("gold", 550.0);
        assert!(
            (n - 0.4237).abs() < 5e-4 && (k - 2.4721).abs() < 5e-4,
            "{n} {k}"
        );
    }
}
