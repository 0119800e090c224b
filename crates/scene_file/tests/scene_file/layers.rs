//! Films and coatings of several layers in scene files: what is accepted, and how the rest is reported.

use crate::{CAMERA, read, said};
use pellicle_scene_file::Problems;
use scene::{Interference, Material, PathDifference, Scene, Thickness, limits};

fn validated(body: &str) -> Result<Scene, Problems> {
    read(&format!("{CAMERA}[materials.x]\n{body}\n"), "")
}

fn material(body: &str) -> Material {
    let scene = validated(body).unwrap_or_else(|problems| panic!("{problems:#}"));
    scene.materials()[0].clone()
}

/// Returns the only problem of a material: its field, and its message with its help.
fn problem(body: &str) -> (String, String) {
    let problems = validated(body).expect_err("must not be accepted");
    assert_eq!(problems.iter().len(), 1, "{problems:#}");
    let only = problems.iter().next().unwrap();
    (only.field.to_string(), said(only))
}

const TWO: &str = "layers = [{ index = 1.5, thickness_nm = 100 }, { index = [2, 0.5], thickness_nm = { pole = 10, equator = 20 } }]";

#[test]
fn a_stack_keeps_its_layers_in_order() {
    let Material::Film {
        layers,
        transparent,
        interference,
    } = material(&format!("type = 'film'\n{TWO}"))
    else {
        panic!("not a film");
    };
    assert_eq!(layers.len(), 2);
    assert_eq!(layers[0].thickness, Thickness::Constant { nm: 100.0 });
    assert!(matches!(layers[1].thickness, Thickness::Polar { .. }));
    assert!(!transparent, "the second layer absorbs");
    assert_eq!(interference, Interference::Exact);
}

#[test]
fn a_coating_lies_on_its_substrate() {
    let coated = format!("type = 'coated'\nsubstrate = 'gold'\nroughness = 0.25\n{TWO}");
    let Material::Interface {
        layers,
        microsurface: Some(facets),
        ..
    } = material(&coated)
    else {
        panic!("not a conductor");
    };
    assert_eq!((layers.len(), facets.roughness), (2, [0.25; 2]));
    let single = "type = 'coated'\nsubstrate = 'titanium'\nindex = 2.4\nthickness_nm = 60";
    assert!(matches!(material(single), Material::Interface { layers, .. } if layers.len() == 1));
}

#[test]
fn two_beams_take_either_path_difference() {
    let with = |rest: &str| {
        let body =
            format!("type = 'film'\nindex = 1.4\nthickness_nm = 300\nmodel = 'two_beam'\n{rest}");
        match material(&body) {
            Material::Film { interference, .. } => interference,
            other => panic!("{other:?}"),
        }
    };
    let optical = Interference::TwoBeam(PathDifference::Optical);
    assert_eq!(with(""), optical);
    assert_eq!(with("path_difference = 'optical'"), optical);
    let printed = Interference::TwoBeam(PathDifference::AsPrinted);
    assert_eq!(with("path_difference = 'as_printed'"), printed);
}

fn refused(body: &str, field: &str, phrases: &[&str]) {
    let (found, said) = problem(body);
    assert_eq!(found, format!("materials.x{field}"), "{said}");
    for phrase in phrases {
        assert!(said.contains(phrase), "{said:?} lacks {phrase:?}");
    }
}

/// More layers than are allowed.
fn many() -> String {
    vec!["{ index = 1.5, thickness_nm = 1 }"; limits::MAX_LAYERS + 1].join(", ")
}

cases! { refused:
    a_film_without_layers("type = 'film'", "", &["`index` and `thickness_nm`", "`layers`"]);
    an_index_without_a_thickness("type = 'film'\nindex = 1.5", "", &["found `index`;", "`thickness_nm`"]);
    an_index_and_layers("type = 'film'\nindex = 1.5\nlayers = []", "", &["found `index` and `layers`"]);
    no_layers("type = 'film'\nlayers = []", ".layers", &["found 0 layers", "from 1 to 64"]);
    too_many_layers(
        &format!("type = 'film'\nlayers = [{}]", many()),
        ".layers",
        &["found 65 layers", "from 1 to 64"],
    );
    a_coating_without_a_substrate(
        "type = 'coated'\nindex = 1.5\nthickness_nm = 100",
        ".substrate",
        &["missing"],
    );
    a_thickness_below_0(
        "type = 'coated'\nsubstrate = 'gold'\nlayers = [{ index = 1.5, thickness_nm = -1 }]",
        ".layers[0].thickness_nm",
        &["found -1", "from 0"],
    );
    a_path_difference_without_two_beams(
        "type = 'film'\nindex = 1.5\nthickness_nm = 100\npath_difference = 'optical'",
        ".path_difference",
        &["only to the two_beam model", "two_beam"],
    );
    two_beams_in_a_layer_that_absorbs(
        "type = 'film'\nindex = [1.5, 0.1]\nthickness_nm = 100\nmodel = 'two_beam'",
        ".model",
        &["does not absorb", "exact"],
    );
    two_beams_in_a_layer_below_1(
        "type = 'film'\nindex = 0.9\nthickness_nm = 100\nmodel = 'two_beam'",
        ".model",
        &["n ≥ 1"],
    );
    two_beams_in_two_layers(
        &format!("type = 'film'\nmodel = 'two_beam'\n{TWO}"),
        ".model",
        &["single layer"],
    );
}
