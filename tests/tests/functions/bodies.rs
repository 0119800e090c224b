//! Functions of gaussian.wgsl, and of Cook's model and coats in bsdf/.

use crate::world::{World, direction, pick, rows, within};
use crate::{Check, lazy, pure, table};
use pellicle_tests::tolerances::{
    ARITHMETIC, BECKMANN, DIRECTION, FACET, FACET_ENERGY, FRESNEL, TRIGONOMETRY,
};
use reference::{coat_probability, cook_facets, sample_cook_facet};
use scene::{CoatedBody, Cook1981, Material};
use std::sync::OnceLock;

pub(crate) fn checks() -> Vec<Check> {
    let mut all = gaussian();
    all.extend([between_directions(), facets()]);
    all.extend(coats());
    all.extend([rough_coats(), transmittance_scales()]);
    all
}

fn world() -> &'static World {
    static WORLD: OnceLock<World> = OnceLock::new();
    WORLD.get_or_init(|| World::new("everything_bodies"))
}

fn gaussian() -> Vec<Check> {
    let slopes = (0.05, 1.0);
    let of_facet = |proves, body, twin, tolerance| Check {
        probe: pure((2, 1), body),
        proves,
        inputs: lazy(move || {
            table(
                &[(0.02, 1.0), slopes],
                &[
                    &[1.0, 0.05],
                    &[0.0, 0.1],
                    &[-1.0, 0.1],
                    &[0.999_999_9, 0.02],
                ],
            )
        }),
        twin,
        tolerance,
    };
    vec![
        of_facet(
            &["gaussian_d1"],
            "put(0u, gaussian_d1(a(0u), a(1u)));",
            |a| vec![optics::gaussian_d1(a[0], a[1])],
            BECKMANN,
        ),
        of_facet(
            &["gaussian_pdf"],
            "put(0u, gaussian_pdf(a(0u), a(1u)));",
            |a| vec![optics::gaussian_pdf(a[0], a[1])],
            BECKMANN,
        ),
        Check {
            probe: pure((1, 1), "put(0u, facet_angle(a(0u)));"),
            proves: &["facet_angle"],
            inputs: lazy(move || table(&[(0.0, 1.0)], &[&[0.0], &[1.0], &[0.999_999_9]])),
            twin: |a| vec![((1.0 - a[0]) * (1.0 + a[0])).sqrt().atan2(a[0])],
            tolerance: TRIGONOMETRY,
        },
        Check {
            probe: pure((1, 1), "put(0u, gaussian_fraction(a(0u)));"),
            proves: &["gaussian_fraction"],
            inputs: lazy(move || table(&[slopes], &[&[0.02], &[1.0]])),
            twin: |a| vec![optics::gaussian_fraction(a[0])],
            tolerance: ARITHMETIC,
        },
        Check {
            probe: pure((3, 3), "put3(0u, sample_gaussian(a(0u), a(1u), a(2u)));"),
            proves: &["sample_gaussian"],
            inputs: lazy(move || {
                table(
                    &[(0.0, 0.999_999), (0.0, 0.999_999), slopes],
                    &[&[0.0, 0.0, 0.1], &[0.999_999_9, 0.5, 1.0]],
                )
            }),
            twin: |a| optics::sample_gaussian(a[0], a[1], a[2]).to_vec(),
            tolerance: DIRECTION,
        },
    ]
}

/// The materials of a kind.
fn indices_of(wanted: fn(&Material) -> bool) -> Vec<usize> {
    let all = world().scene.materials().iter().enumerate();
    all.filter(|(_, material)| wanted(material))
        .map(|(index, _)| index)
        .collect()
}

/// Materials with Cook's model.
fn materials() -> Vec<usize> {
    indices_of(|material| matches!(material, Material::Cook(_)))
}

fn cook(material: f64) -> &'static Cook1981 {
    match &world().scene.materials()[material as usize] {
        Material::Cook(cook) => cook,
        other => panic!("{other:?}"),
    }
}

fn between(a: &[f64]) -> Vec<f64> {
    let found = cook_facets(cook(a[0]), direction(a[1], 0.0), direction(a[2], a[3]));
    vec![found.reflection, found.pdf, found.cosine]
}

fn between_directions() -> Check {
    Check {
        probe: within(
            world,
            (4, 3),
            "let wo = vec3f(sqrt(1.0 - a(1u) * a(1u)), 0.0, a(1u));
             let wi = direction_at(2u);
             let f = cook_facets(u32(a(0u)), wo, wi);
             put(0u, f.reflection); put(1u, f.pdf); put(2u, f.cosine);",
        ),
        proves: &["cook_facets", "cook_of"],
        inputs: lazy(|| {
            let materials = materials();
            rows(4, |u| {
                let cosine = |u: f64| if u < 0.02 { -u } else { 0.03 + 0.97 * u };
                let material = pick(&materials, u[0]) as f64;
                Some(vec![material, cosine(u[1]), cosine(u[2]), u[3]])
            })
        }),
        twin: between,
        tolerance: FACET,
    }
}

fn facets() -> Check {
    Check {
        probe: within(
            world,
            (4, 3),
            "put3(0u, sample_cook_facet(u32(a(0u)), a(1u), a(2u), a(3u)));",
        ),
        proves: &["sample_cook_facet"],
        inputs: lazy(|| {
            let materials = materials();
            rows(4, |u| {
                let material = pick(&materials, u[0]);
                // Away from the values at which the choice changes.
                let mut below = 0.0;
                let is_clear = cook(material as f64).facets.iter().all(|facets| {
                    below += facets.part;
                    (below - u[3]).abs() > 1e-5
                });
                is_clear.then(|| vec![material as f64, u[1], u[2], u[3]])
            })
        }),
        twin: |a| {
            sample_cook_facet(cook(a[0]), [a[1], a[2], a[3]])
                .to_array()
                .to_vec()
        },
        tolerance: DIRECTION,
    }
}

/// Transmittance of a rough coat from the spectra of a table, in the bands of a group.
fn rough_coat(a: &[f64]) -> Vec<f64> {
    let scene = &world().scene;
    let Material::CoatedBody(body) = &scene.materials()[a[0] as usize] else {
        panic!("{a:?}");
    };
    let first = body.reflectances.expect("the coat is rough");
    let place = a[1].sqrt() * (CoatedBody::COSINES - 1) as f64;
    let knot = (place as usize).min(CoatedBody::COSINES - 2);
    let at = |knot: usize| scene.spectrum(first.after(knot)).at(4 + a[2] as u32, a[3]);
    vec![1.0 - (at(knot) + (at(knot + 1) - at(knot)) * (place - knot as f64))]
}

/// Bases below rough coats.
fn rough_bodies() -> Vec<usize> {
    indices_of(
        |material| matches!(material, Material::CoatedBody(body) if body.microsurface.is_some()),
    )
}

fn rough_coats() -> Check {
    Check {
        probe: within(
            world,
            (4, 1),
            "put(0u, rough_coat_transmittance(coated_of(u32(a(0u))).coat_reflectances, a(1u), 1u, wavelengths_at(a(3u)))[u32(a(2u))]);",
        ),
        proves: &["coated_of", "rough_coat_transmittance"],
        inputs: lazy(|| {
            let coats = rough_bodies();
            rows(4, |u| {
                let lane = (4.0 * u[2]).floor();
                Some(vec![pick(&coats, u[0]) as f64, u[1], lane, u[3]])
            })
        }),
        twin: rough_coat,
        tolerance: FRESNEL,
    }
}

/// Factors by which rough coats transmit more in a direction; one of the coats is brushed.
fn transmittance_scales() -> Check {
    Check {
        probe: within(
            world,
            (3, 1),
            "put(0u, coat_transmittance_scale(load_facets(material_at(u32(a(0u))).facets), direction_at(1u)));",
        ),
        proves: &["coat_transmittance_scale", "over_facets"],
        inputs: lazy(|| {
            let coats = rough_bodies();
            rows(3, |u| {
                Some(vec![pick(&coats, u[0]) as f64, 0.02 + 0.98 * u[1], u[2]])
            })
        }),
        twin: |a| match &world().scene.materials()[a[0] as usize] {
            Material::CoatedBody(body) => vec![body.transmittance_scale_at(direction(a[1], a[2]))],
            other => panic!("{other:?}"),
        },
        tolerance: FACET_ENERGY,
    }
}

fn coats() -> [Check; 3] {
    [
        Check {
            probe: within(
                world,
                (2, 1),
                "put(0u, coat_probability(u32(a(0u)), a(1u)));",
            ),
            proves: &["coat_probability"],
            inputs: lazy(|| {
                let bodies = indices_of(|material| matches!(material, Material::CoatedBody(_)));
                rows(2, |u| Some(vec![pick(&bodies, u[0]) as f64, u[1]]))
            }),
            twin: |a| match &world().scene.materials()[a[0] as usize] {
                Material::CoatedBody(body) => vec![coat_probability(body, a[1])],
                other => panic!("{other:?}"),
            },
            tolerance: FRESNEL,
        },
        Check {
            probe: pure(
                (2, 1),
                "put(0u, coat_transmittance(vec4f(a(0u)), a(1u)).x);",
            ),
            proves: &["coat_transmittance"],
            inputs: lazy(move || {
                table(
                    &[(1.0, 3.0), (0.0, 1.0)],
                    &[&[1.5, 0.0], &[1.0, 0.0], &[1.0, 1.0]],
                )
            }),
            twin: |a| vec![1.0 - optics::reflectance_unpolarized(a[0].into(), a[1].max(1e-6))],
            tolerance: FRESNEL,
        },
        Check {
            probe: pure(
                (3, 1),
                "put(0u, coated_albedo_factor(vec4f(a(0u)), vec4f(a(1u)), vec4f(a(2u))).x);",
            ),
            proves: &["coated_albedo_factor"],
            inputs: lazy(move || {
                table(
                    &[(0.0, 1.0), (0.8, 3.0), (0.0, 0.6)],
                    &[&[1.0, 3.0, 0.6], &[0.0, 1.0, 0.0]],
                )
            }),
            twin: |a| vec![optics::coated_albedo_factor(a[0], a[1], a[2])],
            // n² − ρ (n² − 1) cancels, up to 9 against 8.6.
            tolerance: BECKMANN,
        },
    ]
}
