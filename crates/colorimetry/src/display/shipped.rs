//! The built-in displays: files in the same format as users' files, with their sources.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::Display;
use super::file::parse;

/// Name and file of each display.
const FILES: &[(&str, &str)] = &[
    (
        "adobe_rgb",
        include_str!("../../data/displays/adobe_rgb.toml"),
    ),
    ("bt2020", include_str!("../../data/displays/bt2020.toml")),
    (
        "bt2100_pq",
        include_str!("../../data/displays/bt2100_pq.toml"),
    ),
    (
        "crt_1997",
        include_str!("../../data/displays/crt_1997.toml"),
    ),
    ("dci_p3", include_str!("../../data/displays/dci_p3.toml")),
    (
        "display_p3",
        include_str!("../../data/displays/display_p3.toml"),
    ),
    ("ebu", include_str!("../../data/displays/ebu.toml")),
    ("lcd", include_str!("../../data/displays/lcd.toml")),
    (
        "ntsc_1953",
        include_str!("../../data/displays/ntsc_1953.toml"),
    ),
    ("smpte_c", include_str!("../../data/displays/smpte_c.toml")),
    ("srgb", include_str!("../../data/displays/srgb.toml")),
];

/// The tables named in these files.
const TABLES: &[(&str, &str)] = &[
    (
        "crt_1997.csv",
        include_str!("../../data/displays/crt_1997.csv"),
    ),
    ("lcd.csv", include_str!("../../data/displays/lcd.csv")),
];

fn all() -> &'static BTreeMap<&'static str, Display> {
    static ALL: OnceLock<BTreeMap<&'static str, Display>> = OnceLock::new();
    ALL.get_or_init(|| {
        let display = |&(name, text): &(&'static str, &str)| {
            // No user can cause an error in them, and the test that loads every display rules it out.
            let display = parse(name, text, TABLES)
                .unwrap_or_else(|error| panic!("the built-in display {name}: {error:#}"));
            (name, display)
        };
        FILES.iter().map(display).collect()
    })
}

pub(super) fn named(name: &str) -> Option<Display> {
    all().get(name).cloned()
}

pub(super) fn names() -> Vec<&'static str> {
    all().keys().copied().collect()
}
