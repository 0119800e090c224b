//! The built-in data sets, by name.
//!
//! The files are in `data/`, next to this crate's `src/`, each with its source and license in the
//! header; see [`table`] for the format. They are compiled into the program: nothing is read at run time.

use std::borrow::Cow;

mod aliases;
mod illuminant_error;
mod illuminants;
mod materials;
mod observer;
mod radiators;
mod reflectances;
mod table;

pub use illuminant_error::IlluminantError;
pub use illuminants::{find_illuminant, illuminant, illuminant_names, is_line_lamp};
pub use materials::{
    MaterialInfo, material_aliases, material_info, material_names, material_sets, optical_constants,
};
pub use observer::{Observer, UnknownObserver, observer_1931};
pub use radiators::black_body;
pub(crate) use radiators::components as daylight_components;
pub use reflectances::{reflectance, reflectance_names};

/// Maximum luminous efficacy of radiation, lm/W (CIE 018:2019; 683 as the CIE rounds 683.002).
pub const KM_LUMENS_PER_WATT: f64 = 683.0;

/// A named spectrum with its source.
#[derive(Clone, Debug, PartialEq)]
pub struct DataSet<T> {
    /// The name that scenes use.
    pub name: Cow<'static, str>,
    /// The publication that the data come from, and the license if one applies.
    pub citation: String,
    /// The data.
    pub data: T,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the data sets of one kind: names are sorted and unique, and each set is found by name and has a source.
    fn check_kind<T>(names: &[&'static str], get: impl Fn(&str) -> Option<DataSet<T>>) {
        assert!(!names.is_empty());
        assert!(names.windows(2).all(|pair| pair[0] < pair[1]), "{names:?}");
        for &name in names {
            let set = get(name).unwrap_or_else(|| panic!("{name} is listed but not found"));
            assert_eq!(set.name, name);
            assert!(set.citation.len() > 20, "{name}: {}", set.citation);
        }
        assert!(get("unobtainium").is_none());
    }

    #[test]
    fn every_data_set_loads_and_names_its_source() {
        check_kind(&illuminant_names(), illuminant);
        check_kind(&material_names(), optical_constants);
        check_kind(&reflectance_names(), reflectance);
        assert_eq!(illuminant_names().len(), 8 + 12 + 9 + 5);
        assert_eq!(material_names().len(), 69);
        assert_eq!(reflectance_names().len(), 24);
    }
}
