//! Campaigns for stacks in files and in a line.

use crate::bombs;
use crate::support::text;
use coating::Stack;
use pellicle_fuzz::{Campaign, Outcome};
use std::path::Path;

const FILE_WORDS: [&str; 20] = [
    "[[layer]]",
    "index",
    "thickness_nm",
    "optical_thickness",
    "waves",
    "at_nm",
    "incident",
    "substrate",
    "\"vacuum\"",
    "\"gold\"",
    "\"SiO2\"",
    "[1.5, 0.1]",
    "{ cauchy = [1.5, 0.004] }",
    "{ sellmeier = { b = [1], c_um2 = [0.3] } }",
    "{ mixture = 'bruggeman', of = [1, 'gold'], fraction = 0.5 }",
    "{ mixture = 'maxwell_garnett', of = [1, 'gold'], fraction = 0.5 }",
    "{ normal_reflectance = 0.5 }",
    "extrapolate = 'clamp'",
    "=",
    "\n",
];

const LINE_WORDS: [&str; 24] = [
    "|",
    ";",
    "=",
    "(",
    ")",
    "^",
    "(HL)^8",
    "2H",
    "0.25@550",
    "H=TiO2 0.25@550;",
    "L=SiO2 90nm;",
    "@",
    "nm",
    "um",
    "µm",
    "mm",
    "Å",
    "angstrom",
    "1.5+0.1i",
    "i",
    "air",
    "vacuum",
    "gold",
    "a.csv",
];

/// Thicknesses must be finite and not negative; where the media have data, n must be above 0 and k not below 0.
fn sound(stack: &Stack) -> Outcome {
    let is_thickness = |nm: &f64| nm.is_finite() && *nm >= 0.0;
    if stack.layers().len() > Stack::MAX_LAYERS || !stack.thicknesses_nm().iter().all(is_thickness)
    {
        let most = stack.thicknesses_nm().iter().take(9).collect::<Vec<_>>();
        return Outcome::Unsound(format!("{} layers {most:?}", stack.layers().len()));
    }
    let layers = stack.layers().iter().take(9).map(|layer| &layer.medium);
    for medium in [stack.incident(), stack.substrate()]
        .into_iter()
        .chain(layers)
    {
        for nm in [380.0, 551.3, 780.0] {
            if let Ok(index) = medium.constants().at(nm)
                && !(index.re > 0.0 && index.im >= 0.0 && index.is_finite())
            {
                return Outcome::Unsound(format!("an index: {index} at {nm} nm"));
            }
        }
    }
    Outcome::ACCEPTED
}

#[test]
fn stack_files() {
    let folder = tempfile::tempdir().unwrap();
    let read = |bytes: &[u8]| match Stack::from_toml("fuzz.toml", &text(bytes), folder.path()) {
        Ok(stack) => sound(&stack),
        Err(problems) => Outcome::Refused(format!("{problems:#}")),
    };
    Campaign {
        unchanged: bombs::toml(),
        words: &FILE_WORDS,
        ..Campaign::new("stack_files", 1000)
    }
    .run(read);
}

#[test]
fn stack_lines() {
    let read = |bytes: &[u8]| match Stack::parse(&text(bytes)) {
        Ok(stack) => sound(&stack),
        Err(error) => Outcome::Refused(error.to_string()),
    };
    Campaign {
        seeds: bombs::lines(),
        words: &LINE_WORDS,
        ..Campaign::new("stack_lines", 1000)
    }
    .run(read);
}

/// A stack that is written out is read back as the same stack.
#[test]
fn a_line_and_its_file_are_the_same_stack() {
    let stack = Stack::parse("air | (TiO2 60nm | SiO2 90nm)^2 | BK7").unwrap();
    assert_eq!(stack.thicknesses_nm(), [60.0, 90.0, 60.0, 90.0]);
    let layer = |index: &str, nm| format!("[[layer]]\nindex = \"{index}\"\nthickness_nm = {nm}\n");
    let pair = layer("TiO2", 60) + &layer("SiO2", 90);
    let file = format!("incident = \"air\"\nsubstrate = \"BK7\"\n{pair}{pair}");
    let read = Stack::from_toml("a.toml", &file, Path::new("")).unwrap();
    assert_eq!(read.thicknesses_nm(), stack.thicknesses_nm());
}
