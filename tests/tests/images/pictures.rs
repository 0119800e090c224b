//! Developed pictures against goldens, by FLIP. A missing golden fails. After looking at the pictures, bless them again with
//! `PELLICLE_BLESS=1 cargo test --release -p pellicle-tests --test images pictures::`.

use color::DevelopSettings;
use color::compare::{Picture, flip};
use pellicle_tests::device;
use pellicle_tests::scenes::file;
use pellicle_tests::sources::root;
use pellicle_tests::tolerances::PICTURES;
use picture_file::RgbImage8;
use scene_file::SceneFile;
use scene_file::description::{Index, Material};
use spectra::SpectralImage;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

const BLESS: &str =
    "PELLICLE_BLESS=1 cargo test --release -p pellicle-tests --test images pictures::";

/// Tests both renderers on each of these scenes at a size.
macro_rules! goldens {
    ($($scene:ident: $size:expr,)*) => {
        const SCENES: &[(&str, [u32; 2])] = &[$((stringify!($scene), $size)),*];

        mod pictures_look_like_their_goldens {
            $(#[test] fn $scene() { super::looks_like_its_golden(stringify!($scene), $size); })*
        }

        mod the_reference_renders_the_same_pictures {
            $(#[test] fn $scene() { super::reference_renders_the_same(stringify!($scene), $size); })*
        }
    };
}

goldens! {
    soap_bubble: [160, 120],
    film_wedge: [160, 40],
    metal_spheres: [160, 120],
    draining_bubble: [90, 90],
    paper_wedge: [140, 54],
    oil_on_water: [120, 90],
    silicon_steps: [140, 28],
    metamers: [80, 40],
    anodized_titanium: [120, 90],
    tempered_steel: [120, 75],
    dichroic_ball: [48, 36],
    gold_visor: [100, 75],
    paper_figure_5: [80, 40],
    figure_5_exact: [80, 40],
    metals: [80, 60],
    brushed_disk: [80, 60],
    bubble_in_room: [80, 60],
    bubble_under_sky: [80, 60],
    room: [80, 40],
    studio: [96, 54],
}

/// A scene rendered small on the device and developed at its own exposure.
fn rendered(gpu: &gpu::Gpu, mut file: SceneFile, size: [u32; 2]) -> RgbImage8 {
    let render = &mut file.description.render;
    (render.size, render.samples, render.seed) = (size, 64, 1);
    let scene = file
        .validate()
        .unwrap_or_else(|problems| panic!("{problems}"));
    let image = gpu::render(gpu, &scene, &mut |_| ControlFlow::Continue(())).unwrap();
    developed(&image, &scene)
}

fn developed(image: &SpectralImage, scene: &scene::Scene) -> RgbImage8 {
    let settings = DevelopSettings::srgb(scene.settings().exposure_ev);
    color::develop(image, &settings).unwrap()
}

/// The same scene rendered by the reference, with the same random numbers.
fn rendered_by_reference(mut file: SceneFile, size: [u32; 2]) -> RgbImage8 {
    let render = &mut file.description.render;
    (render.size, render.samples, render.seed) = (size, 64, 1);
    let scene = file
        .validate()
        .unwrap_or_else(|problems| panic!("{problems}"))
        .rounded_to_f32();
    let image = reference::render(&scene, &mut |_| ControlFlow::Continue(())).unwrap();
    developed(&image, &scene)
}

fn golden_path(name: &str) -> PathBuf {
    root().join("tests/goldens").join(format!("{name}.png"))
}

/// Compares a picture with the golden at `path`.
fn compare(actual: &Picture, path: &Path) -> Result<f64, String> {
    let golden = Picture::read_png(path)
        .map_err(|error| format!("{}: {error}; to make it: {BLESS}", path.display()))?;
    let differences = flip(&golden, actual).map_err(|error| error.to_string())?;
    let mean = differences.iter().sum::<f64>() / differences.len() as f64;
    if mean <= PICTURES {
        Ok(mean)
    } else {
        Err(format!("mean FLIP {mean:.4}, allowed {PICTURES}"))
    }
}

fn looks_like_its_golden(name: &str, size: [u32; 2]) {
    let picture = rendered(&device::lend(), file(name), size);
    let path = golden_path(name);
    if std::env::var("PELLICLE_BLESS").is_ok_and(|value| value == "1") {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        picture_file::png::write(&path, &picture).unwrap();
    }
    match compare(&Picture::of_codes(&picture), &path) {
        Ok(mean) => println!("mean FLIP {mean:.5}"),
        Err(report) => {
            let folder = root().join("target/pictures");
            std::fs::create_dir_all(&folder).unwrap();
            let saved = folder.join(format!("{name}.png"));
            picture_file::png::write(&saved, &picture).unwrap();
            panic!("{report}; see {}", saved.display());
        }
    }
}

/// The reference differs from the goldens as another driver does: in rounding.
fn reference_renders_the_same(name: &str, size: [u32; 2]) {
    let picture = rendered_by_reference(file(name), size);
    let found = compare(&Picture::of_codes(&picture), &golden_path(name));
    println!("reference against golden: {found:?}");
    assert!(found.is_ok(), "{found:?}");
}

/// The index of water in the project's data, times a factor.
fn water(factor: f64) -> Index {
    let constants = spectra::optical_constants("water").unwrap().data;
    let nm: Vec<f64> = (360..=830).step_by(5).map(f64::from).collect();
    let n = nm
        .iter()
        .map(|&nm| factor * constants.n.at(nm).unwrap())
        .collect();
    Index::Table {
        nm,
        n,
        k: None,
        extrapolate: scene_file::description::Extrapolate::Error,
    }
}

#[test]
fn a_film_with_a_wrong_index_is_noticed() {
    let gpu = device::lend();
    let (name, size) = ("film_wedge", [160, 40]);
    let with = |factor: f64| {
        let mut file = file(name);
        let mut films = 0;
        for material in file.description.materials.values_mut() {
            if let Material::Film { index, .. } = material {
                *index = Some(water(factor));
                films += 1;
            }
        }
        assert_eq!(films, 1);
        Picture::of_codes(&rendered(&gpu, file, size))
    };
    // The table reproduces the named index faithfully, so the difference below comes from the factor.
    let right = compare(&with(1.0), &golden_path(name));
    assert!(right.is_ok(), "{right:?}");
    let wrong = compare(&with(1.01), &golden_path(name));
    println!("index + 1 %: {wrong:?}");
    assert!(wrong.is_err(), "{wrong:?}");
}

#[test]
fn a_missing_golden_fails_and_says_how_to_bless_it() {
    let folder = tempfile::tempdir().unwrap();
    let picture = Picture::of_codes(&RgbImage8::new(1, 1, vec![0; 3]).unwrap());
    let report = compare(&picture, &folder.path().join("none.png")).unwrap_err();
    assert!(report.contains(BLESS), "{report}");
}

/// Every golden belongs to a scene; none is left over.
#[test]
fn every_golden_has_its_scene() {
    let mut found: Vec<String> = std::fs::read_dir(root().join("tests/goldens"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    found.sort();
    let mut expected: Vec<_> = SCENES
        .iter()
        .map(|(name, _)| format!("{name}.png"))
        .collect();
    expected.sort();
    assert_eq!(found, expected);
}
