//! Tests of the driver's cache on disk: a second start gives the same picture, and an unusable cache does no harm.

use crate::place::{Place, Ran};
use crate::scene;
use pellicle_tests::device::open;
use std::path::{Path, PathBuf};

/// Renders with the cache in a folder, on the adapter of the suites, and returns the bytes of the spectral image.
fn picture(place: &Place, folder: &Path, adapter: &str) -> Vec<u8> {
    let arguments = "--size 16x8 --samples 1 --bands 4 -o picture.exr --adapter";
    let mut command = place.command("render");
    command
        .arg(scene("film_wedge.toml"))
        .args(arguments.split_whitespace())
        .arg(adapter)
        .env("PELLICLE_CACHE_DIR", folder);
    let output = command.output().unwrap();
    let _ = Ran::of(&output).succeeded();
    std::fs::read(place.path("picture.exr")).unwrap()
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Vec::new();
    };
    entries.map(|entry| entry.unwrap().path()).collect()
}

#[test]
fn a_start_with_a_cache_gives_the_same_picture() {
    let gpu = open();
    let adapter = &gpu.description().info.name;
    let keeps = gpu.device().0.features();
    let keeps = keeps.contains(wgpu::Features::PIPELINE_CACHE);
    let place = Place::default();
    let folder = place.path("cache").join("deeper");
    let first = picture(&place, &folder, adapter);
    let kept = files(&folder);
    assert_eq!(kept.len(), usize::from(keeps), "{kept:?}");
    assert!(picture(&place, &folder, adapter) == first, "with the cache");
    assert_eq!(files(&folder), kept);

    // A file of ours that ends early is written again.
    for file in &kept {
        let whole = std::fs::read(file).unwrap();
        let damaged = &whole[..whole.len() - 1];
        std::fs::write(file, damaged).unwrap();
        assert!(picture(&place, &folder, adapter) == first, "a damaged file");
        assert_ne!(std::fs::read(file).unwrap(), damaged);
    }
    assert_eq!(files(&folder), kept);
}

#[test]
fn a_folder_that_cannot_be_written_is_no_error() {
    let gpu = open();
    let adapter = &gpu.description().info.name;
    let place = Place::default();
    let without = picture(&place, Path::new(""), adapter);
    assert_eq!(place.names(), ["picture.exr"]);
    let file = place.path("no_folder");
    std::fs::write(&file, "a file").unwrap();
    assert!(picture(&place, &file, adapter) == without);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "a file");
}
