//! Tests of the commands that the README and the other pages show.

use crate::place::{PELLICLE, Place, Ran};
use crate::root;
use pellicle_tests::sources::{Source, sources};
use std::process::Command;

/// The pages of the documentation. The changelog also names what has gone.
fn pages() -> Vec<Source> {
    let mut pages = sources();
    pages.retain(|page| page.ends_in("md") && page.path != "CHANGELOG.md");
    assert!(pages.len() > 12, "few pages found: {}", pages.len());
    pages
}

#[test]
fn the_commands_of_the_documentation_exist() {
    let help = Place::default().run("--help").succeeded().stdout;
    let known: Vec<&str> = help
        .lines()
        .filter_map(|line| line.strip_prefix("  "))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(known.contains(&"render") && known.len() >= 10, "{known:?}");
    let mut named = 0;
    for Source { path, text } in pages() {
        // In a code span, at the start of a line of a block, or after cargo's two dashes.
        let starts = ["`pellicle ", "\npellicle ", "run --release -- "];
        for rest in starts.iter().flat_map(|start| text.split(start).skip(1)) {
            let command: String = rest.chars().take_while(char::is_ascii_lowercase).collect();
            assert!(
                command.is_empty() || known.contains(&command.as_str()),
                "{path}: pellicle {command}"
            );
            named += 1;
        }
    }
    assert!(named > 30, "{named}");
}

/// The commands of the README run, as in a shell, on the file that it shows.
#[test]
fn the_commands_of_the_readme_run() {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let (_, section) = readme.split_once("`mirror.toml`").unwrap();
    let (_, file) = section.split_once("```toml\n").unwrap();
    let place = Place::default();
    let (file, _) = file.split_once("```").unwrap();
    std::fs::write(place.path("mirror.toml"), file).unwrap();
    let commands = readme
        .lines()
        .filter_map(|line| line.strip_prefix("cargo run --release -- film "));
    let mut count = 0;
    for command in commands {
        let line = format!("\"$PELLICLE\" film {command}");
        let mut shell = Command::new("sh");
        shell
            .args(["-c", &line])
            .env("PELLICLE", PELLICLE)
            .current_dir(place.path(""));
        let _ = Ran::of(&shell.output().unwrap()).succeeded();
        count += 1;
    }
    assert_eq!(count, 8);
    let names = ["mirror.svg", "mirror.toml", "newton.png", "psi_delta.svg"];
    assert_eq!(place.names(), names);
}
