//! Inputs that are deep, long or that grow when they are read.

const DEPTH: usize = 20_000;

/// Nested TOML: arrays, inline tables, dotted keys, headers.
pub(crate) fn toml() -> Vec<Vec<u8>> {
    let many = |piece: &str| piece.repeat(DEPTH);
    [
        format!("a = {}{}", many("["), many("]")),
        format!("a = {}", many("[")),
        format!("a = {}1{}", many("{b="), many("}")),
        format!("a = {}", many("{b=")),
        format!("{}a = 1", many("a.")),
        format!("[{}a]", many("a.")),
        format!("[[{}a]]", many("a.")),
        many("[[objects]]\n"),
        many("[materials.a]\n"),
        numbered(DEPTH, |i| format!("k{i} = 1\n")),
        format!("a = \"{}\"", many("long ")),
        format!("a = {}", many("1")),
        format!("a = 0.{}1", many("0")),
        format!("\"{}\" = 1", many("a")),
        format!("a = [{}]", many("1,")),
        format!(
            "substrate = {}1{}",
            many("{mixture='bruggeman',of=[1,"),
            many("],fraction=0.5}")
        ),
    ]
    .map(String::into_bytes)
    .to_vec()
}

/// Nested YAML, and aliases that expand to more and more of it.
pub(crate) fn yaml() -> Vec<Vec<u8>> {
    let many = |piece: &str| piece.repeat(DEPTH);
    let lists = (0..40).map(|i| format!("a{}: &a{} [*a{i}, *a{i}, *a{i}]\n", i + 1, i + 1));
    let indented: String = numbered(600, |i| format!("{}a:\n", " ".repeat(i)));
    [
        format!("DATA: {}", many("[")),
        format!("DATA: {}{}", many("["), many("]")),
        format!("DATA: {}", many("{a: ")),
        format!("DATA:\n  {}", many("- ")),
        format!("DATA: {}", many("? ")),
        format!("a0: &a0 [1, 1]\n{}DATA: *a40\n", lists.collect::<String>()),
        "DATA: &a [*a]\n".to_owned(),
        "DATA: &a\n  - type: tabulated nk\n    data: *a\n".to_owned(),
        indented,
        many("---\n"),
        format!("DATA: \"{}\"", many("\\u0041")),
        format!("DATA: {}", many("!t ")),
    ]
    .map(String::into_bytes)
    .to_vec()
}

/// Nested XML, and entities that expand to more and more of it.
pub(crate) fn xml() -> Vec<Vec<u8>> {
    let many = |piece: &str| piece.repeat(DEPTH);
    let head = "<?xml version=\"1.0\"?>";
    let entities = (0..20).map(|i| format!("<!ENTITY e{} \"&e{i};&e{i};&e{i};\">", i + 1));
    let entities: String = entities.collect();
    let sample = "<SpectralDistribution><SpectralData wavelength=\"500\">&e20;</SpectralData></SpectralDistribution>";
    [
        format!("{head}<IESTM2714>{}", many("<a>")),
        format!("{head}<IESTM2714>{}{}</IESTM2714>", many("<a>"), many("</a>")),
        format!("{head}<!DOCTYPE IESTM2714 [<!ENTITY e0 \"1\">{entities}]><IESTM2714>{sample}</IESTM2714>"),
        format!("{head}<IESTM2714 {}>", many("a=\"1\" ")),
        format!("{head}<!DOCTYPE a [<!ENTITY x SYSTEM \"file:///etc/hostname\">]><IESTM2714>{}</IESTM2714>",
            sample.replace("e20", "x")),
        format!("{head}{}", many("<!-- ")),
        format!("{head}<IESTM2714>{}", many("<![CDATA[")),
    ]
    .map(String::into_bytes)
    .to_vec()
}

/// Stacks in a line: nested groups, powers of powers, definitions in definitions.
pub(crate) fn lines() -> Vec<Vec<u8>> {
    let many = |piece: &str| piece.repeat(DEPTH);
    let doubled = |count: u8| -> String {
        let names = (b'B'..b'B' + count).map(char::from);
        let line = names.map(|name| {
            let before = char::from(name as u8 - 1);
            format!("{name}={before}{before}; ")
        });
        format!("A=SiO2 90nm; {}", line.collect::<String>())
    };
    [
        format!("air | {}1.5 10nm{} | 1.5", many("("), many(")")),
        format!("air | {}1.5 10nm{} | 1.5", many("("), many(")^9")),
        format!(
            "air | {}1.5 10nm{} | 1.5",
            "(".repeat(30),
            ")^99".repeat(30)
        ),
        format!("air | (1.5 10nm)^{} | 1.5", many("9")),
        "air | (1.5 10nm)^1000000000 | 1.5".to_owned(),
        format!("{}air | Z | 1.5", doubled(25)),
        "A=A; air | A | 1.5".to_owned(),
        "A=B; B=A; air | A | 1.5".to_owned(),
        many("| "),
        format!("air | {} | 1.5", many("1.5 10nm | ")),
        many("H=1.5 10nm; "),
        format!("air | {} 1.5", many("H")),
        format!("air | 1.5 {}nm | 1.5", many("9")),
    ]
    .map(String::into_bytes)
    .to_vec()
}

/// Tables: long lines, many columns, many headers, many samples.
pub(crate) fn tables() -> Vec<Vec<u8>> {
    let many = |piece: &str| piece.repeat(DEPTH);
    let rows = |row: fn(usize) -> String| (0..DEPTH).map(row).collect::<String>();
    [
        many("1,"),
        many("\t"),
        format!("nm,{}\n400,{}\n", many("r,"), many("1,")),
        many("nm,r\n"),
        rows(|i| format!("{} 0.5\n", 400.0 + i as f64 * 1e-3)),
        rows(|i| format!("{i}")),
        many("\""),
        format!("nm,\"{}\n400,0.5\n", many("a\n")),
        format!("CGATS.17\nNUMBER_OF_FIELDS 99999999999\nBEGIN_DATA_FORMAT\n{}\n", many("SPECTRAL_NM400 ")),
        format!("CGATS.17\n{}", many("BEGIN_DATA\n")),
        format!("CGATS.17\nNUMBER_OF_SETS 4000000000\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPECTRAL_NM400\nEND_DATA_FORMAT\nBEGIN_DATA\n{}END_DATA\n", many("1 0.5\n")),
        many(">>>>>Begin Spectral Data<<<<<\n"),
        format!("{}\n400 1{}\n", many("#"), many("0")),
    ]
    .map(String::into_bytes)
    .to_vec()
}

/// A text with `count` lines.
fn numbered(count: usize, line: impl Fn(usize) -> String) -> String {
    (0..count).map(line).collect::<Vec<_>>().concat()
}
