//! Invalid files: the scene file itself and the files that it names.
#![expect(
    clippy::float_cmp,
    reason = "the figures are exact in binary, or rounding is what is tested"
)]

use pellicle_scene::description::{Extrapolate, Index};
use pellicle_scene::{Material, ProblemKind, Problems, SceneFile, file};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn reported(problems: &Problems) -> String {
    format!("{problems:#}")
}

/// Reads a scene whose metal has the index of the file `name`.
fn with_csv(directory: &Path, name: &str) -> Result<pellicle_scene::Scene, Problems> {
    let scene = format!(
        "[camera]\ntype = 'perspective'\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov_deg = 40\n\
         [materials.metal]\ntype = 'conductor'\nindex = {{ csv = '{name}' }}\n"
    );
    fs::write(directory.join("scene.toml"), scene).unwrap();
    file::load(directory.join("scene.toml"))
}

#[test]
fn scene_files_that_cannot_be_read_say_why() {
    let directory = TempDir::new().unwrap();
    let path = |name: &str| directory.path().join(name);
    fs::write(path("binary.toml"), b"a = 1\n\xff\xfe\x00").unwrap();
    fs::File::create(path("huge.toml"))
        .unwrap()
        .set_len((16 << 20) + 1)
        .unwrap();
    let cases = [
        ("missing.toml", "missing.toml: cannot be opened"),
        ("", "is a directory"),
        (
            "binary.toml",
            "binary.toml: is not text: line 2 has a zero byte",
        ),
        ("huge.toml", "huge.toml: is larger than 16 MiB"),
    ];
    for (name, expected) in cases {
        let problems = SceneFile::read(path(name)).unwrap_err();
        assert!(
            reported(&problems).contains(expected),
            "{}",
            reported(&problems)
        );
        let kinds: Vec<_> = problems.iter().map(|problem| problem.kind).collect();
        assert_eq!(kinds, [ProblemKind::File]);
    }
}

#[test]
fn a_table_file_is_read_beside_the_scene() {
    let directory = TempDir::new().unwrap();
    let table = "\u{feff}# a metal of our own\nwavelength, n, k\n\n380, 0.5, 2\n 780 ; 0.5 ; 4\n";
    fs::write(directory.path().join("metal.csv"), table).unwrap();
    let scene =
        with_csv(directory.path(), "metal.csv").unwrap_or_else(|p| panic!("{}", reported(&p)));
    let Material::Interface { n, k, .. } = scene.materials()[0] else {
        panic!("{:?}", scene.materials());
    };
    assert_eq!(scene.spectrum(n).at(3, 0.1), 0.5);
    // 580 nm, in the middle of the table.
    assert!((scene.spectrum(k).at(20, 0.0) - 3.0).abs() < 1e-12);
    fs::write(directory.path().join("glass.csv"), "380\t1.5\n780\t1.5\n").unwrap();
    let scene =
        with_csv(directory.path(), "glass.csv").unwrap_or_else(|p| panic!("{}", reported(&p)));
    assert_eq!(scene.spectra()[1].extent(), (0.0, 0.0));
}

#[test]
fn table_files_that_cannot_be_used_name_the_field_and_the_line() {
    let directory = TempDir::new().unwrap();
    let cases: &[(&str, &[u8], &str)] = &[
        ("empty.csv", b"", "empty.csv: the table has no points"),
        (
            "heading.csv",
            b"nm,n,k\n",
            "heading.csv: the table has no points",
        ),
        (
            "words.csv",
            b"nm,n,k\n380,1,2\n780,x,2\n",
            "words.csv: line 3: \"x\" is not a number",
        ),
        (
            "narrow.csv",
            b"380,1.0,2\n780\n",
            "narrow.csv: line 2: found 1 columns, expected 3",
        ),
        (
            "wide.csv",
            b"380,1,2,3\n",
            "wide.csv: line 1: found 4 columns",
        ),
        (
            "twice.csv",
            b"780,1.0,2\n780,1,2\n",
            "twice.csv: lines 1 and 2 are both at 780",
        ),
        (
            "commas.csv",
            b"380,1,2\n780,1,2\n",
            "commas.csv: line 1: \"380,1,2\" is ambiguous",
        ),
        (
            "nan.csv",
            b"380,nan,2\n780,1,2\n",
            "nan.csv: line 1: \"nan\" is not a number",
        ),
        (
            "short.csv",
            b"400,1.0,2\n700,1,2\n",
            "the data cover 400 to 700 nm",
        ),
        (
            "binary.csv",
            b"380,1\n\xff\xff",
            "binary.csv: is not text: line 2",
        ),
    ];
    for (name, content, expected) in cases {
        fs::write(directory.path().join(name), content).unwrap();
        let problems = with_csv(directory.path(), name).unwrap_err();
        let text = reported(&problems);
        assert!(text.contains(expected), "{text}");
        assert!(text.contains("scene.toml:8:"), "{text}");
        assert!(text.contains("materials.metal.index"), "{text}");
        assert_eq!(problems.iter().len(), 1, "{text}");
    }
    let long: Vec<String> = (0..100_001)
        .map(|i| format!("{},1,1\n", 380.0 + f64::from(i) * 0.01))
        .collect();
    fs::write(directory.path().join("long.csv"), long.concat()).unwrap();
    let text = reported(&with_csv(directory.path(), "long.csv").unwrap_err());
    assert!(text.contains("has more than 100000 points"), "{text}");
    for (name, expected) in [("none.csv", "cannot be opened"), ("", "is a directory")] {
        let text = reported(&with_csv(directory.path(), name).unwrap_err());
        assert!(
            text.contains(expected) && text.contains("materials.metal.index.csv"),
            "{text}"
        );
    }
}

#[cfg(unix)]
#[test]
fn links_in_a_circle_and_devices_are_refused_at_once() {
    let directory = TempDir::new().unwrap();
    let here = |name: &str| directory.path().join(name);
    std::os::unix::fs::symlink(here("b.csv"), here("a.csv")).unwrap();
    std::os::unix::fs::symlink(here("a.csv"), here("b.csv")).unwrap();
    let status = std::process::Command::new("mkfifo")
        .arg(here("pipe.csv"))
        .status();
    assert!(status.unwrap().success());
    for (name, expected) in [
        ("a.csv", "cannot be opened"),
        ("/dev/zero", "which leads out of the folder"),
        ("pipe.csv", "is not a regular file"),
    ] {
        let problems = with_csv(directory.path(), name).unwrap_err();
        assert!(
            reported(&problems).contains(expected),
            "{}",
            reported(&problems)
        );
        assert_eq!(problems.iter().len(), 1);
    }
}

#[test]
fn an_index_alone_is_read_and_its_mistakes_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("good.csv"),
        "400,1.5,0.25\n800,2.5,0.75\n",
    )
    .unwrap();
    let file = |name: &str| Index::File {
        csv: name.into(),
        column: None,
        unit: None,
        extrapolate: Extrapolate::Error,
    };
    let (constants, _) = media::optical_constants(&file("good.csv"), folder.path()).unwrap();
    assert_eq!(constants.n.at(600.0), Ok(2.0));
    assert_eq!(constants.k.at(600.0), Ok(0.5));
    assert!(constants.n.at(399.0).is_err());

    let said = |index: &Index| {
        let problems = media::optical_constants(index, folder.path()).unwrap_err();
        format!("{problems}\n{problems:#}")
    };
    let missing = said(&file("absent.csv"));
    assert!(
        missing.contains("the index has a problem\ncsv: "),
        "{missing}"
    );
    assert!(missing.contains("absent.csv"), "{missing}");
    let misspelled = said(&Index::Name("glod".to_owned()));
    assert!(
        misspelled.contains("did you mean \"gold\"?"),
        "{misspelled}"
    );
    assert!(said(&Index::Complex([1.0, -1.0])).contains("[1]: found -1"));
}

/// Reads a scene next to a picture of one pixel, which it names `picture`.
fn with_picture(
    file: &str,
    pixel: &image::DynamicImage,
    scene: &str,
) -> Result<pellicle_scene::Scene, Problems> {
    let directory = TempDir::new().unwrap();
    pixel.save(directory.path().join(file)).unwrap();
    let text = format!(
        "[camera]\ntype = 'perspective'\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov_deg = 40\n{}",
        scene.replace("picture", file)
    );
    SceneFile::parse("scene.toml", &text, directory.path())?.validate()
}

#[test]
fn the_brightest_pixel_of_environment_is_bounded_with_its_scale() {
    let bright = image::Rgb([1e6, 1e6, 1e6]);
    let pixels = image::Rgb32FImage::from_pixel(2, 1, bright).into();
    let scene = |scale: &str| {
        format!("[environment]\ntype = 'image'\nimage = 'picture'\nscale = {scale}\n")
    };
    with_picture("sky.hdr", &pixels, &scene("100")).unwrap_or_else(|p| panic!("{}", reported(&p)));
    let problems = with_picture("sky.hdr", &pixels, &scene("1e4")).unwrap_err();
    let said = reported(&problems);
    assert!(
        said.contains("environment.scale: found 1e4, which may give the picture's brightest pixel"),
        "{said}"
    );
    assert!(said.contains("at most 1e9"), "{said}");
}

/// A picture covers a whole sphere, so its size has a meaning only if a flat object has the material too.
#[test]
fn the_size_of_a_picture_on_spheres_alone_is_refused() {
    let pixel = || {
        image::DynamicImage::ImageRgb8(image::RgbImage::from_pixel(
            1,
            1,
            image::Rgb([200, 100, 50]),
        ))
    };
    let scene = |material: &str, objects: &str| {
        format!(
            "[materials.x]\n{material}\n[[objects]]\ntype = 'sphere'\nmaterial = 'x'\ncenter = [0, 0, 0]\nradius = 1\n{objects}"
        )
    };
    let disk = "[[objects]]\ntype = 'disk'\nmaterial = 'x'\ncenter = [0, 0, 3]\nnormal = [0, 0, 1]\nradius = 1\n";
    for (material, field) in [
        (
            "type = 'diffuse'\nreflectance = { texture = 'picture', size = [1, 1] }",
            "reflectance",
        ),
        (
            "type = 'dielectric'\nindex = 1.5\nbase = { texture = 'picture', size = [1, 1] }",
            "base",
        ),
    ] {
        let said = reported(&with_picture("map.png", &pixel(), &scene(material, "")).unwrap_err());
        assert!(
            said.contains(&format!(
                "materials.x.{field}.size: only spheres have this material"
            )),
            "{said}"
        );
        with_picture("map.png", &pixel(), &scene(material, disk))
            .unwrap_or_else(|p| panic!("{}", reported(&p)));
        let plain = material.replace(", size = [1, 1]", "");
        with_picture("map.png", &pixel(), &scene(&plain, ""))
            .unwrap_or_else(|p| panic!("{}", reported(&p)));
    }
}

/// Returns the reflectance at 580 nm of a diffuse surface with a reflectance from this table, and the notes of the scene.
fn with_reflectance(csv: &str, more: &str) -> Result<(f64, Vec<String>), Problems> {
    let directory = TempDir::new().unwrap();
    fs::write(directory.path().join("tile.txt"), csv).unwrap();
    let scene = format!(
        "[camera]\ntype = 'perspective'\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov_deg = 40\n\
         [materials.tile]\ntype = 'diffuse'\nreflectance = {{ csv = 'tile.txt'{more} }}\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'tile'\ncenter = [0, 0, 0]\nradius = 1\n"
    );
    let scene = SceneFile::parse("scene.toml", &scene, directory.path())?.validate()?;
    let table = scene.spectra().iter().find(|table| table.extent().1 > 0.0);
    Ok((table.unwrap().at(20, 0.0), scene.notes()))
}

#[test]
fn tables_say_what_was_assumed_and_take_columns_and_units() {
    // 580 nm is halfway between 380 and 780.
    for (csv, more, said) in [
        ("380,0.25\n780,0.75\n", "", ""),
        (
            "nm,%R\n380,25\n780,75\n",
            "",
            "read with values in percent, as the file says",
        ),
        (
            "780;0,75\n380;0,25\n",
            "",
            "semicolons between columns; decimal commas; rows reversed",
        ),
        ("nm,R,T\n380,0.25,1\n780,0.75,1\n", ", column = 'R'", ""),
        ("nm,R,T\n380,0.25,1\n780,0.75,1\n", ", column = 2", ""),
        ("0.38,25\n0.78,75\n", ", unit = 'um percent'", ""),
    ] {
        let (value, notes) =
            with_reflectance(csv, more).unwrap_or_else(|p| panic!("{}", reported(&p)));
        assert!((value - 0.5).abs() < 1e-12, "{csv}: {value}");
        let notes: Vec<_> = notes
            .iter()
            .filter(|note| note.contains("tile.txt"))
            .collect();
        assert_eq!(notes.len(), usize::from(!said.is_empty()), "{notes:?}");
        assert!(
            notes
                .iter()
                .all(|note| note.contains(said) && note.contains("materials.tile.reflectance.csv")),
            "{notes:?}"
        );
    }
    for (csv, more, said) in [
        ("380,25\n", "", "unit = \"percent\""),
        ("0.38,0.5\n", "", "unit = \"um\""),
        (
            "380,0.5\n",
            ", unit = 'mile'",
            "reflectance.unit: found \"mile\"",
        ),
        (
            "nm,R,T\n380,0.5,1\n",
            "",
            "the columns are 1 \"nm\", 2 \"R\", 3 \"T\"",
        ),
        (
            "nm,R,T\n380,0.5,1\n",
            ", column = 'X'",
            "there is no column \"X\"",
        ),
    ] {
        let problems = reported(&with_reflectance(csv, more).unwrap_err());
        assert!(problems.contains(said), "{problems}");
    }
}
