//! Light groups in a file: their channels, and the attributes with their names and lamps.

use std::fmt::Write;

use exr::meta::attribute::AttributeValue;
use exr::meta::header::Header;
use spectra::{BandGrid, LayerKey, LightGroup, Stokes, Tabulated};

use super::content::Content;
use super::metadata::{text, unicode};

/// Prefix of the names of the channels, followed by the light group's name.
const LAYER: &str = "pellicle.light.";
/// Attribute: the names in order, separated by spaces.
const NAMES: &str = "pellicle.lightGroups";
/// The most names of a list; a longer list was not written here.
const MAX: usize = 256;
/// The largest power of a lamp: products of larger powers with other numbers would not be finite in `f32`.
const MAX_POWER: f64 = 1e30;

/// Returns the prefix of the names of a light group's channels.
pub(super) fn prefix(name: &str) -> String {
    format!("{LAYER}{name}.")
}

/// Splits the name of a channel of one of several light groups: the index of the light group, and what follows its prefix.
pub(super) fn split<'a>(name: &'a str, groups: &[LightGroup]) -> Option<(usize, &'a str)> {
    let (group, rest) = name.strip_prefix(LAYER)?.split_once('.')?;
    let index = groups.iter().position(|known| known.name == group)?;
    (groups.len() > 1).then_some((index, rest))
}

/// Returns the first light group that lacks some of its channels of a component of the Stokes vector.
pub(super) fn incomplete<'a>(
    groups: &'a [LightGroup],
    contents: &[Option<Content>],
    grid: &BandGrid,
    stokes: Stokes,
) -> Option<&'a str> {
    if groups.len() < 2 {
        return None;
    }
    let mut counts = vec![0; groups.len()];
    for content in contents.iter().flatten() {
        if let Content::Value(key, _) = content
            && let Some(group) = key.light_group
            && key.stokes == stokes
        {
            counts[group] += 1;
        }
    }
    let of_group = LayerKey::all(groups.len()).filter(|key| key.light_group == Some(0));
    let values = |key: LayerKey| key.quantity.values_per_pixel(grid.count() as usize);
    let whole: usize = of_group.map(values).sum();
    let short = counts.iter().position(|&count| count != whole)?;
    Some(&groups[short].name)
}

/// Returns the first name that a file cannot hold, or that occurs twice.
pub(super) fn bad_name(groups: &[LightGroup]) -> Option<&str> {
    let mut names = groups.iter().map(|group| group.name.as_str()).enumerate();
    let is_bad = |(position, name): &(usize, &str)| {
        let mut before = groups[..*position].iter();
        !LightGroup::is_name(name) || before.any(|other| other.name == *name)
    };
    names.find(is_bad).map(|(_, name)| name)
}

/// Writes names and lamps into the header of a file; nothing if the only light group is unknown.
pub(super) fn into_header(groups: &[LightGroup], header: &mut Header) {
    if groups == [LightGroup::unknown()] {
        return;
    }
    let mut put = |name: &str, value: &str| {
        let value = AttributeValue::Text(text(value));
        header.own_attributes.other.insert(text(name), value);
    };
    let names: Vec<&str> = groups.iter().map(|group| group.name.as_str()).collect();
    put(NAMES, &names.join(" "));
    for LightGroup { name, lamp } in groups {
        if let Some(lamp) = lamp {
            put(&lamp_key(name), &table(lamp));
        }
    }
}

/// Returns the light groups in the header of a file; a single unknown one if the header has none, or not in our format. A lamp
/// that cannot be the lamp of an image with these bands becomes unknown, with a note.
pub(super) fn of_header(
    header: &Header,
    grid: &BandGrid,
    notes: &mut Vec<String>,
) -> Vec<LightGroup> {
    let names = attribute(header, NAMES).unwrap_or_default();
    let group = |name: &str| LightGroup {
        name: name.to_owned(),
        lamp: None,
    };
    let mut groups: Vec<LightGroup> = names.split(' ').take(MAX + 1).map(group).collect();
    if groups.len() > MAX || bad_name(&groups).is_some() {
        return vec![LightGroup::unknown()];
    }
    for LightGroup { name, lamp } in &mut groups {
        if let Some(text) = attribute(header, &lamp_key(name)) {
            *lamp = parsed(&text, grid);
            if lamp.is_none() {
                notes.push(format!(
                    "the lamp of its light group {name:?} is not a spectrum over its bands and is taken as unknown"
                ));
            }
        }
    }
    groups
}

/// Returns the attribute for a lamp: lines of wavelength in nm, a comma, and power at scale 1.
fn lamp_key(name: &str) -> String {
    format!("{LAYER}{name}.lamp")
}

fn table(lamp: &Tabulated) -> String {
    lamp.points().fold(String::new(), |mut text, (nm, value)| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{nm},{value}");
        text
    })
}

/// Parses a lamp; `None` unless it is a spectrum over all of the bands.
fn parsed(text: &str, grid: &BandGrid) -> Option<Tabulated> {
    let (low, high) = BandGrid::LIMITS_NM;
    let point = |line: &str| {
        let (nm, value) = line.split_once(',')?;
        let (nm, value): (f64, f64) = (nm.parse().ok()?, value.parse().ok()?);
        let is_sound = (low..=high).contains(&nm) && (0.0..=MAX_POWER).contains(&value);
        is_sound.then_some((nm, value))
    };
    let points: Option<Vec<_>> = text.lines().map(point).collect();
    let lamp = Tabulated::new(points?).ok()?;
    let (from_nm, to_nm) = lamp.range_nm();
    (from_nm <= grid.min_nm() && grid.max_nm() <= to_nm).then_some(lamp)
}

fn attribute(header: &Header, name: &str) -> Option<String> {
    match header.own_attributes.other.get(&text(name)) {
        Some(AttributeValue::Text(value)) => Some(unicode(value)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lamp_comes_back_from_its_text() {
        let grid = BandGrid::visible(4).unwrap();
        let points = vec![(380.0, 0.1), (385.5, 1.0 / 3.0), (780.0, 12.0)];
        let lamp = Tabulated::new(points).unwrap();
        assert_eq!(parsed(&table(&lamp), &grid), Some(lamp));
        assert!(parsed("360,1\n830,1e30", &grid).is_some());
        for bad in [
            "",
            "380",
            "380,1\n780,x",
            "380,1\n370,1\n780,1",
            "380,-1\n780,1",
            "380,NaN\n780,1",
            "380,inf\n780,1",
            "380,1\n780,1e31",
            "381,1\n780,1",
            "380,1\n779,1",
            "1,1\n1e12,1",
            "359,1\n780,1",
            "380,1\n831,1",
        ] {
            assert_eq!(parsed(bad, &grid), None, "{bad:?}");
        }
    }
}
