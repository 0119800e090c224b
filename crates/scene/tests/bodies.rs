//! Conductors by Cook's model, and dielectrics: what becomes of what is written, and what is refused.

use pellicle_scene::{Material, Problems, Scene, SceneFile};
use std::f64::consts::PI;
use std::path::Path;

fn scene(material: &str) -> Result<Scene, Problems> {
    let text = format!(
        "camera = {{ type = 'perspective', position = [0, 0, 5], look_at = [0, 0, 0], fov_deg = 40 }}\n\
         [materials]\na = {material}\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'a'\ncenter = [0, 0, 0]\nradius = 1\n"
    );
    SceneFile::parse("bodies.toml", &text, Path::new("")).and_then(|file| file.validate())
}

fn cook(index: &str, model: &str) -> pellicle_scene::Cook1981 {
    let material = format!("{{ type = 'conductor', index = {index}, {model} }}");
    match scene(&material)
        .unwrap_or_else(|p| panic!("{p:#}"))
        .materials()[0]
        .clone()
    {
        Material::Cook(cook) => cook,
        other => panic!("{other:?}"),
    }
}

#[test]
fn constants_and_weights_become_one_weight() {
    let plain = cook("'gold'", "roughness = 0.3, model = 'cook1981'");
    assert_eq!(plain.facets.len(), 1);
    assert!((plain.facets[0].weight - 1.0 / PI).abs() < 1e-15);
    assert!(plain.diffuse.is_none() && plain.ambient.is_none());
    let normalised = cook(
        "'gold'",
        "model = { cook1981 = { normalisation = 'normalised', specular = 0.5, slopes = [{ m = 0.2, weight = 0.25 }, { m = 0.5, weight = 0.75 }] } }",
    );
    assert!((normalised.facets[1].weight - 0.5 * 0.75 / (4.0 * PI)).abs() < 1e-15);
    let gaussian = cook(
        "'gold'",
        "roughness = 0.3, model = { cook1981 = { distribution = 'gaussian', constant = 2 } }",
    );
    assert!((gaussian.facets[0].weight - 2.0 / PI).abs() < 1e-15);
}

#[test]
fn a_normal_reflectance_is_an_index() {
    let scene = scene("{ type = 'conductor', index = { normal_reflectance = 0.04 } }").unwrap();
    let Material::Conductor { n, k, .. } = scene.materials()[0] else {
        panic!("{:?}", scene.materials());
    };
    let (low, high) = scene.spectrum(n).extent();
    assert!((low - 1.5).abs() < 1e-12 && (high - 1.5).abs() < 1e-12);
    assert_eq!(scene.spectrum(k).extent(), (0.0, 0.0));
}

#[test]
fn a_dielectric_without_a_base_is_opaque() {
    let opaque = scene("{ type = 'dielectric', index = [1.5, 0.1] }").unwrap();
    assert!(matches!(opaque.materials()[0], Material::Conductor { .. }));
    let enamel = scene("{ type = 'dielectric', index = 1.5, base = 0.5 }").unwrap();
    let Material::CoatedBody(body) = &enamel.materials()[0] else {
        panic!("{:?}", enamel.materials());
    };
    // Judd 1942: 0.0918.
    assert!((enamel.spectrum(body.mean_reflectance).extent().0 - 0.0918).abs() < 5e-5);
}

#[test]
fn what_does_not_fit_is_told() {
    let conductor = |rest: &str| format!("{{ type = 'conductor', index = 'gold', {rest} }}");
    for (material, field, words) in [
        (
            conductor("model = 'cook1981'"),
            "materials.a",
            "give a `roughness`",
        ),
        (
            conductor("roughness = 0.3, distribution = 'ggx', model = 'cook1981'"),
            "materials.a.distribution",
            "cannot use",
        ),
        (
            conductor("roughness = 0.3, model = { cook1981 = { constant = 2 } }"),
            "materials.a.model.cook1981.constant",
            "only D1",
        ),
        (
            conductor("model = { cook1981 = { slopes = [{ m = 0.2, weight = 0.4 }] } }"),
            "materials.a.model.cook1981.slopes",
            "sum to 0.4",
        ),
        (
            conductor(
                "roughness = 0.3, model = { cook1981 = { slopes = [{ m = 0.2, weight = 1 }] } }",
            ),
            "materials.a.model.cook1981.slopes",
            "either",
        ),
        (
            conductor(
                "roughness = 0.3, model = { cook1981 = { diffuse = 0.4, diffuse_reflectance = 0.5 } }",
            ),
            "materials.a.model.cook1981.diffuse",
            "at most 1",
        ),
        (
            conductor("roughness = 0.3, model = { cook1981 = { specular = 0.5, diffuse = 0.4 } }"),
            "materials.a.model.cook1981.diffuse_reflectance",
            "needs",
        ),
        (
            "{ type = 'conductor', index = { normal_reflectance = 0.999 } }".to_owned(),
            "materials.a.index.normal_reflectance",
            "0.996",
        ),
        (
            "{ type = 'dielectric', index = 'gold', base = 0.5 }".to_owned(),
            "materials.a.index",
            "must be clear",
        ),
    ] {
        let problems = scene(&material).expect_err(&material);
        let told: Vec<_> = problems.iter().collect();
        assert_eq!(told.len(), 1, "{material}: {problems:#}");
        assert_eq!(told[0].field.to_string(), field, "{material}");
        assert!(
            told[0].message.contains(words),
            "{material}: {}",
            told[0].message
        );
    }
}
