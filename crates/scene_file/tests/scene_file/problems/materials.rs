//! Problems of materials.

use super::{assert_problem, assert_problems, with_camera, with_material};
use pellicle_scene_file::SceneFile;
use std::path::Path;

/// A material with this body has one problem: place, field within the material, phrases.
fn material(body: &str, place: &str, field: &str, phrases: &[&str]) {
    assert_problem(
        &with_material(body),
        place,
        &format!("materials.x.{field}"),
        phrases,
    );
}

fn film(thickness: &str, place: &str, field: &str, phrases: &[&str]) {
    let body = format!("type = 'film'\nindex = 1.33\nthickness_nm = {thickness}");
    material(&body, place, field, phrases);
}

cases! { film:
    a_thickness_that_is_no_number("nan", "9:16", "thickness_nm", &["found nan"]);
    a_thickness_that_is_too_large("100001", "9:16", "thickness_nm", &["0 to 100000 nm"]);
    a_thickness_below_0_at_the_far_pole(
        "{ pole = 700, equator = 300 }",
        "9:16",
        "thickness_nm",
        &["gives -100 nm at the far pole", "`equator` can be from 350 to"],
    );
    a_thickness_that_is_too_large_at_the_far_pole(
        "{ pole = 0, equator = 60000 }",
        "9:16",
        "thickness_nm",
        &["gives 120000 nm", "to 50000 nm"],
    );
    an_axis_without_a_direction(
        "{ pole = 3, equator = 3, axis = [0, 0, 0] }",
        "9:48",
        "thickness_nm.axis",
        &["has no direction"],
    );
    a_line_without_length(
        "{ start = 1, end = 2, from = [1, 0, 0], to = [1, 0, 0] }",
        "9:61",
        "thickness_nm.to",
        &["not far enough from `materials.x.thickness_nm.from`"],
    );
}

/// A conductor with this body below its type has one problem.
fn conductor(rest: &str, place: &str, field: &str, phrases: &[&str]) {
    material(
        &format!("type = 'conductor'\n{rest}"),
        place,
        field,
        phrases,
    );
}

cases! { conductor:
    a_roughness_that_is_too_small(
        "index = 'gold'\nroughness = 0.01",
        "9:13",
        "roughness",
        &["0 (a smooth mirror)", "0.02 to 1"],
    );
    a_roughness_across_that_is_too_large(
        "index = 'gold'\nroughness = [0.1, 2]\nbrushed = { along = [1, 0, 0] }",
        "9:19",
        "roughness[1]",
        &["found 2; it must be from 0.02 to 1"],
    );
    two_roughnesses_without_a_grain(
        "index = 'gold'\nroughness = [0.1, 0.2]",
        "9:13",
        "roughness",
        &["no direction of its grain", "brushed = { along"],
    );
    a_grain_with_one_roughness(
        "index = 'gold'\nroughness = 0.1\nbrushed = { around = [0, 1, 0] }",
        "10:11",
        "brushed",
        &["found a grain", "along and across"],
    );
    a_grain_around_nothing(
        "index = 'gold'\nroughness = [0.1, 0.2]\nbrushed = { around = [0, 0, 0] }",
        "10:22",
        "brushed.around",
        &["no direction"],
    );
    a_distribution_without_a_roughness(
        "index = 'gold'\ndistribution = 'ggx'",
        "9:16",
        "distribution",
        &["for a rough surface"],
    );
    an_unknown_distribution(
        "index = 'gold'\nroughness = 0.1\ndistribution = 'phong'",
        "10:16",
        "distribution",
        &["\"beckmann\" or \"ggx\""],
    );
}

cases! { conductor:
    an_index_of_0("index = 0", "8:9", "index", &["found 0", "0.001 to 1000"]);
    an_absorption_below_0("index = [1, -0.5]", "8:13", "index[1]", &["found -0.5", "0 to 1000"]);
    an_index_of_three_numbers(
        "index = [1, 2, 3]",
        "8:9",
        "index",
        &["an array of 3", "an array of 2 numbers"],
    );
    an_index_that_is_too_large("index = [1e4, 2]", "8:10", "index[0]", &["0.001 to 1000"]);
    a_misspelled_metal("index = { name = 'glod' }", "8:18", "index.name", &["did you mean \"gold\"?"]);
}

cases! { material:
    a_reflectance_above_1("type = 'diffuse'\nreflectance = 1.5", "8:15", "reflectance", &["0 to 1"]);
    a_field_of_a_checker_above_1(
        "type = 'diffuse'\nreflectance = { checker = [0.5, 2], size = 1 }",
        "8:33",
        "reflectance.checker[1]",
        &["0 to 1"],
    );
    a_checker_without_a_size(
        "type = 'diffuse'\nreflectance = { checker = [0.5, 1], size = 0 }",
        "8:44",
        "reflectance.size",
        &["1e-6 to 1e6"],
    );
    an_emission_below_0(
        "type = 'emitter'\nemission = { constant = -1 }",
        "8:25",
        "emission.constant",
        &["found -1", "0 to 1e9"],
    );
    an_emission_that_is_too_bright(
        "type = 'emitter'\nemission = { constant = 1e6, scale = 1e6 }",
        "8:38",
        "emission.scale",
        &[
            "found 1e6",
            "a radiance of 1.000e12 W m⁻² sr⁻¹ nm⁻¹",
            "at most 1e9 is possible, which is `scale` = 1.000e3",
        ],
    );
    a_misspelled_illuminant(
        "type = 'emitter'\nemission = { illuminant = 'd65' }",
        "8:27",
        "emission.illuminant",
        &["no illuminant \"d65\"", "did you mean \"D65\"?"],
    );
}

/// Flat objects on which a grain has no direction.
#[test]
fn a_grain_along_the_normal_is_reported_of_the_object() {
    let scene = |brushed: &str, object: &str| {
        with_camera(&format!(
            "[materials.x]\ntype = 'conductor'\nindex = 'gold'\nroughness = [0.1, 0.2]\nbrushed = {{ {brushed} }}\n\
             [[objects]]\nmaterial = 'x'\ncenter = [0, 0, 0]\nradius = 1\n{object}\n"
        ))
    };
    let disk = "type = 'disk'\nnormal = [0, 0, 2]";
    let said = ["\"x\"", "parallel to the normal"];
    for brushed in ["along = [0, 0, -1]", "around = [1, 0, 0]"] {
        assert_problems(
            &scene(brushed, disk),
            &[("12:12", "objects[0].material", &said)],
        );
    }
    for (brushed, object) in [
        ("along = [1, 0, 1]", disk),
        ("around = [0, 0, 1]", disk),
        ("along = [0, 0, 1]", "type = 'sphere'"),
    ] {
        let file = SceneFile::parse("good.toml", &scene(brushed, object), Path::new(""));
        if let Err(problems) = file.and_then(|file| file.validate()) {
            panic!("{problems:#}");
        }
    }
}

/// Several objects may have one material: the object that does not suit it is reported.
#[test]
fn thicknesses_for_spheres_are_refused_on_planes() {
    let scene = |thickness: &str, shape: &str| {
        with_camera(&format!(
            "[materials.x]\ntype = 'film'\nlayers = [{{ index = 1.5, thickness_nm = 9 }}, {{ index = 1.3, thickness_nm = {thickness} }}]\n\
             [[objects]]\ntype = 'sphere'\nmaterial = 'x'\ncenter = [0, 0, 0]\nradius = 1\n\
             [[objects]]\nmaterial = 'x'\n{shape}\n"
        ))
    };
    let plane = "type = 'plane'\npoint = [0, 0, 0]\nnormal = [0, 0, 1]";
    let rectangle = "type = 'rectangle'\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nsize = [1, 1]";
    let polar = "{ product = [2, { pole = 3, equator = 4 }] }";
    let bubble = "{ drainage = { initial = 500, radius_m = 0.01 } }";
    for (thickness, shape, said) in [
        (
            polar,
            plane,
            [
                "\"x\"",
                "`pole` and `equator`",
                "this is a plane",
                "`start`, `end`",
            ],
        ),
        (
            bubble,
            rectangle,
            ["\"x\"", "`radius_m`", "this is a rectangle", "`height_m`"],
        ),
    ] {
        assert_problems(
            &scene(thickness, shape),
            &[("15:12", "objects[1].material", &said)],
        );
    }
    let sphere = "type = 'sphere'\ncenter = [0, 3, 0]\nradius = 1";
    let film =
        "{ drainage = { initial = 500, height_m = 0.01, from = [0, 1, 0], to = [0, 0, 0] } }";
    for (thickness, shape) in [(polar, sphere), (bubble, sphere), (film, rectangle)] {
        let file = SceneFile::parse("good.toml", &scene(thickness, shape), Path::new(""));
        if let Err(problems) = file.and_then(|file| file.validate()) {
            panic!("{problems:#}");
        }
    }
}
