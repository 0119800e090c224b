//! What the README shows is so.

use pellicle_tests::wgsl::root;
use scene::SceneFile;

fn readme() -> String {
    std::fs::read_to_string(root().join("README.md")).expect("the README exists")
}

/// The text of the first block of code in a language.
fn block<'a>(text: &'a str, language: &str) -> &'a str {
    let fence = format!("```{language}\n");
    let start = text.find(&fence).expect("there is such a block") + fence.len();
    let end = text[start..].find("```").expect("the block ends");
    &text[start..start + end]
}

#[test]
fn the_scene_is_valid() {
    let readme = readme();
    let file = SceneFile::parse("README.md", block(&readme, "toml"), &root());
    let scene = file
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems:#}"));
    assert_eq!(scene.objects().len(), 2);
}

#[test]
fn the_files_that_it_names_exist() {
    let readme = readme();
    let named: Vec<&str> = readme
        .split(['`', '(', ')'])
        .filter(|word| {
            ["crates/", "scenes/", "tests/", "docs/"]
                .iter()
                .any(|room| word.starts_with(room))
        })
        .filter(|word| !word.contains(' '))
        .collect();
    assert!(named.len() > 8, "few files found: {named:?}");
    for name in named {
        assert!(root().join(name).exists(), "{name}");
    }
}
