//! The color layers of a file, found by the names of its channels and parts.

use exr::meta::header::Header;

use crate::exr_file::name_of;

/// The kind of a layer's channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// R, G and B.
    Rgb,
    /// X, Y and Z.
    Xyz,
    /// Y alone.
    Luminance,
}

/// A set of channels that form a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ColorLayer {
    /// The channels' names up to the last dot, preceded by the name of the part if the file has several; empty for plain `R`, `G`
    /// and `B`.
    pub(super) name: String,
    /// Index of the part.
    pub(super) part: usize,
    pub(super) kind: Kind,
    /// The channels in the order of the kind.
    pub(super) channels: Vec<usize>,
    /// A channel of the layer that occurs twice in the part.
    pub(super) twice: Option<String>,
    /// Whether the layer also has RY or BY.
    pub(super) has_chroma: bool,
    /// The channels' names up to the last dot, without the name of the part.
    prefix: String,
}

/// Returns all color layers.
pub(super) fn of_headers(headers: &[Header]) -> Vec<ColorLayer> {
    let mut layers = Vec::new();
    for (part, header) in headers.iter().enumerate() {
        let own = header.own_attributes.layer_name.as_ref();
        let own = own.filter(|_| headers.len() > 1);
        let part_name = own.map(|name| name_of(name.as_slice())).unwrap_or_default();
        of_part(part, &part_name, &names(header), &mut layers);
    }
    layers
}

/// Returns the names of a part's channels.
pub(super) fn names(header: &Header) -> Vec<String> {
    let channels = header.channels.list.iter();
    channels.map(|c| name_of(c.name.as_slice())).collect()
}

/// The channels of one layer by their last names, and how often each occurs.
#[derive(Default)]
struct Found<'a> {
    places: std::collections::BTreeMap<&'a str, (usize, usize)>,
}

fn of_part(part: usize, part_name: &str, names: &[String], layers: &mut Vec<ColorLayer>) {
    let mut by_prefix: std::collections::BTreeMap<&str, Found<'_>> = Default::default();
    for (channel, name) in names.iter().enumerate() {
        let (prefix, last) = name.rsplit_once('.').unwrap_or(("", name));
        if ["R", "G", "B", "X", "Y", "Z", "RY", "BY"].contains(&last) {
            let places = &mut by_prefix.entry(prefix).or_default().places;
            places.entry(last).or_insert((channel, 0)).1 += 1;
        }
    }
    for (prefix, Found { places }) in by_prefix {
        let all = |wanted: &[&str]| -> Option<Vec<usize>> {
            let places = wanted.iter().map(|name| Some(places.get(name)?.0));
            places.collect()
        };
        let (kind, last, channels) = if let Some(channels) = all(&["R", "G", "B"]) {
            (Kind::Rgb, &["R", "G", "B"][..], channels)
        } else if let Some(channels) = all(&["X", "Y", "Z"]) {
            (Kind::Xyz, &["X", "Y", "Z"][..], channels)
        } else if let Some(channels) = all(&["Y"]) {
            (Kind::Luminance, &["Y"][..], channels)
        } else {
            continue;
        };
        let mut twice = last.iter().filter(|name| places[*name].1 > 1);
        layers.push(ColorLayer {
            name: full_name(part_name, prefix),
            part,
            kind,
            channels,
            twice: twice.next().map(|name| (*name).to_owned()),
            has_chroma: places.contains_key("RY") || places.contains_key("BY"),
            prefix: prefix.to_owned(),
        });
    }
}

/// Returns the name of a layer. Some writers repeat the part's name in the names of its channels.
fn full_name(part: &str, prefix: &str) -> String {
    let repeats = prefix
        .strip_prefix(part)
        .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
    match (part, prefix) {
        ("", prefix) => prefix.to_owned(),
        (part, "") => part.to_owned(),
        (_, prefix) if repeats => prefix.to_owned(),
        (part, prefix) => format!("{part}.{prefix}"),
    }
}

/// Why no layer was chosen.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum NotChosen {
    None,
    Several(Vec<String>),
    NoSuch(Vec<String>),
}

/// Returns the requested layer; otherwise the only layer of R, G and B, or the one without a prefix; otherwise X, Y and Z without a
/// prefix (vectors have these names too), and then a luminance by the same rule as R, G and B. The flag says whether the choice
/// should be reported.
pub(super) fn choose(
    layers: &[ColorLayer],
    asked: Option<&str>,
) -> Result<(ColorLayer, bool), NotChosen> {
    let names = |of: &[&ColorLayer]| of.iter().map(|layer| layer.name.clone()).collect();
    if let Some(asked) = asked {
        let full = layers.iter().filter(|layer| layer.name == asked);
        let mut found: Vec<&ColorLayer> = full.collect();
        if found.is_empty() {
            let by_prefix = layers.iter().filter(|layer| layer.prefix == asked);
            found = by_prefix
                .filter(|layer| !asked.is_empty() || layer.name.is_empty())
                .collect();
        }
        return match found.as_slice() {
            [one] => Ok(((*one).clone(), false)),
            [] => Err(NotChosen::NoSuch(names(&layers.iter().collect::<Vec<_>>()))),
            several => Err(NotChosen::Several(names(several))),
        };
    }
    let of_kind = |kind: Kind| layers.iter().filter(move |layer| layer.kind == kind);
    let choices: [Vec<&ColorLayer>; 3] = [
        of_kind(Kind::Rgb).collect(),
        of_kind(Kind::Xyz)
            .filter(|layer| layer.prefix.is_empty())
            .collect(),
        of_kind(Kind::Luminance).collect(),
    ];
    for choice in choices {
        let plain: Vec<&ColorLayer> = choice
            .iter()
            .filter(|l| l.name.is_empty())
            .copied()
            .collect();
        match (choice.as_slice(), plain.as_slice()) {
            ([], _) => {}
            ([one], _) => return Ok(((*one).clone(), !one.name.is_empty())),
            (_, [one]) => return Ok(((*one).clone(), true)),
            (several, _) => return Err(NotChosen::Several(names(several))),
        }
    }
    Err(NotChosen::None)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layers(parts: &[(&str, &[&str])]) -> Vec<ColorLayer> {
        let mut layers = Vec::new();
        for (part, (name, channels)) in parts.iter().enumerate() {
            let names: Vec<String> = channels.iter().map(|&name| name.to_owned()).collect();
            of_part(part, name, &names, &mut layers);
        }
        layers
    }

    fn chosen(
        parts: &[(&str, &[&str])],
        asked: Option<&str>,
    ) -> Result<(String, usize), NotChosen> {
        choose(&layers(parts), asked).map(|(layer, _)| (layer.name, layer.part))
    }

    #[test]
    fn the_only_layer_or_the_plain_one_is_taken() {
        let is = |name: &str, part| Ok((name.to_owned(), part));
        let plain = ["A", "B", "G", "R"];
        let blender = [
            "V.Combined.A",
            "V.Combined.B",
            "V.Combined.G",
            "V.Combined.R",
            "V.Depth.Z",
        ];
        assert_eq!(chosen(&[("", &plain)], None), is("", 0));
        assert_eq!(chosen(&[("", &blender)], None), is("V.Combined", 0));
        let both = ["B", "G", "R", "key.B", "key.G", "key.R"];
        assert_eq!(chosen(&[("", &both)], None), is("", 0));
        assert_eq!(chosen(&[("", &both)], Some("key")), is("key", 0));
        assert_eq!(
            chosen(&[("z", &["Z"]), ("beauty", &plain)], None),
            is("beauty", 1)
        );
        let repeated = ["beauty.B", "beauty.G", "beauty.R"];
        assert_eq!(chosen(&[("beauty", &repeated)], None), is("beauty", 0));
        let parts: [(&str, &[&str]); 2] = [("left", &plain), ("right", &plain)];
        assert_eq!(chosen(&parts, Some("right")), is("right", 1));
        let several = NotChosen::Several(vec!["left".into(), "right".into()]);
        assert_eq!(chosen(&parts, None), Err(several));
        let layered = ["a.B", "a.G", "a.R", "b.B", "b.G", "b.R"];
        assert!(matches!(
            chosen(&[("", &layered)], None),
            Err(NotChosen::Several(_))
        ));
        let known = NotChosen::NoSuch(vec!["a".into(), "b".into()]);
        assert_eq!(chosen(&[("", &layered)], Some("c")), Err(known));
        assert!(chosen(&[("", &layered)], Some("")).is_err());
    }

    #[test]
    fn other_kinds_are_taken_where_there_is_no_red_green_and_blue() {
        let kind =
            |channels: &[&str]| choose(&layers(&[("", channels)]), None).map(|(l, _)| l.kind);
        assert_eq!(kind(&["Y"]), Ok(Kind::Luminance));
        assert_eq!(kind(&["A", "Y"]), Ok(Kind::Luminance));
        assert_eq!(kind(&["X", "Y", "Z"]), Ok(Kind::Xyz));
        assert_eq!(kind(&["B", "G", "R", "X", "Y", "Z"]), Ok(Kind::Rgb));
        // Normals and positions have these names.
        assert_eq!(kind(&["N.X", "N.Y", "N.Z"]), Err(NotChosen::None));
        assert_eq!(kind(&["Z"]), Err(NotChosen::None));
        assert_eq!(kind(&["B", "G"]), Err(NotChosen::None));
        let chroma = &layers(&[("", &["BY", "RY", "Y"])])[0];
        assert!(chroma.has_chroma);
        let twice = &layers(&[("", &["B", "G", "R", "R"])])[0];
        assert_eq!(twice.twice.as_deref(), Some("R"));
    }
}
