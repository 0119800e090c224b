//! Light groups in a file: their channels, and the attributes that tell their names and lamps.

use std::fmt::Write;

use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::Header;
use spectra::{BandGrid, LightGroup, Tabulated};

use super::bands::wavelength_text;
use super::channels::{Content, LightContent};

/// The names of the channels start so, and go on with the light group's name.
const LAYER: &str = "pellicle.light.";
/// Attribute: the names in their order, with spaces between them.
const NAMES: &str = "pellicle.lightGroups";
/// A list of more names is none of ours.
const MOST: usize = 256;
/// The names of X, Y and Z behind that of the light group.
const XYZ: [&str; 3] = ["cieX", "cieY", "cieZ"];

/// The channels of an image with several light groups, by name; none where the only one is the total.
pub(super) fn channels(groups: &[LightGroup], grid: &BandGrid) -> Vec<(String, Content)> {
    let mut named = Vec::new();
    for (index, LightGroup { name, .. }) in groups.iter().enumerate() {
        let mut add = |name, content| named.push((name, Content::Light(index, content)));
        for (i, rgb) in ["R", "G", "B"].iter().enumerate() {
            add(format!("{name}.{rgb}"), LightContent::Rgb(i));
        }
        for (i, xyz) in XYZ.iter().enumerate() {
            add(format!("{LAYER}{name}.{xyz}"), LightContent::Xyz(i));
        }
        for band in 0..grid.count() {
            let wavelength = wavelength_text(grid.centre_nm(band));
            let content = LightContent::Radiance(band as usize);
            add(format!("{LAYER}{name}.{wavelength}"), content);
        }
    }
    if groups.len() > 1 { named } else { Vec::new() }
}

/// What a channel of one of several light groups holds, by its name; `None` for other channels and for red, green and blue,
/// which are developed again from XYZ.
pub(super) fn content(name: &str, groups: &[LightGroup], grid: &BandGrid) -> Option<Content> {
    let (group, rest) = name.strip_prefix(LAYER)?.split_once('.')?;
    let index = groups.iter().position(|known| known.name == group)?;
    if groups.len() < 2 {
        return None;
    }
    if let Some(axis) = XYZ.iter().position(|xyz| *xyz == rest) {
        return Some(Content::Light(index, LightContent::Xyz(axis)));
    }
    let nm: f64 = rest.strip_suffix("nm")?.replace(',', ".").parse().ok()?;
    let band = ((nm - grid.min_nm()) / grid.width_nm()).floor();
    // A cast takes what is negative or not a number to 0, and the name then differs.
    let band = (band as u32).min(grid.count() - 1);
    let is_same = wavelength_text(grid.centre_nm(band)) == rest;
    is_same.then_some(Content::Light(index, LightContent::Radiance(band as usize)))
}

/// The first light group without some of its channels.
pub(super) fn incomplete<'a>(
    groups: &'a [LightGroup],
    contents: &[Option<Content>],
    grid: &BandGrid,
) -> Option<&'a str> {
    if groups.len() < 2 {
        return None;
    }
    let mut counts = vec![0; groups.len()];
    for content in contents.iter().flatten() {
        if let Content::Light(group, _) = content {
            counts[*group] += 1;
        }
    }
    let whole = grid.count() as usize + XYZ.len();
    let short = counts.iter().position(|&count| count != whole)?;
    Some(&groups[short].name)
}

/// The first name that cannot stand in a file, or stands twice.
pub(super) fn bad_name(groups: &[LightGroup]) -> Option<&str> {
    let mut names = groups.iter().map(|group| group.name.as_str()).enumerate();
    let is_bad = |(position, name): &(usize, &str)| {
        let mut before = groups[..*position].iter();
        !LightGroup::is_name(name) || before.any(|other| other.name == *name)
    };
    names.find(is_bad).map(|(_, name)| name)
}

/// Puts names and lamps into the header of a file; nothing where nothing is known.
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

/// The light groups that the header of a file tells of; a single unknown one where it tells of none, or not in our way.
pub(super) fn of_header(header: &Header) -> Vec<LightGroup> {
    let names = attribute(header, NAMES).unwrap_or_default();
    let group = |name: &str| LightGroup {
        name: name.to_owned(),
        lamp: attribute(header, &lamp_key(name)).and_then(|text| parsed(&text)),
    };
    let groups: Vec<LightGroup> = names.split(' ').take(MOST + 1).map(group).collect();
    if groups.len() > MOST || bad_name(&groups).is_some() {
        return vec![LightGroup::unknown()];
    }
    groups
}

/// Attribute: wavelength in nm and power at scale 1, in lines of two numbers with a comma between them.
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

fn parsed(text: &str) -> Option<Tabulated> {
    let point = |line: &str| {
        let (nm, value) = line.split_once(',')?;
        let (nm, value): (f64, f64) = (nm.parse().ok()?, value.parse().ok()?);
        (value >= 0.0).then_some((nm, value))
    };
    let points: Option<Vec<_>> = text.lines().map(point).collect();
    Tabulated::new(points?).ok()
}

fn attribute(header: &Header, name: &str) -> Option<String> {
    match header.own_attributes.other.get(&text(name)) {
        Some(AttributeValue::Text(value)) => {
            Some(String::from_utf8_lossy(value.as_slice()).into_owned())
        }
        _ => None,
    }
}

fn text(string: &str) -> Text {
    Text::from_slice_unchecked(string.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lamp_comes_back_from_its_text() {
        let points = vec![(380.0, 0.1), (385.5, 1.0 / 3.0), (780.0, 12.0)];
        let lamp = Tabulated::new(points).unwrap();
        assert_eq!(parsed(&table(&lamp)), Some(lamp));
        for bad in ["", "380", "380,x", "380,1\n370,1", "380,-1", "380,NaN"] {
            assert_eq!(parsed(bad), None, "{bad:?}");
        }
    }
}
