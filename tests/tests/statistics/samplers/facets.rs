//! Rough surfaces: sampled directions against their density, over roughness, angle, grain and distribution; the energy
//! that they return; reciprocity.

use super::chi_square::{Experiment, direction, numbers, turns};
use glam::DVec3;
use rayon::prelude::*;
use reference::{Facets, random4, sample_cosine_hemisphere};
use scene::Microsurface;
use scene_file::SceneFile;
use std::f64::consts::TAU;
use std::path::Path;

/// Roughness along and across the grain.
const ROUGHNESS: [[f64; 2]; 10] = [
    [0.05, 0.05],
    [0.1, 0.1],
    [0.3, 0.3],
    [0.6, 0.6],
    [1.0, 1.0],
    [0.05, 0.1],
    [0.1, 0.3],
    [0.4, 0.05],
    [0.6, 0.2],
    [0.3, 1.0],
];
const DEGREES: [f64; 5] = [0.0, 30.0, 60.0, 75.0, 85.0];
const DISTRIBUTIONS: [&str; 2] = ["beckmann", "ggx"];

/// Number of chi-square tests in this file.
pub(super) const TESTS: usize = ROUGHNESS.len() * DEGREES.len() * DISTRIBUTIONS.len();

/// Facets as a scene makes them.
fn microsurface(distribution: &str, [along, across]: [f64; 2]) -> Microsurface {
    let roughness = if along == across {
        format!("roughness = {along:?}")
    } else {
        format!("roughness = [{along:?}, {across:?}]\nbrushed = {{ along = [1, 0, 0] }}")
    };
    let text = format!(
        "[camera]\ntype = 'orthographic'\nposition = [0, 0, 1]\nlook_at = [0, 0, 0]\nheight = 1\n\
         [materials.rough]\ntype = 'conductor'\nindex = 'silver'\n{roughness}\ndistribution = '{distribution}'\n"
    );
    let scene = SceneFile::parse("rough", &text, Path::new(""))
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems}"));
    let found = scene.materials()[0].microsurface();
    found.expect("the material is rough").clone()
}

fn each(check: impl Fn(u32, &Microsurface, DVec3) + Sync) {
    let of_distribution = |name| ROUGHNESS.map(|roughness| microsurface(name, roughness));
    let surfaces = DISTRIBUTIONS.map(of_distribution).concat();
    let views = (0..surfaces.len() * DEGREES.len()).into_par_iter();
    views.for_each(|i| {
        let tilt = DEGREES[i % DEGREES.len()].to_radians();
        let surface = &surfaces[i / DEGREES.len()];
        check(1000 + i as u32, surface, direction(tilt.cos(), 0.13));
    });
}

/// Coordinates of a facet: its slope r on the surface of α = 1, as r / (1 + r), and its azimuth.
fn coordinates(surface: &Microsurface, facet: DVec3) -> [f64; 2] {
    let [along, across] = surface.roughness;
    let slope = DVec3::new(facet.x / along, facet.y / across, 0.0) / facet.z;
    let r = slope.length();
    [r / (1.0 + r), turns(slope)]
}

/// The facet with these coordinates, and the solid angle of facets per unit of them.
fn facet_at(surface: &Microsurface, place: f64, turn: f64) -> (DVec3, f64) {
    let [along, across] = surface.roughness;
    let r = place / (1.0 - place);
    let (sine, cosine) = (TAU * turn).sin_cos();
    let facet = DVec3::new(along * r * cosine, across * r * sine, 1.0).normalize();
    let area = along * across * r * TAU / (1.0 - place).powi(2);
    (facet, area * facet.z.powi(3))
}

/// Directions `wi`, by the coordinates of the facets that reflect them into `wo`. Samples below the horizon are counted in the remaining
/// cell. The density is that of the surface `claimed`.
fn scattered(
    surface: &Microsurface,
    claimed: &Microsurface,
    wo: DVec3,
    check: impl Fn(&Experiment),
) {
    let (facets, density_of) = (Facets::new(surface), Facets::new(claimed));
    let choice = std::cell::Cell::new(0_u32);
    let draw = |u: f64, v: f64| {
        choice.set(choice.get() + 1);
        let [pick, ..] = random4([choice.get() % 4096, choice.get() / 4096], 3, 5, 77);
        let wi = facets.sample(wo, [u, v, pick]);
        (wi.z > 0.0).then(|| coordinates(surface, (wo + wi).normalize()))
    };
    let density = |place: f64, turn: f64| {
        let (facet, solid_angle) = facet_at(surface, place, turn);
        let cosine = wo.dot(facet);
        let wi = 2.0 * cosine * facet - wo;
        if cosine <= 0.0 {
            return 0.0;
        }
        let found = density_of.eval(wo, wi);
        found.map_or(0.0, |found| found.pdf * 4.0 * cosine * solid_angle)
    };
    check(&Experiment {
        name: format!(
            "{:?} {:?} from {wo}",
            surface.distribution, surface.roughness
        ),
        ranges: [(0.0, 1.0), (0.0, 1.0)],
        draw: &draw,
        density: &density,
        // The horizon of `wi` runs through cells.
        parts: 4,
        outside: None,
    });
}

#[test]
fn directions_are_sampled_by_their_density() {
    each(|seed, surface, wo| scattered(surface, surface, wo, |right| right.holds(seed)));
}

#[test]
fn directions_of_another_roughness_are_noticed() {
    for (seed, distribution) in (900..).zip(DISTRIBUTIONS) {
        for roughness in [[0.1, 0.1], [0.1, 0.3]] {
            let surface = microsurface(distribution, roughness);
            let claimed = microsurface(distribution, roughness.map(|alpha| 0.93 * alpha));
            let wo = direction(0.5, 0.13);
            scattered(&surface, &claimed, wo, |wrong| wrong.is_refused(seed));
        }
    }
}

/// White furnace by sampling: light reflected by one facet and light reflected by several add up to everything within 0.5 %, for
/// roughness from 0.05 to 1 and angles up to 85°; where much is lost, the first alone does not.
#[test]
fn a_lossless_surface_returns_everything() {
    each(|seed, surface, wo| {
        let facets = Facets::new(surface);
        let (mut sum, mut squares, mut once) = (0.0, 0.0, 0.0);
        let mut count = 0.0;
        for (i, (u, v)) in (0..).zip(numbers(seed)) {
            let [pick, ..] = random4([i % 512, i / 512], 1, 5, seed);
            let wi = facets.sample(wo, [u, v, pick]);
            count += 1.0;
            if let Some(found) = facets.eval(wo, wi) {
                let weight = (found.single + found.multiple) / found.pdf;
                sum += weight;
                squares += weight * weight;
                once += found.single / found.pdf;
            }
        }
        let mean = sum / count;
        let error = ((squares / count - mean * mean) / count).sqrt();
        let name = format!("{:?} {:?} {wo}", surface.distribution, surface.roughness);
        assert!(
            (mean - 1.0).abs() < 0.005 + 4.5 * error,
            "{name}: {mean} ± {error}"
        );
        assert!(error < 0.0025, "{name}: {mean} ± {error}");
        if surface.roughness == [1.0, 1.0] {
            assert!(once / count < 0.99, "{name}: {once}");
        }
    });
}

/// f(wo, wi) = f(wi, wo) within 1e-5, for both parts; multiplied by a cosine this fails, which shows that the test can fail.
#[test]
fn rough_surfaces_are_reciprocal() {
    let mut lopsided = 0;
    for distribution in DISTRIBUTIONS {
        for roughness in ROUGHNESS {
            let surface = microsurface(distribution, roughness);
            let facets = Facets::new(&surface);
            for ((u1, v1), (u2, v2)) in numbers(71).zip(numbers(72)).take(2000) {
                let a = sample_cosine_hemisphere(u1, v1);
                let b = sample_cosine_hemisphere(u2, v2);
                let (Some(there), Some(back)) = (facets.eval(a, b), facets.eval(b, a)) else {
                    continue;
                };
                for (there, back) in [(there.single, back.single), (there.multiple, back.multiple)]
                {
                    let (f, g) = (there / b.z, back / a.z);
                    assert!(
                        (f - g).abs() <= 1e-5 * f + 1e-30,
                        "{a} {b} {roughness:?}: {f} {g}"
                    );
                    lopsided += u32::from((there - back).abs() > 1e-5 * there);
                }
            }
        }
    }
    assert!(lopsided > 2000);
}
