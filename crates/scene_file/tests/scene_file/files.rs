//! Invalid files: the scene file itself and the files that it names.
#![expect(
    clippy::float_cmp,
    reason = "the figures are exact in binary, or rounding is what is tested"
)]

use pellicle_scene_file::description::{Extrapolate, Index};
use pellicle_scene_file::{ProblemKind, Problems, SceneFile, load};
use scene::Material;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn reported(problems: &Problems) -> String {
    format!("{problems:#}")
}

/// Reads a scene whose metal has the index of the file `name`.
fn with_csv(directory: &Path, name: &str) -> Result<scene::Scene, Problems> {
    let scene = format!(
        "[camera]\ntype = 'perspective'\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov_deg = 40\n\
         [materials.metal]\ntype = 'conductor'\nindex = {{ csv = '{name}' }}\n"
    );
    fs::write(directory.join("scene.toml"), scene).unwrap();
    load(directory.join("scene.toml"))
}

/// A scene file that cannot be read says why.
fn unreadable(name: &str, expected: &str) {
    let directory = TempDir::new().unwrap();
    let path = |name: &str| directory.path().join(name);
    fs::write(path("binary.toml"), b"a = 1\n\xff\xfe\x00").unwrap();
    fs::File::create(path("huge.toml"))
        .unwrap()
        .set_len((16 << 20) + 1)
        .unwrap();
    let problems = SceneFile::read(path(name)).unwrap_err();
    let said = reported(&problems);
    assert!(said.contains(expected), "{said}");
    let kinds: Vec<_> = problems.iter().map(|problem| problem.kind).collect();
    assert_eq!(kinds, [ProblemKind::File]);
}

cases! { unreadable:
    a_missing_scene("missing.toml", "missing.toml: cannot be opened");
    a_folder_as_scene("", "is a directory");
    a_binary_scene("binary.toml", "binary.toml: is not text: line 2 has a zero byte");
    a_scene_that_is_too_long("huge.toml", "huge.toml: is larger than 16 MiB");
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

/// A table file that cannot be used is reported with its field and its line.
fn bad_table(content: &[u8], expected: &str) {
    let directory = TempDir::new().unwrap();
    fs::write(directory.path().join("t.csv"), content).unwrap();
    let problems = with_csv(directory.path(), "t.csv").unwrap_err();
    let text = reported(&problems);
    for words in [expected, "scene.toml:8:", "materials.metal.index"] {
        assert!(text.contains(words), "{words:?} is not in {text}");
    }
    assert_eq!(problems.iter().len(), 1, "{text}");
}

cases! { bad_table:
    an_empty_table(b"", "t.csv: the table has no points");
    a_table_of_a_heading(b"nm,n,k\n", "t.csv: the table has no points");
    a_word_in_a_table(b"nm,n,k\n380,1,2\n780,x,2\n", "t.csv: line 3: \"x\" is not a number");
    a_table_with_a_short_row(b"380,1.0,2\n780\n", "t.csv: line 2: found 1 columns, expected 3");
    a_table_with_too_many_columns(b"380,1,2,3\n", "t.csv: line 1: found 4 columns");
    a_wavelength_that_is_there_twice(b"780,1.0,2\n780,1,2\n", "t.csv: lines 1 and 2 are both at 780");
    a_table_whose_commas_are_ambiguous(b"380,1,2\n780,1,2\n", "t.csv: line 1: \"380,1,2\" is ambiguous");
    a_table_with_a_nan(b"380,nan,2\n780,1,2\n", "t.csv: line 1: \"nan\" is not a number");
    a_table_that_is_too_short(b"400,1.0,2\n700,1,2\n", "the data cover 400 to 700 nm");
    a_binary_table(b"380,1\n\xff\xff", "t.csv: is not text: line 2");
}

#[test]
fn a_table_that_is_too_long() {
    let long: Vec<String> = (0..100_001)
        .map(|i| format!("{},1,1\n", 380.0 + f64::from(i) * 0.01))
        .collect();
    bad_table(long.concat().as_bytes(), "has more than 100000 points");
}

fn no_table(name: &str, expected: &str) {
    let directory = TempDir::new().unwrap();
    let text = reported(&with_csv(directory.path(), name).unwrap_err());
    assert!(text.contains(expected), "{text}");
    assert!(text.contains("materials.metal.index.csv"), "{text}");
}

cases! { no_table:
    a_missing_table("none.csv", "cannot be opened");
    a_folder_as_table("", "is a directory");
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
) -> Result<scene::Scene, Problems> {
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

/// A table gives a reflectance of 1/2 and a note on what was assumed, if anything was. 580 nm is halfway between 380 and 780.
fn half_reflectance(csv: &str, more: &str, said: &str) {
    let (value, notes) = with_reflectance(csv, more).unwrap_or_else(|p| panic!("{}", reported(&p)));
    assert!((value - 0.5).abs() < 1e-12, "{value}");
    let notes: Vec<_> = notes
        .iter()
        .filter(|note| note.contains("tile.txt"))
        .collect();
    assert_eq!(notes.len(), usize::from(!said.is_empty()), "{notes:?}");
    for note in notes {
        assert!(note.contains(said), "{note}");
        assert!(note.contains("materials.tile.reflectance.csv"), "{note}");
    }
}

cases! { half_reflectance:
    a_table_of_fractions("380,0.25\n780,0.75\n", "", "");
    a_table_of_percents("nm,%R\n380,25\n780,75\n", "", "read with values in percent, as the file says");
    a_table_with_decimal_commas_and_reversed_rows(
        "780;0,75\n380;0,25\n",
        "",
        "semicolons between columns; decimal commas; rows reversed",
    );
    a_column_by_its_name("nm,R,T\n380,0.25,1\n780,0.75,1\n", ", column = 'R'", "");
    a_column_by_its_number("nm,R,T\n380,0.25,1\n780,0.75,1\n", ", column = 2", "");
    a_table_with_a_unit("0.38,25\n0.78,75\n", ", unit = 'um percent'", "");
}

fn no_reflectance(csv: &str, more: &str, said: &str) {
    let problems = reported(&with_reflectance(csv, more).unwrap_err());
    assert!(problems.contains(said), "{problems}");
}

cases! { no_reflectance:
    percents_without_a_unit("380,25\n", "", "unit = \"percent\"");
    micrometers_without_a_unit("0.38,0.5\n", "", "unit = \"um\"");
    an_unknown_unit("380,0.5\n", ", unit = 'mile'", "reflectance.unit: found \"mile\"");
    a_table_of_several_columns("nm,R,T\n380,0.5,1\n", "", "the columns are 1 \"nm\", 2 \"R\", 3 \"T\"");
    an_unknown_column("nm,R,T\n380,0.5,1\n", ", column = 'X'", "there is no column \"X\"");
}
