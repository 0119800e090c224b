//! The whole BSDF of every surface that scatters, with its spectrum: against the reference, and with `wo` and `wi` exchanged (Helmholtz
//! reciprocity). Smooth surfaces and films only reflect specularly and transmit, by a factor of a single cosine.

use crate::world::{BANDS, World, direction, pick, rows, within};
use crate::{Check, lazy};
use glam::DVec3;
use gpu::PackedScene;
use pellicle_tests::cases::report;
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::{RECIPROCITY, SURFACE_FUNCTIONS};
use reference::{PreparedScene, SurfaceFunction, SurfacePoint};
use scene::Shape;
use scene_file::SceneFile;
use std::path::Path;
use std::sync::OnceLock;

const MATERIALS: &[&str] = &[
    "type = 'diffuse', reflectance = 'red'",
    "type = 'conductor', index = 'gold', roughness = 0.15",
    "type = 'conductor', index = 'copper', roughness = 0.9, distribution = 'ggx'",
    "type = 'conductor', index = 'silver', roughness = [0.15, 0.5], brushed = { along = [1, 0, 0] }",
    "type = 'conductor', index = 'tungsten', roughness = [0.9, 0.3], distribution = 'ggx', brushed = { along = [1, 0, 0] }",
    "type = 'coated', substrate = 'titanium', index = 2.4, thickness_nm = 150, roughness = 0.4",
    "type = 'coated', substrate = 'gold', roughness = [0.5, 0.2], distribution = 'ggx', brushed = { along = [1, 0, 0] },
     layers = [{ index = 1.46, thickness_nm = { pole = 80, equator = 250 } }, { index = [1.6, 0.05], thickness_nm = 60 }]",
    "type = 'dielectric', index = 1.5, base = 'red'",
    "type = 'dielectric', index = { cauchy = [1.5, 0.01] }, base = 'orange', roughness = 0.3",
    "type = 'dielectric', index = 1.6, base = 0.9, roughness = [0.2, 0.6], distribution = 'ggx', brushed = { along = [1, 0, 0] }",
    "type = 'dielectric', index = [1.5, 0.1], roughness = 0.3",
    "type = 'conductor', index = 'gold', roughness = 0.3, model = 'cook1981'",
    "type = 'conductor', index = { normal_reflectance = 0.7 }, model = { cook1981 = { distribution = 'gaussian',
     slopes = [{ m = 0.2, weight = 0.4 }, { m = 0.6, weight = 0.6 }], specular = 0.7, diffuse = 0.3, diffuse_reflectance = 'red' } }",
    "type = 'conductor', index = 'aluminum', model = { cook1981 = { normalization = 'normalized',
     slopes = [{ m = 0.2, weight = 0.5 }, { m = 0.9, weight = 0.5 }], specular = 0.9, diffuse = 0.1, diffuse_reflectance = 0.5 } }",
];

const RADIUS: f64 = 0.25;

/// A world with a sphere of each material.
fn world() -> &'static World {
    static WORLD: OnceLock<World> = OnceLock::new();
    WORLD.get_or_init(|| {
        let each = |f: fn(usize, &str) -> String| -> String {
            MATERIALS.iter().enumerate().map(|(i, m)| f(i, m)).collect()
        };
        let materials = each(|i, m| format!("m{i} = {{ {} }}, ", m.replace('\n', " ")));
        let objects = each(|i, _| {
            format!(
                "[[objects]]\ntype = 'sphere'\nmaterial = 'm{i}'\ncenter = [{i}, 0, 0]\nradius = {RADIUS}\n"
            )
        });
        let text = format!(
            "camera = {{ type = 'orthographic', position = [0, 0, 9], look_at = [0, 0, 0], height = 9 }}\n\
             environment = {{ type = 'constant', emission = {{ constant = 1 }} }}\n\
             render = {{ bands = {BANDS} }}\nmaterials = {{ {} }}\n{objects}",
            materials.trim_end_matches(", ")
        );
        let scene = SceneFile::parse("surfaces", &text, Path::new(""))
            .and_then(|file| file.validate())
            .unwrap_or_else(|problems| panic!("{problems}"))
            .rounded_to_f32();
        let packed = PackedScene::new(&scene);
        World { scene, packed }
    })
}

/// The normal where a sphere is hit.
const NORMAL: DVec3 = DVec3::new(0.6, 0.8, 0.0);

const BODY: &str = "
    let object = u32(a(0u));
    let material = shape_at(object).material;
    let at = At(0u, u32(a(1u)), wavelengths_at(a(2u)));
    let normal = vec3f(0.6, 0.8, 0.0);
    let position = shape_at(object).center + shape_at(object).radius * normal;
    let directions = array<vec3f, 2>(a3(3u), a3(6u));
    for (var i = 0u; i < 2u; i++) {
        let wo = directions[i];
        let wi = directions[1u - i];
        begin_record();
        pending.factor = bsdf_factor(object, SurfacePoint(position, normal, wo.z, true), 0.5);
        pending_body.wo_cosine = wo.z;
        let eval = bsdf_eval(material, wo, wi);
        record_onward(eval.lobes, 1.0);
        record_lit(eval.lobes, 2.0);
        is_pending = true;
        write_vertex();
        let found = bsdf_value(at, vertices[0], factor_value(vertices[0].factor, at));
        // Both ways in which a vertex uses it.
        put4(4u * i, 0.5 * (found.onward + 0.5 * found.lit) / wi.z);
    }";

/// f(wo, wi) in the four bands of a group, and f(wi, wo).
fn both_ways(a: &[f64]) -> Vec<f64> {
    static PREPARED: OnceLock<PreparedScene> = OnceLock::new();
    let (world, object) = (world(), a[0] as usize);
    let prepared = PREPARED.get_or_init(|| PreparedScene::new(&world.scene));
    let Shape::Sphere { center, radius } = *world.shape(object) else {
        panic!("the world has only spheres");
    };
    let (first, second) = (DVec3::from_slice(&a[3..]), DVec3::from_slice(&a[6..]));
    let one_way = |wo: DVec3, wi: DVec3| {
        let point = SurfacePoint {
            position: center + radius * NORMAL,
            normal: NORMAL,
            cosine: wo.z,
            is_front: true,
        };
        let surface = SurfaceFunction::new(prepared, object, &point, a[2], 0.5);
        let values = surface.expect("all materials scatter").values(wo, wi);
        let bands = (0..4).map(|band| 4 * a[1] as usize + band);
        bands.map(|band| values[band] / wi.z).collect::<Vec<_>>()
    };
    [one_way(first, second), one_way(second, first)].concat()
}

/// Rows of an object, a group of bands, an offset, and two directions.
fn pairs_of_directions() -> Vec<f32> {
    rows(6, |u| {
        let object = pick(&(0..MATERIALS.len()).collect::<Vec<_>>(), u[0]) as f64;
        let group = (f64::from(BANDS / 4) * u[1]).floor();
        // Grazing light beyond 87° is left out: a film's phase is steep there.
        let first = direction(0.05 + 0.95 * u[2], u[3]);
        let second = direction(0.05 + 0.95 * u[4], u[5]);
        // The offset equals the azimuth, which tests as much as a separate number.
        Some(
            [
                &[object, group, u[3]][..],
                &first.to_array(),
                &second.to_array(),
            ]
            .concat(),
        )
    })
}

pub(crate) fn checks() -> Vec<Check> {
    vec![Check {
        probe: within(world, (9, 8), BODY),
        proves: &[
            "begin_record",
            "begin_vertex",
            "bsdf_eval",
            "bsdf_factor",
            "coated_eval",
            "coated_factor",
            "coated_value",
            "coating_value",
            "cook_eval",
            "cook_factor",
            "cook_value",
            "dark",
            "diffuse_eval",
            "interface_eval",
            "interface_factor",
            "load_coated",
            "load_cook",
            "multiple_color",
            "record_lit",
            "record_onward",
            "with_multiple",
            "write_vertex",
        ],
        inputs: lazy(pairs_of_directions),
        twin: both_ways,
        tolerance: SURFACE_FUNCTIONS,
    }]
}

/// Largest relative difference between the two directions, over all rows; NaN where either is NaN.
fn asymmetry(values: &[f64], by_row: impl Fn(usize) -> f64) -> f64 {
    let of_row = |(row, both): (usize, &[f64])| {
        let (there, back) = both.split_at(4);
        let pairs = there.iter().zip(back);
        let off = |(f, g): (&f64, &f64)| (f - g * by_row(row)).abs() / (f + RECIPROCITY.absolute);
        pairs.map(off).fold(0.0, larger)
    };
    values.chunks(8).enumerate().map(of_row).fold(0.0, larger)
}

/// The larger of two, or NaN: `f64::max` would drop it.
fn larger(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}

/// The BSDFs of both renderers, with their spectra, are reciprocal within 1e-5; multiplied by the cosine they are not.
pub(crate) fn surfaces_are_reciprocal() {
    let check = &checks()[0];
    let found = check.probe.run(&lend(), &check.inputs);
    let on_gpu: Vec<f64> = found.iter().map(|&x| f64::from(x)).collect();
    let rows: Vec<Vec<f64>> = check
        .inputs
        .chunks(9)
        .map(|row| row.iter().map(|&x| f64::from(x)).collect())
        .collect();
    let on_cpu: Vec<f64> = rows.iter().flat_map(|row| both_ways(row)).collect();
    for (who, values) in [("gpu", on_gpu), ("cpu", on_cpu)] {
        let off = asymmetry(&values, |_| 1.0);
        report(&format!("{who}: {off:.1e}"));
        assert!(off < RECIPROCITY.relative, "{who}: {off}");
        let with_cosines = asymmetry(&values, |row| rows[row][8] / rows[row][5]);
        assert!(with_cosines > 0.1, "{who}: {with_cosines}");
        for broken in [0, values.len() / 2, values.len() - 1] {
            let mut values = values.clone();
            values[broken] = f64::NAN;
            assert!(asymmetry(&values, |_| 1.0).is_nan(), "{who}: {broken}");
        }
    }
}
