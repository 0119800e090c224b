//! Files that a scene names must be in its folder, unless the caller allows others.

use crate::CAMERA;
use pellicle_scene_file::description::{Extrapolate, Index};
use pellicle_scene_file::{Folder, Problems, SceneFile};
use scene::Scene;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// Each way to name a file: its field, the name of the file, and the scene with FILE in place of the path.
const WAYS: [(&str, &str, &str); 7] = [
    (
        "materials.x.index.csv",
        "table.csv",
        "materials.x = { type = 'conductor', index = { csv = 'FILE' } }",
    ),
    (
        "materials.x.index.yaml",
        "table.yml",
        "materials.x = { type = 'conductor', index = { yaml = 'FILE' } }",
    ),
    (
        "materials.x.index.of[1].csv",
        "table.csv",
        "materials.x = { type = 'conductor', index = { mixture = 'bruggeman', of = [1, { csv = 'FILE' }], fraction = 0.5 } }",
    ),
    (
        "materials.x.reflectance.csv",
        "table.csv",
        "materials.x = { type = 'diffuse', reflectance = { csv = 'FILE', column = 'k' } }",
    ),
    (
        "materials.x.reflectance.texture",
        "map.png",
        "materials.x = { type = 'diffuse', reflectance = { texture = 'FILE' } }",
    ),
    (
        "materials.x.thickness_nm.image",
        "map.png",
        "materials.x = { type = 'film', index = 1.5, thickness_nm = { image = 'FILE', min = 0, max = 9 } }",
    ),
    (
        "environment.image",
        "sky.hdr",
        "environment = { type = 'image', image = 'FILE' }",
    ),
];

/// A folder with a file of each kind, and `scenes` in it.
fn tree() -> TempDir {
    let tree = TempDir::new().unwrap();
    fs::create_dir(tree.path().join("scenes")).unwrap();
    let path = |name: &str| tree.path().join(name);
    fs::write(path("table.csv"), "nm,n,k\n300,1.5,0.5\n900,1.5,0.5\n").unwrap();
    let yaml = "DATA:\n  - type: tabulated nk\n    data: |\n        0.3 1.5 0\n        0.9 1.5 0\n";
    fs::write(path("table.yml"), yaml).unwrap();
    image::RgbImage::new(1, 1).save(path("map.png")).unwrap();
    let header = b"#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    let pixels = [128, 128, 128, 129, 64, 0, 0, 129];
    fs::write(path("sky.hdr"), [&header[..], &pixels].concat()).unwrap();
    tree
}

fn read(folder: &Path, rest: &str, allows_outside: bool) -> Result<Scene, Problems> {
    let text = format!("{CAMERA}render = {{ bands = 2 }}\n{rest}\n");
    SceneFile::parse("scene.toml", &text, folder)?
        .allow_outside(allows_outside)
        .validate()
}

#[test]
fn a_scene_reads_no_file_outside_of_its_folder() {
    let tree = tree();
    let scenes = tree.path().join("scenes");
    for (field, file, written) in WAYS {
        let absolute = tree.path().join(file).display().to_string();
        for outside in [format!("../{file}"), absolute] {
            let text = written.replace("FILE", &outside);
            let problems = read(&scenes, &text, false).expect_err(&text);
            let said: Vec<_> = problems.iter().collect();
            assert_eq!(said.len(), 1, "{problems:#}");
            assert_eq!(said[0].field.to_string(), field);
            assert!(said[0].message.contains(&outside), "{problems:#}");
            assert!(said[0].message.contains("--allow-outside"), "{problems:#}");
            read(&scenes, &text, true).unwrap_or_else(|problems| panic!("{problems:#}"));
        }
        // The same file within.
        read(tree.path(), &written.replace("FILE", file), false)
            .unwrap_or_else(|problems| panic!("{problems:#}"));
    }
}

#[test]
fn an_index_alone_reads_no_file_outside_either() {
    let tree = tree();
    let index = Index::Database {
        yaml: "../table.yml".into(),
        extrapolate: Extrapolate::Error,
    };
    let folder = Folder::from(&tree.path().join("scenes"));
    let problems = media::optical_constants(&index, folder.clone()).unwrap_err();
    assert!(format!("{problems:#}").contains("../table.yml"));
    assert!(media::optical_constants(&index, folder.allow_outside(true)).is_ok());
}
