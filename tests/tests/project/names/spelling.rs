//! Checks that all texts are in American English.

use pellicle_tests::sources::{Source, sources};

/// British spellings, each as letters that no American word contains.
const BRITISH: &[&str] = &[
    "aluminium",
    "anodis",
    "artefact",
    "behaviour",
    "cancelled",
    "catalogue",
    "centimetre",
    "centre",
    "centring",
    "characterise",
    "colour",
    "defence",
    "discretis",
    "favour",
    "fibre",
    "fulfil ",
    "generalis",
    "grey",
    "honour",
    "initialis",
    "judgement",
    "labelled",
    "licence",
    "linearis",
    "lustre",
    "memoris",
    "metre ",
    "metres",
    "micrometre",
    "millimetre",
    "minimis",
    "misspelt",
    "modelled",
    "modelling",
    "mould",
    "nanometre",
    "neighbour",
    "normalis",
    "odour",
    "optimis",
    "organis",
    "parametris",
    "polaris",
    "quantis",
    "randomis",
    "realis",
    "recognis",
    "serialis",
    "sceptic",
    "specialis",
    "standardis",
    "sulph",
    "summaris",
    "symmetris",
    "towards",
    "travell",
    "unrecognis",
    "utilis",
    "vapour",
    "visualis",
    "whilst",
    "analyse ",
    "analysed",
    "analysing",
];

/// Where the other spelling is right: titles and names of others, and words that users may write in their files.
const RIGHT: &[(&str, &str)] = &[
    ("colour-science", "the name of a library"),
    ("Unicolour", "the name of a library"),
    ("SDS_COLOURCHECKERS", "a name of a library"),
    ("import colour", "the name of a library"),
    ("colour.", "the name of a library"),
    ("polarisationHandedness", "a name in a file format"),
    ("specification.is_polarised", "a name of a library"),
    ("Colour Developers", "a copyright"),
    ("Colour and Vision Research Laboratory", "a laboratory"),
    ("Metamerism and Colour Constancy", "a title"),
    ("1931 colour-matching functions", "a title"),
    ("1964 colour-matching functions", "a title"),
    ("colour appearance model", "a title"),
    ("colour management systems", "a title"),
    ("Zemax catalogue", "the name of a source"),
    ("licence", "terms that a notice quotes verbatim"),
    ("\"aluminium\"", "a name that people write"),
    ("\"nanometre\"", "a name that people write"),
    ("\"nanometres\"", "a name that people write"),
    ("\"micrometre\"", "a name that people write"),
    ("\"micrometres\"", "a name that people write"),
    ("'centre'", "a value that is refused"),
    ("\\\"centre\\\"", "a value that is refused"),
];

/// Whether a file is exempt because British words are its subject.
fn is_exempt(path: &str) -> bool {
    let lists_old_names = "crates/scene_file/src/description/advice.rs";
    path == "tests/tests/project/names/spelling.rs" || path == lists_old_names
}

/// Positions of British words, with their lines.
fn british(source: &Source) -> Vec<String> {
    let mut found = Vec::new();
    for (number, line) in source.text.lines().enumerate() {
        if source.ends_in("csv") && line.starts_with("# citation") {
            continue;
        }
        let mut text = line.to_owned();
        for (right, _) in RIGHT {
            // Only the notice, which quotes the terms of others, is exempt for this word.
            if *right != "licence" || source.path == "NOTICE" {
                text = text.replace(right, "");
            }
        }
        let lower = format!("{} ", text.to_lowercase());
        if let Some(word) = BRITISH.iter().find(|word| lower.contains(*word)) {
            found.push(format!(
                "{}:{}: {word:?} in {}",
                source.path,
                number + 1,
                line.trim()
            ));
        }
    }
    found
}

#[test]
fn every_text_is_in_american_english() {
    let sources = sources();
    assert!(sources.len() > 500, "few files found: {}", sources.len());
    let wrong: Vec<_> = sources
        .iter()
        .filter(|source| !is_exempt(&source.path))
        .flat_map(british)
        .collect();
    assert!(
        wrong.is_empty(),
        "{} lines:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

#[test]
fn file_names_are_in_american_english() {
    let of = |source: Source| {
        british(&Source {
            path: "a path".to_owned(),
            text: source.path,
        })
    };
    let wrong: Vec<_> = sources().into_iter().flat_map(of).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn a_british_word_is_noticed() {
    let said = |text: &str| {
        !british(&Source {
            path: "a.rs".to_owned(),
            text: text.to_owned(),
        })
        .is_empty()
    };
    for text in [
        "let centre_nm = 1;",
        "fn colour()",
        "// Grey.",
        "POLARISATION",
        "`Neighbours`",
        "two metres",
        "toward and towards",
    ] {
        assert!(said(text), "{text}");
    }
    for text in [
        "center",
        "a perimeter",
        "colour-science 0.4.7",
        "meters",
        "characteristic",
        "rise",
    ] {
        assert!(!said(text), "{text}");
    }
}
