//! Names of materials as in chemistry and trade.

/// Aliases and the data sets that they stand for, sorted by alias.
pub(super) const ALIASES: [(&str, &str); 44] = [
    ("Ag", "silver"),
    ("Al", "aluminum"),
    ("Al2O3", "alumina"),
    ("Au", "gold"),
    ("BK7", "bk7"),
    ("CaF2", "calcium_fluoride"),
    ("Co", "cobalt"),
    ("Cr", "chromium"),
    ("Cu", "copper"),
    ("Fe", "iron"),
    ("Fe2O3", "hematite"),
    ("Fe3O4", "magnetite"),
    ("Ge", "germanium"),
    ("H2O", "water"),
    ("HfO2", "hafnia"),
    ("ITO", "ito"),
    ("MgF2", "magnesium_fluoride"),
    ("N-BK7", "bk7"),
    ("N-SF11", "sf11"),
    ("NBK7", "bk7"),
    ("NSF11", "sf11"),
    ("Nb", "niobium"),
    ("Nb2O5", "niobia"),
    ("Ni", "nickel"),
    ("PMMA", "pmma"),
    ("PS", "polystyrene"),
    ("Pt", "platinum"),
    ("SF11", "sf11"),
    ("Si", "silicon"),
    ("Si3N4", "silicon_nitride"),
    ("SiO", "silicon_monoxide"),
    ("SiO2", "silica"),
    ("Ta2O5", "tantala"),
    ("Ti", "titanium"),
    ("TiN", "titanium_nitride"),
    ("TiO2", "titania"),
    ("W", "tungsten"),
    ("WO3", "tungsten_trioxide"),
    ("Zn", "zinc"),
    ("ZnO", "zinc_oxide"),
    ("ZnS", "zinc_sulfide"),
    ("ZrO2", "zirconia"),
    ("aluminium", "aluminum"),
    ("sapphire", "alumina"),
];

/// Returns the data set that a name stands for; a name that is not an alias stands for itself.
pub(super) fn resolved(name: &str) -> &str {
    let alias = ALIASES.iter().find(|(alias, _)| *alias == name);
    alias.map_or(name, |&(_, stands_for)| stands_for)
}

/// The aliases of a data set.
pub(super) fn of(name: &str) -> Vec<&'static str> {
    let own = ALIASES.iter().filter(|(_, stands_for)| *stands_for == name);
    own.map(|&(alias, _)| alias).collect()
}
