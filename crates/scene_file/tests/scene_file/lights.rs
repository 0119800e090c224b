//! Units of emission, and lights, which are emitters that are not objects.

use crate::{CAMERA, said};
use pellicle_scene_file::Problems;
use scene::{EmitterKind, LightShape, Scene};
use std::f64::consts::PI;

fn read(rest: &str) -> Result<Scene, Problems> {
    crate::read(&format!("{CAMERA}{rest}"), "")
}

fn scene(rest: &str) -> Scene {
    read(rest).unwrap_or_else(|problems| panic!("{problems:#}"))
}

/// There is one problem, with this field and these phrases.
fn refused(rest: &str, field: &str, phrases: &[&str]) {
    let Err(problems) = read(rest) else {
        panic!("accepted: {rest}");
    };
    let all: Vec<_> = problems.iter().collect();
    assert_eq!(all.len(), 1, "{problems:#}");
    assert_eq!(all[0].field.to_string(), field, "{problems:#}");
    let said = said(all[0]);
    for phrase in phrases {
        assert!(said.contains(phrase), "{said:?} lacks {phrase:?}");
    }
}

fn emitter(emission: &str, shape: &str) -> String {
    format!(
        "[materials.lamp]\ntype = 'emitter'\nemission = {{ {emission} }}\n[[objects]]\nmaterial = 'lamp'\n{shape}\n"
    )
}

const SPHERE: &str = "type = 'sphere'\ncenter = [0, 0, 0]\nradius = 0.5";
const PLANE: &str = "type = 'plane'\npoint = [0, 0, 0]\nnormal = [0, 1, 0]";

fn scale(scene: &Scene) -> f64 {
    scene.emitters()[0].emission.scale
}

#[test]
fn units_become_the_factor_of_the_spectrum() {
    let of = |emission: &str| scale(&scene(&emitter(emission, SPHERE)));
    assert_eq!(of("constant = 2"), 1.0);
    assert_eq!(of("constant = 2, scale = 3"), 3.0);
    // 400 nm of 2 W m⁻² sr⁻¹ nm⁻¹.
    assert!((of("constant = 2, radiance = 1600") - 2.0).abs() < 1e-12);
    // Φ = π A L with A = 4π r².
    let watts = 800.0 * PI * 4.0 * PI * 0.25;
    assert!((of(&format!("constant = 2, power_w = {watts}")) - 1.0).abs() < 1e-12);
    // ∫ ȳ dλ from 380 to 780 nm is 106.857 nm for the table of 1 nm (CIE 018:2019 gives 106.857).
    assert!((of("constant = 1, luminance_cd_m2 = 683") * 106.857 - 1.0).abs() < 1e-4);
}

#[test]
fn each_object_has_the_power_of_its_material() {
    let small = "type = 'sphere'\ncenter = [2, 0, 0]\nradius = 0.25";
    let text = emitter("constant = 1, power_w = 10", SPHERE);
    let scene = scene(&format!("{text}[[objects]]\nmaterial = 'lamp'\n{small}\n"));
    let sources = scene.emitters();
    assert_eq!(sources.len(), 2);
    let ratio = sources[1].emission.scale / sources[0].emission.scale;
    assert!((ratio - 4.0).abs() < 1e-12, "{ratio}");
    assert_eq!(scene.light_groups().len(), 1);
}

#[test]
fn a_plane_has_no_power() {
    refused(
        &emitter("constant = 1, power_w = 10", PLANE),
        "objects[0].material",
        &["infinite plane", "power_w", "rectangle"],
    );
}

fn refused_emission(emission: &str, field: &str, phrases: &[&str]) {
    let field = format!("materials.lamp.emission{field}");
    refused(&emitter(emission, SPHERE), &field, phrases);
}

cases! { refused_emission:
    two_units("constant = 1, scale = 2, radiance = 3", "", &["`scale` and `radiance`", "one of them", "`power_lm`"]);
    a_unit_of_another_light("constant = 1, illuminance_lux = 3", ".illuminance_lux", &["an emitter has no", "`luminance_cd_m2`", "`power_w`"]);
    a_radiance_below_0("constant = 1, radiance = -1", ".radiance", &["found -1"]);
    a_radiance_without_a_spectrum("constant = 0, radiance = 1", ".radiance", &["0 over the scene"]);
    a_radiance_that_is_too_large(
        "constant = 1, radiance = 1e12",
        ".radiance",
        &[
            "found 1e12",
            "a radiance of 2.500e9",
            "at most 1e9 is possible, which is `radiance` = 4.000e11",
        ],
    );
}

fn refused_light(light: &str, field: &str, phrases: &[&str]) {
    let text = format!("[[lights]]\n{light}\n");
    refused(&text, &format!("lights[0]{field}"), phrases);
}

cases! { refused_light:
    a_point_with_a_radiance(
        "type = 'point'\nposition = [0, 1, 0]\nemission = { constant = 1, radiance = 1 }",
        ".emission.radiance",
        &["`intensity_cd`", "`power_w`"],
    );
    a_laser_with_a_luminance(
        "type = 'distant'\ndirection = [0, 1, 0]\ndiameter_deg = 0\nemission = { constant = 1, luminance_cd_m2 = 1 }",
        ".emission.luminance_cd_m2",
        &["without a diameter", "`illuminance_lux`"],
    );
    a_laser_that_is_too_bright(
        "type = 'distant'\ndirection = [0, 1, 0]\ndiameter_deg = 0\nemission = { constant = 1e3, scale = 1e7 }",
        ".emission.scale",
        &["an irradiance of 1.000e10 W m⁻² nm⁻¹", "`scale` = 1.000e6"],
    );
    a_disk_that_is_too_bright(
        "type = 'distant'\ndirection = [0, 1, 0]\ndiameter_deg = 0.01\nemission = { constant = 1, illuminance_lux = 1e9 }",
        ".emission.illuminance_lux",
        &["a radiance of", "a larger `diameter_deg`"],
    );
    a_point_that_is_too_bright(
        "type = 'point'\nposition = [0, 1, 0]\nemission = { constant = 1, intensity_w_sr = 1e12 }",
        ".emission.intensity_w_sr",
        &["an intensity of 2.500e9 W sr⁻¹ nm⁻¹"],
    );
}

#[test]
fn an_environment_has_no_power() {
    refused(
        "[environment]\ntype = 'constant'\nemission = { constant = 1, power_w = 1 }\n",
        "environment.emission.power_w",
        &["a constant environment has no `power_w`"],
    );
}

#[test]
fn lumens_are_watts_by_the_eye() {
    let of = |emission: &str| scale(&scene(&emitter(emission, SPHERE)));
    // Φv = π A Lv with A = 4π r².
    let lumens = 683.0 * PI * 4.0 * PI * 0.25;
    let by_luminance = of("illuminant = 'A', luminance_cd_m2 = 683");
    let by_power = of(&format!("illuminant = 'A', power_lm = {lumens}"));
    assert!((by_power / by_luminance - 1.0).abs() < 1e-12);
    let point = |emission: &str| {
        scale(&scene(&format!(
            "[[lights]]\ntype = 'point'\nposition = [0, 1, 0]\nemission = {{ {emission} }}\n"
        )))
    };
    let by_intensity = point("illuminant = 'A', intensity_cd = 100");
    let by_power = point(&format!("illuminant = 'A', power_lm = {}", 400.0 * PI));
    assert!((by_power / by_intensity - 1.0).abs() < 1e-12);
    refused(
        &emitter("constant = 1, power_lm = 10", PLANE),
        "objects[0].material",
        &["infinite plane", "`power_lm`"],
    );
}

/// As documented: at 0 stops 72 983 cd/m² are white, the luminance of radiance 1 at every wavelength; and 1000 cd/m² of D65
/// have a radiance of up to 0.0163, at 460 nm.
#[test]
fn white_at_no_exposure_and_what_d65_is_in_radiance() {
    let white = scale(&scene(&emitter(
        "constant = 1, luminance_cd_m2 = 72983",
        SPHERE,
    )));
    assert!((white - 1.0).abs() < 1e-4, "{white}");
    let panel = scene(&emitter(
        "illuminant = 'D65', luminance_cd_m2 = 1000",
        SPHERE,
    ));
    let emission = panel.emitters()[0].emission;
    let peak = emission.scale * panel.spectrum(emission.spectrum).extent().1;
    assert!((peak - 0.0163).abs() < 5e-5, "{peak}");
}

#[test]
fn lights_that_no_ray_meets_are_refused_where_rays_alone_look_for_them() {
    let with = |way: &str, light: &str| {
        format!(
            "[render]\ndirect_light = '{way}'\n[[lights]]\nemission = {{ constant = 1 }}\n{light}\n"
        )
    };
    let lights = [
        ("type = 'point'\nposition = [0, 1, 0]", "a point"),
        (
            "type = 'spot'\nposition = [0, 1, 0]\ndirection = [0, -1, 0]\nangle_deg = 30",
            "a spot",
        ),
        (
            "type = 'distant'\ndirection = [0, 1, 0]\ndiameter_deg = 0",
            "a single direction",
        ),
    ];
    for (light, what) in lights {
        refused(
            &with("bsdf", light),
            "lights[0]",
            &[what, "\"bsdf\"", "would be dark"],
        );
        scene(&with("both", light));
        scene(&with("emitters", light));
    }
    scene(&with("bsdf", "type = 'distant'\ndirection = [0, 1, 0]"));
}

/// A point light is never seen in a smooth mirror.
#[test]
fn light_that_no_surface_can_show_is_noted() {
    const POINT: &str =
        "[[lights]]\ntype = 'point'\nposition = [2, 3, 4]\nemission = { constant = 1 }\n";
    let ball = |name: &str, material: &str| {
        format!("[materials.{name}]\n{material}\n[[objects]]\nmaterial = '{name}'\n{SPHERE}\n")
    };
    let gold = ball("gold", "type = 'conductor'\nindex = 'gold'");
    let soap = ball("soap", "type = 'film'\nindex = 1.33\nthickness_nm = 300");
    let rough = ball(
        "rough",
        "type = 'conductor'\nindex = 'gold'\nroughness = 0.2",
    );
    let white = ball("white", "type = 'diffuse'\nreflectance = 1");
    let glow = ball("glow", "type = 'emitter'\nemission = { constant = 1 }");
    let sun = "[[lights]]\ntype = 'distant'\ndirection = [0, -1, 0]\ndiameter_deg = 0.5\nemission = { constant = 1 }\n";
    let says = |rest: &[&str]| {
        let notes = scene(&rest.concat()).notes();
        notes.iter().any(|note| note.contains("never visible"))
    };
    assert!(says(&[&gold, POINT]) && says(&[&gold, &soap, POINT]));
    for lit in [&rough, &white, &glow] {
        assert!(!says(&[&gold, lit, POINT]), "{lit}");
    }
    assert!(!says(&[&gold, POINT, sun]));
    assert!(!says(&[
        &gold,
        "[environment]\ntype = 'constant'\nemission = { constant = 1 }\n",
        POINT
    ]));
}

#[test]
fn a_scene_that_may_not_be_meant_is_noted() {
    let notes = |rest: &str| scene(rest).notes();
    let dark = notes("");
    assert!(
        dark.len() == 1 && dark[0].contains("nothing emits light"),
        "{dark:?}"
    );
    assert_eq!(notes(&emitter("constant = 0", PLANE)).len(), 1);
    for (lit, lamps) in [
        (emitter("constant = 1", PLANE), 1),
        (
            "[environment]\ntype = 'constant'\nemission = { constant = 1 }\n".to_owned(),
            0,
        ),
        (
            "[environment]\ntype = 'sky'\nsun_elevation_deg = 30\n".to_owned(),
            1,
        ),
    ] {
        let scene = scene(&lit);
        assert!(scene.notes().is_empty(), "{lit}: {:?}", scene.notes());
        assert_eq!(scene.lamps(), lamps, "{lit}");
        assert_eq!(scene.is_lit_by_environment(), lit.starts_with("[env"));
    }
    let printed = |rest: &str, segments: u32| {
        notes(&format!(
            "[render]\nmax_path_segments = {segments}\n[environment]\ntype = 'constant'\nemission = {{ constant = 1 }}\n\
             [materials.x]\ntype = 'conductor'\nindex = 'gold'\nroughness = 0.3\nmodel = {{ cook1981 = {{ {rest} }} }}\n\
             [[objects]]\nmaterial = 'x'\n{SPHERE}\n"
        ))
    };
    let said = printed("", 12);
    assert!(
        said.len() == 1 && said[0].contains("4.0 times") && said[0].contains("(found 12)"),
        "{said:?}"
    );
    for (rest, segments) in [
        ("", 2),
        ("normalization = 'normalized'", 12),
        ("specular = 0.25", 12),
    ] {
        assert_eq!(
            printed(rest, segments),
            Vec::<String>::new(),
            "{rest} {segments}"
        );
    }
}

fn refused_spot(angles: &str, field: &str, phrases: &[&str]) {
    let light = format!(
        "type = 'spot'\nposition = [0, 1, 0]\ndirection = [0, -1, 0]\nemission = {{ constant = 1 }}\n{angles}"
    );
    refused_light(&light, field, phrases);
}

cases! { refused_spot:
    a_spot_with_an_edge_too_narrow("angle_deg = 40\nfull_angle_deg = 45", ".full_angle_deg", &["0 to 39.6"]);
    a_spot_that_is_too_wide("angle_deg = 200", ".angle_deg", &["0.1 to 180"]);
}

fn refused_distant(rest: &str, field: &str, phrases: &[&str]) {
    let light = format!("type = 'distant'\nemission = {{ constant = 1 }}\n{rest}");
    refused_light(&light, field, phrases);
}

cases! { refused_distant:
    a_distant_light_from_nowhere("direction = [0, 0, 0]", ".direction", &["no direction"]);
    a_distant_light_that_is_too_narrow("direction = [0, 1, 0]\ndiameter_deg = 0.001", ".diameter_deg", &["0 or at least 0.01"]);
    a_light_group_with_a_bad_name("direction = [0, 1, 0]\nlight_group = 'a b'", ".light_group", &["cannot be the name"]);
}

#[test]
fn the_sun_is_half_a_degree_wide_and_disks_come_first() {
    let text = "[[lights]]\ntype = 'point'\nposition = [0, 1, 0]\nemission = { constant = 1 }\nlight_group = 'lamp'\n\
                [[lights]]\ntype = 'distant'\ndirection = [0, 2, 0]\nemission = { constant = 3 }\nlight_group = 'sun'\n";
    let scene = scene(text);
    let LightShape::DistantDisk { height, .. } = scene.lights()[0].shape else {
        panic!("{:?}", scene.lights());
    };
    let half: f64 = (1.0 - height).acos().to_degrees();
    assert!((2.0 * half - 0.533).abs() < 1e-6, "{half}");
    let kinds: Vec<_> = scene.emitters().iter().map(|source| source.kind).collect();
    assert_eq!(kinds, [EmitterKind::Environment(1), EmitterKind::Light(1)]);
    let names: Vec<_> = scene
        .light_groups()
        .iter()
        .map(|group| group.name.as_str())
        .collect();
    let of = |index: usize| names[scene.lights()[index].emission.light_group.index()];
    assert_eq!((of(0), of(1)), ("sun", "lamp"));
}
