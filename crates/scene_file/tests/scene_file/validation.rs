//! How a valid scene file is read.
#![expect(
    clippy::float_cmp,
    reason = "the values are exact in binary, or rounding is what is tested"
)]

use glam::DVec3;
use pellicle_scene_file::description::{self, Description};
use pellicle_scene_file::{Problems, SceneFile};
use scene::{
    Emission, EmitterKind, Environment, Interference, Material, MaterialId, Pattern, Projection,
    Scene, Shape, Thickness, WavelengthSampling,
};
use std::path::Path;

const CAMERA: &str = "
[camera]
type = 'perspective'
position = [0, 0, 5]
look_at = [0, 0, 0]
fov_deg = 90
";

fn file(rest: &str) -> SceneFile {
    SceneFile::parse("good.toml", &format!("{CAMERA}{rest}"), Path::new(""))
        .unwrap_or_else(|problems| panic!("{problems:#}"))
}

fn scene(rest: &str) -> Scene {
    file(rest)
        .validate()
        .unwrap_or_else(|problems| panic!("{problems:#}"))
}

fn value(scene: &Scene, id: scene::SpectrumId) -> f64 {
    scene.spectrum(id).at(7, 0.3)
}

fn close(a: DVec3, b: DVec3) -> bool {
    (a - b).length() < 1e-12
}

#[test]
fn defaults_are_the_documented_ones() {
    let scene = scene("");
    let settings = scene.settings();
    assert_eq!((settings.width, settings.height), (640, 480));
    assert_eq!(
        (settings.samples, settings.seed, settings.max_path_segments),
        (64, 0, 12)
    );
    assert_eq!(settings.bands.count(), 40);
    assert_eq!(
        (settings.bands.min_nm(), settings.bands.max_nm()),
        (380.0, 780.0)
    );
    assert_eq!(settings.sampling, WavelengthSampling::Random);
    assert_eq!(settings.exposure_ev, 0.0);
    assert!(
        scene.objects().is_empty() && scene.materials().is_empty() && scene.emitters().is_empty()
    );
    let Environment::Constant(Emission {
        spectrum, scale, ..
    }) = *scene.environment()
    else {
        panic!("{:?}", scene.environment());
    };
    assert_eq!((value(&scene, spectrum), scale), (0.0, 0.0));
}

#[test]
fn the_observer_is_the_cie_one() {
    let scene = scene("");
    // ȳ(555 nm) = 1 (CIE 018:2019); 555 nm is the middle of band 17.
    assert!((scene.observer()[1].at(17, 0.5) - 1.0).abs() < 1e-12);
}

#[test]
fn cameras_look_where_they_should() {
    let scene = scene("");
    let camera = scene.camera();
    assert!(
        close(camera.right, DVec3::X) && close(camera.up, DVec3::Y) && close(camera.back, DVec3::Z)
    );
    let Projection::Perspective { half_height } = camera.projection else {
        panic!("{:?}", camera.projection);
    };
    assert!((half_height - 1.0).abs() < 1e-12);
    let text = "[camera]\ntype = 'orthographic'\nposition = [1, 2, 3]\nlook_at = [1, 0, 3]\nup = [0, 9, -2]\nheight = 3";
    let file = SceneFile::parse("above.toml", text, Path::new("")).unwrap();
    let above = file
        .validate()
        .unwrap_or_else(|problems| panic!("{problems:#}"));
    let camera = above.camera();
    assert_eq!(
        camera.projection,
        Projection::Orthographic { half_height: 1.5 }
    );
    assert!(
        close(camera.right, DVec3::X)
            && close(camera.up, DVec3::NEG_Z)
            && close(camera.back, DVec3::Y)
    );
}

#[test]
fn axes_of_surfaces_are_right_handed_and_documented() {
    let scene = scene(
        "
[materials.a]
type = 'diffuse'
reflectance = 0.5
[[objects]]
type = 'plane'
material = 'a'
point = [0, 0, 0]
normal = [0, 3, 0]
[[objects]]
type = 'rectangle'
material = 'a'
center = [0, 0, 0]
normal = [0, 0, 1]
size = [4, 2]
[[objects]]
type = 'rectangle'
material = 'a'
center = [0, 0, 0]
normal = [1, 2, 3]
size = [4, 2]
up = [1, 0, 0]
",
    );
    let axes = |index: usize| match scene.objects()[index].shape {
        Shape::Plane {
            normal,
            tangent,
            bitangent,
            ..
        }
        | Shape::Rectangle {
            normal,
            tangent,
            bitangent,
            ..
        } => (normal, tangent, bitangent),
        Shape::Sphere { .. } | Shape::Disk { .. } => panic!("no rectangle or plane"),
    };
    assert_eq!(axes(0), (DVec3::Y, DVec3::X, DVec3::NEG_Z));
    assert_eq!(axes(1), (DVec3::Z, DVec3::X, DVec3::Y));
    for index in 0..3 {
        let (normal, tangent, bitangent) = axes(index);
        assert!(close(tangent.cross(bitangent), normal));
        assert!((tangent.length() - 1.0).abs() < 1e-12 && (bitangent.length() - 1.0).abs() < 1e-12);
    }
    assert!(axes(2).2.x > 0.9);
    assert!(matches!(
        scene.objects()[1].shape,
        Shape::Rectangle {
            half_width: 2.0,
            half_height: 1.0,
            ..
        }
    ));
}

const MATERIALS: &str = "
[materials.a_diffuse]
type = 'diffuse'
reflectance = { nm = [400, 700], values = [0.25, 0.25], extrapolate = 'clamp' }
[materials.b_checker]
type = 'diffuse'
reflectance = { checker = [0.25, 'white_9_5'], size = 0.5 }
[materials.c_conductor]
type = 'conductor'
index = { nm = [380, 780], n = [0.5, 0.5], k = [3, 3] }
[materials.d_conductor]
type = 'conductor'
index = [0.5, 3]
roughness = 0.3
[materials.e_film]
type = 'film'
index = 1.25
thickness_nm = 300
[materials.f_film]
type = 'film'
index = [1.25, 0.125]
thickness_nm = { pole = 300, equator = 1200, axis = [0, 2, 0] }
[materials.g_film]
type = 'film'
index = 'water'
thickness_nm = { start = 112, end = 750, from = [0, 0, 0], to = [1, 0, 0] }
[materials.h_emitter]
type = 'emitter'
emission = { illuminant = 'E', scale = 12 }
reflectance = 0
[materials.i_emitter]
type = 'emitter'
emission = { nm = [380, 780], values = [1, 1] }
reflectance = 0.25
";

#[test]
fn every_material_becomes_what_it_says() {
    let scene = scene(MATERIALS);
    let materials = scene.materials();
    let Material::Diffuse {
        reflectance: Pattern::Uniform(quarter),
    } = materials[0]
    else {
        panic!("{:?}", materials[0]);
    };
    assert_eq!(value(&scene, quarter), 0.25);
    let Material::Diffuse {
        reflectance: Pattern::Checker { even, odd, size },
    } = materials[1]
    else {
        panic!("{:?}", materials[1]);
    };
    assert_eq!((even, size), (quarter, 0.5));
    assert!(value(&scene, odd) > 0.8);
    let (
        Material::Interface {
            n,
            k,
            layers,
            microsurface: None,
        },
        Material::Interface {
            microsurface: Some(facets),
            ..
        },
    ) = (&materials[2], &materials[3])
    else {
        panic!("{materials:?}");
    };
    assert!(layers.is_empty());
    assert_eq!(facets.roughness, [0.3, 0.3]);
    assert!(!facets.is_brushed());
    assert_eq!((value(&scene, *n), value(&scene, *k)), (0.5, 3.0));
    assert_eq!(
        only_layer(&materials[4]),
        (&Thickness::Constant { nm: 300.0 }, true)
    );
    let polar = Thickness::Polar {
        axis: DVec3::Y,
        pole_nm: 300.0,
        equator_nm: 1200.0,
    };
    assert_eq!(only_layer(&materials[5]), (&polar, false));
    let linear = Thickness::Linear {
        start: DVec3::ZERO,
        end: DVec3::X,
        start_nm: 112.0,
        end_nm: 750.0,
    };
    assert_eq!(only_layer(&materials[6]).0, &linear);
    let Material::Emitter {
        emission,
        reflectance: None,
    } = materials[7]
    else {
        panic!("{:?}", materials[7]);
    };
    assert_eq!(
        (value(&scene, emission.spectrum), emission.scale),
        (1.0, 12.0)
    );
    let Material::Emitter {
        emission: second,
        reflectance: Some(reflectance),
    } = materials[8]
    else {
        panic!("{:?}", materials[8]);
    };
    assert_eq!((second.spectrum, second.scale), (emission.spectrum, 1.0));
    assert_eq!(reflectance, quarter);
}

/// Returns the thickness of a film's only layer, and whether the film is transparent.
fn only_layer(material: &Material) -> (&Thickness, bool) {
    match material {
        Material::Film {
            layers,
            transparent,
            interference: Interference::Exact,
        } if layers.len() == 1 => (&layers[0].thickness, *transparent),
        other => panic!("{other:?}"),
    }
}

#[test]
fn n_and_k_are_neighbors_and_equal_spectra_are_one() {
    let scene = scene(MATERIALS);
    let pairs: Vec<_> = scene
        .materials()
        .iter()
        .filter_map(|material| match material {
            Material::Interface { n, k, .. } => Some((*n, *k)),
            Material::Film { layers, .. } => Some((layers[0].n, layers[0].k)),
            _ => None,
        })
        .collect();
    assert_eq!(pairs.len(), 5);
    assert!(pairs.iter().all(|(n, k)| k.index() == n.index() + 1));
    assert_eq!(pairs[0], pairs[1]);
    // 1.25 + 0i and 1.25 + 0.125i share n, but not the pair.
    assert_ne!(pairs[2], pairs[3]);
    let is_paired = |index| {
        pairs
            .iter()
            .any(|(n, k)| n.index() == index || k.index() == index)
    };
    let singles: Vec<_> = (0..scene.spectra().len())
        .filter(|&index| !is_paired(index))
        .map(|index| &scene.spectra()[index])
        .collect();
    assert!(singles.len() >= 4);
    for single in &singles {
        assert_eq!(singles.iter().filter(|other| *other == single).count(), 1);
    }
}

#[test]
fn lights_are_the_bounded_emitters_that_shine() {
    let object =
        |material: &str, shape: &str| format!("[[objects]]\nmaterial = '{material}'\n{shape}\n");
    let sphere = "type = 'sphere'\ncenter = [0, 0, 0]\nradius = 1";
    let plane = "type = 'plane'\npoint = [0, 0, 0]\nnormal = [0, 1, 0]";
    let rectangle = "type = 'rectangle'\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]\nsize = [1, 1]";
    let materials = "
[materials.on]
type = 'emitter'
emission = { constant = 1 }
[materials.off]
type = 'emitter'
emission = { constant = 1, scale = 0 }
[materials.black]
type = 'emitter'
emission = { constant = 0 }
[materials.gray]
type = 'diffuse'
reflectance = 0.5
";
    let objects = [
        object("gray", sphere),
        object("on", sphere),
        object("off", sphere),
        object("black", rectangle),
        object("on", plane),
        object("on", rectangle),
    ];
    let scene = scene(&format!("{materials}{}", objects.concat()));
    let sources: Vec<_> = scene.emitters().iter().map(|s| s.kind).collect();
    assert_eq!(sources, [1, 5].map(EmitterKind::Object));
    let names: [MaterialId; 2] = [scene.objects()[0].material, scene.objects()[1].material];
    assert!(matches!(scene.material(names[0]), Material::Diffuse { .. }));
    assert!(matches!(scene.material(names[1]), Material::Emitter { .. }));
}

#[test]
fn a_gradient_without_ground_ends_at_its_horizon() {
    let scene = scene(
        "[environment]\ntype = 'gradient'\nzenith = { constant = 2 }\nhorizon = { constant = 1, scale = 3 }",
    );
    let Environment::Gradient {
        zenith,
        horizon,
        ground,
    } = *scene.environment()
    else {
        panic!("{:?}", scene.environment());
    };
    assert_eq!(ground, horizon);
    assert_eq!((value(&scene, zenith.spectrum), zenith.scale), (2.0, 1.0));
    assert_eq!((value(&scene, horizon.spectrum), horizon.scale), (1.0, 3.0));
}

#[test]
fn rounding_to_f32_changes_once_and_then_no_more() {
    let scene = scene(&format!(
        "[render]\nwavelengths_nm = [380.1, 779.7]\nexposure_ev = 0.1\n{MATERIALS}
[[objects]]
type = 'rectangle'
material = 'a_diffuse'
center = [0.1, 0.2, 0.3]
normal = [1, 2, 3]
size = [0.1, 0.2]
[[objects]]
type = 'sphere'
material = 'h_emitter'
center = [0.1, 0.2, 0.3]
radius = 0.7
[environment]
type = 'gradient'
zenith = {{ illuminant = 'C', scale = 0.1, extrapolate = 'clamp' }}
horizon = {{ constant = 0.1 }}
"
    ));
    let rounded = scene.rounded_to_f32();
    assert_ne!(rounded, scene);
    assert_eq!(rounded.rounded_to_f32(), rounded);
    // Every printed number of the rounded scene is an f32, except for the lamps, which are reported and not rendered.
    let lamps = format!("{:?}", rounded.light_groups());
    let text = format!("{rounded:?}");
    assert!(text.contains(&lamps));
    let text = text.replace(&lamps, "");
    let numbers = text.split(|c: char| !(c.is_ascii_digit() || ".-e".contains(c)));
    let floats: Vec<f64> = numbers
        .filter(|word| word.contains('.'))
        .filter_map(|word| word.parse().ok())
        .collect();
    assert!(floats.len() > 1000);
    let double = floats
        .iter()
        .find(|&&number| f64::from(number as f32) != number);
    assert_eq!(double, None);
}

#[test]
fn the_command_line_changes_what_the_file_says() {
    let mut file = file("[render]\nsamples = 8\nbands = 10\n");
    file.description.render.samples = 3;
    file.description.render.size = [2, 1];
    let scene = file.validate().unwrap();
    assert_eq!((scene.settings().samples, scene.settings().width), (3, 2));
    assert_eq!(scene.settings().bands.count(), 10);
}

#[test]
fn a_bad_override_is_not_blamed_on_the_file() {
    let mut file = file("[render]\nsamples = 8\nbands = 0\n");
    file.description.render.samples = 0;
    let problems = file.validate().unwrap_err();
    let reported: Vec<_> = problems
        .iter()
        .map(|p| (p.field.to_string(), p.location.is_some()))
        .collect();
    assert_eq!(
        reported,
        [
            ("render.samples".to_owned(), false),
            ("render.bands".to_owned(), true)
        ]
    );
    let advice = problems.iter().next().and_then(|p| p.help.clone());
    assert_eq!(
        advice.as_deref(),
        Some("this value was set outside the file")
    );
}

#[test]
fn an_override_does_not_hide_what_is_wrong_in_the_file() {
    let mut file = file("[render]\nsamples = 'many'\n");
    file.description.render.samples = 3;
    let problems: Problems = file.validate().unwrap_err();
    assert!(
        format!("{problems:#}").contains("render.samples: found the string 'many'"),
        "{problems:#}"
    );
}

#[test]
fn a_scene_can_be_built_in_code() {
    let mut described = Description {
        camera: description::Camera::Perspective {
            position: [0.0, 0.0, 5.0],
            look_at: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            fov_deg: 30.0,
            lens: None,
            filter: description::Filter::Box,
            polarizer: None,
        },
        render: description::Render {
            samples: 2,
            ..Default::default()
        },
        materials: [(
            "soap".to_owned(),
            description::Material::film(
                description::Index::Name("water".to_owned()),
                description::Thickness::Constant(400.0),
            ),
        )]
        .into(),
        lights: Vec::new(),
        objects: vec![description::Object::Sphere {
            material: "soap".to_owned(),
            center: [0.0; 3],
            radius: 1.0,
        }],
        environment: None,
    };
    let scene = pellicle_scene_file::validate(&described, Path::new("")).unwrap();
    assert_eq!(scene.objects().len(), 1);
    // A program can write the scene that it has built, and read it again.
    let text = toml::to_string(&described).unwrap();
    assert_eq!(
        SceneFile::parse("built.toml", &text, Path::new(""))
            .unwrap()
            .description,
        described
    );
    described.objects[0] = description::Object::Sphere {
        material: "soap".to_owned(),
        center: [0.0; 3],
        radius: f64::NAN,
    };
    let problems = pellicle_scene_file::validate(&described, Path::new("")).unwrap_err();
    assert_eq!(
        format!("{problems:#}"),
        "objects[0].radius: found NaN; it must be from 1e-6 to 1e6"
    );
}
