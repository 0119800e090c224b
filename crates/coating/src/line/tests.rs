//! Tests of one-line stacks.

use super::*;

fn said(line: &str) -> (String, Range<usize>) {
    let error = parse(line).unwrap_err();
    let help = error.help.unwrap_or_default();
    let at = error.at.offset()..error.at.offset() + error.at.len();
    (format!("{}; {help}", error.message), at)
}

#[test]
fn media_are_names_and_numbers_and_thicknesses_have_units() {
    let stack = parse(" 1.0|silica 300nm | 1.5+0.1i 0.25 um|2.3e0-0i 1.5µm|gold 2 μm|1.5 + 2e-1i ")
        .unwrap();
    assert_eq!(stack.thicknesses_nm(), [300.0, 250.0, 1500.0, 2000.0]);
    let media: Vec<_> = stack
        .layers()
        .iter()
        .map(|l| l.medium.written().clone())
        .collect();
    let named = |name: &str| Index::Name(name.to_owned());
    assert_eq!(
        media,
        [
            named("silica"),
            Index::Complex([1.5, 0.1]),
            Index::Complex([2.3, 0.0]),
            named("gold")
        ]
    );
    assert_eq!(stack.substrate().written(), &Index::Complex([1.5, 0.2]));
    assert_eq!(
        stack.label(),
        "1 | silica 300 nm | 1.5+0.1i 250 nm | 2.3+0i 1500 nm | gold 2000 nm | 1.5+0.2i"
    );
}

#[test]
fn vacuum_is_one_and_air_is_a_little_more() {
    let index = |line| parse(line).unwrap().sampled(&[550.0]).unwrap().incident()[0];
    assert_eq!(index("vacuum | 1.5"), 1.0);
    assert_eq!(index("1 | 1.5"), 1.0);
    // Ciddor (1996): 1.000278 at 550 nm.
    assert!((index("air | 1.5") - 1.000_278).abs() < 1e-6);
}

#[test]
fn files_have_their_endings() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.csv");
    std::fs::write(&path, "nm,n,k\n300,1.5,0\n800,1.6,0.1\n").unwrap();
    let stack = parse(&format!("1 | {} 3nm | 1.5", path.display())).unwrap();
    let index = stack.sampled(&[550.0]).unwrap().layers()[0][0];
    assert!((index.re - 1.55).abs() < 1e-14 && (index.im - 0.05).abs() < 1e-14);
    assert!(said("1 | none.csv 3nm | 1").0.contains("none.csv"));
    assert!(said("1 | none.yml 3nm | 1").0.contains("none.yml"));
}

#[test]
fn mistakes_are_reported_with_their_place_and_what_would_be_right() {
    for (line, words, place) in [
        ("1.5", "at least an incident medium", "1.5"),
        ("1 | silca 3nm | 2", "did you mean \"silica\"", "silca 3nm"),
        ("1 | silica | 2", "has no thickness", "silica"),
        ("1 | silica 300 | 2", "300nm, 0.3um", "silica 300"),
        ("1 | silica -3nm | 2", "from 0 to 100000 nm", "silica -3nm"),
        ("1 | silica nannm | 2", "no thickness", "silica nannm"),
        (
            "1 | silica 3.4.5nm | 2",
            "\"3.4.5\" is not a number",
            "silica 3.4.5nm",
        ),
        ("1 | 300nm | 2", "no medium", "300nm"),
        ("1 | silica 3nm", "are half spaces", "silica 3nm"),
        ("3nm | silica", "are half spaces", "3nm"),
        ("1 || 2", "nothing between two bars", "|"),
        ("| 2", "no medium", "|"),
        ("gold | 1", "gold absorbs", "gold"),
        ("1+0.1i | 2", "must be transparent", "1+0.1i"),
        (
            "1 | 1.5-0.1i 3nm | 2",
            "k > 0 absorbs: write n - ik from other programs as 1.5+0.1i",
            "1.5-0.1i 3nm",
        ),
        ("1 | 1.5x 3nm | 2", "is not an index", "1.5x 3nm"),
        ("1 | 0 3nm | 2", "from 0.001", "0 3nm"),
    ] {
        let (message, at) = said(line);
        assert!(message.contains(words), "{line}: {message}");
        assert_eq!(&line[at], place, "{line}: {message}");
    }
    let many = "1 |".to_owned() + &" 1.5 1nm |".repeat(1001) + " 1";
    assert!(said(&many).0.contains("1000"));
}

fn thicknesses(line: &str) -> Vec<f64> {
    let stack = parse(line).unwrap_or_else(|error| panic!("{line}: {error} {:?}", error.help));
    stack.thicknesses_nm().to_vec()
}

fn labels(line: &str) -> Vec<String> {
    let stack = parse(line).unwrap_or_else(|error| panic!("{line}: {error} {:?}", error.help));
    stack.layers().iter().map(|l| l.medium.label()).collect()
}

#[test]
fn thicknesses_have_the_units_that_people_use() {
    let line = "1 | 1.5 3000Å | 1.5 3000 \u{212b} | 1.5 3000angstrom | 1.5 0.05mm | 1.5 0.3\u{b5}m | 1.5 0.3\u{3bc}m | 1";
    let expected = [300.0, 300.0, 300.0, 5e4, 300.0, 300.0];
    let found = thicknesses(line);
    assert!(
        found
            .iter()
            .zip(expected)
            .all(|(a, b)| (a - b).abs() < 1e-9),
        "{found:?}"
    );
    assert!(said("1 | 1.5 3000A | 1").0.contains("3000Å"));
    let (message, at) = said("1 | 1.5 0.2mm | 1");
    assert!(
        message.contains("0.2 mm, 200000 nm; it must be from 0 to 100000 nm"),
        "{message}"
    );
    assert_eq!(at, 4..13);
}

#[test]
fn quarter_waves_are_an_optical_thickness_at_normal_incidence() {
    // 0.25 · 550 / 1.25 and 0.5 · 600 / 1.5; k does not matter.
    let line = "1 | 1.25 0.25@550 | 1.5+3i 0.5 @ 600 nm | 1.5 1@300nm | 2";
    assert_eq!(thicknesses(line), [110.0, 200.0, 200.0]);
    // Malitson's silica has 1.459 911 at 550 nm.
    let found = thicknesses("1 | SiO2 0.25@550 | 1")[0];
    assert!((found - 137.5 / 1.459_911).abs() < 1e-4, "{found}");
    for (line, words) in [
        ("1 | 1.5 x@550 | 1", "\"x\" is not a number"),
        ("1 | 1.5 0.25@5.5.0 | 1", "\"5.5.0\" is not a number"),
        (
            "1 | 1.5 0.25@0 | 1",
            "a wavelength of 0 nm; it must be from 1",
        ),
        ("1 | 1.5 -0.25@550 | 1", "it must be from 0 to 100000 nm"),
        ("1 | 1.5 400@550 | 1", "400 waves at 550 nm"),
        ("1 | 0.25@550 | 1", "no medium"),
        ("1 | rutile 0.25@400 | 1", "no value at 400 nm"),
        ("1 | 1.5 0.25@ | 1", "has no thickness"),
    ] {
        let (message, _) = said(line);
        assert!(message.contains(words), "{line}: {message}");
    }
}

#[test]
fn groups_repeat_layers_and_definitions() {
    let alternating = |line: &str| {
        assert_eq!(thicknesses(line), [60.0, 90.0, 60.0, 90.0, 60.0], "{line}");
        assert_eq!(
            labels(line),
            ["2.3", "1.46", "2.3", "1.46", "2.3"],
            "{line}"
        );
    };
    let defined = "H=2.3 60nm; L = 1.46 0.09um ; ";
    for stack in [
        "1 | (HL)^2 H | 1.5",
        "1 | (H L)^2 H | 1.5",
        "1 | (H | L) ^ 2 | H | 1.5",
        "1|((HL))^2H|1.5",
        "1 | H(LH)^2 | 1.5",
        "1 | HLHLH | 1.5",
        "1 | H L H | 1.46 90nm | H | 1.5",
        "1 | (2.3 60nm | L)^2 1H | 1.5",
    ] {
        alternating(&format!("{defined}{stack}"));
    }
    alternating("1 | (2.3 60nm | 1.46 90nm)^2 | 2.3 60nm | 1.5");
    alternating("high=2.3 60nm;low=1.46 90nm;1 | (high low)^2 high | 1.5");
    let cavity = "H=2.3 60nm; L=1.46 90nm; 1 | (H L)^1 2H 0.5L | 1.5";
    assert_eq!(thicknesses(cavity), [60.0, 90.0, 120.0, 45.0]);
    let media = "glass = 1.5; film = 1.38; glass | film 100nm | glass";
    assert_eq!(thicknesses(media), [100.0]);
    assert_eq!(parse(media).unwrap().substrate().label(), "1.5");
    assert_eq!(
        thicknesses("H=TiO2 0.25@550; L=SiO2 0.25@550; air | (HL)^8 H | BK7").len(),
        17
    );
}

#[test]
fn mistakes_in_groups_are_reported_where_they_are() {
    let defined = "H=2.3 60nm; L=1.46 90nm; HL=1 1nm; M=1.5; ";
    for (stack, words, place) in [
        ("1 | (H L^2 | 1", "this bracket is not closed", "("),
        ("1 | H L)^2 | 1", "no bracket is open", ")"),
        ("1 | H L^2 | 1", "a power belongs to a group", "L"),
        ("1 | (H L)^ | 1", "from 1 to 1000 times", "(H L)^"),
        ("1 | (H L)^0 | 1", "from 1 to 1000 times", "(H L)^0"),
        (
            "1 | (H)^99999999999999999999999 | 1",
            "from 1 to 1000 times",
            "(H)^99999999999999999999999",
        ),
        (
            "1 | (H L)^501 | 1",
            "found 1002 layers; at most 1000",
            "(H L)^501",
        ),
        (
            "1 | ((H)^1000)^1000 | 1",
            "found 1000000 layers",
            "((H)^1000)^1000",
        ),
        ("1 | ( )^3 | 1", "nothing in this group", "( )"),
        ("1 | (H K)^3 | 1", "\"K\" is not defined", "K"),
        ("1 | (HL)^3 | 1", "a row of letters", "HL"),
        ("1 | (H M)^3 | 1", "M is defined without a thickness", "M"),
        ("1 | H | H", "H is defined as a layer of 60 nm", "H"),
        (
            "1 | H 30nm | 1",
            "H is defined as a layer of 60 nm",
            "H 30nm",
        ),
        ("1 | 1e9H | 1", "not defined", "1e9H"),
        ("1 | 99999H | 1", "a thickness of 5999940 nm", "99999H"),
        ("1 | 1.2.3H | 1", "\"1.2.3\" is not a number", "1.2.3"),
        ("1 | 0.5(H L)^2 | 1", "\"\" is not defined", "0.5"),
        ("1 | H | (HL)^2", "are half spaces", "(HL)^2"),
    ] {
        let line = format!("{defined}{stack}");
        let (message, at) = said(&line);
        assert!(message.contains(words), "{stack}: {message}");
        assert_eq!(&line[at], place, "{stack}: {message}");
        assert!(!message.contains(" = {"), "{message}");
    }
    for (line, words) in [
        ("1 | (HL)^8 | 1", "\"HL\": H and L are not defined"),
        ("1 | (HL)^8 H | 1", "H=TiO2 0.25@550; L=TiO2 0.25@550; air"),
        ("1 | (2HLH)^8 | 1", "H and L are not defined"),
        ("1 | (H | 1.5 3nm)^8 | 1", "\"H\": H is not defined"),
        ("1 | (Si | 1.5 3nm)^8 | 1", "\"Si\" has no thickness"),
        ("H=1.5 3nm; 1 | (HLLK)^2 | 1", "L and K are not defined"),
        ("H=2.3 60nm; H=2.3 6nm; 1 | H | 1", "H is defined twice"),
        ("H 2.3; 1 | H | 1", "is not a definition"),
        ("2=2.3 60nm; 1 | H | 1", "\"2\" is not a name"),
        ("=2.3; 1 | 1", "\"\" is not a name"),
        ("H=; 1 | H | 1", "there is no medium here"),
        (";1 | 1", "is not a definition"),
        ("H=silca 60nm; 1 | H | 1", "did you mean \"silica\""),
    ] {
        let found = parse(line).err().map(|_| said(line).0);
        assert!(
            found.as_ref().is_some_and(|found| found.contains(words)),
            "{line}: {found:?}"
        );
    }
}

#[test]
fn bombs_of_powers_and_brackets_are_refused_at_once() {
    let deep = format!(
        "1 | {}1.5 1nm{} | 1",
        "(".repeat(50_000),
        ")".repeat(50_000)
    );
    assert!(said(&deep).0.contains("more than 16 deep"));
    let powers = format!("1 | {}1.5 1nm{} | 1", "(".repeat(15), ")^1000".repeat(15));
    assert!(said(&powers).0.contains("found 1000000 layers"));
    let open = format!("1 | {} | 1", "(".repeat(100_000));
    assert!(said(&open).0.contains("not closed"));
    let long = format!("H=1.5 1nm; 1 | {} | 1", "H".repeat(100_000));
    assert!(said(&long).0.contains("found 100000 layers"));
}

proptest::proptest! {
    #[test]
    fn no_text_panics(line in "[ |0-9a-zH.+µÅ()^@;=-]{0,40}") {
        let _ = parse(&line);
    }

    #[test]
    fn no_text_of_any_signs_panics(line in "\\PC*\\|\\PC*") {
        let _ = parse(&line);
    }
}
