//! Conductors with the model of Cook and Torrance, and dielectrics: how they are read, and what is refused.

use crate::{CAMERA, read};
use pellicle_scene_file::Problems;
use scene::{Material, Scene};
use std::f64::consts::PI;

fn scene(material: &str) -> Result<Scene, Problems> {
    let text = format!(
        "{CAMERA}[materials]\na = {material}\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'a'\ncenter = [0, 0, 0]\nradius = 1\n"
    );
    read(&text, "")
}

fn cook(index: &str, model: &str) -> scene::Cook1981 {
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
    let normalized = cook(
        "'gold'",
        "model = { cook1981 = { normalization = 'normalized', specular = 0.5, slopes = [{ m = 0.2, weight = 0.25 }, { m = 0.5, weight = 0.75 }] } }",
    );
    assert!((normalized.facets[1].weight - 0.5 * 0.75 / (4.0 * PI)).abs() < 1e-15);
    let gaussian = cook(
        "'gold'",
        "roughness = 0.3, model = { cook1981 = { distribution = 'gaussian', constant = 2 } }",
    );
    assert!((gaussian.facets[0].weight - 2.0 / PI).abs() < 1e-15);
}

#[test]
fn a_normal_reflectance_is_an_index() {
    let scene = scene("{ type = 'conductor', index = { normal_reflectance = 0.04 } }").unwrap();
    let Material::Interface { n, k, .. } = scene.materials()[0] else {
        panic!("{:?}", scene.materials());
    };
    let (low, high) = scene.spectrum(n).extent();
    assert!((low - 1.5).abs() < 1e-12 && (high - 1.5).abs() < 1e-12);
    assert_eq!(scene.spectrum(k).extent(), (0.0, 0.0));
}

#[test]
fn a_dielectric_without_a_base_is_opaque() {
    let opaque = scene("{ type = 'dielectric', index = [1.5, 0.1] }").unwrap();
    assert!(matches!(opaque.materials()[0], Material::Interface { .. }));
    let enamel = scene("{ type = 'dielectric', index = 1.5, base = 0.5 }").unwrap();
    let Material::CoatedBody(body) = &enamel.materials()[0] else {
        panic!("{:?}", enamel.materials());
    };
    // Judd 1942: 0.0918.
    assert!((enamel.spectrum(body.mean_reflectance).extent().0 - 0.0918).abs() < 5e-5);
}

/// Tables of clear media have a k that is too small to show in a coat.
#[test]
fn real_glasses_are_clear_coats() {
    for name in ["bk7", "sf11", "soda_lime", "water_hale", "silica"] {
        let scene = scene(&format!(
            "{{ type = 'dielectric', index = '{name}', base = 0.5 }}"
        ));
        let scene = scene.unwrap_or_else(|problems| panic!("{name}: {problems:#}"));
        let Material::CoatedBody(body) = &scene.materials()[0] else {
            panic!("{name}: {:?}", scene.materials());
        };
        assert_eq!(scene.spectrum(body.k).extent(), (0.0, 0.0), "{name}");
        assert_eq!(body.k, body.n.after(1), "{name}");
    }
    // 1 − exp(−8π k d / λ) at the bound: 1 % for 20 µm, 5 % for 0.1 mm.
    let lost = |d_nm: f64| {
        1.0 - (-8.0 * PI * pellicle_scene_file::limits::CLEAR_COAT_K * d_nm / 500.0).exp()
    };
    assert!((lost(20e3) - 0.01).abs() < 2e-4 && (lost(100e3) - 0.049).abs() < 1e-3);
}

/// Fraction of the light from `degrees` that perfectly reflecting facets reflect with the normalized constant: ∫ D̂ G (E·H) / (N·E)
/// dω over the facets whose mirror image of E is above the surface.
fn albedo(distribution: &str, slope: f64, degrees: f64) -> f64 {
    let is_gaussian = distribution == "gaussian";
    let steps = 400;
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let constant = if is_gaussian {
        optics::gaussian_constant(slope)
    } else {
        1.0 / PI
    };
    let mut sum = 0.0;
    for (i, j) in (0..steps).flat_map(|i| (0..steps).map(move |j| (i, j))) {
        let at = |index: i32| (f64::from(index) + 0.5) / f64::from(steps);
        let ((facet_sine, facet_cosine), turn) = ((0.5 * PI * at(i)).sin_cos(), PI * at(j));
        let seen = sine * facet_sine * turn.cos() + cosine * facet_cosine;
        let light = 2.0 * seen * facet_cosine - cosine;
        if seen > 0.0 && light > 0.0 {
            let density = if is_gaussian {
                optics::gaussian_d1(facet_cosine, slope)
            } else {
                optics::beckmann_d2(facet_cosine, slope)
            };
            let g = optics::v_groove_g(facet_cosine, cosine, light, seen);
            sum += constant * density * g * seen / cosine * 2.0 * facet_sine;
        }
    }
    sum * 0.5 * PI * PI / f64::from(steps * steps)
}

/// The values in docs/metals.md.
#[test]
fn what_the_normalized_model_loses() {
    for (distribution, slope, returned) in [
        ("beckmann", 0.3, 0.984),
        ("beckmann", 0.5, 0.878),
        ("beckmann", 1.0, 0.514),
        ("gaussian", 0.3, 0.979),
        ("gaussian", 0.5, 0.857),
        ("gaussian", 1.0, 0.589),
    ] {
        let found = albedo(distribution, slope, 27.0);
        assert!(
            (found - returned).abs() < 1e-3,
            "{distribution} {slope}: {found}"
        );
    }
}

/// Gain with the printed constants. ∫ exp(−a²/m²) sin 2a da = m F(m) with Dawson's F(0.3) = 0.28263, so D₁ with c = 1 has
/// 4 m F(m) = 0.339 (Abramowitz and Stegun, table 7.5).
#[test]
fn the_gain_of_the_printed_constants() {
    let gain = |model: &str| cook("'gold'", &format!("roughness = 0.3, model = {model}")).gain;
    assert!((gain("'cook1981'") - 4.0).abs() < 1e-12);
    assert!(
        (gain("{ cook1981 = { normalization = 'normalized', specular = 0.7 } }") - 0.7).abs()
            < 1e-12
    );
    let printed = gain("{ cook1981 = { distribution = 'gaussian' } }");
    assert!((printed - 4.0 * 0.3 * 0.28263).abs() < 1e-4, "{printed}");
}

/// A material has one problem, at the given field and with the given words.
fn refused(material: &str, field: &str, words: &str) {
    let problems = scene(material).expect_err(material);
    let reported: Vec<_> = problems.iter().collect();
    assert_eq!(reported.len(), 1, "{problems:#}");
    assert_eq!(reported[0].field.to_string(), format!("materials.a{field}"));
    assert!(
        reported[0].message.contains(words),
        "{}",
        reported[0].message
    );
}

/// A conductor of gold with these fields is refused.
fn gold(rest: &str, field: &str, words: &str) {
    let material = format!("{{ type = 'conductor', index = 'gold', {rest} }}");
    refused(&material, field, words);
}

cases! { gold:
    cooks_model_without_a_roughness("model = 'cook1981'", "", "give the material a `roughness`");
    cooks_model_of_another_distribution(
        "roughness = 0.3, distribution = 'ggx', model = 'cook1981'",
        ".distribution",
        "cannot use",
    );
    a_constant_of_d2(
        "roughness = 0.3, model = { cook1981 = { constant = 2 } }",
        ".model.cook1981.constant",
        "only D1",
    );
    slopes_whose_weights_do_not_sum_to_1(
        "model = { cook1981 = { slopes = [{ m = 0.2, weight = 0.4 }] } }",
        ".model.cook1981.slopes",
        "sum to 0.4",
    );
    a_roughness_and_slopes(
        "roughness = 0.3, model = { cook1981 = { slopes = [{ m = 0.2, weight = 1 }] } }",
        ".model.cook1981.slopes",
        "only one of them",
    );
    a_diffuse_part_that_is_too_bright(
        "roughness = 0.3, model = { cook1981 = { diffuse = 0.4, diffuse_reflectance = 0.5 } }",
        ".model.cook1981.diffuse",
        "at most 1",
    );
    a_diffuse_part_without_a_reflectance(
        "roughness = 0.3, model = { cook1981 = { specular = 0.5, diffuse = 0.4 } }",
        ".model.cook1981.diffuse_reflectance",
        "needs",
    );
    a_constant_that_is_too_large(
        "roughness = 0.3, model = { cook1981 = { distribution = 'gaussian', constant = 1e6 } }",
        ".model.cook1981.constant",
        "at most 16 times is possible, which is 4.718e1",
    );
    ambient_light_with_a_power(
        "roughness = 0.3, model = { cook1981 = { ambient = { constant = 1, power_w = 1 } } }",
        ".model.cook1981.ambient.power_w",
        "ambient light has no `power_w`",
    );
}

cases! { refused:
    a_normal_reflectance_near_1(
        "{ type = 'conductor', index = { normal_reflectance = 0.999 } }",
        ".index.normal_reflectance",
        "0.996",
    );
    a_coat_of_gold(
        "{ type = 'dielectric', index = 'gold', base = 0.5 }",
        ".index",
        "must be clear (k at most 1e-5)",
    );
    a_coat_that_absorbs(
        "{ type = 'dielectric', index = [1.5, 1e-4], base = 0.5 }",
        ".index",
        "found k = 0.0001",
    );
    a_normal_reflectance_above_1(
        "{ type = 'conductor', index = { normal_reflectance = 1.5 } }",
        ".index.normal_reflectance",
        "0 to 0.996",
    );
    a_normal_reflectance_above_1_in_a_table(
        "{ type = 'conductor', index = { normal_reflectance = { nm = [380, 780], values = [0.5, 1.5] } } }",
        ".index.normal_reflectance.values[1]",
        "found 1.5; it must be from 0 to 0.996",
    );
    a_normal_reflectance_of_white(
        "{ type = 'conductor', index = { normal_reflectance = { linear_srgb = [1, 1, 1] } } }",
        ".index.normal_reflectance",
        "nm; it must be from 0 to 0.996",
    );
    a_normal_reflectance_by_name(
        "{ type = 'conductor', index = { normal_reflectance = 'gold' } }",
        ".index.normal_reflectance",
        "the name of an index",
    );
}
