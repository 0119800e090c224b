//! Checks that the README and the other pages show what exists.

use pellicle_tests::sources::{Source, root, sources};
use scene_file::SceneFile;

fn readme() -> String {
    std::fs::read_to_string(root().join("README.md")).expect("the README exists")
}

/// The text of the first code block in a language.
fn block<'a>(text: &'a str, language: &str) -> &'a str {
    let fence = format!("```{language}\n");
    let start = text.find(&fence).expect("the page has such a block") + fence.len();
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

/// The example of every kind of light, with a camera added.
#[test]
fn the_lights_of_the_documentation_are_valid() {
    let page = std::fs::read_to_string(root().join("docs/lights.md")).expect("the page exists");
    let camera = "camera = { type = \"perspective\", position = [0, 1, 5], look_at = [0, 0, 0], fov_deg = 30 }\n";
    let text = format!("{camera}{}", block(&page, "toml"));
    let scene = SceneFile::parse("lights.md", &text, &root())
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems:#}"));
    assert_eq!((scene.objects().len(), scene.lights().len()), (1, 3));
}

/// The pages of the documentation. The changelog also names what has gone.
fn pages() -> Vec<Source> {
    let mut pages = sources();
    pages.retain(|page| page.ends_in("md") && page.path != "CHANGELOG.md");
    assert!(pages.len() > 12, "few pages found: {}", pages.len());
    pages
}

/// Paths of the project that a page names, in code or as a link. A path with `<name>` in it is a pattern.
fn paths_in(text: &str) -> Vec<&str> {
    let rooms = ["crates/", "docs/", "fuzz/", "scenes/", "shaders/", "tests/"];
    let words = text.split(|c: char| c.is_whitespace() || "`(),;".contains(c));
    let is_path = |word: &&str| rooms.iter().any(|room| word.starts_with(room));
    words
        .filter(is_path)
        .filter(|word| !word.contains(['<', '*', '…']))
        .collect()
}

#[test]
fn the_files_that_pages_name_exist() {
    let mut named = 0;
    let mut missing = Vec::new();
    for page in pages() {
        for path in paths_in(&page.text) {
            let path = path.trim_end_matches(['.', ':', '/']);
            named += 1;
            if !root().join(path).exists() {
                missing.push(format!("{}: {path}", page.path));
            }
        }
    }
    assert!(named > 100, "few files found: {named}");
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

#[test]
fn a_path_that_is_missing_is_found() {
    assert_eq!(
        paths_in("see `shaders/none.wgsl`, [here](docs/none.md) and `crates/<name>.rs`"),
        ["shaders/none.wgsl", "docs/none.md"]
    );
}

/// Every picture of the gallery exists, none is left over, and the suites render every scene that its commands name.
#[test]
fn the_gallery_shows_what_exists() {
    let gallery =
        std::fs::read_to_string(root().join("docs/gallery.md")).expect("the gallery exists");
    let mut shown: Vec<&str> = gallery
        .split("](gallery/")
        .skip(1)
        .filter_map(|rest| rest.split(')').next())
        .collect();
    shown.sort_unstable();
    let files = std::fs::read_dir(root().join("docs/gallery")).expect("the gallery has pictures");
    let mut there: Vec<String> = files
        .map(|entry| {
            entry
                .expect("readable")
                .file_name()
                .into_string()
                .expect("UTF-8")
        })
        .collect();
    there.sort_unstable();
    assert_eq!(shown, there);

    let rendered: Vec<&str> = gallery
        .split("pellicle render scenes/")
        .skip(1)
        .filter_map(|rest| rest.split(".toml").next())
        .collect();
    assert_eq!(rendered.len(), 16, "{rendered:?}");
    for name in rendered {
        assert!(pellicle_tests::scenes::SHIPPED.contains(&name), "{name}");
    }
}

/// Every picture and page that a page of the documentation shows or links to exists.
#[test]
fn the_links_of_the_pages_exist() {
    let mut links = 0;
    for page in pages() {
        let targets = page
            .text
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split(')').next());
        for target in targets.filter(|target| !target.contains("://")) {
            let file = target.split('#').next().unwrap_or(target);
            let beside = root().join(&page.path).with_file_name(file);
            assert!(beside.exists(), "{}: {target}", page.path);
            links += 1;
        }
    }
    assert!(links > 40, "{links}");
}

/// The display file that `docs/color.md` shows as an example is valid.
#[test]
fn the_display_is_valid() {
    let page = std::fs::read_to_string(root().join("docs/color.md")).expect("the page exists");
    let directory = tempfile::tempdir().expect("a folder can be created");
    let path = directory.path().join("monitor.toml");
    std::fs::write(&path, block(&page, "toml")).expect("writable");
    let display = colorimetry::Display::read(&path).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(display.title(), "the monitor in room 12");
}
